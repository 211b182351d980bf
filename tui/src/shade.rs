//! From hits to light, by no more than the scene requires.
//!
//! Without lights there is no shading: a sphere has its plain colour. With lights there is Lambert's law in linear light, a little light
//! from everywhere, and an exposure of all that. With shadows, a ray from the surface to the light decides whether the light counts.
//! Normals do not depend on t, and shadow rays start where the kernel proves that they do not meet the sphere that they leave: there is no
//! distance to choose, nothing shadows itself, and no shadow is lost.

pub mod depth_cue;
mod exposure;
pub mod silhouettes;

use crate::picture::Picture;
use crate::scene::{Light, Scene, Source};
use crate::structure::openness::OpennessMemory;
use crate::structure::picture_search::PictureSearch;
use crate::structure::search::{Scratch, Search, Tracing};
use crate::threads::Threads;
use exposure::{Exposure, STEEPNESS};
use spherule_kernel::{
    HitPacket, RayPacket, Spheres, SurfaceHits, SurfacePacket, Towards, Vec3, shadow_packets,
    surface_packets,
};

/// What a ray of a packet adds to the picture.
#[derive(Clone, Copy, Debug)]
struct Sample {
    lane: usize,
    pixel: u32,
    /// The colour of the surface in linear light, times the sample's share of its pixel.
    color: Vec3,
    /// The light that the surface receives.
    received: Vec3,
}

/// Packets of rays, what they hit, and the surfaces there.
#[derive(Clone, Debug, Default)]
pub struct Surfaces(Vec<SurfacePacket>);

/// Rays to a light, from the points that face it.
#[derive(Clone, Debug, Default)]
pub struct ShadowRays {
    rays: Vec<RayPacket>,
    /// Which of them meet anything, a bit a lane: none until they are traced.
    occluded: Vec<u32>,
}

impl Surfaces {
    /// Computes the surfaces where rays hit.
    pub fn compute(
        &mut self,
        tracing: Tracing,
        spheres: Spheres<'_>,
        rays: &[RayPacket],
        hits: &[HitPacket],
    ) -> &[SurfacePacket] {
        self.0.resize(rays.len(), SurfacePacket::none());
        surface_packets(tracing.tier, tracing.level, spheres, rays, hits, &mut self.0);
        &self.0
    }
}

/// The bits of 2^-126 and 2^126: each is the other's inverse.
const LEAST_POWER: u32 = 1 << 23;
const GREATEST_POWER: u32 = 253 << 23;

/// The cosines between normals and rays, whichever way these point; no number where there is no ray.
///
/// They are computed lane after lane, so that the compiler takes several at a time: one by one they took a tenth of a frame.
fn cosines(surfaces: &SurfacePacket, rays: &RayPacket) -> [f32; RayPacket::COUNT] {
    let [[nx, ny, nz], [dx, dy, dz]] = [surfaces.normals(), rays.directions()].map(|vectors| {
        vectors.map(|lanes| lanes.first_chunk().unwrap_or(&[0.0; RayPacket::COUNT]))
    });
    let mut cosines = [0.0; RayPacket::COUNT];
    for lane in 0..RayPacket::COUNT {
        // Way to a light: its square may leave the range of numbers, so the largest component is brought near 1, exactly.
        let largest = dx[lane].abs().max(dy[lane].abs()).max(dz[lane].abs());
        let power =
            (largest.to_bits() & f32::INFINITY.to_bits()).clamp(LEAST_POWER, GREATEST_POWER);
        let inverse = f32::from_bits(LEAST_POWER + GREATEST_POWER - power);
        let [x, y, z] = [dx[lane] * inverse, dy[lane] * inverse, dz[lane] * inverse];
        let along = nx[lane] * x + ny[lane] * y + nz[lane] * z;
        let square = x * x + y * y + z * z;
        cosines[lane] = along.abs() / square.sqrt();
    }
    cosines
}

impl ShadowRays {
    /// Makes a ray from every point that faces `light`, and inactive rays from the others.
    pub fn cast(
        &mut self,
        tracing: Tracing,
        spheres: Spheres<'_>,
        hit: SurfaceHits<'_>,
        light: &Light,
    ) -> &[RayPacket] {
        let towards = match light.source {
            Source::Direction(direction) => Towards::Direction(direction),
            Source::Position(position) => Towards::Point(position),
        };
        self.rays.clear();
        self.rays.resize(hit.0.len(), RayPacket::inactive());
        let Tracing { tier, level, .. } = tracing;
        shadow_packets(tier, level, spheres, hit, towards, &mut self.rays);
        self.occluded.clear();
        self.occluded.resize(self.rays.len(), 0);
        &self.rays
    }

    /// Finds which of them meet anything, until the threads are stopped.
    fn trace(
        &mut self,
        tracing: Tracing,
        (scratch, threads): (&mut Scratch, &Threads),
        search: &Search<'_>,
    ) {
        for part in search.parts(self.rays.len(), threads) {
            let (rays, occluded) = (&self.rays[part.clone()], &mut self.occluded[part]);
            search.any_hits(tracing, scratch, rays, occluded);
        }
    }
}

/// Lights the hits of a part of the picture, light by light. Its memory is reused from part to part.
#[derive(Clone, Debug, Default)]
pub struct Shader {
    /// The samples of packet after packet, and how many each packet has.
    samples: Vec<Sample>,
    counts: Vec<usize>,
    surfaces: Surfaces,
    shadow_rays: ShadowRays,
    /// Whether the picture shows how open the scene is.
    is_open: bool,
    openness: OpennessMemory,
}

impl Shader {
    /// Sets whether the picture shows, from now on, how open the scene is around its spheres.
    pub fn show_openness(&mut self, shown: bool) {
        self.is_open = shown;
    }

    /// Begins with the samples of the next packet.
    #[inline]
    pub fn begin_packet(&mut self) {
        self.counts.push(0);
    }

    /// Adds a sample that met a sphere of `color` (times the sample's share) to `pixel`; at once
    /// if the scene has no light, and nothing else asks for its surface.
    #[inline]
    pub fn add(
        &mut self,
        scene: &Scene,
        picture: &mut Picture,
        lane: usize,
        pixel: u32,
        color: Vec3,
    ) {
        if scene.lighting.is_plain() && !self.is_open {
            picture.add(pixel as usize, color);
        } else if let Some(count) = self.counts.last_mut() {
            *count += 1;
            self.samples.push(Sample { lane, pixel, color, received: Vec3::ZERO });
        }
    }

    /// Lights what was added since the last call: hits of these packets; `search` is that of the picture. Returns how many rays that took,
    /// to lights and for openness. When the threads are stopped, the light is worthless.
    pub fn light(
        &mut self,
        tracing: Tracing,
        (scratch, threads): (&mut Scratch, &Threads),
        scene: &Scene,
        search: &PictureSearch<'_>,
        (rays, hits): (&[RayPacket], &[HitPacket]),
        picture: &mut Picture,
    ) -> u64 {
        let Self { samples, counts, surfaces, shadow_rays, openness, .. } = self;
        let mut traced = 0;
        if !samples.is_empty() {
            let surfaces = surfaces.compute(tracing, scene.spheres(), rays, hits);
            for (index, light) in search.lights.iter().enumerate() {
                shadow_rays.cast(tracing, scene.spheres(), (rays, hits, surfaces), light);
                let towards = search.to_lights.get(index);
                if let Some(towards) = towards {
                    shadow_rays.trace(tracing, (&mut *scratch, threads), towards);
                }
                let brightness = light.color.to_linear();
                let mut samples = samples.iter_mut();
                for (packet, &count) in counts.iter().enumerate() {
                    let rays = &shadow_rays.rays[packet];
                    let (live, occluded) = (rays.live(), shadow_rays.occluded[packet]);
                    let cosines = cosines(&surfaces[packet], rays);
                    for sample in samples.by_ref().take(count) {
                        traced += u64::from(towards.is_some() && live >> sample.lane & 1 == 1);
                        if (live & !occluded) >> sample.lane & 1 == 1 {
                            sample.received += cosines[sample.lane] * brightness;
                        }
                    }
                }
            }
            match &search.setting.around {
                None => {
                    let exposure = Exposure::of(&scene.lighting);
                    for sample in samples.iter() {
                        let seen = exposure.seen(sample.received + exposure.ambient);
                        picture.add(sample.pixel as usize, seen * sample.color);
                    }
                }
                Some(around) => {
                    let met = hits.iter().flat_map(HitPacket::spheres).copied();
                    let by = (tracing.level, threads);
                    traced += around.learn(by, scratch, openness, met);
                    let exposure = Exposure::of_open(&scene.lighting);
                    let mut samples = samples.iter();
                    for (packet, &count) in counts.iter().enumerate() {
                        let spheres = hits[packet].spheres();
                        for sample in samples.by_ref().take(count) {
                            let normal = STEEPNESS * surfaces[packet].normal(sample.lane);
                            let open = around.openness.towards(spheres[sample.lane], normal);
                            let received = exposure.lights * sample.received + exposure.ambient;
                            let seen = exposure.seen(Exposure::left(open) * received);
                            picture.add(sample.pixel as usize, seen * sample.color);
                        }
                    }
                }
            }
        }
        self.samples.clear();
        self.counts.clear();
        traced
    }
}
