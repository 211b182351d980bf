//! A file that is there whole or not at all.
//!
//! It is written under another name in the same folder, and renamed when it is done. Whatever is no file, such as a
//! device or a pipe, is written in place.

mod outputs;
mod place;
mod watch;

pub use outputs::{check_outputs, is_stdout};
pub use watch::Watch;

use crate::error::stdout::Stdout;
use place::place;
use rustix::io::Errno;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, Write};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A file that is being written.
#[derive(Debug)]
pub enum WholeFile {
    /// Standard output.
    Stdout(Stdout),
    /// What else is no file.
    InPlace(File),
    /// Under its other name.
    Unfinished {
        /// Removed when it is dropped.
        file: NamedTempFile,
        /// The name to be.
        name: PathBuf,
        /// Until then a signal removes the file, too.
        watch: Watch,
    },
}

impl WholeFile {
    /// Creates a file that will be called `name`; `-` is standard output. If there is a file of that name, it stays
    /// until the new one is whole, which has its mode, and its group as far as the user may give it that.
    ///
    /// # Errors
    /// If it cannot be made, or the file that is there cannot be written to.
    pub fn create(name: &Path) -> io::Result<Self> {
        if name == Path::new("-") {
            return Ok(Self::Stdout(Stdout));
        }
        // As it was named: a pipe, which `/dev/stdout` may be, has no place.
        let old = match fs::metadata(name) {
            Ok(data) if data.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(data) if !data.is_file() => {
                return Ok(Self::InPlace(OpenOptions::new().write(true).open(name)?));
            }
            Ok(data) => {
                // Who may not write to a file may not replace it, even if the folder is theirs.
                OpenOptions::new().write(true).open(name)?;
                Some(data)
            }
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            Err(_) if names_folder(name) => return Err(io::ErrorKind::NotADirectory.into()),
            Err(_) => None,
        };
        // The file that a symbolic link leads to, not the link.
        let name = place(name);
        let folder = name.parent().filter(|folder| !folder.as_os_str().is_empty());
        // As any new file: the system takes away what the user's mask says. One that replaces another is the user's
        // alone until it is open to those who might read the other.
        let mode = if old.is_some() { 0o600 } else { 0o666 };
        let (watch, file) = Watch::over(|| {
            tempfile::Builder::new()
                .prefix(".spherule-")
                .permissions(Permissions::from_mode(mode))
                .tempfile_in(folder.unwrap_or_else(|| Path::new(".")))
        })?;
        if let Some(old) = old {
            // The group first: bits of the mode are lost with another.
            let _ = fchown(file.as_file(), None, Some(old.gid()));
            file.as_file().set_permissions(old.permissions())?;
        }
        Ok(Self::Unfinished { file, name, watch })
    }

    /// Sees to it that all that has been written is on the disk.
    ///
    /// # Errors
    /// If it is not: a disk over a network may be full only now.
    pub fn written(&self) -> io::Result<()> {
        match self {
            Self::Stdout(_) | Self::InPlace(_) => Ok(()),
            Self::Unfinished { file, .. } => synced(file.as_file()),
        }
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// If not all of it is on the disk, or it cannot be renamed: then it is removed.
    pub fn finish(self) -> io::Result<()> {
        self.written()?;
        match self {
            Self::Stdout(_) | Self::InPlace(_) => Ok(()),
            Self::Unfinished { file, name, watch: _watch } => {
                file.persist(name).map(|_| ()).map_err(|error| error.error)
            }
        }
    }

    fn output(&mut self) -> &mut dyn Write {
        match self {
            Self::Stdout(stdout) => stdout,
            Self::InPlace(file) => file,
            Self::Unfinished { file, .. } => file.as_file_mut(),
        }
    }
}

/// Sees to it that all of `file` is on the disk. Volumes of other machines and programs may not be able to, which macOS tells: there it
/// is enough that all is written.
///
/// # Errors
/// If it is not.
pub fn synced(file: &File) -> io::Result<()> {
    file.sync_all().or_else(unless_impossible)
}

/// Returns `error` unless it says that a volume cannot do what is asked for.
fn unless_impossible(error: io::Error) -> io::Result<()> {
    let is_possible = |errno| ![Errno::INVAL, Errno::NOTSUP, Errno::OPNOTSUPP].contains(&errno);
    if Errno::from_io_error(&error).is_none_or(is_possible) { Err(error) } else { Ok(()) }
}

/// Whether only a folder may have this name. (A [`Path`] leaves such an end out.)
fn names_folder(name: &Path) -> bool {
    let name = name.as_os_str().as_bytes();
    name.ends_with(b"/") || name.ends_with(b"/.")
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.output().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_that_cannot_tell_has_what_is_written() {
        let is_well = |errno: Errno| unless_impossible(errno.into()).is_ok();
        assert_eq!([Errno::INVAL, Errno::NOTSUP, Errno::OPNOTSUPP].map(is_well), [true; 3]);
        assert_eq!([Errno::NOSPC, Errno::DQUOT, Errno::IO].map(is_well), [false; 3]);
        assert!(unless_impossible(io::ErrorKind::WriteZero.into()).is_err());
    }
}
