//! Spheres that replace those of a list.

use super::sphere::{Sphere, Spheres};
use super::sphere_list::SphereList;
use alloc::vec::Vec;

mod sealed {
    /// As many spheres as a list has, which replace its own. (`Into<SphereList>` would allocate a list each time.)
    pub trait Replacement {
        /// How many spheres.
        fn count(&self) -> usize;

        /// Replaces the spheres of a list of as many. A list that is given brings its memory; all others are copied, without an
        /// allocation.
        fn replace(self, list: &mut super::SphereList);
    }
}

/// What [`SphereTree::refit`](crate::SphereTree::refit) takes: [`Spheres`], a slice, a vector or an array of anything that becomes a
/// [`Sphere`], or a [`SphereList`], given or lent.
///
/// Sealed: it is there to be named in generic code.
///
/// ```
/// use spherule_kernel::{MovedSpheres, RefitError, SphereTree};
///
/// fn step(tree: &mut SphereTree, moved: impl MovedSpheres) -> Result<(), RefitError> {
///     if tree.refit(moved)? > 1.5 {
///         *tree = SphereTree::new(tree.list().clone());
///     }
///     Ok(())
/// }
///
/// let mut tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
/// step(&mut tree, &[[0.0, 0.0, 7.0, 1.0]])?;
/// assert_eq!(tree.list().spheres().get(0).map(|sphere| sphere.center.z), Some(7.0));
/// # Ok::<(), RefitError>(())
/// ```
pub trait MovedSpheres: sealed::Replacement {}

impl<S: sealed::Replacement> MovedSpheres for S {}

impl sealed::Replacement for SphereList {
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
        impl<$($generics)*> sealed::Replacement for $spheres {
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
