//! From hits to light, by no more than the scene requires.
//!
//! No light, no shading: the plain colour of the sphere. With lights, Lambert's law in linear
//! light, and a little that comes from everywhere. With shadows, a ray from the surface to the
//! light decides whether it counts.

mod surface;

pub use surface::SurfacePoint;

use crate::picture::Picture;
use crate::scene::Scene;
use crate::structure::scene::PictureSearch;
use crate::structure::search::{Scratch, Search, Tracing};
use spherule_kernel::{Ray, RayPacket, Vec3};

/// How much of a surface's colour is seen if no light reaches it.
const AMBIENT: f32 = 0.06;

/// A surface point and what it adds to the picture.
#[derive(Clone, Copy, Debug)]
struct Shaded {
    point: SurfacePoint,
    /// The colour of the surface in linear light, times the sample's share of its pixel.
    color: Vec3,
    pixel: u32,
}

/// Collects the hits of a part of the picture, then lights them, light by light, so that shadow
/// rays of one light fill packets. Its memory is reused from part to part.
#[derive(Clone, Debug, Default)]
pub struct Shader {
    shaded: Vec<Shaded>,
    shadows: Shadows,
}

/// Shadow rays of one light.
#[derive(Clone, Debug, Default)]
struct Shadows {
    rays: Vec<RayPacket>,
    /// What each ray adds, and to which pixel, if nothing is in its way.
    waiting: Vec<(u32, Vec3)>,
    met: Vec<u32>,
}

impl Shader {
    /// Adds a sample that met a sphere of `color` (times the sample's share) to `pixel`; at once
    /// if the scene has no light.
    #[inline]
    pub fn add(
        &mut self,
        scene: &Scene,
        picture: &mut Picture,
        pixel: u32,
        color: Vec3,
        point: impl FnOnce() -> SurfacePoint,
    ) {
        if scene.lights.is_empty() {
            picture.add(pixel as usize, color);
        } else {
            self.shaded.push(Shaded { point: point(), color, pixel });
        }
    }

    /// Lights what was added since the last call; `search` is that of the picture.
    /// Returns how many shadow rays that took.
    pub fn light(
        &mut self,
        tracing: Tracing,
        scratch: &mut Scratch,
        scene: &Scene,
        search: &PictureSearch<'_>,
        picture: &mut Picture,
    ) -> u64 {
        for shaded in &self.shaded {
            picture.add(shaded.pixel as usize, AMBIENT * shaded.color);
        }
        let mut shadow_rays = 0;
        for (light, towards) in scene.lights.iter().zip(&search.lights) {
            let brightness = light.color.to_linear();
            for shaded in &self.shaded {
                let Some(cosine) = shaded.point.cosine(light) else { continue };
                let received = cosine * brightness * shaded.color;
                if scene.shadows {
                    if let Some(ray) = shaded.point.ray_to(tracing.tier, light) {
                        self.shadows.push(&ray, shaded.pixel, received);
                    }
                } else {
                    picture.add(shaded.pixel as usize, received);
                }
            }
            shadow_rays += self.shadows.cast(tracing, scratch, towards, picture);
        }
        self.shaded.clear();
        shadow_rays
    }
}

impl Shadows {
    /// Puts a ray into the next free lane.
    #[inline]
    fn push(&mut self, ray: &Ray, pixel: u32, received: Vec3) {
        let lane = self.waiting.len() % RayPacket::COUNT;
        if lane == 0 {
            self.rays.push(RayPacket::inactive());
        }
        if let Some(packet) = self.rays.last_mut() {
            packet.set(lane, ray);
        }
        self.waiting.push((pixel, received));
    }

    /// Traces the rays, adds the light of those that meet nothing, and returns how many there were.
    fn cast(
        &mut self,
        tracing: Tracing,
        scratch: &mut Scratch,
        search: &Search<'_>,
        picture: &mut Picture,
    ) -> u64 {
        self.met.clear();
        self.met.resize(self.rays.len(), 0);
        search.any_hits(tracing, scratch, &self.rays, &mut self.met);
        for (index, &(pixel, received)) in self.waiting.iter().enumerate() {
            if self.met[index / RayPacket::COUNT] >> (index % RayPacket::COUNT) & 1 == 0 {
                picture.add(pixel as usize, received);
            }
        }
        let count = self.waiting.len() as u64;
        self.rays.clear();
        self.waiting.clear();
        count
    }
}
