//! What gzip and bzip2 have compressed, told by its first bytes.
//!
//! A small file may claim to hold anything, so data that grows more than real data does is refused.

mod members;

use bzip2::read::MultiBzDecoder;
use members::Members;
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::os::unix::fs::FileExt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Data that grows to more than so many times its size is refused ...
const LARGEST_GROWTH: u64 = 200;
/// ... if it is longer than this.
const ALWAYS_READ: u64 = 32 << 20;

/// What is in `reader`.
///
/// # Errors
/// If it cannot be read.
pub(super) fn decompressed(mut reader: Box<dyn Read + Send>) -> io::Result<Box<dyn Read + Send>> {
    let mut head = Vec::new();
    reader.by_ref().take(MAGIC as u64).read_to_end(&mut head)?;
    let (gz, bz) = (is_gz(&head), is_bz(&head));
    let all = Cursor::new(head).chain(reader);
    if !gz && !bz {
        return Ok(Box::new(all));
    }
    let taken = Arc::new(AtomicU64::new(0));
    let counted = Counted { reader: all, taken: Arc::clone(&taken) };
    let reader: Box<dyn Read + Send> =
        if gz { Box::new(Members::new(counted)) } else { Box::new(MultiBzDecoder::new(counted)) };
    Ok(Box::new(Bounded { reader, taken, given: 0 }))
}

/// How many bytes tell the compression.
const MAGIC: usize = 10;

fn is_gz(head: &[u8]) -> bool {
    head.starts_with(b"\x1f\x8b\x08")
}

/// `BZh`, the size of blocks, and the number of a block, or of the end.
fn is_bz(head: &[u8]) -> bool {
    head.starts_with(b"BZh")
        && matches!(head.get(4..), Some(b"\x31\x41\x59\x26\x53\x59" | b"\x17\x72\x45\x38\x50\x90"))
}

/// Whether the file is not compressed.
///
/// # Errors
/// If it cannot be read.
pub(super) fn is_plain(file: &File) -> io::Result<bool> {
    let mut head = [0; MAGIC];
    let read = file.read_at(&mut head, 0)?;
    Ok(!is_gz(&head[..read]) && !is_bz(&head[..read]))
}

/// Counts what is taken of the compressed data.
struct Counted<R> {
    reader: R,
    taken: Arc<AtomicU64>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(bytes)?;
        self.taken.fetch_add(read as u64, Relaxed);
        Ok(read)
    }
}

struct Bounded {
    reader: Box<dyn Read + Send>,
    taken: Arc<AtomicU64>,
    given: u64,
}

impl Read for Bounded {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(bytes).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => {
                io::Error::new(error.kind(), "the compressed data ends early")
            }
            kind => io::Error::new(kind, format!("the compressed data is damaged: {error}")),
        })?;
        self.given += read as u64;
        if self.given > ALWAYS_READ && self.given / LARGEST_GROWTH > self.taken.load(Relaxed) {
            let what =
                format!("compressed data that grows to more than {LARGEST_GROWTH} times its size");
            return Err(io::Error::other(what));
        }
        Ok(read)
    }
}
