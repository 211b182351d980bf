//! Closest point first, in single precision.

use super::{Accuracy, RayLanes, Roots, sealed};
use crate::Lanes;
use crate::error_free::{product_error, split, two_sum};

/// The best form that plain `f32` allows.
#[derive(Clone, Copy, Debug)]
pub struct Stable;

/// The rays, and a = d.d.
#[derive(Clone, Copy, Debug)]
pub struct StableRays<L> {
    origin: [L; 3],
    direction: [L; 3],
    halves: [(L, L); 3],
    a: L,
}

impl sealed::Sealed for Stable {}

impl Accuracy for Stable {
    const NAME: &'static str = "stable";
    type Prepared<L: Lanes> = StableRays<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> StableRays<L> {
        let d = rays.direction;
        StableRays {
            origin: rays.origin,
            direction: d,
            halves: d.map(split),
            a: d[0] * d[0] + d[1] * d[1] + d[2] * d[2],
        }
    }

    #[inline(always)]
    fn roots<L: Lanes>(rays: &StableRays<L>, center: [L; 3], radius: L) -> Roots<L> {
        let StableRays { origin: o, direction: d, halves, a } = *rays;
        let p = [0, 1, 2].map(|i| two_sum(center[i], -o[i]));
        let b = d[0] * p[0].0 + d[1] * p[1].0 + d[2] * p[2].0;
        let middle = b / a;
        let middle_halves = split(middle);
        let q = [0, 1, 2].map(|i| {
            let product = middle * d[i];
            let error = product_error(product, middle_halves, halves[i]);
            (p[i].0 - product) + (p[i].1 - error)
        });
        let g = d[0] * q[0] + d[1] * q[1] + d[2] * q[2];
        let c = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) - radius * radius;
        let discriminant = g * g - a * c;
        let root = discriminant.sqrt();
        Roots {
            meets: L::splat(a.token(), 0.0).le(discriminant),
            near: middle + (g - root) / a,
            far: middle + (g + root) / a,
        }
    }
}
