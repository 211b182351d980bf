//! The ends of single precision: subnormals, overflow, NaN and infinities, and any bits at all.

use super::plain;
use crate::aim::{Aim, double, single};
use crate::case::Case;
use crate::random::{Random, power_of_two};
use spherule_kernel::{Ray, Sphere, Vec3};

/// Some or all lengths a few thousand units of 2^-149.
pub(super) fn subnormals(random: &mut Random) -> Case {
    let unit = power_of_two(-149);
    let reach = 1 << random.integer(2, 22);
    let mut point = || [(); 3].map(|()| random.integer(-reach, reach) as f64 * unit);
    let (origin, center) = (point(), point());
    let radius = random.integer(0, reach / 2) as f64 * unit;
    // The ray aims at a point within two radii of the centre; its direction is as short as the
    // rest, or of common length.
    let aside = random.unit().map(|x| x * radius * random.uniform(0.0, 2.0));
    let toward: [f64; 3] = core::array::from_fn(|i| center[i] + aside[i] - origin[i]);
    let scale = if random.one_in(2) { 1.0 } else { power_of_two(random.integer(100, 240)) };
    let mut ray = Ray::new(single(origin), single(toward.map(|x| x * scale)));
    if random.one_in(4) {
        ray.t_min = f32::NEG_INFINITY;
    }
    Case { ray, sphere: Sphere { center: single(center), radius: radius as f32 } }
}

/// Lengths of 2^100 and more, whose squares are beyond single precision.
pub(super) fn near_overflow(random: &mut Random) -> Case {
    let radius = random.log_uniform(100, 126);
    let origin = random.unit().map(|x| x * radius * random.uniform(0.0, 1.0));
    let distance = radius * random.uniform(-1.0, 1.0);
    let offset = random.uniform(0.0, 1.5);
    let length = if random.one_in(2) { random.log_uniform(-4, 4) } else { radius };
    Aim { origin, length, distance, radius, offset }.case(random)
}

/// An ordinary case with one of the inputs that the contract judges by name.
pub(super) fn degenerate(random: &mut Random) -> Case {
    let mut case = plain::ordinary(random);
    let Case { ray, sphere } = &mut case;
    match random.integer(0, 13) {
        0 => ray.direction = Vec3::ZERO,
        1 => ray.direction = -Vec3::ZERO,
        2 => sphere.radius = -sphere.radius,
        3 => sphere.radius = 0.0,
        4 => sphere.radius = -0.0,
        5 => (ray.t_min, ray.t_max) = (random.uniform(1.0, 2.0) as f32, 0.5),
        6 => ray.t_min = f32::NAN,
        7 => ray.t_max = f32::NAN,
        8 => ray.t_min = f32::NEG_INFINITY,
        9 => (ray.t_min, ray.t_max) = (f32::INFINITY, f32::INFINITY),
        10 => {
            // A point sphere that the ray meets: at twice the direction.
            sphere.radius = 0.0;
            ray.origin = Vec3::new(3.0, -5.0, 7.0);
            sphere.center = ray.origin + 2.0 * Vec3::new(1.0, 2.0, -3.0);
            ray.direction = Vec3::new(1.0, 2.0, -3.0);
        }
        11 => {
            // From the centre.
            ray.origin = sphere.center;
        }
        _ => {
            let mut numbers = case.numbers();
            let which = random.integer(0, Case::NUMBERS as i64 - 1) as usize;
            numbers[which] = random.pick(&[f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
            case = Case::from_numbers(numbers);
        }
    }
    case
}

/// Roots near the largest and the least numbers of single precision. For the least t, one direction in eight overflows.
pub(super) fn extreme_t(random: &mut Random) -> Case {
    let large = random.one_in(2);
    let t_exponent = if large { random.integer(124, 130) } else { -random.integer(124, 154) };
    // The scene takes a part of the exponent, the direction the rest.
    let part = random.integer(10, 60) * t_exponent.signum();
    let radius = random.uniform(1.0, 2.0) * power_of_two(part);
    let distance = radius * random.uniform(1.0, 20.0);
    let aim = Aim {
        origin: random.unit().map(|x| x * radius),
        length: distance * power_of_two(-t_exponent),
        distance,
        radius,
        offset: random.uniform(0.0, 1.2),
    };
    let mut case = aim.case(random);
    if random.one_in(3) {
        case.ray.t_min = f32::NEG_INFINITY;
        case.ray.direction *= random.sign() as f32;
    }
    case
}

/// Any bits in all places. In half of the cases all numbers are finite, and the ray is a half-line.
pub(super) fn random_bits(random: &mut Random) -> Case {
    let mut case = Case::from_numbers([0.0; Case::NUMBERS].map(|_| random.any_f32()));
    if random.one_in(2) {
        let numbers = case.numbers().map(|x| if x.is_finite() { x } else { 1.0 });
        case = Case::from_numbers(numbers);
        (case.ray.t_min, case.ray.t_max) = (0.0, f32::INFINITY);
        case.sphere.radius = case.sphere.radius.abs();
    }
    case
}

/// Every size has its own power of two, and yet most lines meet the sphere.
pub(super) fn wide_exponents(random: &mut Random) -> Case {
    let radius = random.log_uniform(-126, 100);
    let length = random.log_uniform(-120, 120);
    let origin = random.unit().map(|x| x * radius * power_of_two(random.integer(-30, 20)));
    let distance = radius * random.log_uniform(-20, 20) * random.sign();
    let offset = random.uniform(0.0, 1.2);
    let mut case = Aim { origin, length, distance, radius, offset }.case(random);
    // One coordinate of the direction has another size; moving the centre keeps the aim.
    if random.one_in(3) {
        let axis = random.integer(0, 2) as usize;
        case.ray.direction[axis] *= power_of_two(-random.integer(1, 60)) as f32;
        let (o, d) = (double(case.ray.origin), double(case.ray.direction));
        let t = distance / length;
        let center = core::array::from_fn(|i| o[i] + t * d[i]);
        case.sphere.center = single(center);
    }
    if random.one_in(2) {
        case.ray.t_min = f32::NEG_INFINITY;
    }
    case
}
