//! The rays that a picture of a scene takes: from the camera, and from there to the lights.

use crate::scene::Scene;
use crate::shade::SurfacePoint;
use spherule_kernel::dispatch::{Level, Packet, nearest};
use spherule_kernel::{Camera, Exact, HitPacket, Lanes, Ray, RayPacket};

/// The most tests of a ray against a sphere a pass, padding among them: some 0.1 s at the least
/// level.
const MOST_TESTS: usize = 1 << 27;

/// Packets of rays, and how many rays they hold.
pub(super) struct Rays {
    pub(super) packets: Vec<RayPacket<Packet>>,
    pub(super) count: usize,
}

impl Rays {
    /// Of the packets as many as may be tested against so many spheres, from everywhere.
    fn thinned(packets: Vec<RayPacket<Packet>>, spheres: usize) -> Self {
        let most = (MOST_TESTS / (spheres.max(1) * Packet::COUNT)).max(1);
        let step = packets.len().div_ceil(most).max(1);
        let packets: Vec<_> = packets.into_iter().step_by(step).collect();
        let live = |packet: &RayPacket<Packet>| {
            (0..Packet::COUNT).filter(|&lane| packet.ray(lane).is_live()).count()
        };
        Self { count: packets.iter().map(live).sum(), packets }
    }

    /// The rays of a picture of `width` x `height` samples, in the tiles that it is drawn in.
    pub(super) fn of_camera(camera: &Camera, width: u32, height: u32, spheres: usize) -> Self {
        let (across, down) = Camera::tile::<Packet>();
        let rows = (0..height).step_by(down as usize);
        let packets = rows.flat_map(|iy| {
            let columns = (0..width).step_by(across as usize);
            columns.map(move |ix| camera.packet::<Packet>(ix, iy, width, height))
        });
        Self::thinned(packets.collect(), spheres)
    }

    /// The rays from what `camera` rays meet to every light that the surface faces, light by
    /// light.
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
        let towards = |light| points.iter().filter_map(move |point| point.towards(light));
        let packed = scene.lights.iter().flat_map(|light| {
            let rays: Vec<Ray> = towards(light).map(|(ray, _)| ray).collect();
            rays.chunks(Packet::COUNT).map(RayPacket::<Packet>::new).collect::<Vec<_>>()
        });
        Self::thinned(packed.collect(), spheres.len())
    }
}
