//! One ray and one sphere: the method of [`exact`](super), without lanes.
//!
//! Except `decided_inline`, these functions are not generic, and are called instead of inlined: where operations on
//! doubles are library calls, one estimate is as long as all the rest.

use super::estimate::{Solved, Sums};
use crate::accuracy::constants::Constants;
use crate::count::count;
use crate::exact::{Quadratic, QuadraticTerms, Root};
use crate::{Ray, Sphere};
#[cfg(feature = "std")]
use glam::Vec3;

/// What [`Estimate`](super::estimate::Estimate) says of one lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracketed {
    /// D.
    pub(super) discriminant: f64,
    /// The bound of D.
    pub(super) error: f64,
    /// The two numbers between which each root lies; meaningless where D is not above its bound.
    pub(super) roots: [[f64; 2]; 2],
}

/// D and the roots, each with its bound.
#[inline(never)]
pub(super) fn estimate(ray: &Ray, sphere: &Sphere) -> Bracketed {
    let sums = sums(ray, sphere);
    let solved = Solved::new(&sums, f64::from(sphere.radius), &Constants::PROVEN);
    let mut roots = [[sums.b - solved.root; 2], [sums.b + solved.root; 2]];
    for ends in &mut roots {
        let (t, bound) = solved.t(ends[0], &Constants::PROVEN);
        *ends = [t - bound, t + bound];
    }
    Bracketed { discriminant: solved.discriminant, error: solved.error, roots }
}

impl Bracketed {
    /// Whether the line meets the sphere, if that is known.
    pub(super) fn meets(&self) -> Option<bool> {
        // Of numbers that are not negative, the larger one has the larger bits.
        let is_known = self.error.to_bits() < self.discriminant.to_bits() & (u64::MAX >> 1);
        is_known.then_some(self.discriminant.is_sign_positive())
    }

    /// The two numbers of single precision between which the near root lies.
    pub(super) fn near(&self) -> [f32; 2] {
        let [[low, high], _] = &self.roots;
        [*low as f32, *high as f32]
    }
}

/// [`Sums::new`], axis after axis.
fn sums(ray: &Ray, sphere: &Sphere) -> Sums<f64> {
    let [o, d, c] = [ray.origin.to_array(), ray.direction.to_array(), sphere.center.to_array()];
    let (mut along, mut way) = ([0.0; 3], [0.0; 3]);
    // Adding to -0 changes nothing.
    let mut sums = Sums { a: -0.0, b: -0.0, square: -0.0, d: -0.0, p: -0.0, x: -0.0 };
    for i in 0..3 {
        let (d, p) = (f64::from(d[i]), f64::from(c[i]) - f64::from(o[i]));
        (along[i], way[i]) = (d, p);
        sums.a += d * d;
        sums.b += d * p;
        sums.d += d.abs();
        sums.p += p.abs();
    }
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let x = along[j] * way[k] - along[k] * way[j];
        sums.square += x * x;
        sums.x += x.abs();
    }
    sums
}

/// Returns the t of rules 2 to 4 of a valid ray and a valid sphere; `+inf` if there is none, or where it is larger than
/// `limit`; `None` where doubles cannot decide.
#[inline(never)]
pub(super) fn decided(ray: &Ray, sphere: &Sphere, limit: f32) -> Option<f32> {
    let estimate = estimate(ray, sphere);
    if !estimate.meets()? {
        return Some(f32::INFINITY);
    }
    for [low, high] in &estimate.roots {
        let (low, high) = (*low as f32, *high as f32);
        let is_out = high < ray.t_min || ray.t_max < low || limit < low;
        if is_out || low == f32::INFINITY || high == f32::NEG_INFINITY {
            continue;
        }
        // Adding zero turns -0 into +0.
        return if low == high { Some(low + 0.0) } else { None };
    }
    Some(f32::INFINITY)
}

#[cfg(feature = "std")]
#[inline(always)]
fn doubles(v: Vec3) -> [f64; 3] {
    [f64::from(v.x), f64::from(v.y), f64::from(v.z)]
}

/// [`decided`] without a limit, for processors that have doubles: the far root is solved only if it is needed.
#[cfg(feature = "std")]
#[inline(always)]
pub(super) fn decided_inline(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    // Not by an array's `map`, which is a call where nothing is optimised across units: 0.9 of the speed.
    let (o, d, c) = (doubles(ray.origin), doubles(ray.direction), doubles(sphere.center));
    let sums = Sums::new(o, d, c);
    let solved = Solved::new(&sums, f64::from(sphere.radius), &Constants::PROVEN);
    if solved.discriminant < -solved.error {
        return Some(f32::INFINITY);
    }
    let meets = solved.error < solved.discriminant;
    if !meets {
        return None;
    }
    for root in [-solved.root, solved.root] {
        let (t, bound) = solved.t(sums.b + root, &Constants::PROVEN);
        let (low, high) = ((t - bound) as f32, (t + bound) as f32);
        let is_out = high < ray.t_min || ray.t_max < low;
        if is_out || low == f32::INFINITY || high == f32::NEG_INFINITY {
            continue;
        }
        // Adding zero turns -0 into +0.
        return if low == high { Some(low + 0.0) } else { None };
    }
    Some(f32::INFINITY)
}

/// Both roots of the line of a valid ray and a valid sphere; `None` if the line misses it.
#[inline(never)]
pub(super) fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    let estimate = estimate(ray, sphere);
    let meets = estimate.meets();
    if meets == Some(false) {
        return None;
    }
    let [[near, near_end], [far, far_end]] = estimate.roots.map(|ends| ends.map(|end| end as f32));
    if meets.is_some() && near == near_end && far == far_end {
        return Some([near + 0.0, far + 0.0]);
    }
    let terms = terms(ray, sphere);
    let quadratic = Quadratic::new(&terms)?;
    Some([quadratic.rounded(Root::Near), quadratic.rounded(Root::Far)])
}

/// The t of rules 2 to 4 by exact sums, `+inf` if there is none.
#[cold]
#[inline(never)]
pub(super) fn settled(ray: &Ray, sphere: &Sphere) -> f32 {
    count!(ExactRoot);
    let terms = terms(ray, sphere);
    let Some(quadratic) = Quadratic::new(&terms) else { return f32::INFINITY };
    for root in [Root::Near, Root::Far] {
        let t = quadratic.rounded(root);
        if ray.t_min <= t && t <= ray.t_max && t.is_finite() {
            return t;
        }
    }
    f32::INFINITY
}

/// The line and the sphere, for exact sums.
#[inline(never)]
pub(super) fn terms(ray: &Ray, sphere: &Sphere) -> QuadraticTerms {
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    QuadraticTerms::new(origin, direction, sphere.center.to_array(), sphere.radius)
}

#[cfg(all(test, proofs))]
mod tests {
    use super::super::estimate::Estimate;
    use super::estimate;
    use crate::proofs::climb::Random;
    use crate::{Ray, Sphere};

    /// The estimates are equal bit for bit, so what is proven of the one in lanes holds for one
    /// ray.
    #[test]
    fn an_estimate_is_that_of_lanes() {
        let mut random = Random(61);
        for round in 0..200_000 {
            let most = [3, 126][round % 2];
            let mut any = || random.wide(-most, most);
            let [ox, oy, oz, dx, dy, dz] = [(); 6].map(|()| any());
            let ray = Ray::new([ox, oy, oz].into(), [dx, dy, dz].into());
            let sphere = Sphere { center: [any(), any(), any()].into(), radius: any().abs() };
            let vectors = [ray.origin, ray.direction, sphere.center];
            let [o, d, c] = vectors.map(|vector| vector.to_array().map(f64::from));
            let radius = f64::from(sphere.radius);
            let lanes = Estimate::new(o, d, c, radius, &Estimate::<f64>::PROVEN);
            let one = estimate(&ray, &sphere);
            let ends = |(t, bound): (f64, f64)| [t - bound, t + bound].map(f64::to_bits);
            assert_eq!(
                [one.discriminant, one.error].map(f64::to_bits),
                [lanes.discriminant, lanes.error].map(f64::to_bits)
            );
            if lanes.error < lanes.discriminant {
                assert_eq!(
                    one.roots.map(|ends| ends.map(f64::to_bits)),
                    [lanes.near, lanes.far].map(ends)
                );
            }
            let meets =
                (lanes.error < lanes.discriminant.abs()).then_some(lanes.discriminant > 0.0);
            assert_eq!(one.meets(), meets);
        }
    }
}
