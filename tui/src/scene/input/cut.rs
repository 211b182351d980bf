//! A file that is written anew while it is followed: cut and copied over again, or another one under its name.

use super::{Input, Place};
use crate::scene::read_error::ReadError;
use std::os::unix::fs::{FileExt, MetadataExt};

/// How many bytes before a place tell whether a file is still the same there.
const TELLING: u64 = 64;

impl Input {
    /// Whether the file is as long again as up to `last`; of a compressed one that is not known.
    ///
    /// It is opened anew at `place` if it is shorter than what has been read, or another file is there now.
    ///
    /// # Errors
    /// As [`Self::go_anew`].
    pub(in crate::scene) fn reaches(
        &mut self,
        last: Place,
        place: Place,
    ) -> Result<bool, ReadError> {
        let there = self.file.as_ref().and_then(|path| path.metadata().ok());
        let open = self.plain.as_ref().and_then(|file| file.metadata().ok());
        let (Some(there), Some(open)) = (there, open) else { return Ok(true) };
        let read = last.offset.max(self.before + self.end as u64);
        let is_other = (there.dev(), there.ino()) != (open.dev(), open.ino());
        // What was empty may be compressed by now.
        if is_other || there.len() < read || read == 0 {
            self.go_anew(place)?;
        }
        Ok(there.len() >= last.offset)
    }

    /// The last bytes before a place, as they are in the file now; none if it is compressed or shorter.
    pub(in crate::scene) fn bytes_before(&self, place: Place) -> Option<Vec<u8>> {
        let mut bytes = vec![0; place.offset.min(TELLING) as usize];
        let from = place.offset - bytes.len() as u64;
        self.plain.as_ref()?.read_exact_at(&mut bytes, from).ok()?;
        Some(bytes)
    }
}
