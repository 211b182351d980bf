//! Asks for surfaces, sides of spheres, and rays spawned there.

use super::fnv::Fnv;
use super::questions::Asked;
use crate::cases::{Case, HARD, case};
use core::array::from_fn;
use spherule_kernel::{
    HitPacket, Ray, RayPacket, Side, SpherePacket, Spheres, SurfacePacket, Towards, Vec3,
    discriminant, side, surface,
};
#[cfg(not(feature = "std"))]
use spherule_kernel::{f32x4, pair_lanes, shadow_lanes, surface_lanes};
#[cfg(feature = "std")]
use spherule_kernel::{pair_packets, shadow_packets, surface_packets};

/// How many cases are asked.
const SURVEYED: u32 = 1024;
/// The lanes of a packet: sixteen at a level; without `std` four, which take less of a board's flash.
const LANES: usize = if cfg!(feature = "std") { 16 } else { 4 };
/// A point to which rays are spawned.
const LIGHT: Vec3 = Vec3::new(4.0, 9.0, -7.0);
/// Where shadow rays go.
const LIGHTS: [Towards; 2] = [Towards::Direction(Vec3::new(0.3, 0.7, -0.6)), Towards::Point(LIGHT)];

/// What packets say of rays: hits, surfaces, and shadow rays to every light.
struct Answers {
    hits: HitPacket<[f32; LANES]>,
    surfaces: SurfacePacket<[f32; LANES]>,
    shadow_rays: [RayPacket<[f32; LANES]>; LIGHTS.len()],
}

impl Asked {
    /// Asks for the surfaces that rays hit, and for what starts there: by packets, and ray by ray.
    pub(super) fn surfaces(&self) -> Fnv {
        let mut fnv = Fnv::new(self.control);
        for first in (0..SURVEYED).step_by(LANES) {
            let cases: [Case; LANES] = from_fn(|lane| surveyed(first + lane as u32));
            let spheres = cases.map(|case| case.sphere);
            let [x, y, z] = [0, 1, 2].map(|axis| spheres.map(|sphere| sphere.center[axis]));
            let radius = spheres.map(|sphere| sphere.radius);
            let Ok(list) = Spheres::new(&x, &y, &z, &radius) else { return fnv };
            let rays = RayPacket::new(&cases.map(|case| case.ray));
            let answers = self.by_packets(&rays, &SpherePacket::new(&spheres), list);
            for (lane, case) in cases.iter().enumerate() {
                self.one(&mut fnv, case, lane, &answers);
            }
        }
        fnv
    }

    #[cfg(feature = "std")]
    fn by_packets(&self, rays: &RayPacket, spheres: &SpherePacket, list: Spheres<'_>) -> Answers {
        let (tier, level, rays) = (self.tier, self.level, [*rays]);
        let (mut hits, mut surfaces) = ([HitPacket::none()], [SurfacePacket::none()]);
        pair_packets(tier, level, &rays, &[*spheres], &mut hits);
        surface_packets(tier, level, list, &rays, &hits, &mut surfaces);
        let shadow_rays = LIGHTS.map(|light| {
            let mut shadow_rays = [RayPacket::inactive()];
            let hit = (&rays[..], &hits[..], &surfaces[..]);
            shadow_packets(tier, level, list, hit, light, &mut shadow_rays);
            shadow_rays[0]
        });
        Answers { hits: hits[0], surfaces: surfaces[0], shadow_rays }
    }

    #[cfg(not(feature = "std"))]
    fn by_packets(
        &self,
        rays: &RayPacket<[f32; 4]>,
        spheres: &SpherePacket<[f32; 4]>,
        list: Spheres<'_>,
    ) -> Answers {
        let hits = pair_lanes::<f32x4>(self.tier, (), rays, spheres);
        let surfaces = surface_lanes::<f32x4>(self.tier, (), list, rays, &hits);
        let hit = (rays, &hits, &surfaces);
        let shadow_rays =
            LIGHTS.map(|light| shadow_lanes::<f32x4>(self.tier, (), list, hit, light));
        Answers { hits, surfaces, shadow_rays }
    }

    /// Adds what is known of one case.
    fn one(&self, fnv: &mut Fnv, Case { ray, sphere }: &Case, lane: usize, answers: &Answers) {
        if let Some((value, bound)) = discriminant(ray, sphere) {
            for bits in [value, bound].map(f64::to_bits) {
                fnv.word(bits as u32);
                fnv.word((bits >> 32) as u32);
            }
        }
        let Some(hit) = answers.hits.hit(lane) else { return };
        let surface = surface(self.tier, ray, hit.t, sphere);
        let point = surface.position(sphere);
        let of_packet = &answers.surfaces;
        for vector in
            [surface.normal, surface.point, point, of_packet.normal(lane), of_packet.point(lane)]
        {
            vector.to_array().into_iter().for_each(|number| fnv.number(number));
        }
        add_side(fnv, side(point, sphere));
        add_side(fnv, Some(surface.incident_side(ray.direction)));
        for side in [Side::Outside, Side::Inside] {
            add_ray(fnv, surface.spawn_ray(self.tier, sphere, side, ray.direction));
            add_ray(fnv, surface.spawn_ray_to(self.tier, sphere, side, LIGHT));
        }
        for shadow_rays in &answers.shadow_rays {
            add_ray(fnv, Some(shadow_rays.ray(lane)));
        }
    }
}

/// The hard cases, then rays from a sphere's centre, whose normals have a coordinate of zero, then some of all cases: an odd step takes
/// every kind.
fn surveyed(number: u32) -> Case {
    match HARD.get(number as usize) {
        Some(hard) => *hard,
        None if number < 16 => {
            let sphere = HARD[0].sphere;
            let direction = Vec3::new(number as f32 - 9.0, 2.0, 0.0);
            Case { ray: Ray::new(sphere.center, direction), sphere }
        }
        None => case(19 * number),
    }
}

fn add_side(fnv: &mut Fnv, side: Option<Side>) {
    fnv.word(side.map_or(u32::MAX, |side| side as u32));
}

fn add_ray(fnv: &mut Fnv, ray: Option<Ray>) {
    let Ray { origin: o, direction: d, t_min, t_max } = ray.unwrap_or(Ray::INACTIVE);
    for number in [o.x, o.y, o.z, d.x, d.y, d.z, t_min, t_max] {
        fnv.word(number.to_bits());
    }
}
