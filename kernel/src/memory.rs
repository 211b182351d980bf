//! Memory: the caller's, which may turn out too small, and the heap's, of which there may be none
//! left.

#[cfg(feature = "alloc")]
use alloc::{collections::TryReserveError, vec::Vec};
use core::fmt;

/// The memory given to a scene structure was too small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooSmall {
    /// What the slice holds that is too short: `nodes`, `places` or `indices` of a [`Bvh`](crate::Bvh), `rays` or `queues` of a
    /// [`StreamMemory`](crate::StreamMemory), `words` of a [`Bvh4`](crate::Bvh4), `numbers` of a
    /// [`DepthList`](crate::DepthList).
    pub what: &'static str,
    /// How many elements the slice must have at least; `usize::MAX` if no memory is enough for so many spheres.
    pub needed: usize,
    /// How many it has.
    pub given: usize,
}

impl TooSmall {
    /// Returns an error if `given` is less than `needed`.
    pub(crate) const fn check(what: &'static str, needed: usize, given: usize) -> Result<(), Self> {
        if given < needed { Err(Self { what, needed, given }) } else { Ok(()) }
    }
}

impl fmt::Display for TooSmall {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, needed, given } = self;
        if *needed == usize::MAX {
            return formatter.write_str("there are more spheres than the structure can hold");
        }
        write!(formatter, "there are {given} {what}, and {needed} are needed")
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
    use crate::{Bvh, Bvh4, BvhNode, RefitError, Sphere, SphereList, TooSmall};
    use std::string::ToString;
    use std::vec;

    #[test]
    fn an_error_says_whether_more_memory_would_do() {
        let few = TooSmall { what: "indices", needed: 9, given: 7 };
        assert_eq!(few.to_string(), "there are 7 indices, and 9 are needed");
        assert_eq!(RefitError::from(few).to_string(), few.to_string());

        let list: SphereList = (0..70_000).map(|_| Sphere::from([0.0; 4])).collect();
        let error = Bvh4::build(list.spheres(), &mut [0; 9]).expect_err("65,536 at most");
        assert_eq!(error.to_string(), "there are more spheres than the structure can hold");
    }

    #[test]
    fn an_error_names_the_slice_that_is_too_short() {
        let list: SphereList = (0..100).map(|_| Sphere::from([0.0, 0.0, 5.0, 1.0])).collect();
        let needed = Bvh::needed(100);
        let what = |[nodes, places, indices]: [usize; 3]| {
            let mut nodes = vec![BvhNode::EMPTY; needed.nodes - nodes];
            let mut places = vec![[0.0; 4]; needed.places - places];
            let mut indices = vec![0; needed.places - indices];
            let tree = Bvh::build(list.spheres(), &mut nodes, &mut places, &mut indices);
            tree.expect_err("one too few").what
        };
        let too_short = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(what);
        assert_eq!(too_short, ["nodes", "places", "indices"]);
    }
}
