//! The tree, borrowed.

use super::build::join::{InTurn, Join};
use super::build::top_down;
use super::built::Built;
use super::node::{BvhLeaf, BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};
use super::traverse::source::{InsideSpheres, OutsideLeaves, SphereSource};
use crate::geometry::sphere::{Sphere, Spheres};
use crate::memory::TooSmall;
use crate::scale::scene::SceneScale;

/// How much memory a tree takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhSize {
    /// Nodes, of 512 bytes.
    pub nodes: usize,
    /// Leaves, of 320 bytes.
    pub leaves: usize,
}

/// A tree over a list of spheres, in memory of the caller's.
///
/// It keeps the list that it was built from, and holds copies of its spheres in their order.
///
/// ```
/// use spherule_kernel::{Bvh, BvhLeaf, BvhNode, Exact, Intersect, Ray, Spheres, Vec3};
///
/// // No heap: memory for up to sixteen spheres.
/// let spheres = Spheres::new(&[0.0, 0.0], &[0.0, 0.0], &[5.0, 9.0], &[1.0, 1.0]).expect("equal lengths");
/// let (mut nodes, mut leaves) = ([BvhNode::EMPTY; 1], [BvhLeaf::EMPTY; 2]);
/// let tree = Bvh::build(spheres, &mut nodes, &mut leaves)?;
/// let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 0)));
/// # Ok::<(), spherule_kernel::TooSmall>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bvh<'a> {
    /// The list that it was built from.
    pub(crate) spheres: Spheres<'a>,
    pub(crate) nodes: &'a [BvhNode],
    /// Those of the tree, in its order, scaled.
    pub(crate) leaves: &'a [BvhLeaf],
    /// Leaves of no node: spheres that no bound sees, as they were given.
    pub(crate) outside: &'a [BvhLeaf],
    /// A node, a leaf with [`LEAF`] set, or [`NO_CHILD`].
    pub(crate) root: u32,
    /// How bounds see lengths.
    pub(crate) scale: SceneScale,
    /// No coordinate of a box is larger, as bounds see it.
    pub(crate) extent: f32,
}

impl SphereSource for Bvh<'_> {
    #[inline(always)]
    fn spheres(&self) -> Spheres<'_> {
        self.spheres
    }

    #[inline(always)]
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)> {
        match self.leaves.get(place as usize / WIDTH) {
            Some(leaf) => {
                let (scaled, index) = leaf.sphere(place as usize);
                Some((self.scale.restored(&scaled), index))
            }
            None => None,
        }
    }
}

impl<'a> Bvh<'a> {
    /// The memory that any list of `count` spheres needs: 38 bytes a sphere at most, and 832 bytes.
    ///
    /// All leaves except one are full, and one more keeps the spheres of other sizes than the rest: count/16,
    /// rounded up, and one; of nodes 8/15 of the leaves are enough (`docs/traversal-margins.md`).
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhSize};
    ///
    /// assert_eq!(Bvh::needed(100), BvhSize { nodes: 4, leaves: 8 });
    /// ```
    #[must_use]
    pub const fn needed(count: usize) -> BvhSize {
        let full = count.div_ceil(WIDTH);
        // In the order that cannot overflow.
        BvhSize { nodes: full / 15 * 8 + full % 15 * 8 / 15 + 1, leaves: full + 1 }
    }

    /// Builds a tree over `spheres` in the memory given, whose contents do not matter.
    ///
    /// Spheres that are not valid are left out. The same list gives the same tree on every target.
    ///
    /// Cost: a cut looks at each of its spheres a bounded number of times, and a node makes fifteen
    /// cuts at most of runs that its children are eight times shorter than; so time grows by the
    /// number of spheres times its logarithm, whatever the spheres. Stack: some 20 KiB. No other
    /// memory.
    ///
    /// # Errors
    /// [`TooSmall`] if either slice is shorter than [`Bvh::needed`] says; longer is no error, and the
    /// rest is left alone.
    pub fn build(
        spheres: Spheres<'a>,
        nodes: &'a mut [BvhNode],
        leaves: &'a mut [BvhLeaf],
    ) -> Result<Self, TooSmall> {
        Self::build_with(&InTurn, spheres, nodes, leaves)
    }

    /// [`Bvh::build`] with several pieces of work at once, on threads of the caller's: the same tree.
    ///
    /// Cost: with two threads some 0.7 of the time for a million spheres.
    ///
    /// # Errors
    /// As [`Bvh::build`].
    pub fn build_with(
        join: &impl Join,
        spheres: Spheres<'a>,
        nodes: &'a mut [BvhNode],
        leaves: &'a mut [BvhLeaf],
    ) -> Result<Self, TooSmall> {
        let needed = Self::needed(spheres.len());
        TooSmall::check(needed.nodes, nodes.len())?;
        TooSmall::check(needed.leaves, leaves.len())?;
        let built = top_down::build(join, &spheres, nodes, leaves);
        Ok(Self::of(built, spheres, nodes, leaves))
    }

    /// The tree that was built in that memory.
    pub(super) fn of(
        built: Built,
        spheres: Spheres<'a>,
        nodes: &'a [BvhNode],
        leaves: &'a [BvhLeaf],
    ) -> Self {
        let (leaves, rest) = leaves.split_at(built.leaves.min(leaves.len()));
        Self {
            spheres,
            nodes: nodes.get(..built.nodes).unwrap_or_default(),
            leaves,
            outside: rest.get(..built.outside).unwrap_or_default(),
            root: built.root,
            scale: built.scale,
            extent: built.extent,
        }
    }

    /// No sphere of the tree is farther from the coordinates' origin: twice the extent is more than its diagonal.
    #[inline(always)]
    pub(crate) fn radius(&self) -> f32 {
        2.0 * self.extent / self.scale.factor
    }

    /// The spheres that are in the tree, in the order of their list.
    #[inline(always)]
    pub(crate) fn inside(&self) -> InsideSpheres<'a> {
        InsideSpheres { spheres: self.spheres, scale: self.scale }
    }

    /// The spheres that no bound sees.
    #[inline(always)]
    pub(crate) fn outside(&self) -> OutsideLeaves<'a> {
        OutsideLeaves { spheres: self.spheres, leaves: self.outside }
    }

    /// The list that the tree was built from.
    #[must_use]
    pub const fn spheres(&self) -> Spheres<'a> {
        self.spheres
    }

    /// The memory that the tree takes: at most what was needed.
    #[must_use]
    pub const fn size(&self) -> BvhSize {
        BvhSize { nodes: self.nodes.len(), leaves: self.leaves.len() + self.outside.len() }
    }

    /// How many nodes lie one below the other: 0 for up to sixteen spheres, at most 9.
    #[must_use]
    pub fn depth(&self) -> usize {
        // Children come after their parents, so one pass from the back would need memory;
        // a stack of the nodes on the way needs little.
        let mut pending = [(NO_CHILD, 0); WIDTH * (DEPTH + 1)];
        let (mut top, mut depth) = (1, 0);
        pending[0] = (self.root, 1);
        while top > 0 {
            top -= 1;
            let Some(&(child, level)) = pending.get(top) else { break };
            let Some(node) = self.nodes.get(child as usize) else { continue };
            depth = depth.max(level);
            for &child in node.child.iter().filter(|&&child| child & LEAF == 0) {
                if let Some(place) = pending.get_mut(top) {
                    *place = (child, level + 1);
                    top += 1;
                }
            }
        }
        depth
    }
}
