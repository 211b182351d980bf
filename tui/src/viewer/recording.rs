//! What the viewer shows, recorded: kept until it ends, then written in one piece.

use crate::cast::Cast;
use crate::cells::CellGrid;
use crate::encode::Economy;
use crate::error::signal::within;
use crate::whole_file::synced;
use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tempfile::NamedTempFile;

/// A recording takes no more memory than this: then it ends by itself.
const MOST_BYTES: usize = 256 << 20;
/// The most recordings of one scene in a folder.
const MOST_NAMES: u32 = 10_000;
/// How long a slow disk may hold up the end of the process: more than most take for a full recording.
const PATIENCE: Duration = Duration::from_secs(5);

/// A recording that goes on.
#[derive(Debug)]
pub(super) struct Recording {
    name: String,
    cast: Cast,
    since: Instant,
    text: Vec<u8>,
    frames: u32,
}

impl Recording {
    /// Begins now; its file will be called `name` and a number.
    ///
    /// # Errors
    /// If no file can be made in this folder whose name is as long as those of [`write`](Recording::write): all would be lost at the end.
    pub(super) fn begin(name: &str, now: Instant) -> io::Result<Self> {
        // One with a name: in a folder that was removed there may be others.
        NamedTempFile::with_prefix_in(format!("{name}-"), ".")?;
        Ok(Self {
            name: name.to_owned(),
            cast: Cast::default(),
            since: now,
            text: Vec::new(),
            frames: 0,
        })
    }

    /// Takes note of what is shown from `now` on.
    pub(super) fn frame(&mut self, cells: &CellGrid, now: Instant, economy: Economy) {
        let seconds = (now - self.since).as_secs_f64();
        // Writing to a vector cannot fail.
        let _ = self.cast.frame(cells, seconds, economy, &mut self.text);
        self.frames += 1;
    }

    /// Whether it is as long as it may be.
    pub(super) fn is_full(&self) -> bool {
        self.text.len() >= MOST_BYTES
    }

    /// Whether anything was shown: without a frame there is nothing to play.
    pub(super) fn has_frames(&self) -> bool {
        self.frames > 0
    }

    /// Ends, and writes a file that is called by its name and a number, in this folder; returns what it is called, and how many
    /// frames are in it.
    ///
    /// # Errors
    /// Says what it would have been called, and why it cannot be written; then there is no file.
    pub(super) fn write(mut self, now: Instant) -> Result<(PathBuf, u32), (PathBuf, io::Error)> {
        let seconds = (now - self.since).as_secs_f64();
        let _ = self.cast.end(seconds, &mut self.text);
        let numbered = |number: u32| PathBuf::from(format!("{}-{number}.cast", self.name));
        let mut number = 1;
        while number < MOST_NAMES && numbered(number).exists() {
            number += 1;
        }
        let file = self.write_unfinished().map_err(|error| (numbered(number), error))?;
        // Another program may have made a file meanwhile.
        let path = loop {
            let path = numbered(number);
            match File::create_new(&path) {
                Ok(_) => break path,
                Err(error)
                    if error.kind() == io::ErrorKind::AlreadyExists && number < MOST_NAMES =>
                {
                    number += 1;
                }
                Err(error) => return Err((path, error)),
            }
        };
        match file.persist(&path) {
            Ok(_) => Ok((path, self.frames)),
            Err(error) => {
                let _ = fs::remove_file(&path);
                Err((path, error.error))
            }
        }
    }

    /// Writes all of it under another name.
    fn write_unfinished(&self) -> io::Result<NamedTempFile> {
        // As any new file: the system takes away what the user's mask says.
        let mode = Permissions::from_mode(0o666);
        let mut file =
            tempfile::Builder::new().prefix(".spherule-").permissions(mode).tempfile_in(".")?;
        *unfinished() = Some(file.path().to_owned());
        file.write_all(&self.text)?;
        synced(file.as_file())?;
        Ok(file)
    }
}

/// The recording that goes on. While it is written it is held.
pub(super) fn current() -> MutexGuard<'static, Option<Recording>> {
    static CURRENT: Mutex<Option<Recording>> = Mutex::new(None);
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The other name of the file that was written last.
fn unfinished() -> MutexGuard<'static, Option<PathBuf>> {
    static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the recording, if there is one, and writes its file, for whoever ends the process. A disk that takes longer than
/// [`PATIENCE`] keeps nothing of it.
pub(super) fn keep() {
    within(PATIENCE, || {
        let mut current = current();
        if let Some(recording) = current.take().filter(Recording::has_frames) {
            // No one is there to be told.
            let _ = recording.write(Instant::now());
        }
    });
    // If it has its own name by now, there is no such file.
    if let Some(path) = unfinished().take() {
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_without_a_frame_leaves_no_file() {
        let name = format!("spherule-kept-{}", std::process::id());
        let file = format!("{name}-1.cast");
        for frames in [0, 1] {
            let mut recording = Recording::begin(&name, Instant::now()).expect("a folder");
            for _ in 0..frames {
                recording.frame(&CellGrid::new(2, 1), Instant::now(), Economy::NONE);
            }
            *current() = Some(recording);
            keep();
            let text = fs::read_to_string(&file).ok();
            assert_eq!(text.as_ref().map_or(0, |text| text.lines().count()), 3 * frames);
            let _ = fs::remove_file(&file);
        }
    }
}
