//! The door: every scene structure answers the same questions, by the same methods.

use crate::Accuracy;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::columns::{HitColumns, RayColumns};
use crate::geometry::hit::{Hit, HitPacket};
use crate::geometry::many::ManyRays;
use crate::geometry::many_answers::{ManyHits, ManyOccluded};
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::Lanes;
use crate::query::{AnyHit, ClosestHit};
use crate::slices;
use crate::structures::Traverse;
use crate::structures::lend::Lend;
use crate::trace::Trace;

/// Spheres that rays are intersected with: [`Spheres`](crate::Spheres) tests every ray against every sphere; a
/// [`Bvh`](crate::Bvh) is for many spheres; a [`DepthList`](crate::DepthList) is for rays of a common origin or direction, without a
/// tree; a [`Bvh4`](crate::Bvh4) is for firmware. `SphereList` and `SphereTree` own what `Spheres` and `Bvh` borrow.
///
/// # Guarantee
///
/// The closest hit has the smallest accepted root. [`Exact`](crate::Exact) compares roots as real numbers, the other
/// tiers compare t; among equals the lowest index wins. t is in multiples of each ray's own direction.
///
/// Every structure returns bit for bit what the list returns, at every level, in every lane width, alone or beside any
/// other ray, and [`any_hit`](Intersect::any_hit) returns true exactly if there is a closest hit. (`Bvh`, `Bvh4` and `DepthList` say what
/// that means for `Fast` and `Geometric`, and for `Stable` outside its domain.) `any_hit` is cheaper, since a ray is done as soon as it has
/// hit something. The [crate's page](crate#every-hit-of-a-ray) says how to find every hit.
///
/// # Domain
///
/// Every bit pattern is allowed. Invalid rays and spheres hit nothing, and change nothing for their neighbours (`docs/contract.md`,
/// rule 1). If the slices differ in length, rays past the end of the answers are ignored, and answers past the end of the rays are
/// left as they are.
///
/// # Cost
///
/// A list takes some 8 operations for a ray and a sphere that miss each other, and the tier's price for other pairs. To prepare 128
/// spheres costs as much as to test one packet against them, so pass many rays in one call.
///
/// A tree takes time in proportion to the logarithm of the number of spheres, if they do not overlap much. Spheres that are 2^40 times
/// as large or as small as most cost as much as in a list. So do rays that start farther away than 2^56 times the size of most
/// spheres.
///
/// Neither units nor the lengths of directions matter to any structure.
///
/// Beside the traversal, a call pays for its layer:
///
/// | layer | rays are | costs |
/// |---|---|---|
/// | slices, columns | `&[Ray]`, [`RayColumns`] | some 3 ns a ray, to pack and unpack it |
/// | packets | `&[RayPacket]`, sixteen rays each | nothing, unless a tree sorts shuffled rays: these are copied |
/// | lanes | packets as wide as your vectors, and their token | compiled in your crate: its profile counts |
///
/// Slices, columns and packets are traced at the best level that the CPU has, or at the one that [`Trace`] names.
///
/// # Stack
///
/// With `std`, provide 256 KiB for slices, columns and packets, and 512 in a build that checks for overflow: a tree that sorts the
/// shuffled rays of a long call takes 130 to 160 KiB by slices with AVX2, 96 to 128 at the baseline. (Rust's threads have 2 MiB
/// by default.) Rays that are not sorted take up to 110 KiB in a tree by slices; in a list 46.
///
/// These are figures of optimised builds. At `opt-level = 0` a tree takes up to 0.4 MiB, by `Fast` and `Geometric` 0.8, since there the
/// rays of slices, packets and tiles go one by one. Lanes of your own take 2.3 MiB there, a list 1.6, and a depth list 3: Rust's threads
/// have 2.
///
/// Without `std`, slices take some 8 KiB in a list. On a Cortex-M4F, one ray a call takes 0.6 to 2.9 KiB in a list or a
/// [`Bvh4`](crate::Bvh4), by tier, and some 8 in a [`Bvh`](crate::Bvh); `docs/targets.md` says how much to provide.
///
/// # Where it runs
///
/// Calls are reentrant, and structures may be shared by threads. No call can be stopped: for an answer in time, pass fewer rays a call.
///
/// The trait is not dyn-compatible, since its methods are generic over the tier. If the structure is chosen at run time, match on an enum
/// of yours; [`Tier`](crate::Tier) is a tier that is chosen so.
///
/// ```
/// use spherule_kernel::{Exact, Hit, Intersect, Ray, SphereList, Vec3};
///
/// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
/// let rays = [Ray::new(Vec3::ZERO, Vec3::Z), Ray::new(Vec3::ZERO, Vec3::X)];
/// let mut hits = [None; 2];
/// spheres.closest_hits(Exact, &rays, &mut hits);
/// assert_eq!(hits, [Some(Hit { t: 4.0, sphere: 0 }), None]);
/// ```
pub trait Intersect: Lend {
    /// Returns the list whose indices hits name, for [`surface()`](crate::surface()) and [`compare_hits`](crate::compare_hits).
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, Sphere, SphereTree, Vec3};
    ///
    /// fn hit_sphere(scene: &impl Intersect, ray: &Ray) -> Option<Sphere> {
    ///     let hit = scene.closest_hit(Exact, ray)?;
    ///     scene.spheres().get(hit.sphere as usize)
    /// }
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// assert_eq!(hit_sphere(&tree, &Ray::new(Vec3::ZERO, Vec3::Z)), tree.spheres().get(0));
    /// ```
    fn spheres(&self) -> Spheres<'_> {
        self.list()
    }

    /// Returns the closest hit of one ray; `None` if it hits nothing.
    ///
    /// Cost: with `std` a tree has a traversal for one ray, and other structures use one lane of a packet. Many rays in one call are
    /// faster. Without `std` everything is computed in one lane, which takes the least flash and stack, as firmware needs.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereList, Vec3};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let hit = spheres.closest_hit(Exact, &Ray::new(Vec3::ZERO, Vec3::Z));
    /// assert_eq!(hit.map(|hit| hit.t), Some(4.0));
    /// ```
    fn closest_hit(&self, tier: impl Accuracy, ray: &Ray) -> Option<Hit> {
        self.lend().one_plainly::<ClosestHit>(tier, ray)
    }

    /// Returns whether one ray hits anything.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereList, Vec3};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    /// assert!(spheres.any_hit(Exact, &ray));
    /// assert!(!spheres.any_hit(Exact, &Ray { t_max: 3.9, ..ray }));
    /// ```
    fn any_hit(&self, tier: impl Accuracy, ray: &Ray) -> bool {
        self.lend().one_plainly::<AnyHit>(tier, ray)
    }

    /// [`closest_hit`](Intersect::closest_hit), traced as `trace` says.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Trace, Vec3};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// let mut trace = Trace::new();
    /// let hit = tree.closest_hit_with(Exact, &mut trace, &Ray::new(Vec3::ZERO, Vec3::Z));
    /// assert_eq!(hit.map(|hit| hit.t), Some(4.0));
    /// ```
    fn closest_hit_with(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        ray: &Ray,
    ) -> Option<Hit> {
        self.lend().one::<ClosestHit>(tier, trace, ray)
    }

    /// [`any_hit`](Intersect::any_hit), traced as `trace` says.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Trace, Vec3};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// assert!(tree.any_hit_with(Exact, &mut Trace::new(), &Ray::new(Vec3::ZERO, Vec3::Z)));
    /// ```
    fn any_hit_with(&self, tier: impl Accuracy, trace: &mut Trace<'_>, ray: &Ray) -> bool {
        self.lend().one::<AnyHit>(tier, trace, ray)
    }

    /// Finds the closest hit of every ray: `hits[i]` becomes that of `rays[i]`, or `None` if the ray hits nothing.
    ///
    /// Rays may come in any order: a tree finds out which of them are faster together. It traces a call of up to eight rays one by
    /// one, and also a longer call of few rays that gain nothing together. If many rays come shuffled, it sorts those of a camera or
    /// of a beam, and in a large tree other rays, too. If many rays start in one point, and do much in the tree, as inside nested spheres,
    /// it sorts the spheres (100,000 at most) by their distance from there, and traces the rays as a [`DepthList`](crate::DepthList) does:
    /// by `Exact` and `Stable`.
    ///
    /// With feature `alloc`, a call of more than 1,008 rays in a tree of more than four leaves may allocate up to 430 bytes a ray, at
    /// most 4.5 MB. It does so to sort rays that have nothing in common with those next to them, or to trace them as a stream. With
    /// `std`, a call from 1,280 rays on may allocate 24 bytes a sphere to sort spheres, at most 2.4 MB. If an allocation fails, the
    /// call goes on without the memory.
    ///
    /// ```
    /// use spherule_kernel::{Intersect, Ray, Spheres, Stable, Vec3};
    ///
    /// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0])?;
    /// let mut hits = [None];
    /// spheres.closest_hits(Stable, &[Ray::new(Vec3::ZERO, Vec3::Z)], &mut hits);
    /// assert_eq!(hits[0].map(|hit| hit.sphere), Some(0));
    /// # Ok::<(), spherule_kernel::SpheresError>(())
    /// ```
    fn closest_hits(&self, tier: impl Accuracy, rays: &[Ray], hits: &mut [Option<Hit>]) {
        self.closest_hits_with(tier, &mut Trace::new(), rays, hits);
    }

    /// Finds whether each ray hits anything: `occluded[i]` becomes true if `rays[i]` does, else false.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Vec3};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// let mut occluded = [false; 2];
    /// tree.any_hits(Exact, &[Vec3::Z, Vec3::X].map(|d| Ray::new(Vec3::ZERO, d)), &mut occluded);
    /// assert_eq!(occluded, [true, false]);
    /// ```
    fn any_hits(&self, tier: impl Accuracy, rays: &[Ray], occluded: &mut [bool]) {
        self.any_hits_with(tier, &mut Trace::new(), rays, occluded);
    }

    /// [`closest_hits`](Intersect::closest_hits), traced as `trace` says.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Trace, Vec3};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// let mut hits = [None];
    /// let rays = [Ray::new(Vec3::ZERO, Vec3::Z)];
    /// tree.closest_hits_with(Exact, &mut Trace::new().incoherent(), &rays, &mut hits);
    /// assert!(hits[0].is_some());
    /// ```
    fn closest_hits_with(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
    ) {
        let (rays, hits) = (ManyRays::Slice(rays), ManyHits::Slice(hits));
        slices::traverse::<_, ClosestHit>(&*self.lend(), tier, trace, rays, hits);
    }

    /// [`any_hits`](Intersect::any_hits), traced as `trace` says.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, SphereTree, Trace, Vec3};
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
    /// let mut occluded = [false];
    /// tree.any_hits_with(Exact, &mut Trace::new().coherent(), &[Ray::new(Vec3::ZERO, Vec3::Z)], &mut occluded);
    /// assert!(occluded[0]);
    /// ```
    fn any_hits_with(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[Ray],
        occluded: &mut [bool],
    ) {
        let (rays, occluded) = (ManyRays::Slice(rays), ManyOccluded::Slice(occluded));
        slices::traverse::<_, AnyHit>(&*self.lend(), tier, trace, rays, occluded);
    }

    /// Finds the closest hit of every ray in eight columns, and writes it into two columns: number `i` of each becomes the hit of ray
    /// `i`, or `+inf` and [`HitColumns::NO_SPHERE`] if the ray hits nothing. The shortest column decides how many rays are traced; hits
    /// past its end are left as they are.
    ///
    /// Cost: that of slices. Threads share the rays by [`RayColumns::part`].
    ///
    /// ```
    /// use spherule_kernel::{Exact, HitColumns, Intersect, RayColumns, SphereList, Trace};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// // Two rays from the origin: along z, and along x.
    /// let (zero, infinity) = ([0.0; 2], [f32::INFINITY; 2]);
    /// let direction: [&[f32]; 3] = [&[0.0, 1.0], &zero, &[1.0, 0.0]];
    /// let rays = RayColumns { origin: [&zero; 3], direction, t_min: &zero, t_max: &infinity };
    /// let (mut t, mut sphere) = ([0.0; 2], [0; 2]);
    /// let hits = HitColumns { t: &mut t, sphere: &mut sphere };
    /// spheres.closest_hit_columns(Exact, &mut Trace::new(), rays, hits);
    /// assert_eq!((t, sphere), ([4.0, f32::INFINITY], [0, HitColumns::NO_SPHERE]));
    /// ```
    fn closest_hit_columns(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: RayColumns<'_>,
        hits: HitColumns<'_>,
    ) {
        let (rays, hits) = (ManyRays::Columns(rays), ManyHits::Columns(hits));
        slices::traverse::<_, ClosestHit>(&*self.lend(), tier, trace, rays, hits);
    }

    /// Finds whether each ray of eight columns hits anything. The shortest column decides how many rays are traced; answers past its
    /// end are left as they are.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, RayColumns, SphereList, Trace};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let (zero, one, ends) = ([0.0; 2], [1.0; 2], [3.9, 4.0]);
    /// let rays = RayColumns {
    ///     origin: [&zero; 3],
    ///     direction: [&zero, &zero, &one],
    ///     t_min: &zero,
    ///     t_max: &ends,
    /// };
    /// let mut occluded = [true; 2];
    /// spheres.any_hit_columns(Exact, &mut Trace::new(), rays, &mut occluded);
    /// assert_eq!(occluded, [false, true]);
    /// ```
    fn any_hit_columns(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: RayColumns<'_>,
        occluded: &mut [bool],
    ) {
        let (rays, occluded) = (ManyRays::Columns(rays), ManyOccluded::Slice(occluded));
        slices::traverse::<_, AnyHit>(&*self.lend(), tier, trace, rays, occluded);
    }

    /// Finds the closest hit of every ray of every packet: `hits[i]` becomes those of `rays[i]`. A long call sorts shuffled rays, as
    /// [`closest_hits`](Intersect::closest_hits) does.
    ///
    /// ```
    /// use spherule_kernel::{Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// // Lanes that are not filled are inactive.
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::none()];
    /// spheres.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].hits().flatten().count(), 1);
    /// ```
    fn closest_hit_packets(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[RayPacket],
        hits: &mut [HitPacket],
    ) {
        slices::traverse_packets::<_, ClosestHit>(&*self.lend(), tier, trace, rays, hits);
    }

    /// Finds whether each ray of every packet hits anything: bit `i` of `occluded[k]` is set if lane `i` of `rays[k]` does.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, RayPacket, SphereList, Trace, Vec3};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut occluded = [0];
    /// spheres.any_hit_packets(Exact, &mut Trace::new(), &rays, &mut occluded);
    /// assert_eq!(occluded, [1]);
    /// ```
    fn any_hit_packets(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        rays: &[RayPacket],
        occluded: &mut [u32],
    ) {
        slices::traverse_packets::<_, AnyHit>(&*self.lend(), tier, trace, rays, occluded);
    }

    /// Makes the rays of a camera's tiles, and finds their closest hits. Rays and hits of tile `i` go to packet `i`, as far as there
    /// are tiles, rays and hits.
    ///
    /// `rays` is overwritten, and then holds the rays for shading. They are bit for bit those of
    /// [`Camera::packet`](crate::Camera::packet), except for the bits of a NaN. The answers are bit for bit those of
    /// [`closest_hit_packets`](Intersect::closest_hit_packets). A tree need not read the rays of four tiles to know what they may meet:
    /// the tiles' corners bound them.
    ///
    /// Cost: a tree takes as long as for packets that exist already. To make packets one by one and then trace them takes up to twice
    /// as long. Other structures make the rays first, in lanes. With feature `alloc`, a tree may allocate memory for a stream, as
    /// [`closest_hit_lanes`](Intersect::closest_hit_lanes) does.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Camera, CameraTiles, Exact, HitPacket, Intersect, Projection, RayPacket, SphereTree, Trace, Vec3,
    /// };
    ///
    /// let tree = SphereTree::new([[0.0, 0.0, -5.0, 1.0]]);
    /// let camera = Camera {
    ///     projection: Projection::Perspective { eye: Vec3::ZERO },
    ///     corner: Vec3::new(-0.35, 0.15, -1.0),
    ///     step_x: Vec3::new(0.1, 0.0, 0.0),
    ///     step_y: Vec3::new(0.0, -0.1, 0.0),
    /// };
    /// // A picture of 8 x 4 pixels: two tiles.
    /// let tiles = CameraTiles { camera, size: (8, 4), corners: &[(0, 0), (4, 0)] };
    /// let (mut rays, mut hits) = ([RayPacket::inactive(); 2], [HitPacket::none(); 2]);
    /// tree.closest_hit_tiles(Exact, &mut Trace::new(), tiles, &mut rays, &mut hits);
    /// // A disc of twelve pixels: half of them in either tile.
    /// assert_eq!(hits.map(|tile| tile.hits().flatten().count()), [6, 6]);
    /// ```
    fn closest_hit_tiles(
        &self,
        tier: impl Accuracy,
        trace: &mut Trace<'_>,
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket],
        hits: &mut [HitPacket],
    ) {
        trace.learnt.begin_call::<ClosestHit>(rays.len());
        self.lend().tiles_in_packets(tier, trace, tiles, rays, hits);
    }

    /// [`closest_hit_packets`](Intersect::closest_hit_packets) in the caller's lanes, with their token. The level of `trace`
    /// is ignored.
    ///
    /// No rays are sorted. With feature `alloc`, a call of 1,024 rays or more in a tree of more than four leaves may allocate up to 384
    /// bytes a ray, at most 3.2 MB, to trace rays as a stream. It does not do so if `trace` [lends](Trace::with_stream) memory, or says
    /// that the rays are [incoherent](Trace::incoherent). If the allocation fails, the call goes on without the memory.
    ///
    /// ```
    /// use spherule_kernel::{Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3, f32x8};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let rays = [RayPacket::<[f32; 8]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut hits = [HitPacket::<[f32; 8]>::none()];
    /// spheres.closest_hit_lanes::<f32x8>(Exact, (), &mut Trace::new(), &rays, &mut hits);
    /// assert_eq!(hits[0].hit(0).map(|hit| hit.t), Some(4.0));
    /// ```
    #[inline(always)]
    fn closest_hit_lanes<L: Lanes>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        trace: &mut Trace<'_>,
        rays: &[RayPacket<L::Array>],
        hits: &mut [HitPacket<L::Array>],
    ) {
        trace.learnt.begin_call::<ClosestHit>(rays.len());
        self.lend().in_lanes::<L, ClosestHit>(tier, token, trace, rays, hits);
    }

    /// [`any_hit_packets`](Intersect::any_hit_packets) in the caller's lanes, with their token. The level of `trace` is
    /// ignored. Memory is as for [`closest_hit_lanes`](Intersect::closest_hit_lanes).
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, RayPacket, SphereList, Trace, Vec3};
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    /// let rays = [RayPacket::<[f32; 1]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
    /// let mut occluded = [0];
    /// spheres.any_hit_lanes::<f32>(Exact, (), &mut Trace::new(), &rays, &mut occluded);
    /// assert_eq!(occluded, [1]);
    /// ```
    #[inline(always)]
    fn any_hit_lanes<L: Lanes>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        trace: &mut Trace<'_>,
        rays: &[RayPacket<L::Array>],
        occluded: &mut [u32],
    ) {
        trace.learnt.begin_call::<AnyHit>(rays.len());
        self.lend().in_lanes::<L, AnyHit>(tier, token, trace, rays, occluded);
    }

    /// [`closest_hit_tiles`](Intersect::closest_hit_tiles) in the caller's lanes, with their token. Tiles are as large as
    /// [`Camera::tile`](crate::Camera::tile) says for these lanes. The level of `trace` is ignored.
    ///
    /// ```
    /// use spherule_kernel::{
    ///     Camera, CameraTiles, Exact, HitPacket, Intersect, Projection, RayPacket, SphereList, Trace, Vec3, f32x8,
    /// };
    ///
    /// let spheres = SphereList::from([[0.0, 0.0, -5.0, 1.0]]);
    /// // Rays along -z, a tenth apart, around the sphere's centre.
    /// let camera = Camera {
    ///     projection: Projection::Parallel { direction: -Vec3::Z },
    ///     corner: Vec3::new(-0.15, 0.05, 0.0),
    ///     step_x: Vec3::new(0.1, 0.0, 0.0),
    ///     step_y: Vec3::new(0.0, -0.1, 0.0),
    /// };
    /// let tiles = CameraTiles { camera, size: (4, 2), corners: &[(0, 0)] };
    /// let (mut rays, mut hits) = ([RayPacket::<[f32; 8]>::inactive()], [HitPacket::<[f32; 8]>::none()]);
    /// spheres.closest_hit_tile_lanes::<f32x8>(Exact, (), &mut Trace::new(), tiles, &mut rays, &mut hits);
    /// assert_eq!(hits[0].hits().flatten().count(), 8);
    /// ```
    #[inline(always)]
    fn closest_hit_tile_lanes<L: Lanes>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        trace: &mut Trace<'_>,
        tiles: CameraTiles<'_>,
        rays: &mut [RayPacket<L::Array>],
        hits: &mut [HitPacket<L::Array>],
    ) {
        trace.learnt.begin_call::<ClosestHit>(rays.len());
        self.lend().tiles_in_lanes::<L>(tier, token, trace, tiles, rays, hits);
    }
}

impl<S: Lend> Intersect for S {}
