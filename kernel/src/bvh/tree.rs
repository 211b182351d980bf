//! The tree, borrowed.

use super::boxes_per_ray::BoxesPerRay;
use super::build::budget::{BvhSize, needed};
use super::build::join::{InTurn, Join};
use super::build::top_down;
use super::built::Built;
use super::leaf::{Leaf, extent_of, number_of};
use super::node::BvhNode;
use super::prefetch::NEAR_BYTES;
use super::source::{SomeSpheres, SphereSource, Which};
use crate::geometry::sphere::{Sphere, Spheres};
use crate::memory::TooSmall;
use crate::scale::scene::SceneScale;
use glam::Vec3;

/// A tree over a list of spheres, in the caller's memory.
///
/// It borrows the list that it was built from, and holds copies of its spheres in an order of its own.
///
/// It answers bit for bit what the list does, by [`Exact`](crate::Exact) for every input, by [`Stable`](crate::Stable) in its domain. Of the
/// hits that [`Fast`](crate::Fast) and [`Geometric`](crate::Geometric) find on lines that pass a sphere by, a tree of more than four spheres
/// loses those on lines that miss the box around the sphere: by every call the same. Where squares of these tiers underflow, or of `Stable`
/// outside its domain, such a tree may take what its bounds see for what the formula sees: that may depend on the other rays of a call.
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
    /// A node, a leaf with [`LEAF`](super::node::LEAF) set, or [`NO_CHILD`](super::node::NO_CHILD).
    pub(crate) root: u32,
    /// How bounds see lengths.
    pub(crate) scale: SceneScale,
    /// No coordinate of a box is larger than this, as bounds see it.
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
    fn is_tree(&self) -> bool {
        true
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
    /// Returns how much memory any list of `count` spheres needs: at most 40 bytes a sphere, and 1,040 more. A built tree takes
    /// 24 to 28 bytes a sphere of it, as [`size`](Bvh::size) says.
    ///
    /// More than 2^27 spheres are too many: then no memory is enough.
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

    /// Builds a tree over `spheres` in the given memory, which is overwritten.
    ///
    /// Spheres that are not valid are left out. The same list gives the same tree on every target.
    ///
    /// Cost: time in proportion to n log n for n spheres, wherever they lie, since a node makes at most fifteen cuts, and its
    /// children have at most an eighth of its spheres. Stack: some 40 KiB, or 34 KiB on a Cortex-M4F (`tests/targets/sizes`);
    /// where that is too much, a [`Bvh4`](crate::Bvh4) takes 2.7 KiB (`docs/targets.md`). No other memory.
    ///
    /// # Errors
    /// [`TooSmall`] if a slice is shorter than [`Bvh::needed`] says. A longer slice is no error, and its rest is left alone.
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

    /// Builds the same tree as [`Bvh::build`], with parts of the work running at once on the caller's threads.
    ///
    /// Cost: for a million spheres, two threads take some 0.7 of the time of one.
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
        let built = Self::built(join, &spheres, nodes, places, indices)?;
        Ok(Self::of(built, spheres, nodes, places, indices))
    }

    /// Builds a tree; returns an error if the memory is less than the spheres need.
    pub(super) fn built(
        join: &impl Join,
        spheres: &Spheres<'_>,
        nodes: &mut [BvhNode],
        places: &mut [[f32; 4]],
        indices: &mut [u32],
    ) -> Result<Built, TooSmall> {
        let needed = Self::needed(spheres.len());
        TooSmall::check("nodes", needed.nodes, nodes.len())?;
        TooSmall::check("places", needed.places, places.len())?;
        TooSmall::check("indices", needed.places, indices.len())?;
        Ok(top_down::build(join, spheres, nodes, places, indices))
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

    /// No sphere of the tree is farther from the coordinates' origin than this: twice the extent is more than its diagonal.
    #[inline(always)]
    pub(crate) fn radius(&self) -> f32 {
        2.0 * self.extent / self.scale.factor
    }

    /// How many bytes its boxes and spheres take.
    #[inline(always)]
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.nodes) + size_of_val(self.numbers)
    }

    /// Whether the tree is near the core: its second-level cache holds it.
    #[inline(always)]
    pub(crate) fn is_near(&self) -> bool {
        self.bytes() <= NEAR_BYTES
    }

    /// The spheres that are in the tree, in the order of their list.
    #[inline(always)]
    pub(crate) fn inside(&self) -> SomeSpheres<'a> {
        SomeSpheres { spheres: self.spheres, which: Which::Inside(self.scale) }
    }

    /// The spheres that no bound sees.
    #[inline(always)]
    pub(crate) fn outside(&self) -> SomeSpheres<'a> {
        SomeSpheres { spheres: self.spheres, which: Which::Indices(self.outside) }
    }

    /// The leaf of a number.
    #[inline(always)]
    pub(crate) fn leaf(&self, number: u32) -> Option<Leaf<'a>> {
        Leaf::of(self.numbers, number)
    }

    /// Returns the list that the tree was built from.
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

    /// Returns by how much the boxes have grown: how many boxes a ray is expected to enter, divided by how many it was expected
    /// to enter when the tree was built. It is 1 for a tree that was not refitted, and finite and above 0 for any.
    ///
    /// The time that a ray spends on boxes has grown by about this factor. At 1.5 or 2, build the tree
    /// anew if it is used for more than a few frames.
    ///
    /// This is an estimate by the surface area heuristic (MacDonald and Booth 1990), for rays through the space in which most of
    /// the spheres are. It stays 1 if the scene grows or shrinks as a whole,
    /// or moves to within some 2^10 of its spheres' sizes of the coordinates' origin: farther off margins grow, in a new tree
    /// as well. Sixteen spheres that no box holds, which every ray must meet, count as one box that every ray enters. Trees of
    /// up to 64 spheres have no boxes that a ray looks at.
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

    /// Returns how much memory the tree takes: at most what [`needed`](Bvh::needed) says; after a refit, a place more for each sphere that
    /// no box holds.
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

    /// Returns how many nodes lie one below the other: 0 for up to sixteen spheres, at most 10.
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
        self.depth_below(self.root)
    }

    /// How many nodes lie one below the other from a child on.
    fn depth_below(&self, child: u32) -> usize {
        // What is a leaf, or not there, has a number past all nodes.
        let Some(node) = self.nodes.get(child as usize) else { return 0 };
        1 + node.child.iter().map(|&child| self.depth_below(child)).max().unwrap_or(0)
    }
}
