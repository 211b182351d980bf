//! Functions that need no structure, packet by packet at a level: pairs, tiles of a camera, object order, surfaces, shadow
//! rays.

use crate::Accuracy;
use crate::dispatch::Level;
use crate::geometry::camera::tiles::CameraTiles;
use crate::geometry::hit::{Hit, HitPacket};
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, SpherePacket, Spheres};
use crate::geometry::surface::SurfacePacket;
use crate::linear::Writes;
use crate::spawn_ray::packets::{SurfaceHits, Towards};
#[cfg(not(feature = "std"))]
use crate::{dispatch::BuildLanes, linear, spawn_ray::packets, surface};

/// How many pairs are tested at a time.
#[cfg(feature = "std")]
const PAIRS: usize = RayPacket::COUNT;
/// How many pairs are tested at a time.
#[cfg(not(feature = "std"))]
const PAIRS: usize = <BuildLanes as crate::Lanes>::COUNT;

/// Tests ray `i` against sphere `i` alone, packet by packet; the sphere index of a hit is its lane.
///
/// Calls [`pair_lanes`](crate::pair_lanes) at `level`. Packets past the end of the shortest slice are left as they are.
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

/// Makes the rays of a camera's tiles at `level`. Those of tile `i` go to packet `i`, as far as there are tiles and packets.
/// They are bit for bit those of [`Camera::packet`](crate::Camera::packet), except for the bits of a NaN. Cost: a seventh
/// (SSE2) to a twelfth (AVX-512) of the time of `Camera::packet`.
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

/// Tests sphere `index` of a list against the rays of the packets that `numbers` names: object order. `hits` are the closest
/// hits so far, and take those that are closer. Returns how many hits were stored.
///
/// Calls [`object_lanes`](crate::object_lanes) at `level`. A number past the end of rays or hits changes nothing.
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
    let object = (spheres, index);
    #[cfg(feature = "std")]
    {
        crate::dispatch::compiled::object(level, tier.tier(), object, (numbers, rays), hits)
    }
    #[cfg(not(feature = "std"))]
    {
        let _ = level;
        linear::one_object::<wide::f32x16>(tier, (), object, numbers, rays, hits)
    }
}

/// Finds the [`surface`](crate::surface()) that each ray of every packet hits among `spheres`.
///
/// Calls [`surface_lanes`](crate::surface_lanes) at `level`. Packets past the end of the shortest slice are left as they are.
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

/// Makes rays to a light from the hits of every packet. Each begins on the side of the surface that its ray came from; where
/// that side does not face the light, or nothing was hit, the lane is inactive.
///
/// Calls [`shadow_lanes`](crate::shadow_lanes) at `level`. `hit` holds rays, hits and surfaces. Packets past the end of the
/// shortest slice are left as they are.
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

/// Tests ray `i` against sphere `i` alone, at the best level that the CPU has; the sphere of a hit is `i`.
///
/// A hit is bit for bit what [`Intersect`](crate::Intersect) finds for that ray in a list of that sphere. Hits past the end of
/// the shortest slice are left as they are.
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
