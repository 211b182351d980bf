//! What is traced: a structure itself, or the one that it lends.

use super::Traverse;
use crate::geometry::sphere::Spheres;
use core::ops::Deref;

/// A structure that is traced itself, or that lends the one that is.
pub trait Lend {
    /// The structure that is traced.
    type Lent<'a>: Traverse
    where
        Self: 'a;

    /// Lends it.
    fn lend(&self) -> impl Deref<Target = Self::Lent<'_>>;

    /// The list of its spheres.
    fn list(&self) -> Spheres<'_>;
}

impl<S: Traverse> Lend for S {
    type Lent<'a>
        = S
    where
        S: 'a;

    #[inline(always)]
    fn lend(&self) -> impl Deref<Target = Self::Lent<'_>> {
        self
    }

    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        Traverse::list(self)
    }
}
