//! Slices and columns of rays: packed, traced and unpacked, some packets at a time, on the stack.

#[cfg(feature = "alloc")]
mod many_at_once;

use crate::Accuracy;
use crate::dispatch::Level;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::{Hit, HitPacket};
use crate::geometry::many::ManyRays;
use crate::geometry::ray::{Ray, RayPacket};
use crate::geometry::sphere::{Sphere, SpherePacket, Spheres};
use crate::geometry::surface::SurfacePacket;
use crate::linear::Writes;
use crate::spawn_ray::packets::{SurfaceHits, Towards};
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
#[cfg(not(feature = "std"))]
use crate::{dispatch::BuildLanes, linear, spawn_ray::packets, surface};

/// How many packets are traced at a time: enough that preparing 128 spheres of a list for them is a
/// hundredth of the work; for firmware as many as its stack holds.
const PACKETS: usize = if cfg!(feature = "std") { 64 } else { 4 };
/// How many packets go first, if as many as are traced at a time are left: only then is it known whether groups pay, or a
/// stream. (With 64, rays sorted by direction and half of a camera, among a million spheres, ran at 0.65 to 0.98 of ray by
/// ray, closest hits; with 16 at 0.81 to 1.26. Where fewer are left than a stream has, those that went first are lost to it:
/// 0.7 of the best way among nested spheres.)
const FIRST: usize = 16;
/// How many packets few rays fill: what goes through a tree together.
const FEW: usize = 4;

/// How many pairs are tested at a time.
#[cfg(feature = "std")]
const PAIRS: usize = RayPacket::COUNT;
/// How many pairs are tested at a time.
#[cfg(not(feature = "std"))]
const PAIRS: usize = <BuildLanes as crate::Lanes>::COUNT;

/// Answers every ray, as far as there is room for answers.
pub(crate) fn traverse<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: ManyRays<'_>,
    answers: Q::Many<'_>,
) {
    let count = rays.count().min(Q::room(&answers));
    #[cfg(feature = "std")]
    if count <= S::ONE_BY_ONE {
        let mut answers = answers;
        return one_by_one::<S, Q>(structure, tier, trace, (rays, 0, count), &mut answers);
    }
    trace.learnt.begin_call::<Q>(count.div_ceil(RayPacket::COUNT));
    // Memory is cleared before it is used: for few rays that takes longer than they do.
    if count <= RayPacket::COUNT {
        windows::<S, Q, 1>(structure, tier, trace, (rays, count), answers);
    } else if count <= FEW * RayPacket::COUNT {
        windows::<S, Q, FEW>(structure, tier, trace, (rays, count), answers);
    } else {
        windows::<S, Q, PACKETS>(structure, tier, trace, (rays, count), answers);
    }
}

/// Answers rays `from` to `to` one by one.
#[cfg(feature = "std")]
#[inline(always)]
fn one_by_one<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from, to): (ManyRays<'_>, usize, usize),
    answers: &mut Q::Many<'_>,
) {
    for index in from..to {
        if let Some(ray) = rays.ray(index) {
            Q::write_one(answers, index, structure.one::<Q>(tier, trace, &ray));
        }
    }
}

/// Answers rays, so many packets at a time. (The same trace for all: a call is one.)
#[inline(never)]
fn windows<S: Traverse + ?Sized, Q: LevelQuery, const AT_ONCE: usize>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, count): (ManyRays<'_>, usize),
    mut answers: Q::Many<'_>,
) {
    let mut packets = [RayPacket::BLANK; AT_ONCE];
    let mut answered = [Q::none::<[f32; 16]>(); AT_ONCE];
    let is_long = count >= (FIRST + AT_ONCE) * RayPacket::COUNT;
    let mut packets_at_once = if is_long { FIRST.min(AT_ONCE) } else { AT_ONCE };
    let mut from = 0;
    // Chunks divide by their length, and where that is not seen to be a number, may panic.
    while from < count {
        let to = (from + packets_at_once * RayPacket::COUNT).min(count);
        #[cfg(feature = "std")]
        if to - from <= S::ONE_BY_ONE {
            return one_by_one::<S, Q>(structure, tier, trace, (rays, from, to), &mut answers);
        }
        let part = rays.part(from, to);
        structure.many_in_packets::<Q>(tier, trace, part, &mut packets, &mut answered);
        #[cfg(feature = "std")]
        Q::write_at(trace.level, &mut answers, &answered, from, to);
        #[cfg(not(feature = "std"))]
        Q::write(&mut answers, &answered, from, to);
        from = to;
        packets_at_once = AT_ONCE;
        #[cfg(feature = "alloc")]
        {
            let rest = (rays, from, count);
            from = many_at_once::answer::<S, Q>(structure, tier, trace, rest, &mut answers);
        }
    }
}

/// Ray `i` against sphere `i` alone, packet by packet; the sphere index of a hit is its lane.
///
/// As [`pair_lanes`](crate::pair_lanes), at `level`. Packets past the end of the shortest slice are left as
/// they are.
///
/// ```
/// use spherule_kernel::{Exact, HitPacket, Level, Ray, RayPacket, SpherePacket, Vec3, pair_packets};
///
/// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
/// let spheres = [SpherePacket::new(&[[0.0, 0.0, 5.0, 1.0].into()])];
/// let mut hits = [HitPacket::none()];
/// pair_packets(Exact, Level::best(), &rays, &spheres, &mut hits);
/// assert_eq!(hits[0].t()[0], 4.0);
/// ```
pub fn pair_packets(
    tier: impl Accuracy,
    level: Level,
    rays: &[RayPacket],
    spheres: &[SpherePacket],
    hits: &mut [HitPacket],
) {
    #[cfg(feature = "std")]
    crate::dispatch::compiled::pairs(level, tier.tier(), rays, spheres, hits);
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        linear::each_pair::<wide::f32x16>(tier, (), rays, spheres, hits);
    }
}

/// Makes the rays of a camera's tiles at `level`, tile `i` in packet `i`, as far as there are tiles and packets: bit for bit
/// [`Camera::packet`](crate::Camera::packet)'s, except for the bits of a NaN, in a seventh (SSE2) to a twelfth (AVX-512) of its
/// time.
///
/// ```
/// use spherule_kernel::{Camera, CameraTiles, Level, Projection, RayPacket, Vec3, tile_rays};
///
/// let camera = Camera {
///     projection: Projection::Perspective { eye: Vec3::ZERO },
///     corner: Vec3::NEG_Z,
///     step_x: Vec3::X,
///     step_y: Vec3::NEG_Y,
/// };
/// let mut rays = [RayPacket::inactive(); 2];
/// let tiles = CameraTiles { camera, size: (8, 4), corners: &[(0, 0), (4, 0)] };
/// tile_rays(Level::best(), tiles, &mut rays);
/// assert_eq!(rays[1], camera.packet(4, 0, 8, 4));
/// ```
pub fn tile_rays(level: Level, tiles: CameraTiles<'_>, rays: &mut [RayPacket]) {
    #[cfg(feature = "std")]
    crate::dispatch::compiled::fill_tiles(level, tiles, rays);
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        tiles.fill::<wide::f32x16>((), tiles.corners, rays);
    }
}

/// Sphere `index` of a list against the rays of those packets that `numbers` names, whose closest hits so far are
/// `hits`: object order. Returns how many hits that stored.
///
/// As [`object_lanes`](crate::object_lanes), at `level`. A number past the end of rays or hits changes nothing.
///
/// ```
/// use spherule_kernel::{Exact, HitPacket, Level, Ray, RayPacket, SphereList, Vec3, object_packets};
///
/// let list = SphereList::from([[0.0, 0.0, 9.0, 1.0], [0.0, 0.0, 5.0, 1.0]]);
/// let packet = RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]);
/// let (rays, mut hits) = ([packet; 3], [HitPacket::none(); 3]);
/// for index in 0..2 {
///     object_packets(Exact, Level::best(), list.spheres(), index, &[0, 2], &rays, &mut hits);
/// }
/// assert_eq!(hits.map(|hits| hits.t()[0]), [4.0, f32::INFINITY, 4.0]);
/// ```
pub fn object_packets(
    tier: impl Accuracy,
    level: Level,
    spheres: Spheres<'_>,
    index: u32,
    numbers: &[u32],
    rays: &[RayPacket],
    hits: &mut [HitPacket],
) -> Writes {
    let (object, mut writes) = ((spheres, index), Writes::default());
    #[cfg(feature = "std")]
    {
        let (tier, asked) = (tier.tier(), (numbers, rays));
        crate::dispatch::compiled::object(level, tier, object, asked, hits, &mut writes);
    }
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        writes += linear::one_object::<wide::f32x16>(tier, (), object, numbers, rays, hits);
    }
    writes
}

/// [`surface`](crate::surface()) for the rays of every packet, and what they hit among `spheres`.
///
/// As [`surface_lanes`](crate::surface_lanes), at `level`. Packets past the end of the shortest slice are left as
/// they are.
///
/// ```
/// use spherule_kernel::{
///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Trace, Vec3,
///     surface_packets,
/// };
///
/// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0]]);
/// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
/// let mut hits = [HitPacket::none()];
/// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
/// let mut surfaces = [SurfacePacket::none()];
/// surface_packets(Exact, Level::best(), tree.list().spheres(), &rays, &hits, &mut surfaces);
/// assert_eq!(surfaces[0].normal(0), -Vec3::Z);
/// ```
pub fn surface_packets(
    tier: impl Accuracy,
    level: Level,
    spheres: Spheres<'_>,
    rays: &[RayPacket],
    hits: &[HitPacket],
    surfaces: &mut [SurfacePacket],
) {
    #[cfg(feature = "std")]
    crate::dispatch::compiled::surfaces(level, tier.tier(), spheres, (rays, hits), surfaces);
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        surface::each_packet::<wide::f32x16>(tier, (), spheres, rays, hits, surfaces);
    }
}

/// Rays to a light from what the rays of every packet hit, each from the side that its ray came from, if that faces
/// the light.
///
/// As [`shadow_lanes`](crate::shadow_lanes), at `level`. What is hit are rays, hits and surfaces; packets past the
/// end of the shortest slice are left as they are.
///
/// ```
/// use spherule_kernel::{
///     Exact, HitPacket, Intersect, Level, Ray, RayPacket, SphereTree, SurfacePacket, Towards, Trace,
///     Vec3, shadow_packets, surface_packets,
/// };
///
/// let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, -5.0, 1.0]]);
/// let (rays, level) = ([RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])], Level::best());
/// let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
/// tree.closest_hit_packets(Exact, &mut Trace::new(), &rays, &mut hits);
/// let spheres = tree.list().spheres();
/// surface_packets(Exact, level, spheres, &rays, &hits, &mut surfaces);
///
/// let mut shadow_rays = [RayPacket::inactive()];
/// let light = Towards::Point(Vec3::new(0.0, 0.0, -20.0));
/// shadow_packets(Exact, level, spheres, (&rays, &hits, &surfaces), light, &mut shadow_rays);
/// let mut occluded = [0];
/// tree.any_hit_packets(Exact, &mut Trace::new(), &shadow_rays, &mut occluded);
/// assert_eq!(occluded, [1]); // the other sphere is in the way
/// ```
pub fn shadow_packets(
    tier: impl Accuracy,
    level: Level,
    spheres: Spheres<'_>,
    hit: SurfaceHits<'_>,
    towards: Towards,
    shadow_rays: &mut [RayPacket],
) {
    #[cfg(feature = "std")]
    crate::dispatch::compiled::shadows(level, tier.tier(), spheres, hit, towards, shadow_rays);
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        packets::each_packet::<wide::f32x16>(tier, (), spheres, hit, towards, shadow_rays);
    }
}

/// Ray `i` against sphere `i` alone, at the best level that the CPU has; the sphere of a hit is `i`.
///
/// Returns bit for bit what [`Intersect`](crate::Intersect) finds for that ray in a list of that sphere.
/// What is past the end of the shortest slice is left as it is.
///
/// ```
/// use spherule_kernel::{Exact, Ray, Sphere, Vec3, pairs};
///
/// let rays = [Ray::new(Vec3::ZERO, Vec3::Z); 2];
/// let spheres = [Sphere::from([0.0, 9.0, 5.0, 1.0]), Sphere::from([0.0, 0.0, 5.0, 1.0])];
/// let mut hits = [None; 2];
/// pairs(Exact, &rays, &spheres, &mut hits);
/// assert_eq!(hits.map(|hit| hit.map(|hit| (hit.t, hit.sphere))), [None, Some((4.0, 1))]);
/// ```
pub fn pairs(tier: impl Accuracy, rays: &[Ray], spheres: &[Sphere], hits: &mut [Option<Hit>]) {
    let count = rays.len().min(spheres.len()).min(hits.len());
    let mut from = 0;
    while from < count {
        let to = (from + PAIRS).min(count);
        let rays = RayPacket::new(rays.get(from..to).unwrap_or_default());
        let others = SpherePacket::new(spheres.get(from..to).unwrap_or_default());
        #[cfg(feature = "std")]
        let found = {
            let mut found = [HitPacket::none()];
            pair_packets(tier, Level::best(), &[rays], &[others], &mut found);
            found[0]
        };
        #[cfg(not(feature = "std"))]
        let found = linear::pair_lanes::<BuildLanes>(tier, (), &rays, &others);
        let answers = hits.get_mut(from..to).unwrap_or_default();
        for (place, (answer, hit)) in answers.iter_mut().zip(found.hits()).enumerate() {
            *answer = hit.map(|hit| Hit { sphere: (from + place) as u32, ..hit });
        }
        from = to;
    }
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    use crate::proofs::work::{Kind, Work};
    use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Vec3};

    #[test]
    fn few_rays_go_one_by_one() {
        let list: SphereList = (0..200).map(|number| (Vec3::X * number as f32, 0.25)).collect();
        let tree = SphereTree::new(list);
        let rays: [Ray; 40] =
            core::array::from_fn(|number| Ray::new(Vec3::new(number as f32, 0.1, -9.0), Vec3::Z));
        for (count, is_packet) in [(1, false), (5, false), (8, false), (9, true), (40, true)] {
            let rays = &rays[..count];
            let (mut hits, mut occluded) = ([None; 40], [false; 40]);
            let closest = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            let any = Work::of(|| tree.any_hits(Exact, rays, &mut occluded));
            // What goes by itself clears no stack; what goes together enters the nodes with its packets.
            let as_packets =
                |work: Work| work.count(Kind::RayStacks) + work.count(Kind::GroupNode) > 0;
            assert_eq!([closest, any].map(as_packets), [is_packet; 2], "{count}");
            for (number, ray) in rays.iter().enumerate() {
                assert_eq!(hits[number], tree.closest_hit(Exact, ray));
                assert_eq!(occluded[number], tree.any_hit(Exact, ray));
            }
            assert!(
                hits[..count].iter().all(Option::is_some) && hits[count..] == [None; 40][count..]
            );
        }
    }

    #[test]
    fn the_last_few_rays_of_a_long_call_have_answers_of_their_own() {
        let list: SphereList = (0..200).map(|number| (Vec3::X * number as f32, 0.25)).collect();
        let tree = SphereTree::new(list);
        let rays: [Ray; 1027] = core::array::from_fn(|number| {
            let x = if number < 1024 { (number % 200) as f32 } else { 1e3 };
            Ray::new(Vec3::new(x, 0.1, -9.0), Vec3::Z)
        });
        let (mut hits, mut occluded) = ([None; 1027], [false; 1027]);
        tree.closest_hits(Exact, &rays, &mut hits);
        tree.any_hits(Exact, &rays, &mut occluded);
        let together = |count| {
            let (rays, mut hits) = (&rays[..count], [None; 1027]);
            let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            [Kind::RayStacks, Kind::GroupNode].map(|kind| work.count(kind))
        };
        assert_eq!(together(1027), together(1024), "the last three go one by one");
        for number in 0..rays.len() {
            assert_eq!(hits[number].is_some(), number < 1024, "{number}");
            assert_eq!(occluded[number], number < 1024, "{number}");
        }
    }
}
