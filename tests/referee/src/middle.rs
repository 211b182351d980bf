//! The middle between the two roots of a line: b/a, where it is closest to the centre.

use crate::aim::double;
use crate::exact_sum::Sum;
use spherule_kernel::{Exact, Ray, Sphere, roots};
use std::cmp::Ordering;

/// Returns whether `t` is nearer to the other root of the line than to `truth`, the one that is right: beyond the middle between them,
/// decided in real arithmetic. A t below 2^-600 counts as zero.
///
/// Rounded roots cannot tell: where a formula has lost the discriminant, t is next to the middle, and they may be as far from it.
#[must_use]
pub fn is_at_the_other_root(ray: &Ray, sphere: &Sphere, t: f64, truth: f32) -> bool {
    if are_before_or_behind(ray, sphere, [t, f64::from(truth)]) {
        return false;
    }
    // Of roots that are one number, t tells neither.
    let apart = roots(Exact, ray, sphere).filter(|[near, far]| near < far);
    apart.is_some_and(|[near, _]| {
        let side = side(t, ray, sphere);
        if truth == near { side.is_gt() } else { side.is_lt() }
    })
}

/// Whether double precision is sure that both t are on one side of the middle, as most are.
fn are_before_or_behind(ray: &Ray, sphere: &Sphere, t: [f64; 2]) -> bool {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(double);
    let (mut middle, mut squared, mut size) = (0.0, 0.0, 0.0);
    for ((o, d), c) in o.into_iter().zip(d).zip(c) {
        let along = (c - o) * d;
        (middle, squared, size) = (middle + along, squared + d * d, size + along.abs());
    }
    let sides = t.map(|t| t * squared - middle);
    // This is thousands of times the error of these few operations.
    let least = 1e-12 * size;
    sides.iter().all(|&side| side > least) || sides.iter().all(|&side| side < -least)
}

/// How `t` compares with the middle, exactly, for valid input.
///
/// It is the sign of a t - b, a = d.d, b = (c - o).d: of a sum of products. Two `f64` hold t d, four t d^2: with |t| between 2^-600 and
/// 2^384 all are multiples of 2^-950, and below 2^642. Larger t are beyond every middle.
fn side(t: f64, ray: &Ray, sphere: &Sphere) -> Ordering {
    let t = t.clamp(-LARGEST, LARGEST);
    let t = if t.abs() < LEAST { 0.0 } else { t };
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(double);
    let mut sum = Sum::default();
    for ((o, d), c) in o.into_iter().zip(d).zip(c) {
        let along = t * d;
        sum.add_product(along, d);
        sum.add_product(t.mul_add(d, -along), d);
        sum.add_product(o, d);
        sum.add_product(-c, d);
    }
    sum.sign()
}

/// 2^-600.
const LEAST: f64 = f64::from_bits((1023 - 600) << 52);
/// 2^384: |b| / a <= |c - o| / |d| is below 2^131 / 2^-149.
const LARGEST: f64 = f64::from_bits((1023 + 384) << 52);

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    #[test]
    fn sides_are_exact() {
        let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
        let ray = Ray::new(Vec3::ZERO, Vec3::Z);
        // b = 2^60 + 1 - 2^60, of which double precision loses the 1; a = 3.
        let far = 2_f32.powi(60);
        let far_sphere = Sphere::from([far, 1.0, 0.0, 1.0]);
        let far_ray = Ray::new(Vec3::new(0.0, 0.0, far), Vec3::ONE);
        let third = 1.0_f32 / 3.0;
        for (t, ray, sphere, expected) in [
            (5.0_f32, &ray, &sphere, Ordering::Equal),
            (5.0_f32.next_up(), &ray, &sphere, Ordering::Greater),
            (5.0_f32.next_down(), &ray, &sphere, Ordering::Less),
            (f32::INFINITY, &ray, &sphere, Ordering::Greater),
            // It is rounded upwards.
            (third, &far_ray, &far_sphere, Ordering::Greater),
            (third.next_down(), &far_ray, &far_sphere, Ordering::Less),
        ] {
            assert_eq!(side(f64::from(t), ray, sphere), expected, "{t:e}");
        }
    }
}
