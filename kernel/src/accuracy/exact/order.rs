//! Which of two spheres a ray hits first, where both answers are rounded to the same t.
//!
//! Rounding keeps the order of roots that it does not make equal, so only roots with equal t need comparing. Double
//! precision with its bound decides nearly always; else [`compare_roots`] decides, exactly.

use super::one_ray;
use crate::count::count;
use crate::exact::{Quadratic, Root, compare_roots};
use crate::{Ray, Sphere};
use core::cmp::Ordering;

/// A root that rounds to the answer t, and the doubles between which it lies.
pub(super) struct Answered {
    pub(super) root: Root,
    ends: [f64; 2],
}

impl Answered {
    /// Takes the near root if it rounds to t, else the far one: rule 4, since the interval accepts t.
    pub(super) fn new(ray: &Ray, t: f32, sphere: &Sphere) -> Self {
        let estimate = one_ray::estimate(ray, sphere);
        let [first, last] = estimate.near();
        if estimate.meets() == Some(true) && first == last {
            let root = if first == t { Root::Near } else { Root::Far };
            return Self { root, ends: estimate.roots[root as usize] };
        }
        let terms = one_ray::terms(ray, sphere);
        let near = Quadratic::new(&terms).map(|quadratic| quadratic.rounded(Root::Near));
        let root = if near == Some(t) { Root::Near } else { Root::Far };
        Self { root, ends: [f64::NEG_INFINITY, f64::INFINITY] }
    }
}

/// Compares the roots that round to `t`, of one ray and two spheres.
#[cold]
#[inline(never)]
pub(super) fn compare(ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
    let [one, other] = spheres;
    if one == other {
        return Ordering::Equal;
    }
    let first = Answered::new(ray, t, one);
    let second = Answered::new(ray, t, other);
    // `total_cmp` orders by bits, which is right: no end is -0.
    if first.ends[1].total_cmp(&second.ends[0]).is_lt() {
        return Ordering::Less;
    }
    if second.ends[1].total_cmp(&first.ends[0]).is_lt() {
        return Ordering::Greater;
    }
    count!(ExactOrder);
    let one = one_ray::terms(ray, one);
    let other = one_ray::terms(ray, other);
    compare_roots((&one, first.root), (&other, second.root))
}
