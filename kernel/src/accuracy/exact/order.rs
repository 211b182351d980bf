//! Which of two spheres a ray hits first, where both answers are rounded to the same t.
//!
//! Rounding keeps the order of what it does not make equal, so roots need comparing only then. Double precision with
//! its bound decides nearly always; else [`compare_roots`] does, exactly.

use super::estimate::Estimate;
use super::one_ray;
use crate::exact::{Root, compare_roots};
use crate::{Ray, Sphere};
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
        let Estimate { discriminant, error, near, far } = one_ray::estimate(ray, sphere);
        let is_known = error < discriminant;
        let (low, high) = (near.0 - near.1, near.0 + near.1);
        let (first, last) = (low as f32, high as f32);
        let root = if is_known && first == last {
            if first == t { Root::Near } else { Root::Far }
        } else {
            match one_ray::quadratic(ray, sphere) {
                Some(quadratic) if quadratic.rounded(Root::Near) == t => Root::Near,
                _ => Root::Far,
            }
        };
        let (low, high) = match root {
            _ if !is_known => (f64::NEG_INFINITY, f64::INFINITY),
            Root::Near => (low, high),
            Root::Far => (far.0 - far.1, far.0 + far.1),
        };
        Self { root, low, high }
    }
}

/// How the roots compare that are answered by `t`, on one ray and two spheres.
#[cold]
#[inline(never)]
pub(super) fn compare(ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
    let [one, other] = spheres;
    if one == other {
        return Ordering::Equal;
    }
    let (first, second) = (Answered::new(ray, t, one), Answered::new(ray, t, other));
    if first.high < second.low {
        return Ordering::Less;
    }
    if second.high < first.low {
        return Ordering::Greater;
    }
    let (one, other) = (one_ray::terms(ray, one), one_ray::terms(ray, other));
    compare_roots((&one, first.root), (&other, second.root))
}
