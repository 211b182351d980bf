//! The rays that a picture of a scene takes: from the camera, and from there to the lights.

use super::blocks::Blocks;
use crate::scene::Light;
use crate::shade::{ShadowRays, Surfaces};
use crate::structure::Structure;
use crate::structure::search::Tracing;
use spherule_kernel::{Camera, HitPacket, Ray, RayPacket, Spheres};

/// The most rays, so that they fit into a cache.
const MOST_RAYS: usize = 1 << 17;
/// The most tests of a ray against a sphere in a pass of brute force: some 0.1 s at the least level.
const MOST_TESTS: usize = 1 << 27;
/// The side in packets of the part of a picture that is measured or left out.
const BLOCK: u32 = 4;

/// Where rays come from.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// The camera: the closest hit counts.
    Camera,
    /// Surfaces, towards a light: any hit counts.
    Shadow,
}

impl Kind {
    /// The name in reports.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::Shadow => "shadow",
        }
    }
}

/// Packets of rays, and how many rays they hold.
pub(super) struct Rays {
    pub(super) kind: Kind,
    pub(super) packets: Vec<RayPacket>,
    /// How many packets share an origin, a direction or an end, one part after the other.
    pub(super) parts: Vec<usize>,
    pub(super) count: usize,
}

/// The most rays that are traced against so many spheres.
pub(super) fn most_rays(spheres: usize, structure: Structure) -> usize {
    match structure {
        Structure::Brute => (MOST_TESTS / spheres.max(1)).clamp(RayPacket::COUNT, MOST_RAYS),
        Structure::DepthList | Structure::Bvh => MOST_RAYS,
    }
}

impl Rays {
    /// Rays of one kind, part by part.
    pub(super) fn new(kind: Kind, parts: impl Iterator<Item = Vec<RayPacket>>) -> Self {
        let parts: Vec<_> = parts.collect();
        let lengths = parts.iter().map(Vec::len).collect();
        let packets = parts.concat();
        let live = |packet: &RayPacket| {
            (0..RayPacket::COUNT).filter(|&lane| packet.ray(lane).is_live()).count()
        };
        Self { kind, count: packets.iter().map(live).sum(), packets, parts: lengths }
    }

    /// Every lane's ray, packet by packet.
    pub(super) fn each(&self) -> impl Iterator<Item = Ray> {
        self.packets
            .iter()
            .flat_map(|packet| (0..RayPacket::COUNT).map(move |lane| packet.ray(lane)))
    }

    /// The rays of a picture of `width` x `height` samples, in the order in which it is drawn; if there are more than
    /// `most`, those of some blocks of packets, from everywhere.
    pub(super) fn of_camera(camera: &Camera, width: u32, height: u32, most: usize) -> Self {
        let (across, down) = Camera::tile::<[f32; 16]>();
        let (across, down) = (BLOCK * across, BLOCK * down);
        let most_packets = most / RayPacket::COUNT;
        let most_blocks = most_packets / (BLOCK * BLOCK) as usize;
        let blocks = Blocks::new(width.div_ceil(across), height.div_ceil(down), most_blocks);
        let packets = blocks.each().flat_map(|(column, row)| {
            let (left, top) = (column * across, row * down);
            Camera::tile_corners::<[f32; 16]>((width - left).min(across), (height - top).min(down))
                .map(move |(x, y)| camera.packet(left + x, top + y, width, height))
        });
        // There is one block at least, even if there are fewer packets to trace.
        Self::new(Kind::Camera, std::iter::once(packets.take(most_packets).collect()))
    }

    /// The rays from the `hits` of the `camera` rays by `tracing` to those of the `lights` that the surface faces, light
    /// by light; if those are more than `most`, from every n-th packet.
    pub(super) fn of_shadows(
        tracing: Tracing,
        (camera, hits): (&Self, &[HitPacket]),
        spheres: Spheres<'_>,
        lights: &[Light],
        most: usize,
    ) -> Self {
        let step = (camera.count * lights.len()).div_ceil(most).max(1);
        let camera: Vec<_> = camera.packets.iter().step_by(step).copied().collect();
        let hits: Vec<_> = hits.iter().step_by(step).copied().collect();
        let (mut surfaces, mut shadow_rays) = (Surfaces::default(), ShadowRays::default());
        let surfaces = surfaces.compute(tracing, spheres, &camera, &hits);
        let of_light = |light| {
            let hit = (&*camera, &*hits, surfaces);
            let packets = shadow_rays.cast(tracing, spheres, hit, light).iter();
            let rays = packets.flat_map(|rays| (0..RayPacket::COUNT).map(|lane| rays.ray(lane)));
            let rays: Vec<Ray> = rays.filter(Ray::is_live).collect();
            rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect()
        };
        Self::new(Kind::Shadow, lights.iter().map(of_light))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin::builtin;
    use spherule_kernel::{Coherence, Exact, Intersect, Level, Tier, Trace};

    #[test]
    fn a_picture_of_any_size_is_some_rays_from_everywhere() {
        let scene = builtin("marbles").expect("marbles");
        for (side, spheres) in [(0, 1), (1, 1), (160, 10), (65_536, 10), (8192, 100_000_000)] {
            let camera = scene.first_view(1.0).camera(side, side, 1.0);
            let most = most_rays(spheres, Structure::Brute);
            let rays = Rays::of_camera(&camera, side, side, most);
            assert!(rays.count <= most);
            assert_eq!(rays.count == 0, side == 0);
            assert!(side > 160 || rays.count == (side * side) as usize);
        }
        let camera = scene.first_view(1.0).camera(4096, 4096, 1.0);
        let rays = Rays::of_camera(&camera, 4096, 4096, MOST_RAYS);
        let mut hits = vec![HitPacket::none(); rays.packets.len()];
        scene.spheres().closest_hit_packets(Exact, &mut Trace::new(), &rays.packets, &mut hits);
        let tracing =
            Tracing { tier: Tier::Exact, level: Level::best(), coherence: Coherence::Detect };
        let lights = scene.lighting.lights(&scene.first_view(1.0));
        let (spheres, hit) = (scene.spheres(), (&rays, &*hits));
        let shadow = Rays::of_shadows(tracing, hit, spheres, &lights, MOST_RAYS);
        assert!(rays.count > MOST_RAYS / 4 && shadow.count > 0 && shadow.count <= MOST_RAYS);
    }
}
