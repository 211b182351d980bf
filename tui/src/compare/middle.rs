//! The middle between the two roots of a line: b/a, where it is closest to the centre.

use spherule_kernel::{Ray, Sphere};
use std::cmp::Ordering;

/// Whether double precision is sure that both t are on one side of the middle, as most are.
pub(super) fn are_before_or_behind(ray: &Ray, sphere: &Sphere, t: [f32; 2]) -> bool {
    let (direction, center) = (ray.direction.as_dvec3(), sphere.center.as_dvec3());
    let way = center - ray.origin.as_dvec3();
    let (middle, squared) = (way.dot(direction), direction.length_squared());
    let sides = t.map(|t| f64::from(t) * squared - middle);
    // This is thousands of times the error of these few operations.
    let least = 1e-12 * (way.abs().dot(direction.abs()) + middle.abs());
    sides.iter().all(|&side| side > least) || sides.iter().all(|&side| side < -least)
}

/// How `t` compares with the middle, exactly, for valid input.
///
/// It is the sign of a t - b, a = d.d, b = (c - o).d: of a sum of products of two or three `f32`. Two `f64` hold each of
/// them, since it is a multiple of 2^-447 and below 2^384.
pub(super) fn side(t: f32, ray: &Ray, sphere: &Sphere) -> Ordering {
    let t = f64::from(t.clamp(f32::MIN, f32::MAX));
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    let mut sum = Sum::default();
    for ((o, d), c) in o.into_iter().zip(d).zip(c) {
        let along = t * d;
        let product = along * d;
        for part in [along.mul_add(d, -product), product, o * d, -c * d] {
            sum.add(part);
        }
    }
    sum.sign()
}

/// A sum without any rounding: numbers that do not overlap, from small to large, and zeros (Shewchuk 1997).
#[derive(Default)]
struct Sum(Vec<f64>);

impl Sum {
    fn add(&mut self, value: f64) {
        let mut carried = value;
        for part in &mut self.0 {
            let sum = carried + *part;
            let other = sum - carried;
            *part = (carried - (sum - other)) + (*part - other);
            carried = sum;
        }
        self.0.push(carried);
    }

    /// How it compares with zero: the largest part decides.
    fn sign(&self) -> Ordering {
        let largest = self.0.iter().rev().find(|part| **part != 0.0);
        largest.map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
    }
}

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
            (5.0, &ray, &sphere, Ordering::Equal),
            (5.0_f32.next_up(), &ray, &sphere, Ordering::Greater),
            (5.0_f32.next_down(), &ray, &sphere, Ordering::Less),
            (f32::INFINITY, &ray, &sphere, Ordering::Greater),
            // It is rounded upwards.
            (third, &far_ray, &far_sphere, Ordering::Greater),
            (third.next_down(), &far_ray, &far_sphere, Ordering::Less),
        ] {
            assert_eq!(side(t, ray, sphere), expected, "{t:e}");
        }
    }
}
