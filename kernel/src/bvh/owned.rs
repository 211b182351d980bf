//! The tree that owns its memory.

use super::build::join::{InTurn, Join};
use super::build::refit::refit_anyway;
use super::build::top_down;
use super::built::Built;
use super::leaf::{BEFORE, BEHIND};
use super::memory::RefitError;
use super::node::BvhNode;
use super::tree::Bvh;
use crate::geometry::moved_spheres::MovedSpheres;
use crate::geometry::sphere_list::SphereList;
use crate::memory::lengthen;
use alloc::collections::TryReserveError;
use alloc::vec::Vec;
use core::iter::repeat_n;

/// A tree over spheres that owns both: the owned form of [`Bvh`]. It takes 56 bytes a sphere while it is built, of which 16
/// are the list; what is left over is given back.
///
/// ```
/// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Vec3};
///
/// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
/// let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 0)));
/// ```
#[derive(Clone, Debug)]
pub struct SphereTree {
    spheres: SphereList,
    nodes: Vec<BvhNode>,
    places: Vec<[f32; 4]>,
    indices: Vec<u32>,
    built: Built,
}

impl SphereTree {
    /// Builds a tree over anything that becomes a [`SphereList`], on this thread.
    ///
    /// Cost: as [`Bvh::build`]. Aborts, as `Vec` does, if there is no memory.
    ///
    /// # Panics
    /// If there are more than 2^27 spheres, more than [`Bvh::needed`] has memory for.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(tree.list().len(), 2);
    /// ```
    #[must_use]
    pub fn new(spheres: impl Into<SphereList>) -> Self {
        let spheres = spheres.into();
        let needed = Bvh::needed(spheres.spheres().len());
        let nodes = repeat_n(BvhNode::EMPTY, needed.nodes).collect();
        let places = repeat_n([0.0; 4], needed.places).collect();
        let indices = repeat_n(0, needed.places).collect();
        Self::in_memory(&InTurn, spheres, (nodes, places, indices))
    }

    /// Builds the same tree as [`new`](Self::new), with parts of the work running at once on the caller's threads.
    ///
    /// # Errors
    /// `TryReserveError` if there is no memory, or if there are more than 2^27 spheres.
    ///
    /// ```
    /// use spherule_kernel::{InTurn, SphereTree};
    ///
    /// let tree = SphereTree::build_with(&InTurn, [[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]])?;
    /// assert_eq!(tree.bvh().depth(), 0);
    /// # Ok::<(), std::collections::TryReserveError>(())
    /// ```
    pub fn build_with(
        join: &impl Join,
        spheres: impl Into<SphereList>,
    ) -> Result<Self, TryReserveError> {
        let spheres = spheres.into();
        let needed = Bvh::needed(spheres.spheres().len());
        let (mut nodes, mut places, mut indices) = (Vec::new(), Vec::new(), Vec::new());
        // Nothing is written before there is memory for all.
        nodes.try_reserve_exact(needed.nodes)?;
        places.try_reserve_exact(needed.places)?;
        indices.try_reserve_exact(needed.places)?;
        lengthen(&mut nodes, BvhNode::EMPTY, needed.nodes)?;
        lengthen(&mut places, [0.0; 4], needed.places)?;
        lengthen(&mut indices, 0, needed.places)?;
        Ok(Self::in_memory(join, spheres, (nodes, places, indices)))
    }

    /// Builds in memory that is as large as needed; what is left is given back.
    fn in_memory(
        join: &impl Join,
        spheres: SphereList,
        (mut nodes, mut places, mut indices): (Vec<BvhNode>, Vec<[f32; 4]>, Vec<u32>),
    ) -> Self {
        let list = spheres.spheres();
        let built = top_down::build(join, &list, &mut nodes, &mut places, &mut indices);
        nodes.truncate(built.nodes);
        nodes.shrink_to_fit();
        places.truncate(BEFORE + built.places + BEHIND + built.unplaced.div_ceil(2));
        places.shrink_to_fit();
        indices.truncate(built.places + built.outside);
        indices.shrink_to_fit();
        Self { spheres, nodes, places, indices, built }
    }

    /// Replaces each sphere of the tree by the one with the same index in `moved`, centre and radius. Returns the
    /// [growth](Bvh::growth) of the boxes since the tree was built: at 1.5 or 2 it is time to build anew.
    ///
    /// `moved` is a list, a slice, a vector or an array, given or lent: [`MovedSpheres`]. If one of your conversions panics, refit
    /// the tree again before it is used.
    ///
    /// Guarantees what a new tree guarantees. [`BvhMemory::refit`](crate::BvhMemory::refit) says what becomes of spheres that
    /// are not valid, and of those far larger or smaller than they were.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, RefitError, SphereTree, Vec3};
    ///
    /// let at = |second: f32| [[0.0, 0.0, 5.0, 1.0], [second, 0.0, 3.0, 1.0]];
    /// let mut tree = SphereTree::new(at(8.0));
    /// for (second, sphere) in [(7.0, 0), (0.5, 1)] {
    ///     let growth = tree.refit(at(second))?;
    ///     if growth > 1.5 {
    ///         tree = SphereTree::new(tree.into_list());
    ///     }
    ///     let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
    ///     assert_eq!(hit.map(|hit| hit.sphere), Some(sphere));
    /// }
    /// # Ok::<(), RefitError>(())
    /// ```
    ///
    /// Cost: a tenth to a quarter of a build's time. Spheres are copied into the list that the tree owns; only a `SphereList` that is
    /// given replaces it. Allocates only if more spheres are outside the boxes than ever before: 8 bytes for each. Aborts, as
    /// `Vec` does, if that fails.
    ///
    /// # Errors
    /// [`RefitError::OtherCount`] if `moved` has another number of spheres; then the tree is as it was.
    pub fn refit(&mut self, moved: impl MovedSpheres) -> Result<f32, RefitError> {
        let Self { spheres, nodes, places, indices, built } = self;
        let (count, given) = (spheres.spheres().len(), moved.count());
        if count != given {
            return Err(RefitError::OtherCount { built: count, given });
        }
        moved.replace(spheres);
        let list = spheres.spheres();
        let needed = refit_anyway(built, &list, nodes, places, indices);
        if needed > indices.len() {
            // As many again to sort them with, and no more: a vector that grows by itself becomes twice as long.
            let length = needed + built.outside;
            indices.reserve_exact(length - indices.len());
            indices.resize(length, 0);
            refit_anyway(built, &list, nodes, places, indices);
        }
        Ok(self.bvh().growth())
    }

    /// Borrows the tree: a few words.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(tree.bvh().spheres().len(), 2);
    /// ```
    #[must_use]
    #[inline]
    pub fn bvh(&self) -> Bvh<'_> {
        let (places, indices) = (&self.places, &self.indices);
        Bvh::of(self.built, self.spheres.spheres(), &self.nodes, places, indices)
    }

    /// Returns the list that the tree was built from, or refitted to.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(tree.list().spheres().get(1).map(|sphere| sphere.center.z), Some(9.0));
    /// ```
    #[must_use]
    pub const fn list(&self) -> &SphereList {
        &self.spheres
    }

    /// Gives the list back, without a copy: to build anew, of other spheres or of more.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let mut list = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]).into_list();
    /// list.push([0.0, 0.0, 9.0, 1.0]);
    /// assert_eq!(SphereTree::new(list).list().len(), 2);
    /// ```
    #[must_use]
    pub fn into_list(self) -> SphereList {
        self.spheres
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::SphereTree;
    use crate::{Sphere, SphereList, Vec3};
    use alloc::vec::Vec;

    fn row() -> Vec<Sphere> {
        (0..1000).map(|number| Sphere::from([number as f32, 0.0, 5.0, 0.25])).collect()
    }

    /// Where the numbers of a tree lie.
    fn memory(tree: &SphereTree) -> ([*const f32; 4], *const u32) {
        (tree.list().spheres().columns().map(<[f32]>::as_ptr), tree.indices.as_ptr())
    }

    #[test]
    fn spheres_that_are_lent_are_written_into_the_memory_that_the_tree_has() {
        let start = row();
        let moved: Vec<Sphere> =
            start.iter().map(|s| Sphere { center: s.center + Vec3::Y, ..*s }).collect();
        let [first, second] = [&start, &moved].map(SphereList::from);
        let mut tree = SphereTree::new(&start);
        let before = memory(&tree);
        tree.refit(&moved).expect("as many");
        assert!(*tree.list() == second && memory(&tree) == before, "a vector");
        tree.refit(start.as_slice()).expect("as many");
        assert!(*tree.list() == first && memory(&tree) == before, "a slice");
        tree.refit(second.spheres()).expect("as many");
        assert!(*tree.list() == second && memory(&tree) == before, "columns");
        tree.refit(start).expect("as many");
        assert!(*tree.list() == first && memory(&tree) == before, "rows that are given");
        tree.refit(&second).expect("as many");
        assert!(*tree.list() == second && memory(&tree) == before, "a list that is lent");
        tree.refit(first.clone()).expect("as many");
        assert!(*tree.list() == first, "a list, which brings its memory");
    }

    #[test]
    fn a_sphere_that_leaves_the_boxes_takes_eight_bytes() {
        let mut spheres = row();
        let mut tree = SphereTree::new(&spheres);
        assert_eq!(tree.indices.capacity(), tree.built.places);
        for left in [1, 3] {
            for sphere in spheres.iter_mut().take(left) {
                sphere.radius = 1e30;
            }
            tree.refit(&spheres).expect("as many");
            assert_eq!(tree.built.outside, left);
            assert_eq!(tree.indices.capacity(), tree.built.places + 2 * left);
        }
    }
}
