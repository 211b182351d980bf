//! The tree, borrowed.

use super::boxes_per_ray::BoxesPerRay;
use super::build::budget::{BvhSize, needed};
use super::build::join::{InTurn, Join};
use super::build::top_down;
use super::built::Built;
use super::leaf::{Leaf, extent_of, number_of};
use super::node::{BvhNode, DEPTH, LEAF, NO_CHILD, WIDTH};
use super::source::{InsideSpheres, OutsideSpheres, SphereSource};
use crate::geometry::sphere::{Sphere, Spheres};
use crate::memory::TooSmall;
use crate::scale::scene::SceneScale;
use glam::Vec3;

/// A tree over a list of spheres, in memory of the caller's.
///
/// It keeps the list that it was built from, and holds copies of its spheres in an order of its own.
///
/// ```
/// use spherule_kernel::{Bvh, BvhNode, Exact, Intersect, Ray, Spheres, Vec3};
///
/// // No heap: memory for two spheres.
/// let spheres = Spheres::new(&[0.0, 0.0], &[0.0, 0.0], &[5.0, 9.0], &[1.0, 1.0]).expect("equal lengths");
/// const NEEDED: usize = Bvh::needed(2).places;
/// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
/// let tree = Bvh::build(spheres, &mut nodes, &mut places, &mut indices)?;
/// let hit = tree.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
/// assert_eq!(hit.map(|hit| (hit.t, hit.sphere)), Some((4.0, 0)));
/// # Ok::<(), spherule_kernel::TooSmall>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bvh<'a> {
    /// The list that it was built from.
    pub(crate) spheres: Spheres<'a>,
    pub(crate) nodes: &'a [BvhNode],
    /// The leaves, scaled: what [`Leaf::of`] reads.
    pub(crate) numbers: &'a [f32],
    /// The index of each place.
    pub(crate) indices: &'a [u32],
    /// Spheres that no bound sees.
    pub(crate) outside: &'a [u32],
    /// A node, a leaf with [`LEAF`] set, or [`NO_CHILD`].
    pub(crate) root: u32,
    /// How bounds see lengths.
    pub(crate) scale: SceneScale,
    /// No coordinate of a box is larger, as bounds see it.
    pub(crate) extent: f32,
    /// How many boxes a ray is expected to enter.
    pub(crate) boxes_per_ray: BoxesPerRay,
    /// What a ray was expected to cost when the tree was built.
    cost_when_built: f32,
}

impl SphereSource for Bvh<'_> {
    #[inline(always)]
    fn spheres(&self) -> Spheres<'_> {
        self.spheres
    }

    #[inline(always)]
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)> {
        let (number, lane) = number_of(place);
        let (begin, lanes) = extent_of(number);
        let at = 4 * begin + lane;
        match (
            self.numbers.get(at),
            self.numbers.get(at + lanes),
            self.numbers.get(at + 2 * lanes),
            self.numbers.get(at + 3 * lanes),
            self.indices.get(begin + lane),
        ) {
            (Some(&x), Some(&y), Some(&z), Some(&radius), Some(&index)) => {
                Some((self.scale.restored(&Sphere { center: Vec3::new(x, y, z), radius }), index))
            }
            _ => None,
        }
    }
}

impl<'a> Bvh<'a> {
    /// The memory that any list of `count` spheres needs: 40 bytes a sphere at most, and 700 bytes. What a tree takes
    /// of it, [`size`](Bvh::size) says: 24 to 28.
    ///
    /// More than 2^27 spheres are too many: no memory is enough then.
    ///
    /// ```
    /// use spherule_kernel::{Bvh, BvhSize};
    ///
    /// assert_eq!(Bvh::needed(100), BvhSize { nodes: 3, places: 134 });
    /// ```
    #[must_use]
    pub const fn needed(count: usize) -> BvhSize {
        needed(count)
    }

    /// Builds a tree over `spheres` in the memory given, whose contents do not matter.
    ///
    /// Spheres that are not valid are left out. The same list gives the same tree on every target.
    ///
    /// Cost: a cut looks at each of its spheres a bounded number of times, and a node makes fifteen
    /// cuts at most of runs that its children are eight times shorter than; so time grows by the
    /// number of spheres times its logarithm, whatever the spheres. Stack: some 40 KiB, on a
    /// Cortex-M4F 34 (`tests/targets/sizes`); where that is too much, a [`Bvh4`](crate::Bvh4) takes 2. No other memory.
    ///
    /// # Errors
    /// [`TooSmall`] if a slice is shorter than [`Bvh::needed`] says; longer is no error, and the
    /// rest is left alone.
    ///
    /// ```
    /// use spherule_kernel::{Bvh, Spheres};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let tree = Bvh::build(spheres, &mut nodes, &mut places, &mut indices)?;
    /// assert_eq!(tree.depth(), 0);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn build(
        spheres: Spheres<'a>,
        nodes: &'a mut [BvhNode],
        places: &'a mut [[f32; 4]],
        indices: &'a mut [u32],
    ) -> Result<Self, TooSmall> {
        Self::build_with(&InTurn, spheres, nodes, places, indices)
    }

    /// [`Bvh::build`] with several pieces of work at once, on threads of the caller's: the same tree.
    ///
    /// Cost: with two threads some 0.7 of the time for a million spheres.
    ///
    /// # Errors
    /// As [`Bvh::build`].
    ///
    /// ```
    /// use spherule_kernel::{Bvh, InTurn, Spheres};
    ///
    /// const NEEDED: usize = Bvh::needed(1).places;
    /// let (mut nodes, mut places, mut indices) = ([], [[0.0; 4]; NEEDED], [0; NEEDED]);
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0]).expect("equal lengths");
    /// let tree = Bvh::build_with(&InTurn, spheres, &mut nodes, &mut places, &mut indices)?;
    /// assert_eq!(tree.spheres().len(), 1);
    /// # Ok::<(), spherule_kernel::TooSmall>(())
    /// ```
    pub fn build_with(
        join: &impl Join,
        spheres: Spheres<'a>,
        nodes: &'a mut [BvhNode],
        places: &'a mut [[f32; 4]],
        indices: &'a mut [u32],
    ) -> Result<Self, TooSmall> {
        Self::check(spheres.len(), nodes, places, indices)?;
        let built = top_down::build(join, &spheres, nodes, places, indices);
        Ok(Self::of(built, spheres, nodes, places, indices))
    }

    /// An error where memory is less than so many spheres need.
    pub(super) fn check(
        count: usize,
        nodes: &[BvhNode],
        places: &[[f32; 4]],
        indices: &[u32],
    ) -> Result<(), TooSmall> {
        let needed = Self::needed(count);
        TooSmall::check(needed.nodes, nodes.len())?;
        TooSmall::check(needed.places, places.len())?;
        TooSmall::check(needed.places, indices.len())
    }

    /// The tree that was built in that memory.
    pub(super) fn of(
        built: Built,
        spheres: Spheres<'a>,
        nodes: &'a [BvhNode],
        places: &'a [[f32; 4]],
        indices: &'a [u32],
    ) -> Self {
        let (indices, rest) = indices.split_at(built.places.min(indices.len()));
        Self {
            spheres,
            nodes: nodes.get(..built.nodes).unwrap_or_default(),
            numbers: places
                .as_flattened()
                .get(built.shift..built.shift + built.leaves())
                .unwrap_or_default(),
            indices,
            outside: rest.get(..built.outside).unwrap_or_default(),
            root: built.root,
            scale: built.scale,
            extent: built.extent,
            boxes_per_ray: built.boxes_per_ray,
            cost_when_built: built.cost_when_built,
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
    pub(crate) fn outside(&self) -> OutsideSpheres<'a> {
        OutsideSpheres { spheres: self.spheres, indices: self.outside }
    }

    /// The leaf of a number.
    #[inline(always)]
    pub(crate) fn leaf(&self, number: u32) -> Option<Leaf<'a>> {
        Leaf::of(self.numbers, number)
    }

    /// The list that the tree was built from.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(tree.bvh().spheres().get(0).map(|sphere| sphere.radius), Some(1.0));
    /// ```
    #[must_use]
    pub const fn spheres(&self) -> Spheres<'a> {
        self.spheres
    }

    /// By how much the boxes have grown since the tree was built: how many boxes a ray is expected to enter, times how
    /// many it was then. 1 for a tree that was not refitted; finite and above 0 for any.
    ///
    /// A ray takes about so many times as long, as far as it is boxes that it spends its time on: where it is 1.5 or 2, a
    /// tree that is used for more than a few frames is better built anew. It is an estimate by the surface area heuristic
    /// (MacDonald and Booth 1990), for rays through the space in which most of the spheres are; a scene that moves, grows or shrinks
    /// as a whole has not grown. Sixteen spheres that no box holds, which every ray must meet, count as one box that every
    /// ray enters. Up to 64 spheres have no boxes that a ray looks at.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// assert_eq!(tree.bvh().growth(), 1.0);
    /// ```
    #[must_use]
    pub fn growth(&self) -> f32 {
        self.boxes_per_ray.cost(self.outside.len()) / self.cost_when_built
    }

    /// The memory that the tree takes: at most what was needed.
    ///
    /// ```
    /// use spherule_kernel::{Bvh, SphereTree};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
    /// let (size, needed) = (tree.bvh().size(), Bvh::needed(2));
    /// assert!(size.nodes <= needed.nodes && size.places <= needed.places);
    /// ```
    #[must_use]
    pub const fn size(&self) -> BvhSize {
        BvhSize { nodes: self.nodes.len(), places: self.indices.len() + self.outside.len() }
    }

    /// How many nodes lie one below the other: 0 for up to sixteen spheres, at most 10.
    ///
    /// ```
    /// use spherule_kernel::SphereTree;
    ///
    /// let at = |i: usize| [i as f32, 0.0, 0.0, 0.1];
    /// let tree = SphereTree::new((0..100).map(at).collect::<Vec<_>>());
    /// assert_eq!(tree.bvh().depth(), 1);
    /// ```
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
