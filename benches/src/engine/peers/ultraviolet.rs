//! The ray-sphere example of `ultraviolet`'s README in a loop: 8 lanes, roots only if a lane may improve. It wants unit
//! directions, which are made before the clock starts.

use crate::engine::{Engine, Label, Promise, Query, Rays, Run};
use spherule_kernel::{Hit, Ray, Sphere, Spheres, Vec3};
use std::rc::Rc;
use ultraviolet::{Vec3x8, f32x8};
use ultraviolet_wide::{CmpGt, CmpLt};

/// Centre and squared radius.
type Prepared = (Vec3x8, f32x8);

/// The loop over these spheres.
pub(crate) fn ultraviolet(spheres: Spheres<'_>) -> Engine {
    let prepared = |sphere: Sphere| {
        let center = ultraviolet::Vec3::from(sphere.center.to_array());
        (Vec3x8::splat(center), f32x8::splat(sphere.radius * sphere.radius))
    };
    let spheres: Rc<[Prepared]> = spheres.iter().map(prepared).collect();
    let ready = move |rays: &Rays| -> Box<dyn Run> {
        let packets = rays.list.chunks_exact(8).map(RayX8::new).collect();
        let hits = vec![Hit { t: f32::MAX, sphere: 0 }; rays.list.len()];
        Box::new(Deferred { spheres: Rc::clone(&spheres), packets, hits })
    };
    Engine {
        label: Label { way: "brute force", name: "ultraviolet", lanes: "f32x8" },
        promise: Promise::TEXTBOOK,
        most_rays: usize::MAX,
        ready: Box::new(ready),
    }
}

/// Eight rays with unit directions, and how long the directions were.
struct RayX8 {
    origin: Vec3x8,
    direction: Vec3x8,
    length: f32x8,
}

impl RayX8 {
    fn new(rays: &[Ray]) -> Self {
        let lanes =
            |of: &dyn Fn(&Ray) -> f32| f32x8::from(std::array::from_fn(|lane| of(&rays[lane])));
        let vector = |of: &dyn Fn(&Ray) -> Vec3| {
            let [x, y, z] = [0, 1, 2].map(|axis| lanes(&|ray| of(ray)[axis]));
            Vec3x8::new(x, y, z)
        };
        Self {
            origin: vector(&|ray| ray.origin),
            direction: vector(&|ray| ray.direction.normalize()),
            length: lanes(&|ray| ray.direction.length()),
        }
    }
}

struct Deferred {
    spheres: Rc<[Prepared]>,
    packets: Vec<RayX8>,
    hits: Vec<Hit>,
}

impl Run for Deferred {
    fn run(&mut self, _: Query) {
        for (rays, hits) in self.packets.iter().zip(self.hits.chunks_exact_mut(8)) {
            let (mut best, mut id) = (f32x8::splat(f32::MAX), f32x8::splat(0.0));
            for (index, &(center, square)) in self.spheres.iter().enumerate() {
                let oc = rays.origin - center;
                let b = oc.dot(rays.direction);
                let descrim = b * b - (oc.mag_sq() - square);
                if descrim.cmp_gt(f32x8::splat(0.0)).move_mask() == 0 {
                    continue;
                }
                let t = readme(rays.origin, rays.direction, center, square);
                let nearer = t.cmp_lt(best);
                best = nearer.blend(t, best);
                id = nearer.blend(f32x8::splat(index as f32), id);
            }
            // Turns distances into multiples of the direction that was given.
            let t = best.cmp_lt(f32x8::splat(f32::MAX)).blend(best / rays.length, best);
            for (hit, (t, id)) in hits.iter_mut().zip(t.to_array().into_iter().zip(id.to_array())) {
                *hit = Hit { t, sphere: id as u32 };
            }
        }
        std::hint::black_box(&self.hits);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        self.hits.iter().map(|&hit| (hit.t < f32::MAX).then_some(hit)).collect()
    }
}

/// `ray_sphere_intersect_x8` of the README.
#[inline(always)]
fn readme(ray_o: Vec3x8, ray_d: Vec3x8, sphere_o: Vec3x8, sphere_r_sq: f32x8) -> f32x8 {
    let oc = ray_o - sphere_o;
    let b = oc.dot(ray_d);
    let c = oc.mag_sq() - sphere_r_sq;
    let descrim = b * b - c;
    let desc_pos = descrim.cmp_gt(f32x8::splat(0.0));
    let desc_sqrt = descrim.sqrt();
    let t1 = -b - desc_sqrt;
    let t1_valid = t1.cmp_gt(f32x8::splat(0.0)) & desc_pos;
    let t2 = -b + desc_sqrt;
    let t2_valid = t2.cmp_gt(f32x8::splat(0.0)) & desc_pos;
    let t = t2_valid.blend(t2, f32x8::splat(f32::MAX));
    t1_valid.blend(t1, t)
}
