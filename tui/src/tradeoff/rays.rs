//! The rays that a picture of a scene takes: from the camera, and from there to the lights.

use crate::scene::Scene;
use crate::shade::SurfacePoint;
use spherule_kernel::dispatch::{Level, Packet, nearest};
use spherule_kernel::{Camera, Exact, HitPacket, Lanes, Ray, RayPacket};

/// The most rays, so that their memory is a cache's, not a machine's.
const MOST_RAYS: usize = 1 << 17;
/// The most tests of a ray against a sphere a pass: some 0.1 s at the least level.
const MOST_TESTS: usize = 1 << 27;

/// Packets of rays, and how many rays they hold.
pub(super) struct Rays {
    pub(super) packets: Vec<RayPacket<Packet>>,
    pub(super) count: usize,
}

/// The most rays against so many spheres.
fn most_rays(spheres: usize) -> usize {
    (MOST_TESTS / spheres.max(1)).clamp(Packet::COUNT, MOST_RAYS)
}

impl Rays {
    fn new(packets: Vec<RayPacket<Packet>>) -> Self {
        let live = |packet: &RayPacket<Packet>| {
            (0..Packet::COUNT).filter(|&lane| packet.ray(lane).is_live()).count()
        };
        Self { count: packets.iter().map(live).sum(), packets }
    }

    /// The rays of a picture of `width` x `height` samples, in the tiles that it is drawn in; of
    /// too many tiles every n-th.
    pub(super) fn of_camera(camera: &Camera, width: u32, height: u32, spheres: usize) -> Self {
        let (across, down) = Camera::tile::<Packet>();
        let columns = u64::from(width.div_ceil(across));
        let tiles = columns * u64::from(height.div_ceil(down));
        let mut step = tiles.div_ceil((most_rays(spheres) / Packet::COUNT) as u64).max(1);
        // A step that goes well with the width would see a few columns alone.
        while step > 1 && common_divisor(step, columns) > 1 {
            step += 1;
        }
        let tile = |index: u64| {
            let (ix, iy) = ((index % columns) as u32 * across, (index / columns) as u32 * down);
            camera.packet::<Packet>(ix, iy, width, height)
        };
        Self::new((0..tiles).step_by(step as usize).map(tile).collect())
    }

    /// The rays from what `camera` rays meet to every light that the surface faces, light by
    /// light; from too many points, every n-th.
    pub(super) fn of_shadows(camera: &Self, scene: &Scene, level: Level) -> Self {
        let spheres = scene.spheres();
        let mut hits = vec![HitPacket::<Packet>::none(); camera.packets.len()];
        nearest::<Exact>(level, &camera.packets, spheres, &mut hits);
        let mut points = Vec::new();
        for (rays, hits) in camera.packets.iter().zip(&hits) {
            for lane in 0..Packet::COUNT {
                let Some(hit) = hits.hit(lane) else { continue };
                if let Some(sphere) = spheres.get(hit.sphere as usize) {
                    points.push(SurfacePoint::new(&rays.ray(lane), hit.t, &sphere));
                }
            }
        }
        let wanted = points.len() * scene.lights.len();
        let step = wanted.div_ceil(most_rays(spheres.len())).max(1);
        let packets = scene.lights.iter().flat_map(|light| {
            let towards = |point: &SurfacePoint| point.towards(light).map(|(ray, _)| ray);
            let rays: Vec<Ray> = points.iter().step_by(step).filter_map(towards).collect();
            rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect::<Vec<_>>()
        });
        Self::new(packets.collect())
    }
}

/// The greatest.
fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin::builtin;

    #[test]
    fn a_picture_of_any_size_is_some_rays_from_everywhere() {
        let scene = builtin("marbles").expect("marbles");
        for (side, spheres) in [(0, 1), (1, 1), (160, 10), (65_536, 10), (8192, 100_000_000)] {
            let camera = scene.first_view(1.0).camera(side, side, 1.0);
            let rays = Rays::of_camera(&camera, side, side, spheres);
            assert!(rays.count <= most_rays(spheres));
            assert_eq!(rays.count == 0, side == 0);
            assert!(side > 160 || rays.count == (side * side) as usize);
        }
        let camera = scene.first_view(1.0).camera(4096, 4096, 1.0);
        let rays = Rays::of_camera(&camera, 4096, 4096, 10);
        let shadow = Rays::of_shadows(&rays, &scene, Level::best());
        assert!(rays.count > MOST_RAYS / 4 && shadow.count > 0 && shadow.count <= MOST_RAYS);
        let across = |packet: &RayPacket<Packet>| packet.ray(0).direction.x.to_bits();
        let mut columns: Vec<u32> = rays.packets.iter().map(across).collect();
        columns.sort_unstable();
        columns.dedup();
        assert!(columns.len() > 500, "{} columns", columns.len());
    }
}
