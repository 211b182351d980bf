//! How the points that rays hit are lit by a tier: its normals, and what its shadow rays meet.

use super::Machine;
use super::rays::Rays;
use crate::scene::Scene;
use crate::shade::SurfacePoint;
use spherule_kernel::{HitPacket, Ray, RayPacket, Tier, Vec3};

/// The least difference of a coordinate that makes a normal wrong: a step of a colour of eight bits.
const SHOWS: f32 = 1.0 / 256.0;

/// The points of some rays as a tier lights them.
pub(super) struct Lighting {
    /// The normal of every ray's point, if it has one.
    normals: Vec<Option<Vec3>>,
    /// For every light, whether each point receives it.
    lit: Vec<Vec<bool>>,
}

/// What is wrong of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LightingErrors {
    /// Rays that hit in truth as well as by the tier.
    pub(super) points: usize,
    /// Normals that differ by more than shows.
    pub(super) normals: usize,
    /// Points and lights of which one is lit, and the other is not.
    pub(super) shadows: usize,
}

impl Lighting {
    /// Of every `step`-th of the `camera` rays, which have these `hits` by `tier`; `machine` finds what is between points and
    /// lights.
    pub(super) fn new(
        tier: Tier,
        (camera, hits): (&Rays, &[HitPacket]),
        step: usize,
        scene: &Scene,
        machine: &Machine<'_>,
    ) -> Self {
        let spheres = scene.spheres();
        let rays = camera.packets.iter().zip(hits).flat_map(|(rays, hits)| {
            hits.hits().enumerate().map(|(lane, hit)| (rays.ray(lane), hit))
        });
        let points: Vec<Option<SurfacePoint>> = rays
            .step_by(step)
            .map(|(ray, hit)| {
                let hit = hit?;
                let sphere = spheres.get(hit.sphere as usize)?;
                Some(SurfacePoint::new(tier, &ray, hit.t, &sphere))
            })
            .collect();

        // A ray a point and light; where a surface faces away, one that hits nothing.
        let towards = |light| {
            let ray = |point: &Option<SurfacePoint>| {
                let point = point.as_ref()?;
                point.cosine(light).and_then(|_| point.ray_to(tier, light))
            };
            points.iter().map(ray).collect::<Vec<Option<Ray>>>()
        };
        let rays: Vec<_> = scene.lights.iter().map(towards).collect();
        let packets = rays.iter().map(|rays| {
            let rays: Vec<Ray> = rays.iter().map(|ray| ray.unwrap_or(Ray::INACTIVE)).collect();
            rays.chunks(RayPacket::COUNT).map(RayPacket::new).collect()
        });
        let met = machine.any_hits(tier, &Rays::of_lights(packets));
        let of_light = met.chunks(points.len().div_ceil(RayPacket::COUNT).max(1));
        let lit = rays.iter().zip(of_light).map(|(rays, met)| {
            let is_met = |i: usize| met[i / RayPacket::COUNT] >> (i % RayPacket::COUNT) & 1 == 1;
            rays.iter().enumerate().map(|(i, ray)| ray.is_some() && !is_met(i)).collect()
        });
        Self {
            lit: lit.collect(),
            normals: points.iter().map(|point| point.as_ref().map(SurfacePoint::normal)).collect(),
        }
    }

    /// Against what is true.
    pub(super) fn errors(&self, truth: &Self) -> LightingErrors {
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
