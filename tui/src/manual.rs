//! `spherule generate`: man pages and completions, made from the command line as it is defined.

use crate::arguments::Arguments;
use crate::error::{Error, cause};
use clap::{Arg, ArgAction, Command, CommandFactory, value_parser};
use clap_complete::Shell;
use std::fs::{self, create_dir_all};
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
        let path = clap_complete::generate_to(shell, &mut visible(), "spherule", &completions)?;
        if shell == Shell::Bash {
            fs::write(&path, with_files(&fs::read_to_string(&path)?))?;
        }
    }
    Ok(())
}

/// The command line without its hidden parts, which completions would offer.
fn visible() -> Command {
    let all = Arguments::command();
    Command::new("spherule")
        .version(env!("CARGO_PKG_VERSION"))
        .disable_help_subcommand(true)
        .args(all.get_arguments().cloned().map(completed))
        .subcommands(all.get_subcommands().filter(|command| !command.is_hide_set()).cloned())
}

/// An option as it is completed: `clap_complete` offers values behind a space where only those behind a `=` are taken.
fn completed(option: Arg) -> Arg {
    if !option.is_require_equals_set() {
        return option;
    }
    option
        .require_equals(false)
        .num_args(0)
        .action(ArgAction::SetTrue)
        .value_parser(value_parser!(bool))
        .default_value(None::<&str>)
        .default_missing_value(None::<&str>)
}

/// The completions of bash, with files beside commands: the first word may be a scene.
fn with_files(completions: &str) -> String {
    let first_word = "${COMP_CWORD} -eq 1 ]] ; then\n";
    let words = r#"                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )"#;
    let files = r#"
                local IFS=$'\n'
                COMPREPLY+=( $(compgen -f -- "${cur}") )
                if [[ "${BASH_VERSINFO[0]}" -ge 4 ]]; then
                    compopt -o filenames
                fi"#;
    let commands = format!("{first_word}{words}");
    completions.replacen(&commands, &format!("{commands}{files}"), 1)
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
    fn bash_offers_files_and_only_what_is_taken() {
        let folder = tempfile::tempdir().expect("a folder");
        generate(folder.path()).expect("it can be written");
        fs::write(folder.path().join("scene.toml"), "").expect("a file");
        let script = "source completions/spherule.bash; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1))
            _spherule spherule \"${!#}\" \"${@:$#-1:1}\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
        // For the last of the words.
        let offered = |words: &[&str]| {
            let mut bash = std::process::Command::new("bash");
            let bash = bash.args(["-c", script, "bash", "spherule"]).args(words);
            let output = bash.current_dir(folder.path()).output().ok()?;
            Some(String::from_utf8(output.stdout).expect("text"))
        };
        // Not every machine has bash.
        let Some(first) = offered(&["sc"]) else { return };
        assert_eq!(first, "scenes\nscene.toml\n");
        assert_eq!(offered(&["--accuracy", "st"]).as_deref(), Some("stable\n"));
        assert_eq!(offered(&["unit", "--occlusion", "o"]).as_deref(), Some("\n"));
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_named() {
        let error = generate(Path::new("/dev/null/nowhere")).expect_err("no folder");
        assert!(matches!(error, Error::Running(why) if why.starts_with("/dev/null/nowhere: ")));
    }
}
