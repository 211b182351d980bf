//! Structures that own their memory lend the structure that is traced.

use super::lend::Lend;
use crate::bvh::owned::SphereTree;
use crate::bvh::tree::Bvh;
use crate::geometry::sphere::Spheres;
use crate::geometry::sphere_list::SphereList;
use core::ops::Deref;

impl Lend for SphereList {
    type Lent<'a> = Spheres<'a>;

    #[inline(always)]
    fn lend(&self) -> impl Deref<Target = Self::Lent<'_>> {
        Loan(self.spheres())
    }

    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        self.spheres()
    }
}

impl Lend for SphereTree {
    type Lent<'a> = Bvh<'a>;

    #[inline(always)]
    fn lend(&self) -> impl Deref<Target = Self::Lent<'_>> {
        Loan(self.bvh())
    }

    #[inline(always)]
    fn list(&self) -> Spheres<'_> {
        Self::list(self).spheres()
    }
}

/// What is lent.
struct Loan<T>(T);

impl<T> Deref for Loan<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}
