//! The words of a line, and numbers among them.

use crate::scene::input::Line;
use crate::scene::number::{leading, number};
use crate::scene::read_error::ReadError;
use glam::DVec3;

/// The words of a line, between white space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words<'a> {
    line: Line<'a>,
    at: usize,
}

impl<'a> Words<'a> {
    pub(super) fn of(line: Line<'a>) -> Self {
        Self { line, at: 0 }
    }

    /// The next word and the byte where it begins; `None` at the end of the line.
    #[inline]
    pub(super) fn next(&mut self) -> Option<(usize, &'a [u8])> {
        let bytes = self.line.bytes;
        let start = self.start();
        let mut end = start;
        while bytes.get(end).is_some_and(|&byte| byte > b' ') {
            end += 1;
        }
        self.at = end;
        (start < end).then(|| (start, &bytes[start..end]))
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
    pub(super) fn expect(&mut self, wanted: &str) -> Result<(usize, &'a [u8]), ReadError> {
        match self.next() {
            Some(word) => Ok(word),
            None => Err(self.line.error(self.line.bytes.len(), format!("{wanted} is missing"))),
        }
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
        let (byte, word) = self.expect(name)?;
        coordinate(&self.line, byte, word, name)
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

/// A number that single precision can hold, in the double precision of the file.
///
/// # Errors
/// [`ReadError`] if `word`, which begins at `byte` of `line`, is no such number.
#[inline]
pub(super) fn coordinate(
    line: &Line<'_>,
    byte: usize,
    word: &[u8],
    name: &str,
) -> Result<f64, ReadError> {
    let value = number(word).unwrap_or(f64::NAN);
    if (value as f32).is_finite() {
        Ok(value)
    } else {
        single(line, byte, word, name, 1.0).map(f64::from)
    }
}

/// A finite single-precision number, times `unit`.
///
/// # Errors
/// [`ReadError`] if `word`, which begins at `byte` of `line`, is no such number.
#[inline]
pub(super) fn single(
    line: &Line<'_>,
    byte: usize,
    word: &[u8],
    name: &str,
    unit: f32,
) -> Result<f32, ReadError> {
    match number(word).map(|value| value as f32 * unit) {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(line
            .error(byte, format!("{name} is {}: not finite in single precision", excerpt(word)))),
        None => Err(line.error(byte, format!("{name} is {}: no number", excerpt(word)))),
    }
}

/// Half a diameter; NaN, as of a particle without a radius, if it is missing, NaN or negative.
///
/// # Errors
/// [`ReadError`] if `word`, which begins at `byte` of `line`, is another word than a number, or is infinite.
pub(super) fn half_diameter(
    line: &Line<'_>,
    byte: usize,
    word: &[u8],
    name: &str,
) -> Result<f32, ReadError> {
    match number(word) {
        Some(value) if value.is_nan() || value < 0.0 => Ok(f32::NAN),
        None if word.is_empty() => Ok(f32::NAN),
        _ => single(line, byte, word, name, 0.5),
    }
}

/// A whole number of zero or more.
pub(super) fn count(word: &[u8]) -> Option<usize> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// `text` in quotes, cut if it is long.
pub(super) fn excerpt(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(&text[..text.len().min(200)]);
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}
