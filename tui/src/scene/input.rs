//! The bytes of a scene, from a file or a pipe, as they are or decompressed: line by line, or as they come.
//!
//! Memory does not grow with the input: a line is borrowed from the buffer, and none may be longer than
//! [`LONGEST_LINE`]. Places are remembered, so that a frame can be read again.

mod compressed;

use super::read_error::ReadError;
use crate::error::cause;
use compressed::decompressed;
use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;

/// The longest line, in bytes: a million columns have room.
pub(super) const LONGEST_LINE: usize = 16 << 20;

/// What is read at once, at least.
const BLOCK: usize = 256 << 10;

/// How much of an input is looked at to tell what it is.
const HEAD: usize = 64 << 10;

/// A place in an input, before a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Place {
    offset: u64,
    number: usize,
}

/// An input that is being read.
pub(super) struct Input {
    reader: Box<dyn Read + Send>,
    /// Where it can be opened again.
    file: Option<PathBuf>,
    source: Box<str>,
    /// What has been read and not yet been taken is in `start..end`.
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    /// The bytes before the buffer.
    before: u64,
    /// Lines taken.
    number: usize,
    /// Where the last one began.
    last: Place,
    /// Whether the last line had an end.
    terminated: bool,
}

impl std::fmt::Debug for Input {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Input").field("source", &self.source).finish_non_exhaustive()
    }
}

/// A line, and where it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// Without its end; the first without a byte order mark.
    pub(super) bytes: &'a [u8],
    /// From 1.
    pub(super) number: usize,
    source: &'a str,
}

impl<'a> Line<'a> {
    /// Something is wrong at this byte of it.
    pub(super) fn error(&self, byte: usize, what: impl Into<String>) -> ReadError {
        let before = self.bytes.get(..byte).unwrap_or(self.bytes);
        let column = String::from_utf8_lossy(before).chars().count() + 1;
        ReadError::at(self.source, self.number, column, what)
    }

    /// Without white space at both ends.
    pub(super) fn trimmed(&self) -> &'a [u8] {
        self.bytes.trim_ascii()
    }
}

impl Input {
    /// A file, opened.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn of_file(file: File, path: PathBuf, source: &str) -> Result<Self, ReadError> {
        let mut input = Self::of_reader(Box::new(file), source)?;
        input.file = Some(path);
        Ok(input)
    }

    /// Anything else: it is read once.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn of_reader(reader: Box<dyn Read + Send>, source: &str) -> Result<Self, ReadError> {
        let reader = decompressed(reader);
        let reader = reader.map_err(|error| ReadError::whole(source, cause(&error)))?;
        Ok(Self {
            reader,
            file: None,
            source: source.into(),
            buffer: Vec::new(),
            start: 0,
            end: 0,
            before: 0,
            number: 0,
            last: Place::default(),
            terminated: true,
        })
    }

    /// The bytes of the buffer.
    #[cfg(test)]
    pub(super) fn room(&self) -> usize {
        self.buffer.len()
    }

    /// The name of the input in errors.
    pub(super) fn source(&self) -> &str {
        &self.source
    }

    /// Where it can be opened again: not a pipe.
    pub(super) fn can_be_read_again(&self) -> bool {
        self.file.is_some()
    }

    /// The beginning of what has not been taken, enough to tell what it is.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn head(&mut self) -> Result<&[u8], ReadError> {
        while self.end - self.start < HEAD && self.fill()? {}
        Ok(&self.buffer[self.start..self.end.min(self.start + HEAD)])
    }

    /// Reads more; `false` if there is none.
    fn fill(&mut self) -> Result<bool, ReadError> {
        if self.start > 0 {
            self.buffer.copy_within(self.start..self.end, 0);
            self.before += self.start as u64;
            (self.start, self.end) = (0, self.end - self.start);
        }
        if self.buffer.len() - self.end < BLOCK {
            self.buffer.resize((2 * self.buffer.len()).max(2 * BLOCK), 0);
        }
        loop {
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(read) => {
                    self.end += read;
                    return Ok(read > 0);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(self.failed(&error)),
            }
        }
    }

    fn failed(&self, error: &io::Error) -> ReadError {
        let wrong = ReadError::at(&self.source, self.number + 1, 1, cause(error));
        if error.kind() == io::ErrorKind::UnexpectedEof { wrong.of_end() } else { wrong }
    }

    /// The next line; `None` after the last.
    ///
    /// # Errors
    /// [`ReadError`] if reading fails, or the line is longer than [`LONGEST_LINE`].
    pub(super) fn line(&mut self) -> Result<Option<Line<'_>>, ReadError> {
        let mut searched = 0;
        let length = loop {
            let rest = &self.buffer[self.start + searched..self.end];
            if let Some(length) = memchr::memchr(b'\n', rest) {
                break searched + length;
            }
            searched += rest.len();
            if searched > LONGEST_LINE {
                let what = format!("a line of more than {} MiB", LONGEST_LINE >> 20);
                return Err(ReadError::at(&self.source, self.number + 1, 1, what));
            }
            if !self.fill()? {
                if searched == 0 {
                    return Ok(None);
                }
                break searched;
            }
        };
        self.last = self.place();
        let end = self.start + length;
        self.terminated = end < self.end;
        let mut bytes = &self.buffer[self.start..end];
        self.start = end + usize::from(self.terminated);
        self.number += 1;
        if let Some(without) = bytes.strip_suffix(b"\r") {
            bytes = without;
        }
        if self.number == 1 {
            bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        }
        Ok(Some(Line { bytes, number: self.number, source: &self.source }))
    }

    /// The next line, which there must be: else the input ends before `what`.
    ///
    /// # Errors
    /// As [`Self::line`], and if there is none.
    pub(super) fn expect(&mut self, what: &str) -> Result<Line<'_>, ReadError> {
        if self.is_over()? {
            return Err(self.ends(format!("the file ends before {what}")));
        }
        let ends = ReadError::whole(&self.source, "the file ends");
        self.line()?.ok_or(ends)
    }

    /// It ends too early.
    pub(super) fn ends(&self, what: impl Into<String>) -> ReadError {
        ReadError::at(&self.source, self.number + 1, 1, what).of_end()
    }

    /// Whether nothing is left.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn is_over(&mut self) -> Result<bool, ReadError> {
        Ok(self.start == self.end && !self.fill()?)
    }

    /// Leaves out blank lines; whether nothing is left.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn is_over_but_blanks(&mut self) -> Result<bool, ReadError> {
        while let Some(line) = self.line()? {
            if !line.trimmed().is_empty() {
                self.give_back();
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the last line had an end: one that is still being written has none.
    pub(super) fn is_terminated(&self) -> bool {
        self.terminated
    }

    /// Gives the last line back, so that it is the next one.
    pub(super) fn give_back(&mut self) {
        self.start = (self.last.offset - self.before) as usize;
        self.number = self.last.number;
    }

    /// Where it is.
    pub(super) fn place(&self) -> Place {
        Place { offset: self.before + self.start as u64, number: self.number }
    }

    /// Goes to a place where it has been: the file is opened again.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be, as a pipe cannot.
    pub(super) fn go(&mut self, place: Place) -> Result<(), ReadError> {
        let within = self.before..=self.before + self.end as u64;
        if within.contains(&place.offset) {
            self.start = (place.offset - self.before) as usize;
            self.number = place.number;
            return Ok(());
        }
        self.go_anew(place)
    }

    /// The same, without what has been read before: it may have grown.
    ///
    /// # Errors
    /// As [`Self::go`].
    pub(super) fn go_anew(&mut self, place: Place) -> Result<(), ReadError> {
        let Some(path) = self.file.clone() else {
            return Err(ReadError::whole(&self.source, "a pipe cannot be read again"));
        };
        let failed = |error: io::Error| ReadError::whole(&self.source, cause(&error));
        let mut file = File::open(&path).map_err(failed)?;
        let (reader, skip) = if compressed::is_plain(&file).map_err(failed)? {
            io::Seek::seek(&mut file, io::SeekFrom::Start(place.offset)).map_err(failed)?;
            (Box::new(file) as Box<dyn Read + Send>, 0)
        } else {
            (decompressed(Box::new(file)).map_err(failed)?, place.offset)
        };
        self.reader = reader;
        if skip > 0 {
            let skipped = io::copy(&mut self.reader.by_ref().take(skip), &mut io::sink());
            skipped.map_err(|error| ReadError::whole(&self.source, cause(&error)))?;
        }
        (self.start, self.end, self.before, self.number) = (0, 0, place.offset, place.number);
        Ok(())
    }

    /// All that is left, at most `longest` bytes.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read, or is longer.
    pub(super) fn rest(&mut self, longest: usize) -> Result<Vec<u8>, ReadError> {
        let mut bytes = Vec::new();
        let read = Read::take(&mut *self, longest as u64 + 1).read_to_end(&mut bytes);
        read.map_err(|error| self.failed(&error))?;
        if bytes.len() > longest {
            let what = format!("a scene of more than {} MiB", longest >> 20);
            return Err(ReadError::whole(&self.source, what));
        }
        Ok(bytes)
    }

    /// Reads exactly so many bytes as `bytes` has room for.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read, or ends before.
    pub(super) fn exactly(&mut self, bytes: &mut [u8]) -> Result<(), ReadError> {
        self.read_exact(bytes).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => {
                ReadError::whole(&self.source, "the file ends early").of_end()
            }
            _ => ReadError::whole(&self.source, cause(&error)),
        })
    }
}

impl Read for Input {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if self.start == self.end {
            self.before += self.end as u64;
            (self.start, self.end) = (0, 0);
            if bytes.len() >= BLOCK {
                let read = self.reader.read(bytes)?;
                self.before += read as u64;
                return Ok(read);
            }
            if !self.fill().map_err(|error| io::Error::other(error.what))? {
                return Ok(0);
            }
        }
        let count = bytes.len().min(self.end - self.start);
        bytes[..count].copy_from_slice(&self.buffer[self.start..self.start + count]);
        self.start += count;
        Ok(count)
    }
}
