//! Memory: the caller's, which may turn out too small, and the heap's, of which there may be none
//! left.

#[cfg(feature = "alloc")]
use alloc::{collections::TryReserveError, vec::Vec};
use core::fmt;

/// The memory given to a scene structure was too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooSmall {
    /// How many elements the slice must have at least; `usize::MAX` if no memory is enough for so many spheres.
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
        if *needed == usize::MAX {
            return formatter.write_str("there are more spheres than the structure can hold");
        }
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

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    use crate::{Bvh4, RefitError, Sphere, SphereList, TooSmall};
    use std::string::ToString;

    #[test]
    fn an_error_says_whether_more_memory_would_do() {
        let few = TooSmall { needed: 9, given: 7 };
        assert_eq!(few.to_string(), "the memory holds 7 elements, and 9 are needed");
        assert_eq!(RefitError::from(few).to_string(), few.to_string());

        let list: SphereList = (0..70_000).map(|_| Sphere::from([0.0; 4])).collect();
        let error = Bvh4::build(list.spheres(), &mut [0; 9]).expect_err("65,536 at most");
        assert_eq!(error.to_string(), "there are more spheres than the structure can hold");
    }
}
