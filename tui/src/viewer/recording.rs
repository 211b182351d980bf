//! What the viewer shows, recorded: kept until it ends, then written in one piece.

use crate::cast::Cast;
use crate::cells::CellGrid;
use crate::encode::Economy;
use crate::whole_file::synced;
use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;
use tempfile::NamedTempFile;

/// A recording takes no more memory than this: then it ends by itself.
const MOST_BYTES: usize = 256 << 20;
/// The most recordings of one scene in a folder.
const MOST_NAMES: u32 = 10_000;

/// A recording that goes on.
#[derive(Debug)]
pub(super) struct Recording {
    cast: Cast,
    since: Instant,
    text: Vec<u8>,
    frames: u32,
}

impl Recording {
    /// Begins now.
    ///
    /// # Errors
    /// If no file can be made in this folder whose name is as long as those of [`write`](Recording::write): all would be lost at the end.
    pub(super) fn begin(name: &str, now: Instant) -> io::Result<Self> {
        // One with a name: in a folder that was removed there may be others.
        NamedTempFile::with_prefix_in(format!("{name}-"), ".")?;
        Ok(Self { cast: Cast::default(), since: now, text: Vec::new(), frames: 0 })
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

    /// Ends, and writes a file that is called `name` and a number, in this folder; returns what it is called, and how many
    /// frames are in it.
    ///
    /// # Errors
    /// Says what it would have been called, and why it cannot be written; then there is no file.
    pub(super) fn write(
        mut self,
        name: &str,
        now: Instant,
    ) -> Result<(PathBuf, u32), (PathBuf, io::Error)> {
        let seconds = (now - self.since).as_secs_f64();
        let _ = self.cast.end(seconds, &mut self.text);
        let mut number = 1;
        let (path, mut file) = loop {
            let path = PathBuf::from(format!("{name}-{number}.cast"));
            match File::create_new(&path) {
                Ok(file) => break (path, file),
                Err(error)
                    if error.kind() == io::ErrorKind::AlreadyExists && number < MOST_NAMES =>
                {
                    number += 1;
                }
                Err(error) => return Err((path, error)),
            }
        };
        match file.write_all(&self.text).and_then(|()| synced(&file)) {
            Ok(()) => Ok((path, self.frames)),
            Err(error) => {
                let _ = std::fs::remove_file(&path);
                Err((path, error))
            }
        }
    }
}
