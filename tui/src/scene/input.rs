//! The bytes of a scene, from a file or a pipe, as they are or decompressed: line by line, or as they come.
//!
//! Memory does not grow with the input: a line is borrowed from the buffer, and none may be longer than
//! [`line::LONGEST_LINE`]. Places are remembered, so that a frame can be read again.

mod bytes;
mod compressed;
mod cut;
mod head;
mod line;
mod lines;
mod place;
mod until_end;

use super::read_error::ReadError;
use crate::error::cause;
use crate::progress::Progress;
use compressed::decompressed;
#[cfg(test)]
pub(super) use line::LONGEST_LINE;
pub(super) use line::Line;
pub(super) use place::Place;
use place::{open_at, uncompressed};
use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;
use std::time::Duration;
use until_end::UntilEnd;

/// What is read at once, at least.
const BLOCK: usize = 256 << 10;

/// How long reading may take before its progress is shown.
const PATIENCE: Duration = Duration::from_secs(1);

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
    /// Where the last line began.
    last: Place,
    /// Whether the last line had an end.
    terminated: bool,
    /// Shows the progress of reading, until `be_quiet` is called.
    progress: Option<Progress>,
    /// The open file, if it is not compressed.
    plain: Option<File>,
    /// Why reading failed, if no one has been told yet.
    failure: Option<io::Error>,
}

impl std::fmt::Debug for Input {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Input").field("source", &self.source).finish_non_exhaustive()
    }
}

impl Input {
    /// A file, opened.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn of_file(file: File, path: PathBuf, source: &str) -> Result<Self, ReadError> {
        let plain = uncompressed(&file).map_err(ReadError::io(source))?;
        // More may be written behind its end.
        let mut input = Self::reading(Box::new(file), source)?;
        (input.file, input.plain) = (Some(path), plain);
        Ok(input)
    }

    /// Any other input: it is read once, and only to its end.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read.
    pub(super) fn of_reader(reader: Box<dyn Read + Send>, source: &str) -> Result<Self, ReadError> {
        Self::reading(Box::new(UntilEnd::new(reader)), source)
    }

    fn reading(reader: Box<dyn Read + Send>, source: &str) -> Result<Self, ReadError> {
        Ok(Self {
            reader: decompressed(reader).map_err(ReadError::io(source))?,
            file: None,
            source: source.into(),
            buffer: Vec::new(),
            start: 0,
            end: 0,
            before: 0,
            number: 0,
            last: Place::default(),
            terminated: true,
            progress: Some(Progress::after(PATIENCE)),
            plain: None,
            failure: None,
        })
    }

    /// The bytes of the buffer.
    #[cfg(test)]
    pub(super) fn room(&self) -> usize {
        self.buffer.len()
    }

    /// Stops showing the progress of reading.
    pub(super) fn be_quiet(&mut self) {
        self.progress = None;
    }

    /// The name of the input in errors.
    pub(super) fn source(&self) -> &str {
        &self.source
    }

    /// Whether it can be opened again, as a pipe cannot.
    pub(super) fn can_be_read_again(&self) -> bool {
        self.file.is_some()
    }

    /// Reads more; `false` if there is none.
    fn fill(&mut self) -> Result<bool, ReadError> {
        self.check()?;
        self.read_on().map_err(|error| self.failed(&error))
    }

    /// As [`Self::fill`], whatever has failed before.
    fn read_on(&mut self) -> io::Result<bool> {
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
                    self.tell();
                    return Ok(read > 0);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Shows the progress of reading.
    fn tell(&mut self) {
        let Some(progress) = &mut self.progress else { return };
        let read = self.before + self.end as u64;
        let metadata = self.plain.as_ref().and_then(|file| file.metadata().ok());
        match metadata.map(|metadata| metadata.len()) {
            Some(size) if size > 0 => progress.show("reading", read as f64 / size as f64),
            _ => progress.say(&format!("reading, {} MB", read / 10_000_000 * 10)),
        }
    }

    fn failed(&self, error: &io::Error) -> ReadError {
        let wrong = ReadError::at(&self.source, self.number + 1, 1, cause(error));
        if error.kind() == io::ErrorKind::UnexpectedEof { wrong.of_end() } else { wrong }
    }

    /// The error that the input ends too early.
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

    /// Skips blank lines; returns whether nothing is left.
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

    /// Gives the last line back, so that it is the next one. No other must have been asked for since: not even the end.
    pub(super) fn give_back(&mut self) {
        debug_assert!(self.last.offset >= self.before, "the line is no longer in the buffer");
        self.start = (self.last.offset - self.before) as usize;
        self.number = self.last.number;
    }

    /// Where it is.
    pub(super) fn place(&self) -> Place {
        Place { offset: self.before + self.start as u64, number: self.number }
    }

    /// Goes to a place where it has been; opens the file again if that is no longer in the buffer.
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

    /// As [`Self::go`], but without what has been read before: the file may have grown.
    ///
    /// # Errors
    /// As [`Self::go`].
    pub(super) fn go_anew(&mut self, place: Place) -> Result<(), ReadError> {
        let Some(path) = &self.file else {
            return Err(ReadError::whole(&self.source, "a pipe cannot be read again"));
        };
        (self.reader, self.plain) =
            open_at(path, place.offset).map_err(ReadError::io(&self.source))?;
        self.failure = None;
        (self.start, self.end, self.before, self.number) = (0, 0, place.offset, place.number);
        Ok(())
    }
}
