//! Which of two spheres a ray hits first, where both answers are rounded to the same t.
//!
//! Rounding keeps the order of what it does not make equal, so roots need comparing only then. Double precision with
//! its bound decides nearly always; else [`compare_roots`] does, exactly.

use super::estimate::{Constants, Estimate};
use crate::exact::{Quadratic, QuadraticTerms, Root, compare_roots};
use crate::lanes::LaneMask;
use crate::numeric::axes::axes;
use crate::{DoubleLanes, Ray, Sphere};
use core::cmp::Ordering;

/// A root that is answered by t, and between which doubles it lies.
pub(super) struct Answered {
    pub(super) root: Root,
    low: f64,
    high: f64,
}

impl Answered {
    /// By rule 4 the near root, if it is rounded to t, which the interval accepts.
    pub(super) fn new(ray: &Ray, t: f32, sphere: &Sphere) -> Self {
        let (o, d, c) = (ray.origin.to_array(), ray.direction.to_array(), sphere.center.to_array());
        let Estimate { discriminant, error, near, far } = Estimate::new(
            axes!(i => f64::from(o[i])),
            axes!(i => f64::from(d[i])),
            axes!(i => f64::from(c[i])),
            f64::from(sphere.radius),
            &Constants::PROVEN,
        );
        let is_known = DoubleLanes::lt(error, discriminant).any();
        let [(low, high), far] = [near, far].map(|(t, bound)| (t - bound, t + bound));
        let (first, last) = (low as f32, high as f32);
        let root = if is_known && first == last {
            if first == t { Root::Near } else { Root::Far }
        } else {
            match Quadratic::new(o, d, c, sphere.radius) {
                Some(quadratic) if quadratic.rounded(Root::Near) == t => Root::Near,
                _ => Root::Far,
            }
        };
        let (low, high) = match root {
            _ if !is_known => (f64::NEG_INFINITY, f64::INFINITY),
            Root::Near => (low, high),
            Root::Far => far,
        };
        Self { root, low, high }
    }
}

/// How the roots compare that are answered by `t`, on one ray and two spheres.
#[cold]
#[inline(never)]
pub(super) fn compare(ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
    if spheres[0] == spheres[1] {
        return Ordering::Equal;
    }
    let [first, second] = spheres.map(|sphere| Answered::new(ray, t, sphere));
    if first.high < second.low {
        return Ordering::Less;
    }
    if second.high < first.low {
        return Ordering::Greater;
    }
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let [one, other] = spheres.map(|sphere| {
        QuadraticTerms::new(origin, direction, sphere.center.to_array(), sphere.radius)
    });
    compare_roots((&one, first.root), (&other, second.root))
}
