//! The surface at a hit, computed from the sphere's centre and not from t. For a ray from afar, t is rounded by more
//! than the sphere's size.
//!
//! # Method
//!
//! With p = c - o, a = d.d and D = a r^2 - |d x p|^2, the roots are t = (b -+ sqrt D) / a, and the point as seen from
//! the centre is
//!
//! ```text
//! t d - p = (d x (d x p) -+ d sqrt D) / a.
//! ```
//!
//! In double precision d x p loses some 2^-51 |d| |p|: a normal is off by some 2^-50 |p| / r, 2^-27 from 10^7 radii
//! away. Where that loss matters, d x p is computed without it: the products of single precision are exact, and so is
//! the sum of two of them in two terms. `Exact` has bounds for both forms (`docs/numerics.md`).

use super::constants::Constants;
use super::roots::RayLanes;
use crate::lanes::{DoubleLanes, LaneArray, Lanes};
use crate::numeric::axes::{axes, cross, dot, sum_of_magnitudes};
use crate::numeric::error_free::two_sum;
use crate::numeric::rounding::DOUBLE_U as U;
use crate::{Ray, Sphere};

/// [`Surface`]s in registers.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceLanes<L> {
    pub(crate) normal: [L; 3],
    pub(crate) point: [L; 3],
    pub(crate) rest: [L; 3],
}

/// 2^29 + 1: a split by it leaves the bits of single precision.
const SPLITTER: f64 = 536_870_913.0;
/// 16 ulp of t, at least.
const NEAR_ULPS: f64 = 16.0 / 8_388_608.0;
/// Half an ulp of t, at most.
const HALF_A_STEP: f64 = 0.5 / 8_388_608.0;

/// The factors in the bound of D, where d x p is in two terms.
const TWO_TERMS: Constants = Constants {
    sums: 10.0 * U,
    cross: 8.0 * U * U,
    square: 64.0 * U * U * U * U,
    ..Constants::PROVEN
};

/// A line and a sphere in double precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<D> {
    direction: [D; 3],
    radius: D,
    /// d x p.
    cross: [D; 3],
    pub(super) a: D,
    /// b.
    pub(super) slope: D,
    pub(super) discriminant: D,
    /// The bound of D.
    pub(super) error: D,
    /// |d|_1, and G = |d|_1 |p|_1.
    length: D,
    pub(super) size: D,
    /// A bound on the error of d x (d x p), in units of |d|_1.
    loss: D,
}

impl<D: DoubleLanes> Line<D> {
    /// Computes d x p within 3u of its products, or, if `IN_TWO_TERMS`, within 2u of itself.
    #[inline(always)]
    pub(super) fn new<const IN_TWO_TERMS: bool>(
        o: [D; 3],
        d: [D; 3],
        c: [D; 3],
        radius: D,
    ) -> Self {
        let p = axes!(i => c[i] - o[i]);
        let x = if IN_TWO_TERMS {
            [
                cross_in_two_terms([d[1], d[2]], [c[1], c[2]], [o[1], o[2]]),
                cross_in_two_terms([d[2], d[0]], [c[2], c[0]], [o[2], o[0]]),
                cross_in_two_terms([d[0], d[1]], [c[0], c[1]], [o[0], o[1]]),
            ]
        } else {
            cross(d, p)
        };
        let a = dot(d, d);
        let (reach, square) = (a * (radius * radius), dot(x, x));
        let (length, lost) = (sum_of_magnitudes(d), sum_of_magnitudes(x));
        let size = length * sum_of_magnitudes(p);

        let Constants { sums, cross, square: squared, .. } =
            if IN_TWO_TERMS { TWO_TERMS } else { Constants::PROVEN };
        let error = a.like(sums) * (reach + square)
            + a.like(cross) * (lost * size)
            + a.like(squared) * (size * size);
        let loss = if IN_TWO_TERMS {
            a.like(8.0 * U) * lost + a.like(8.0 * U * U) * size
        } else {
            a.like(8.0 * U) * size
        };
        Self {
            direction: d,
            radius,
            cross: x,
            a,
            slope: dot(d, p),
            discriminant: reach - square,
            error,
            length,
            size,
            loss,
        }
    }

    /// Part `part` of the lanes.
    #[inline(always)]
    pub(super) fn of_part<L: Lanes<Double = D>, const IN_TWO_TERMS: bool>(
        rays: &RayLanes<L>,
        center: [L; 3],
        radius: L,
        part: usize,
    ) -> Self {
        Self::new::<IN_TWO_TERMS>(
            axes!(i => rays.origin[i].widen(part)),
            axes!(i => rays.direction[i].widen(part)),
            axes!(i => center[i].widen(part)),
            radius.widen(part),
        )
    }

    /// Returns the point of the near root in the lanes `is_near`, else of the far one, as seen from the centre; a bound
    /// on the error of every coordinate, if D is above its bound; and 1/r. Where the line misses, it is the line's
    /// point closest to the centre.
    #[inline(always)]
    pub(super) fn point(&self, is_near: D::Mask) -> ([D; 3], D, D) {
        let (d, zero) = (self.direction, self.a.like(0.0));
        let positive = zero.lt(self.discriminant);
        let root = D::select(positive, self.discriminant, zero).sqrt();
        // One division for all three.
        let both = self.a * D::select(positive, root, root.like(1.0));
        let per_all = root.like(1.0) / (both * self.radius);
        let (per_both, per_radius) = (per_all * self.radius, per_all * both);
        let per_a = D::select(positive, root * per_both, per_both);
        let signed = D::select(is_near, -root, root);
        let across = cross(d, self.cross);
        let point = axes!(i => (across[i] + d[i] * signed) * per_a);

        let of_root =
            root.like(1.25) * self.error * (per_both * self.a) + root.like(4.0 * U) * root;
        let error = self.length * (self.loss + of_root) * per_a + root.like(16.0 * U) * self.radius;
        (point, error, per_radius)
    }

    /// The lanes in which `t` is nearer to the near root than to the far one, or as near the near root as a tier gets. If the
    /// near root rounds to a t before `t_min`, only a t before the middle answers it: a tier took the root to be later.
    #[inline(always)]
    fn answers_near(&self, t: D, t_min: D) -> D::Mask {
        let zero = t.like(0.0);
        let root = D::select(zero.lt(self.discriminant), self.discriminant, zero).sqrt();
        let past_middle = t * self.a - self.slope;
        let from_near = (past_middle + root).abs();
        let is_near = from_near.le((t * self.a).abs() * t.like(NEAR_ULPS));
        let rounding = (t * self.a).abs() * t.like(HALF_A_STEP);
        past_middle.le(zero) | (is_near & (t_min * self.a).le(self.slope - root + rounding))
    }

    /// The unit normal, and the point at the radius along it: `point` may be off the sphere, where a tier saw a hit but
    /// the line misses.
    #[inline(always)]
    fn projected(&self, point: [D; 3]) -> [[D; 3]; 2] {
        let zero = self.radius.like(0.0);
        let square = dot(point, point);
        let per_length =
            self.radius.like(1.0) / D::select(zero.lt(square), square, self.radius).sqrt();
        let normal = axes!(i => point[i] * per_length);
        [normal, axes!(i => normal[i] * self.radius)]
    }
}

/// d_0 (c_1 - o_1) - d_1 (c_0 - o_0) of numbers of single precision, whose products are exact.
#[inline(always)]
fn cross_in_two_terms<D: DoubleLanes>(d: [D; 2], c: [D; 2], o: [D; 2]) -> D {
    let (high, low) = two_sum(d[0] * c[1], -(d[0] * o[1]));
    let (other_high, other_low) = two_sum(d[1] * c[0], -(d[1] * o[0]));
    (high - other_high) + (low - other_low)
}

/// One ray and one sphere.
pub(super) fn line<const IN_TWO_TERMS: bool>(ray: &Ray, sphere: &Sphere) -> Line<f64> {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    Line::new::<IN_TWO_TERMS>(o, d, c, f64::from(sphere.radius))
}

/// A number minus its rounding to single precision (Veltkamp).
#[inline(always)]
pub(super) fn rest<D: DoubleLanes>(value: D) -> D {
    let scaled = value * value.like(SPLITTER);
    value - (scaled - (scaled - value))
}

/// The surfaces of spheres of positive radius that rays hit at `t`, in double precision. The tiers that share this
/// function share its code.
#[inline(always)]
pub(super) fn in_lanes<L: Lanes>(
    rays: &RayLanes<L>,
    t: L,
    center: [L; 3],
    radius: L,
) -> SurfaceLanes<L> {
    L::out_of_line(
        t.token(),
        #[inline(always)]
        || projected(rays, t, center, radius),
    )
}

#[inline(always)]
fn projected<L: Lanes>(rays: &RayLanes<L>, t: L, center: [L; 3], radius: L) -> SurfaceLanes<L> {
    let zeros = L::Array::filled(0.0);
    let mut surfaces = [[zeros; 3]; 3];
    for part in 0..L::PARTS {
        let line = Line::of_part::<L, false>(rays, center, radius, part);
        let is_near = line.answers_near(t.widen(part), rays.t_min.widen(part));
        let found = line.projected(line.point(is_near).0);
        for i in 0..3 {
            L::narrow(&mut surfaces[0][i], part, found[0][i]);
            L::narrow(&mut surfaces[1][i], part, found[1][i]);
            L::narrow(&mut surfaces[2][i], part, rest(found[1][i]));
        }
    }
    let zero = t.like(0.0);
    SurfaceLanes {
        normal: axes!(i => L::load(t.token(), &surfaces[0][i]) + zero),
        point: axes!(i => L::load(t.token(), &surfaces[1][i]) + zero),
        rest: axes!(i => L::load(t.token(), &surfaces[2][i]) + zero),
    }
}
