//! Rays that start near the surface or on it, and intervals that end at a root.

use super::{lattice, plain};
use crate::aim::{double, single};
use crate::case::Case;
use crate::random::{Random, power_of_two};
use crate::ulp::step;
use spherule_kernel::{Exact, Ray, Sphere, roots};

/// An origin at `radius * (1 + off)` from the centre, and any direction. The sphere may lie four radii from zero: where `off` is small,
/// rounding the origin may take it to another depth, or to the other side.
fn near_surface(random: &mut Random, off: f64) -> Case {
    let radius = random.log_uniform(-4, 10);
    let center = random.unit().map(|x| x * radius * random.uniform(0.0, 4.0));
    let outward = random.unit();
    let origin =
        core::array::from_fn(|i| f64::from(center[i] as f32) + outward[i] * radius * (1.0 + off));
    let length = random.log_uniform(-4, 3);
    let direction = random.unit().map(|x| x * length);
    Case {
        ray: Ray::new(single(origin), single(direction)),
        sphere: Sphere { center: single(center), radius: radius as f32 },
    }
}

/// The origin is 2^-4 to 2^-26 radii under the surface before it is rounded; then 3 in 100 are over it or on it.
pub(super) fn inside(random: &mut Random) -> Case {
    let off = -power_of_two(-random.integer(4, 26));
    near_surface(random, off)
}

/// The origin is 2^-4 to 2^-26 radii over the surface before it is rounded; then 3 in 100 are under it or on it. The ray looks down.
pub(super) fn outside(random: &mut Random) -> Case {
    let off = power_of_two(-random.integer(4, 26));
    let mut case = near_surface(random, off);
    let (o, c) = (double(case.ray.origin), double(case.sphere.center));
    let down = core::array::from_fn(|i| c[i] - o[i]);
    if crate::random::dot(double(case.ray.direction), down) < 0.0 {
        case.ray.direction = -case.ray.direction;
    }
    case
}

/// On the surface: exactly, by a lattice, or where rounding put the point.
pub(super) fn on(random: &mut Random) -> Case {
    let mut case =
        if random.one_in(2) { near_surface(random, 0.0) } else { lattice::on_surface(random) };
    // Zero, the number after it, and an interval from behind the origin.
    case.ray.t_min = random.pick(&[0.0, -0.0, f32::from_bits(1), f32::NEG_INFINITY]);
    case
}

/// An interval that ends at a root, or an ulp or two beside it.
pub(super) fn range_at_root(random: &mut Random) -> Case {
    loop {
        let draw = random.pick(&[plain::ordinary, inside, lattice::tangent, lattice::tie]);
        let mut case = draw(random);
        let Some(roots) = roots(Exact, &case.ray, &case.sphere) else { continue };
        let end = step(random.pick(&roots), random.integer(-2, 2));
        if random.one_in(2) {
            case.ray.t_min = end;
        } else {
            (case.ray.t_min, case.ray.t_max) = (f32::NEG_INFINITY, end);
        }
        return case;
    }
}
