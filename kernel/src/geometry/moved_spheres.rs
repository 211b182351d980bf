//! Spheres that replace those of a list.

use super::sphere::{Sphere, Spheres};
use super::sphere_list::SphereList;
use alloc::vec::Vec;

/// As many spheres as a list has, which replace its own: all that becomes a [`SphereList`]. (`Into<SphereList>` would allocate a list
/// each time.)
pub trait MovedSpheres {
    /// How many spheres.
    fn count(&self) -> usize;

    /// Replaces the spheres of a list of as many. A list brings its memory with it; all others are copied, without an allocation.
    fn replace(self, list: &mut SphereList);
}

impl MovedSpheres for SphereList {
    fn count(&self) -> usize {
        self.spheres().len()
    }

    fn replace(self, list: &mut SphereList) {
        *list = self;
    }
}

impl MovedSpheres for Spheres<'_> {
    fn count(&self) -> usize {
        self.len()
    }

    fn replace(self, list: &mut SphereList) {
        list.overwrite(self.iter());
    }
}

impl<S: Into<Sphere> + Copy> MovedSpheres for &[S] {
    fn count(&self) -> usize {
        self.len()
    }

    fn replace(self, list: &mut SphereList) {
        list.overwrite(self.iter().copied());
    }
}

impl<S: Into<Sphere> + Copy> MovedSpheres for &Vec<S> {
    fn count(&self) -> usize {
        self.len()
    }

    fn replace(self, list: &mut SphereList) {
        list.overwrite(self.iter().copied());
    }
}

impl<S: Into<Sphere>> MovedSpheres for Vec<S> {
    fn count(&self) -> usize {
        self.len()
    }

    fn replace(self, list: &mut SphereList) {
        list.overwrite(self.into_iter());
    }
}

impl<S: Into<Sphere>, const N: usize> MovedSpheres for [S; N] {
    fn count(&self) -> usize {
        N
    }

    fn replace(self, list: &mut SphereList) {
        list.overwrite(self.into_iter());
    }
}
