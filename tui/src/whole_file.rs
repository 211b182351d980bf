//! A file that is there whole or not at all.
//!
//! It is written under another name in the same folder, and renamed when it is done. Whatever is no file, such as a
//! device or a pipe, is written in place.

use crate::error::stdout::Stdout;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::{Handle, Signals};
use signal_hook::low_level::emulate_default_handler;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::thread;
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
    /// until the new one is whole, which has its mode.
    ///
    /// # Errors
    /// If it cannot be made, or the file that is there cannot be written to.
    pub fn create(name: &Path) -> io::Result<Self> {
        if name == Path::new("-") {
            return Ok(Self::Stdout(Stdout));
        }
        // The file that a symbolic link leads to, not the link.
        let name = fs::canonicalize(name).unwrap_or_else(|_| name.to_owned());
        let old = match fs::metadata(&name) {
            Ok(data) if data.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(data) if !data.is_file() => {
                return Ok(Self::InPlace(OpenOptions::new().write(true).open(name)?));
            }
            Ok(data) => {
                // Who may not write to a file may not replace it, even if the folder is theirs.
                OpenOptions::new().write(true).open(&name)?;
                Some(data.permissions())
            }
            Err(_) => None,
        };
        let folder = name.parent().filter(|folder| !folder.as_os_str().is_empty());
        // As any new file: the system takes away what the user's mask says. One that replaces another is the user's
        // alone until it is open to those who might read the other.
        let mode = if old.is_some() { 0o600 } else { 0o666 };
        let file = tempfile::Builder::new()
            .prefix(".spherule-")
            .permissions(Permissions::from_mode(mode))
            .tempfile_in(folder.unwrap_or_else(|| Path::new(".")))?;
        if let Some(old) = old {
            file.as_file().set_permissions(old)?;
        }
        let watch = Watch::new(file.path().to_owned())?;
        Ok(Self::Unfinished { file, name, watch })
    }

    /// Sees to it that all that has been written is on the disk.
    ///
    /// # Errors
    /// If it is not: a disk over a network may be full only now.
    pub fn written(&self) -> io::Result<()> {
        match self {
            Self::Stdout(_) | Self::InPlace(_) => Ok(()),
            Self::Unfinished { file, .. } => file.as_file().sync_all(),
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

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.output().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Removes a file if the user or the system ends the process.
#[derive(Debug)]
pub struct Watch {
    signals: Handle,
}

impl Watch {
    fn new(path: PathBuf) -> io::Result<Self> {
        let hang_up = if is_ignored(SIGHUP) { None } else { Some(SIGHUP) };
        let mut signals = Signals::new([SIGINT, SIGTERM].into_iter().chain(hang_up))?;
        let handle = signals.handle();
        thread::Builder::new().name("signals".into()).spawn(move || {
            if let Some(signal) = signals.forever().next() {
                let _ = fs::remove_file(path);
                let _ = emulate_default_handler(signal);
            }
        })?;
        Ok(Self { signals: handle })
    }
}

/// Whether whoever started the process wants a signal to do nothing, as `nohup` does with SIGHUP: a handler would undo
/// that. Linux tells; on other systems it is assumed.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.signals.close();
    }
}
