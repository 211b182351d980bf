//! An input as bytes, or as one text, where it has no lines.

use super::{BLOCK, Input};
use crate::error::cause;
use crate::scene::read_error::ReadError;
use std::io::{self, Read};

/// The longest text that is read as a whole, in bytes: some half a million spheres.
const LONGEST_TEXT: usize = 64 << 20;

impl Input {
    /// All that is left as text, without a byte order mark.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read, is longer than [`LONGEST_TEXT`], or no UTF-8.
    pub(in crate::scene) fn text(&mut self) -> Result<String, ReadError> {
        let mut bytes = Vec::new();
        let read = Read::take(&mut *self, LONGEST_TEXT as u64 + 1).read_to_end(&mut bytes);
        read.map_err(|error| self.failed(&error))?;
        if bytes.len() > LONGEST_TEXT {
            let what = format!("a scene of more than {} MiB", LONGEST_TEXT >> 20);
            return Err(ReadError::whole(&self.source, what));
        }
        let mut text = String::from_utf8(bytes).map_err(|error| {
            let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = valid.split(|&byte| byte == b'\n').count();
            let wrong = ReadError::whole(&self.source, "not valid UTF-8");
            ReadError { line: Some(line), ..wrong }
        })?;
        if text.starts_with('\u{feff}') {
            text.remove(0);
        }
        Ok(text)
    }

    /// Adds the next bytes to `bytes`, at most so many.
    ///
    /// # Errors
    /// [`ReadError`] if they cannot be read.
    pub(in crate::scene) fn up_to(
        &mut self,
        most: u64,
        bytes: &mut Vec<u8>,
    ) -> Result<(), ReadError> {
        let read = Read::take(&mut *self, most).read_to_end(bytes);
        read.map(drop).map_err(|error| {
            let wrong = ReadError::whole(&self.source, cause(&error));
            if error.kind() == io::ErrorKind::UnexpectedEof { wrong.of_end() } else { wrong }
        })
    }

    /// Reads exactly so many bytes as `bytes` has room for.
    ///
    /// # Errors
    /// [`ReadError`] if it cannot be read, or ends before.
    pub(in crate::scene) fn exactly(&mut self, bytes: &mut [u8]) -> Result<(), ReadError> {
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
            if let Some(error) = self.failure.take() {
                return Err(error);
            }
            if bytes.len() >= BLOCK {
                let read = self.reader.read(bytes)?;
                self.before += read as u64;
                self.tell();
                return Ok(read);
            }
            if !self.read_on()? {
                return Ok(0);
            }
        }
        let count = bytes.len().min(self.end - self.start);
        bytes[..count].copy_from_slice(&self.buffer[self.start..self.start + count]);
        self.start += count;
        Ok(count)
    }
}
