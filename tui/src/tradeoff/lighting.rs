//! How the points that rays hit are lit by a tier: its normals, and what its shadow rays meet.

use super::machine::Machine;
use super::rays::{Kind, Rays};
use super::report::LightingErrors;
use super::watch::{Step, Watch};
use crate::scene::Light;
use crate::shade::{ShadowRays, Surfaces};
use spherule_kernel::{HitPacket, RayPacket, Spheres, Tier, Vec3};

/// The least difference of a coordinate that makes a normal wrong: a step of a colour of eight bits.
const SHOWS: f32 = 1.0 / 256.0;

/// What is wrong with how every tier lights the points that it hits; `Some(None)` if there is no light, `None` if the
/// watch ends it.
pub(super) fn errors(
    [for_camera, for_shadow]: [&Machine<'_>; 2],
    camera: &Rays,
    (spheres, lights): (Spheres<'_>, &[Light]),
    most: usize,
    watch: &mut Watch<'_>,
) -> Option<Option<Vec<LightingErrors>>> {
    if lights.is_empty() {
        return Some(None);
    }
    let step = (camera.count * lights.len()).div_ceil(most).max(1);
    let lighting = Tier::ALL.into_iter().zip(0_u8..).map(|(tier, done)| {
        watch.go_on(Step::Lighting, f64::from(done) / Tier::ALL.len() as f64)?;
        let hits = for_camera.hits(tier, camera);
        Some(Lighting::new(tier, (camera, &hits), step, (spheres, lights), for_shadow))
    });
    let lighting = lighting.collect::<Option<Vec<_>>>()?;
    let exact = lighting.last()?;
    Some(Some(lighting.iter().map(|of_tier| of_tier.errors(exact)).collect()))
}

/// The points of some rays as a tier lights them.
struct Lighting {
    /// The normal of every ray's point, if it has one.
    normals: Vec<Option<Vec3>>,
    /// For every light, whether each point receives it.
    lit: Vec<Vec<bool>>,
}

impl Lighting {
    /// The lighting of every `step`-th packet of the `camera` rays, whose hits by `tier` are `hits`; `machine` finds
    /// what is between points and lights.
    fn new(
        tier: Tier,
        (camera, hits): (&Rays, &[HitPacket]),
        step: usize,
        (spheres, lights): (Spheres<'_>, &[Light]),
        machine: &Machine<'_>,
    ) -> Self {
        let tracing = machine.tracing(tier);
        let camera: Vec<_> = camera.packets.iter().step_by(step).copied().collect();
        let hits: Vec<_> = hits.iter().step_by(step).copied().collect();
        let (mut surfaces, mut shadow_rays) = (Surfaces::default(), ShadowRays::default());
        let surfaces = surfaces.compute(tracing, spheres, &camera, &hits);
        let normals = surfaces.iter().zip(&hits).flat_map(|(surfaces, hits)| {
            hits.hits().enumerate().map(|(lane, hit)| hit.map(|_| surfaces.normal(lane)))
        });
        let of_light = |light| {
            let hit = (&*camera, &*hits, surfaces);
            shadow_rays.cast(tracing, spheres, hit, light).to_vec()
        };
        let rays = Rays::new(Kind::Shadow, lights.iter().map(of_light));
        let occluded = machine.any_hits(tier, &rays);
        let lit = rays.packets.iter().zip(occluded).flat_map(|(rays, occluded)| {
            (0..RayPacket::COUNT)
                .map(move |lane| rays.ray(lane).is_live() && occluded >> lane & 1 == 0)
        });
        let lit: Vec<bool> = lit.collect();
        let of_light = camera.len() * RayPacket::COUNT;
        Self {
            normals: normals.collect(),
            lit: lit.chunks(of_light.max(1)).map(<[bool]>::to_vec).collect(),
        }
    }

    /// The errors, compared with `truth`.
    fn errors(&self, truth: &Self) -> LightingErrors {
        let both = |i: usize| self.normals[i].zip(truth.normals[i]);
        let points: Vec<usize> = (0..self.normals.len()).filter(|&i| both(i).is_some()).collect();
        let shows = |i: &&usize| {
            let off = both(**i).map_or(0.0, |(ours, truth)| (ours - truth).abs().max_element());
            off > SHOWS || off.is_nan()
        };
        let differ = |(ours, truth): (&Vec<bool>, &Vec<bool>)| {
            points.iter().filter(|&&i| ours[i] != truth[i]).count()
        };
        LightingErrors {
            points: points.len(),
            normals: points.iter().filter(shows).count(),
            shadows: self.lit.iter().zip(&truth.lit).map(differ).sum(),
        }
    }
}
