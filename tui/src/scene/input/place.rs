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

/// What follows `offset` bytes of the file, unpacked if it is compressed.
///
/// # Errors
/// What the system says, or the unpacking.
pub(super) fn open_at(path: &Path, offset: u64) -> io::Result<Box<dyn Read + Send>> {
    let mut file = File::open(path)?;
    if is_plain(&file)? {
        io::Seek::seek(&mut file, io::SeekFrom::Start(offset))?;
        return Ok(Box::new(file));
    }
    let mut reader = decompressed(Box::new(file))?;
    io::copy(&mut reader.by_ref().take(offset), &mut io::sink())?;
    Ok(reader)
}
