//! Spheres that replace those of a list.

use super::sphere::{Sphere, Spheres};
use super::sphere_list::SphereList;
use alloc::vec::Vec;

/// As many spheres as a list has, which replace its own: all that becomes a [`SphereList`]. (`Into<SphereList>` would allocate a list
/// each time.)
pub trait MovedSpheres {
    /// How many spheres.
    fn count(&self) -> usize;

    /// Replaces the spheres of a list of as many. A list that is given brings its memory; all others are copied, without an allocation.
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

/// Spheres that are copied, by what is iterated over.
macro_rules! copied {
    ($([$($generics:tt)*] $spheres:ty: |$self:ident| $iterator:expr;)*) => {$(
        impl<$($generics)*> MovedSpheres for $spheres {
            fn count(&self) -> usize {
                self.len()
            }

            fn replace($self, list: &mut SphereList) {
                list.overwrite($iterator);
            }
        }
    )*};
}

copied! {
    [] Spheres<'_>: |self| self.iter();
    [] &SphereList: |self| self.spheres().iter();
    [S: Into<Sphere> + Copy] &[S]: |self| self.iter().copied();
    [S: Into<Sphere> + Copy, const N: usize] &[S; N]: |self| self.iter().copied();
    [S: Into<Sphere> + Copy] &Vec<S>: |self| self.iter().copied();
    [S: Into<Sphere>] Vec<S>: |self| self.into_iter();
    [S: Into<Sphere>, const N: usize] [S; N]: |self| self.into_iter();
}
