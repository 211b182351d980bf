//! Places in an input, and a file opened anew at one.

use super::compressed::{decompressed, is_plain};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// A place in an input, before a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::scene) struct Place {
    pub(super) offset: u64,
    pub(super) number: usize,
}

/// The same open file, if it is not compressed.
///
/// # Errors
/// What the system says.
pub(super) fn uncompressed(file: &File) -> io::Result<Option<File>> {
    is_plain(file)?.then(|| file.try_clone()).transpose()
}

/// What follows `offset` bytes of the file, unpacked if it is compressed, and the open file if it is not.
///
/// # Errors
/// What the system says, or the unpacking.
pub(super) fn open_at(
    path: &Path,
    offset: u64,
) -> io::Result<(Box<dyn Read + Send>, Option<File>)> {
    let mut file = File::open(path)?;
    if let Some(plain) = uncompressed(&file)? {
        io::Seek::seek(&mut file, io::SeekFrom::Start(offset))?;
        return Ok((Box::new(file), Some(plain)));
    }
    let mut reader = decompressed(Box::new(file))?;
    io::copy(&mut reader.by_ref().take(offset), &mut io::sink())?;
    Ok((reader, None))
}
