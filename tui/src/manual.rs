//! `spherule generate`: man pages and completions, made from the command line as it is defined.

use crate::arguments::Arguments;
use crate::error::{Error, cause};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use std::fs::create_dir_all;
use std::io;
use std::path::Path;

/// The shells that have completions.
const SHELLS: [Shell; 3] = [Shell::Bash, Shell::Zsh, Shell::Fish];

/// Writes `man/` and `completions/` into `folder`, with a page for every subcommand.
///
/// # Errors
/// [`Error::Running`] if a file cannot be written.
pub fn generate(folder: &Path) -> Result<(), Error> {
    write(folder)
        .map_err(|error| Error::Running(format!("{}: {}", folder.display(), cause(&error))))
}

fn write(folder: &Path) -> io::Result<()> {
    let [man, completions] = ["man", "completions"].map(|name| folder.join(name));
    create_dir_all(&man)?;
    create_dir_all(&completions)?;
    clap_mangen::generate_to(Arguments::command(), man)?;
    for shell in SHELLS {
        clap_complete::generate_to(shell, &mut visible(), "spherule", &completions)?;
    }
    Ok(())
}

/// The command line without its hidden parts, which completions would offer.
fn visible() -> Command {
    let all = Arguments::command();
    Command::new("spherule")
        .version(env!("CARGO_PKG_VERSION"))
        .disable_help_subcommand(true)
        .args(all.get_arguments().cloned())
        .subcommands(all.get_subcommands().filter(|command| !command.is_hide_set()).cloned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{read_dir, read_to_string};
    use std::path::PathBuf;

    fn files(folder: &Path) -> Vec<(PathBuf, String)> {
        let mut found: Vec<_> = ["man", "completions"]
            .iter()
            .flat_map(|name| read_dir(folder.join(name)).expect(name))
            .map(|entry| entry.expect("an entry").path())
            .map(|path| {
                let text = read_to_string(&path).expect("text");
                (path.strip_prefix(folder).expect("below").to_owned(), text)
            })
            .collect();
        found.sort();
        found
    }

    /// The packed files say what the command line says: `cargo run -p spherule -- generate tui` writes them anew.
    #[test]
    fn the_packed_pages_are_those_of_the_command_line() {
        let folder = tempfile::tempdir().expect("a folder");
        generate(folder.path()).expect("it can be written");
        let (made, packed) = (files(folder.path()), files(Path::new(env!("CARGO_MANIFEST_DIR"))));
        assert!(made.len() >= 8, "{}", made.len());
        assert!(!made.iter().any(|(_, text)| text.contains("generate")), "it is hidden");
        assert!(made == packed, "stale: cargo run -p spherule -- generate tui");
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let error = generate(Path::new("/dev/null/nowhere")).expect_err("no folder");
        assert!(matches!(error, Error::Running(why) if why.starts_with("/dev/null/nowhere: ")));
    }
}
