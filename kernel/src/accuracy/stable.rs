//! The quadratic, solved near the closest point of the line: the most accurate form in single precision.
//!
//! # Method
//!
//! The lecture's geometric form goes to the point of the line nearest to the centre, and from there
//! half a chord back and forth. Two errors spoil it: rounding p = c - o, which at distance 1e6 r
//! moves the sphere by a twentieth of its radius, and the subtraction r^2 - l^2 near a tangent.
//! Both are cured without a wider type:
//!
//! 1. p is kept as the exact sum of two numbers.
//! 2. t_m = d.p / a need not be the closest point: *any* point of the line is a sound place to
//!    solve the quadratic from, as long as q = p - t_m d is known well for the t_m that was
//!    rounded to. With the product's rounding error recovered it is: to a rounding or two of q,
//!    however large p was. (Moving to the object first: Wald, Ray Tracing Gems II, ch. 34.)
//! 3. From there, with g = d.q: D = g^2 - a (q.q - r^2), t = t_m + (g -+ sqrt D) / a. g is what
//!    is left of the projection, so this is the second projection too (Haines, Guenther,
//!    Akenine-Moeller, Ray Tracing Gems, ch. 7).
//! 4. Where |D| is small beside its terms - a graze - the lane moves on by g / a, with q in two
//!    terms, and sums q.q - r^2 in two-term arithmetic: errors of some 2^-45 in place of 2^-22.
//! 5. Where a root is small beside half the chord - the ray starts near the surface - it is taken from the
//!    product of the roots, (p.p - r^2) / a, with that difference in two-term arithmetic.
//!
//! Few lanes need steps 4 and 5: a packet does them only where one of its lanes needs them, and keeps the results only
//! in that lane, so that the answer does not depend on neighbours.
//!
//! The direction is scaled by a power of two to a length near one, which is exact, and t is scaled back.

use super::formula::{Squares, Tier, TierFormula, Underflow};
use super::range_limits::RangeLimits;
use super::roots::{RayLanes, Roots, line_roots_of};
use crate::numeric::axes::{axes, dot, largest};
use crate::numeric::error_free::{VeltkampSplit, two_sum};
use crate::numeric::power_of_two::inverse_powers_of_two;
use crate::{LaneMask, Lanes, Ray, Sphere};

/// The best form that plain `f32` allows: few-ulp answers without wider arithmetic.
///
/// Domain: r and |p| (p is the centre minus the origin) are zero or within [2^-40, 2^40], |p| from 2^-32 on if r is
/// zero; the largest component of the direction is a normal number. Inside the domain, for |p|/r up to 1e6:
///
/// - Decisions are right except for tangents closer than 2^-41 (|p| + r). The most that a search
///   found is 2^-49.
/// - t is within 12 ulp if the ray starts a radius or more from the surface. The most that a search
///   found is 9; 36 follows from the margins of the traversal.
/// - If it starts nearer, t is within 2^-17 r of distance.
///
/// A scene multiplied by a power of two has the same answers, except for tangents that close: the squares that decide them may underflow.
///
/// Outside the domain, answers of a list are the same bits on every target, but nothing is promised. The tier does not know which of several hits
/// with the same t is the closest.
#[derive(Clone, Copy, Debug)]
pub struct Stable;

/// The rays, their directions scaled to lengths near one.
#[derive(Clone, Copy, Debug)]
pub struct StableRays<L> {
    origin: [L; 3],
    direction: [VeltkampSplit<L>; 3],
    /// a = d.d of the scaled direction, and 1/a.
    a: L,
    per_a: L,
    range_limits: RangeLimits<L>,
    /// The power of two that the direction was scaled by; t is scaled back by the same.
    scale: L,
}

impl TierFormula for Stable {
    const THIS: Self = Self;
    const TIER: Tier = Tier::Stable;
    /// The length is the least normal number, the size 2^-60: what underflows in D / a is below
    /// 2^-144.
    const UNDERFLOW: Underflow =
        Underflow { length: f32::MIN_POSITIVE, size: 1.0 / (1_u64 << 60) as f32 };
    const SQUARES: Squares = Squares::OfPoints;
    type Prepared<L: Lanes> = StableRays<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> StableRays<L> {
        let d = rays.direction;
        let scale = inverse_powers_of_two(largest(d));
        let d = axes!(i => d[i] * scale);
        let a = dot(d, d);
        StableRays {
            origin: rays.origin,
            direction: axes!(i => VeltkampSplit::new(d[i])),
            a,
            per_a: a.like(1.0) / a,
            range_limits: RangeLimits::of_scaled(d, a, scale),
            scale,
        }
    }

    #[inline(always)]
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        prepared: &StableRays<L>,
        center: [L; 3],
        radius: L,
        active: L::Mask,
        limit: L,
        _any: bool,
    ) -> L {
        let active = active & !prepared.range_limits.limit(rays, center, radius, limit);
        let infinity = limit.like(f32::INFINITY);
        if !active.any() {
            return infinity;
        }
        let t = roots(prepared, center, radius).first_accepted(rays);
        L::select(active, t, infinity)
    }

    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
        line_roots_of(Self::prepare, roots, ray, sphere)
    }
}

#[inline(always)]
fn roots<L: Lanes>(rays: &StableRays<L>, center: [L; 3], radius: L) -> Roots<L> {
    let StableRays { origin: o, direction: d, a, per_a, scale, .. } = *rays;
    let d_value = axes!(i => d[i].value);

    // Go to the middle of the chord, or near it, and find the centre from there.
    let p = axes!(i => two_sum(center[i], -o[i]));
    let middle = dot(d_value, axes!(i => p[i].0)) * per_a;
    let halved_middle = VeltkampSplit::new(middle);
    let steps = axes!(i => halved_middle.times(d[i]));
    let q = axes!(i => (p[i].0 - steps[i].0) + (p[i].1 - steps[i].1));

    // Solve the quadratic there.
    let (g, qq, rr) = (dot(d_value, q), dot(q, q), radius * radius);
    let mut offset = g * per_a;
    let mut discriminant = g * g - a * (qq - rr);

    // A graze is solved again, in two-term arithmetic.
    let grazing = discriminant.abs().le(a.like(GRAZING) * (a * (qq + rr)));
    if grazing.any() {
        let (moved, regrazed) = about_closest_point(rays, p, steps, offset, radius);
        offset = L::select(grazing, moved, offset);
        discriminant = L::select(grazing, regrazed, discriminant);
    }
    let half_chord = discriminant.sqrt() * per_a;
    let mut near = middle + (offset - half_chord);
    let mut far = middle + (offset + half_chord);

    // A root that cancelled is taken from the product of the two.
    let forward = a.like(0.0).le(middle);
    let small = L::select(forward, near, far);
    // Strictly less: for a tangent at the origin both sides are zero, and so is the product's
    // divisor.
    let cancelled = small.abs().lt(a.like(CANCELLED) * half_chord);
    if cancelled.any() {
        let large = L::select(forward, far, near);
        let quotient = squares_less_square(p, radius) / (a * large);
        near = L::select(cancelled & forward, quotient, near);
        far = L::select(cancelled & !forward, quotient, far);
    }
    Roots { meets: a.like(0.0).le(discriminant), near: near * scale, far: far * scale }
}

/// A discriminant this small beside its terms is computed again: the line passes within 1.6 % of
/// the radius of the edge. (1/16 was 5 % slower on camera rays, and gained no ulp. 1/64 lost an
/// ulp, and gained nothing.)
const GRAZING: f32 = 1.0 / 32.0;
/// A root this small beside half the chord is computed again.
const CANCELLED: f32 = 1.0 / 8.0;

/// Moves on from p - steps by `offset` d, to the closest point except some 2^-45 of |p|, and solves
/// there. Returns the new offset from the middle, and the discriminant.
#[inline(always)]
fn about_closest_point<L: Lanes>(
    rays: &StableRays<L>,
    p: [(L, L); 3],
    steps: [(L, L); 3],
    offset: L,
    radius: L,
) -> (L, L) {
    let halved_offset = VeltkampSplit::new(offset);
    let q = axes!(i => {
        let (high, low) = two_sum(p[i].0, -steps[i].0);
        let low = low + (p[i].1 - steps[i].1);
        let step = halved_offset.times(rays.direction[i]);
        let (high, lower) = two_sum(high, -step.0);
        two_sum(high, lower + (low - step.1))
    });
    let g = dot(axes!(i => rays.direction[i].value), axes!(i => q[i].0));
    let discriminant = g * g - rays.a * squares_less_square(q, radius);
    (offset + g * rays.per_a, discriminant)
}

/// v.v - r^2 of two-term coordinates, with an error of some 2^-45 of its terms.
#[inline(always)]
fn squares_less_square<L: Lanes>(v: [(L, L); 3], radius: L) -> L {
    let (rr, rr_low) = VeltkampSplit::new(radius).squared();
    let [x, y, z] = axes!(i => {
        let (high, low) = v[i];
        let (square, error) = VeltkampSplit::new(high).squared();
        let cross = high * low;
        (square, error + (cross + cross))
    });

    let (xy, xy_low) = two_sum(x.0, y.0);
    let (zr, zr_low) = two_sum(z.0, -rr);
    let (sum, sum_low) = two_sum(xy, zr);
    sum + ((sum_low + (xy_low + zr_low)) + ((x.1 + y.1) + (z.1 - rr_low)))
}

#[cfg(all(test, proofs))]
mod tests {
    use crate::{Ray, Sphere, Stable, Vec3, roots};

    #[test]
    fn a_tangent_at_the_origin_has_two_roots_of_zero() {
        let ray = Ray::new(Vec3::new(0.0, 33_554_432.0, 0.0), Vec3::new(7.0, 0.0, 0.0));
        let sphere = Sphere { center: Vec3::new(0.0, 16_777_216.0, 0.0), radius: 16_777_216.0 };
        assert_eq!(roots(Stable, &ray, &sphere), Some([0.0, 0.0]));
    }
}
