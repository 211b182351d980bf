//! Outputs that would destroy each other, or an input: they are refused before anything is written.

use super::place::place;
use crate::error::Error;
use std::fs::{self, File, Metadata};
use std::io;
use std::os::fd::AsFd;
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

/// Refuses an output that another one replaces, or that replaces an input. Each has its option, or another name for the user, before
/// the file. Standard output takes one array; a device, such as `/dev/null`, takes all.
///
/// # Errors
/// [`Error::Input`], which names both.
pub fn check_outputs(outputs: &[(&str, &Path)], inputs: &[(&str, &Path)]) -> Result<(), Error> {
    for (index, &(option, output)) in outputs.iter().enumerate() {
        let before = &outputs[..index];
        let own = replaced(output);
        let other = before.iter().find(|(_, other)| {
            own.is_some() && replaced(other) == own || is_stdout(output) && is_stdout(other)
        });
        let what = match (other, own) {
            (Some((other, _)), _) => format!("{other} has that file"),
            (None, Some(file)) => match inputs.iter().find(|(_, input)| place(input) == file) {
                Some((input, _)) => format!("{input} is read from that file"),
                None => continue,
            },
            (None, None) => continue,
        };
        return Err(Error::Input(format!("{option} {}: {what}; name another", output.display())));
    }
    Ok(())
}

/// The file that an output replaces, or makes; `None` if it is written in place.
fn replaced(output: &Path) -> Option<PathBuf> {
    let is_in_place =
        output == Path::new("-") || fs::metadata(output).is_ok_and(|data| !data.is_file());
    (!is_in_place).then(|| place(output))
}

/// Whether an output is what standard output is, by whatever name; except a device.
#[must_use]
pub fn is_stdout(output: &Path) -> bool {
    let is_same = |output: Metadata, stdout: Metadata| {
        (output.dev(), output.ino()) == (stdout.dev(), stdout.ino())
            && !stdout.file_type().is_char_device()
    };
    output == Path::new("-")
        || fs::metadata(output)
            .is_ok_and(|output| stdout_metadata().is_ok_and(|stdout| is_same(output, stdout)))
}

fn stdout_metadata() -> io::Result<Metadata> {
    File::from(io::stdout().as_fd().try_clone_to_owned()?).metadata()
}
