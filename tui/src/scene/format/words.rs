//! The words of a line, and numbers among them.

use crate::scene::input::Line;
use crate::scene::number::{leading, number, parsed};
use crate::scene::read_error::ReadError;
use glam::DVec3;

/// A word of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'a> {
    pub(super) line: Line<'a>,
    /// Where it begins.
    pub(super) byte: usize,
    pub(super) bytes: &'a [u8],
}

impl Word<'_> {
    /// The error that it is wrong.
    pub(super) fn error(&self, what: impl Into<String>) -> ReadError {
        self.line.error(self.byte, what)
    }

    #[cold]
    fn not_finite(&self, name: &str) -> ReadError {
        let value = excerpt(self.bytes);
        self.error(format!("{name} is {value}, which is not finite in single precision"))
    }

    /// The number that it is; `name` is what it is called in errors.
    ///
    /// # Errors
    /// [`ReadError`] if it is none.
    #[inline]
    pub(super) fn number(&self, name: &str) -> Result<f64, ReadError> {
        number(self.bytes).ok_or_else(|| {
            self.error(format!("{name} is {}, which is not a number", excerpt(self.bytes)))
        })
    }

    /// A number that single precision can hold, in the double precision of the file.
    ///
    /// # Errors
    /// [`ReadError`] if it is no such number.
    #[inline]
    pub(super) fn coordinate(&self, name: &str) -> Result<f64, ReadError> {
        let value = self.number(name)?;
        if (value as f32).is_finite() { Ok(value) } else { Err(self.not_finite(name)) }
    }

    /// A finite single-precision number, times `unit`.
    ///
    /// # Errors
    /// [`ReadError`] if it is no such number.
    #[inline]
    pub(super) fn single(&self, name: &str, unit: f32) -> Result<f32, ReadError> {
        let value = self.number(name)? as f32 * unit;
        if value.is_finite() { Ok(value) } else { Err(self.not_finite(name)) }
    }

    /// A radius.
    ///
    /// # Errors
    /// [`ReadError`] if it is no finite number of zero or more.
    pub(super) fn radius(&self, name: &str) -> Result<f32, ReadError> {
        let radius = self.single(name, 1.0)?;
        if radius < 0.0 {
            return Err(self.error(format!("{name} is {radius}, which is negative")));
        }
        Ok(radius)
    }

    /// Half a diameter; NaN, as of a particle without a radius, if it is missing, NaN or negative.
    ///
    /// # Errors
    /// [`ReadError`] if it is another word than a number, or is infinite.
    pub(super) fn half_diameter(&self, name: &str) -> Result<f32, ReadError> {
        match number(self.bytes) {
            Some(value) if value.is_nan() || value < 0.0 => Ok(f32::NAN),
            None if self.bytes.is_empty() => Ok(f32::NAN),
            _ => self.single(name, 0.5),
        }
    }
}

/// The words of a line, between white space.
#[derive(Debug)]
pub(super) struct Words<'a> {
    line: Line<'a>,
    at: usize,
}

impl<'a> Words<'a> {
    pub(super) fn of(line: Line<'a>) -> Self {
        Self { line, at: 0 }
    }

    /// Where the next word begins, or the line ends.
    #[inline]
    fn start(&self) -> usize {
        let mut start = self.at;
        while self.line.bytes.get(start).is_some_and(|&byte| byte <= b' ') {
            start += 1;
        }
        start
    }

    /// The next word, which there must be.
    ///
    /// # Errors
    /// [`ReadError`] if `wanted` is missing.
    #[inline]
    pub(super) fn expect(&mut self, wanted: &str) -> Result<Word<'a>, ReadError> {
        match self.next() {
            Some(word) => Ok(word),
            None => Err(self.line.error(self.line.bytes.len(), format!("{wanted} is missing"))),
        }
    }

    /// The next word as a number.
    ///
    /// # Errors
    /// [`ReadError`] if it is missing, or no number.
    pub(super) fn number(&mut self, name: &str) -> Result<f64, ReadError> {
        self.expect(name)?.number(name)
    }

    /// The next word as a coordinate.
    ///
    /// # Errors
    /// [`ReadError`] if it is missing, no number, or not finite.
    #[inline]
    pub(super) fn coordinate(&mut self, name: &str) -> Result<f64, ReadError> {
        let start = self.start();
        if let Some((value, length)) = leading(&self.line.bytes[start..])
            && (value as f32).is_finite()
        {
            self.at = start + length;
            return Ok(value);
        }
        self.expect(name)?.coordinate(name)
    }

    /// The next three as a point.
    ///
    /// # Errors
    /// As [`Self::coordinate`].
    #[inline]
    pub(super) fn point(&mut self) -> Result<DVec3, ReadError> {
        Ok(DVec3::new(self.coordinate("x")?, self.coordinate("y")?, self.coordinate("z")?))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = Word<'a>;

    #[inline]
    fn next(&mut self) -> Option<Word<'a>> {
        let (line, start) = (self.line, self.start());
        let mut end = start;
        while line.bytes.get(end).is_some_and(|&byte| byte > b' ') {
            end += 1;
        }
        self.at = end;
        (start < end).then(|| Word { line, byte: start, bytes: &line.bytes[start..end] })
    }
}

/// The words of a text, between white space.
pub(super) fn split(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A whole number of zero or more.
pub(super) fn count(word: &[u8]) -> Option<usize> {
    parsed(word)
}

/// `text` in quotes, cut if it is long.
pub(super) fn excerpt(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(&text[..text.len().min(200)]);
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}
