//! Double precision with a proven bound, and expansions for what it cannot prove.
//!
//! # Method
//!
//! What passes the miss filter is computed in double-precision lanes, by the cross product:
//! D = a r^2 - |d x p|^2, t = (b -+ sqrt D) / a, each with a bound on its error. Where D is
//! larger than its bound, its sign is known; where t less and t plus its bound round to the same
//! `f32`, that is the correctly rounded t. The other lanes - exact tangents, ties, some rays that
//! start on the surface - go one by one through [`Quadratic`], which is always right. So is, then,
//! every lane: the bound decides what is spent, never what is answered.
//!
//! # The bound
//!
//! u = 2^-53, first order; every constant below is rounded up by at least an eighth, which covers
//! the second order, the rounding of the bound itself, and that it is computed from rounded
//! quantities. The inputs are `f32`, so products of two of them are exact, and nothing over- or
//! underflows (the table in `exact/quadratic.rs`). G = |d|_1 |p|_1, X = |d x p|_1,
//! L = |d x p|^2, A = a r^2.
//!
//! | quantity | error at most |
//! |---|---|
//! | p | u, relative |
//! | x_k = d_i p_j - d_j p_i; M_k = \|d_i p_j\| + \|d_j p_i\|, sum of M at most G | 1u (p) + 1u (product) + 1u (difference) = 3u M_k |
//! | L, from x | 2 * 3u X G + (3u)^2 G^2 |
//! | L, squares and sums | 3u L |
//! | A: two sums, one product | 3u A |
//! | D = A - L | u (A + L) |
//! | **D, together** | 4u (A + L) + 6u X G + 9u^2 G^2, of computed X: + 18u^2 G^2; **E = 5u (A + L) + 8u X G + 32u^2 G^2** |
//! | sqrt D, where D > E | E / sqrt D + u sqrt D |
//! | b = d.p | 4u G |
//! | n = b -+ sqrt D | 4u G + E / sqrt D + u sqrt D + u \|n\| |
//! | 1/a = sqrt D * i, i = 1 / (a sqrt D): one division serves E / (a sqrt D) too | 2u (a) + 1u + 1u + 1u, relative |
//! | t = n / a | the error of n over a, + 5u \|t\| + u \|t\| (product) |
//! | t -+ the bound, in `f64` | u \|t\| |
//! | **t, together** | **T = (5u G + 2u sqrt D) / a + E i + 11u \|t\|** |
//!
//! E enters T with its own slack of an eighth, which covers the 5u of E i.

use super::beyond::Beyond;
use super::{Accuracy, RayLanes, sealed};
use crate::exact::{Quadratic, Root};
use crate::{DoubleLanes, LaneMask, Lanes, Ray, Sphere};

/// Hits decided as in real arithmetic, t correctly rounded, for every `f32` input.
///
/// Whether the line meets the sphere is decided as in real arithmetic, a tangent being a hit; t is
/// the correctly rounded root, subnormals kept; the interval is tested on that t. So the answer
/// is the same on every target, in every lane width and whatever the order of traversal.
///
/// Asks for the default floating-point environment: round to nearest even, subnormals neither
/// flushed nor taken for zero; [`float_environment_is_sound`](crate::float_environment_is_sound)
/// tells. Exactness is per ray and sphere as given in `f32`: a hit *point* computed from t is
/// rounded, and lies inside the sphere half of the time.
///
/// Cost: as [`Fast`](super::Fast) for what the filter rules out; some 100 double-precision
/// operations a candidate; at most some 10,000, on the stack, for a lane that these cannot decide.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

/// u, of double precision.
const U: f64 = f64::EPSILON / 2.0;

impl sealed::Sealed for Exact {}

impl Accuracy for Exact {
    const NAME: &'static str = "exact";
    type Prepared<L: Lanes> = Beyond<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(rays: &RayLanes<L>) -> Beyond<L> {
        Beyond::new(rays)
    }

    #[inline(always)]
    fn first_root<L: Lanes>(
        rays: &RayLanes<L>,
        beyond: &Beyond<L>,
        center: [L; 3],
        radius: L,
        asked: L::Mask,
        limit: L,
    ) -> L {
        let token = radius.token();
        let infinity = L::splat(token, f32::INFINITY);
        let asked = asked & !beyond.limit(rays, center, radius, limit);
        if !asked.any() {
            return infinity;
        }
        let brackets = Brackets::new(rays, center, radius, asked);

        // A root is settled where its bracket is one number, and out where none of its bracket is
        // acceptable. What lies past the limit need not be known any better.
        let within =
            |t: L| rays.t_min.le(t) & t.le(rays.t_max) & t.abs().le(L::splat(token, f32::MAX));
        let settled = |low: L, high: L| high.le(low);
        let out = |low: L, high: L| high.lt(rays.t_min) | rays.t_max.lt(low) | limit.lt(low);
        let [near_low, near_high] = brackets.near.map(|t| L::load(token, &t));
        let [far_low, far_high] = brackets.far.map(|t| L::load(token, &t));

        let near_known = settled(near_low, near_high) | out(near_low, near_high);
        let near_hit = settled(near_low, near_high) & within(near_low);
        let far_known = settled(far_low, far_high) | out(far_low, far_high);
        let far_hit = settled(far_low, far_high) & within(far_low);
        let far = L::select(far_hit, far_low, infinity);
        let t = L::select(near_hit, near_low, far);

        // The far root does not matter where the near one is taken, or lies past the limit.
        let decided = near_known & (near_hit | far_known | limit.lt(near_low));
        let undecided = (asked & !decided).bits();
        // Adding zero turns -0 into +0.
        let t = t + L::splat(token, 0.0);
        let t = L::select(asked, t, infinity);
        if undecided == 0 { t } else { settle(rays, center, radius, undecided, t) }
    }

    fn line_roots(ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
        let quadratic = Quadratic::<f64>::new(
            ray.origin.to_array(),
            ray.direction.to_array(),
            sphere.center.to_array(),
            sphere.radius,
        )?;
        Some([quadratic.rounded(Root::Near), quadratic.rounded(Root::Far)])
    }
}

/// For every lane the least and the greatest `f32` that each root can round to: both `+inf` where
/// the line surely misses, `-inf` and `+inf` where it is not known to meet the sphere.
struct Brackets<L: Lanes> {
    near: [L::Array; 2],
    far: [L::Array; 2],
}

impl<L: Lanes> Brackets<L> {
    #[inline(always)]
    fn new(rays: &RayLanes<L>, center: [L; 3], radius: L, asked: L::Mask) -> Self {
        let mut brackets = Self { near: Default::default(), far: Default::default() };
        let asked = asked.bits();
        for part in 0..L::PARTS {
            let first = part * L::Double::COUNT;
            if (asked >> first) & ((1 << L::Double::COUNT) - 1) != 0 {
                let widen = |lanes: L| lanes.widen(part);
                brackets.fill(
                    part,
                    rays.origin.map(widen),
                    rays.direction.map(widen),
                    center.map(widen),
                    widen(radius),
                );
            }
        }
        brackets
    }

    #[inline(always)]
    fn fill(
        &mut self,
        part: usize,
        origin: [L::Double; 3],
        direction: [L::Double; 3],
        center: [L::Double; 3],
        radius: L::Double,
    ) {
        let splat = |value| L::Double::splat(radius.token(), value);
        let [dx, dy, dz] = direction;
        let [px, py, pz] = [0, 1, 2].map(|i| center[i] - origin[i]);

        // D and its bound.
        let [x, y, z] = [dy * pz - dz * py, dz * px - dx * pz, dx * py - dy * px];
        let a = dx * dx + dy * dy + dz * dz;
        let (reach, square) = (a * (radius * radius), x * x + y * y + z * z);
        let discriminant = reach - square;
        let g = (dx.abs() + dy.abs() + dz.abs()) * (px.abs() + py.abs() + pz.abs());
        let sum = x.abs() + y.abs() + z.abs();
        let error = splat(5.0 * U) * (reach + square)
            + splat(8.0 * U) * (sum * g)
            + splat(32.0 * U * U) * (g * g);
        let meets = error.lt(discriminant);
        let misses = discriminant.lt(-error);

        // The roots and their bounds.
        let root = discriminant.sqrt();
        let inverse = splat(1.0) / (a * root);
        let per_a = root * inverse;
        let b = dx * px + dy * py + dz * pz;
        let shared = per_a * (splat(5.0 * U) * g + splat(2.0 * U) * root) + error * inverse;
        let infinity = splat(f64::INFINITY);
        let low_otherwise = L::Double::select(misses, infinity, -infinity);
        for (bracket, n) in [(&mut self.near, b - root), (&mut self.far, b + root)] {
            let t = n * per_a;
            let bound = shared + splat(11.0 * U) * t.abs();
            let [low, high] = bracket;
            L::narrow(low, part, L::Double::select(meets, t - bound, low_otherwise));
            L::narrow(high, part, L::Double::select(meets, t + bound, infinity));
        }
    }
}

/// The t of rules 2 to 4 in the lanes whose bit is set in `undecided`, by expansions; `t` in the
/// others.
#[cold]
#[inline(never)]
fn settle<L: Lanes>(rays: &RayLanes<L>, center: [L; 3], radius: L, undecided: u32, t: L) -> L {
    let (origin, direction) = (rays.origin.map(L::store), rays.direction.map(L::store));
    let (center, radius) = (center.map(L::store), radius.store());
    let (t_min, t_max) = (rays.t_min.store(), rays.t_max.store());
    let mut settled = t.store();
    for (lane, t) in settled.as_mut().iter_mut().enumerate() {
        if undecided >> lane & 1 == 1 {
            let get = |array: &L::Array| array.as_ref().get(lane).copied().unwrap_or(f32::NAN);
            let get3 = |arrays: &[L::Array; 3]| arrays.each_ref().map(get);
            let accepted = |t: &f32| get(&t_min) <= *t && *t <= get(&t_max) && t.is_finite();
            *t =
                Quadratic::<f64>::new(get3(&origin), get3(&direction), get3(&center), get(&radius))
                    .and_then(|quadratic| {
                        Some(quadratic.rounded(Root::Near))
                            .filter(accepted)
                            .or_else(|| Some(quadratic.rounded(Root::Far)).filter(accepted))
                    })
                    .unwrap_or(f32::INFINITY);
        }
    }
    L::load(rays.t_min.token(), &settled)
}
