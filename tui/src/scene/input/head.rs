//! The beginning of an input, by which its format is told.

use super::Input;
use crate::scene::read_error::ReadError;

/// How much of an input is looked at to tell what it is.
const HEAD: usize = 64 << 10;

impl Input {
    /// The beginning of what has not been taken, enough to tell its format. What a pipe has brought is taken for that as soon as it
    /// `is_enough`: more may be long in coming.
    ///
    /// Where reading fails, it is what could be read, and whoever reads on is told.
    pub(in crate::scene) fn head(&mut self, is_enough: impl Fn(&[u8]) -> bool) -> &[u8] {
        while self.end - self.start < HEAD {
            if !self.can_be_read_again() && is_enough(&self.buffer[self.start..self.end]) {
                break;
            }
            match self.read_on() {
                Ok(true) => {}
                Ok(false) => break,
                Err(error) => {
                    self.failure = Some(error);
                    break;
                }
            }
        }
        &self.buffer[self.start..self.end.min(self.start + HEAD)]
    }

    /// Whether a further line that is not blank has been read, so that asking for it waits for nothing.
    pub(in crate::scene) fn has_line(&self) -> bool {
        memchr::memchr(b'\n', self.buffer[self.start..self.end].trim_ascii_start()).is_some()
    }

    /// Tells what [`Self::head`] has kept to itself.
    ///
    /// # Errors
    /// [`ReadError`] if reading has failed there.
    pub(in crate::scene) fn check(&mut self) -> Result<(), ReadError> {
        match self.failure.take() {
            Some(error) => Err(self.failed(&error)),
            None => Ok(()),
        }
    }
}
