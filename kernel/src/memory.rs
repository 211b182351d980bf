//! Memory: the caller's, which may turn out too small, and the heap's, of which there may be none
//! left.

#[cfg(feature = "alloc")]
use alloc::{collections::TryReserveError, vec::Vec};
use core::fmt;

/// The memory given to a scene structure was too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooSmall {
    /// How many elements the slice must have at least: what the structure's `needed` says.
    pub needed: usize,
    /// How many it has.
    pub given: usize,
}

impl TooSmall {
    /// Returns an error if `given` is less than `needed`.
    pub(crate) const fn check(needed: usize, given: usize) -> Result<(), Self> {
        if given < needed { Err(Self { needed, given }) } else { Ok(()) }
    }
}

impl fmt::Display for TooSmall {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { needed, given } = self;
        write!(formatter, "the memory holds {given} elements, and {needed} are needed")
    }
}

impl core::error::Error for TooSmall {}

/// Makes heap memory at least so long; returns an error if the allocation fails.
#[cfg(feature = "alloc")]
pub(crate) fn lengthen<T: Clone>(
    memory: &mut Vec<T>,
    filler: T,
    length: usize,
) -> Result<(), TryReserveError> {
    let missing = length.saturating_sub(memory.len());
    memory.try_reserve_exact(missing)?;
    memory.resize(memory.len() + missing, filler);
    Ok(())
}
