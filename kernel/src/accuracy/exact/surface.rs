//! The surface at a hit, correctly rounded.
//!
//! Double precision with its bound computes it as seen from the centre and, where that does not decide, as seen from
//! the start of the ray. Exact sums decide the rest, a coordinate at a time.

use super::order::Answered;
use super::{from_start, one_ray};
use crate::accuracy::RayLanes;
use crate::accuracy::surface::{Line, SurfaceLanes, line, rest};
use crate::exact::{Quadratic, Root, SurfaceCoordinate, Surveyed};
use crate::geometry::surface::Surface;
use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::DOUBLE_U as U;
use crate::{Ray, Sphere};
use glam::Vec3;

/// Returns the surface of a sphere of positive radius where `ray` hits it at `t`. Exact sums decide what double precision
/// does not.
pub(super) fn at(ray: &Ray, t: f32, sphere: &Sphere) -> Surface {
    let line = line::<true>(ray, sphere);
    let terms = one_ray::terms(ray, sphere);
    let mut root = Answered::new(ray, t, sphere).root;
    if root == Root::Far && f64::from(t) * line.a < line.slope {
        // A far root rounds to a t before the middle if the roots are that close. Else t answers neither.
        let far = Quadratic::new(&terms).map(|quadratic| quadratic.rounded(Root::Far));
        root = if far == Some(t) { Root::Far } else { Root::Near };
    }
    let (value, error, per_radius) = line.point(root == Root::Near);
    let of_point = if line.error < line.discriminant { error } else { f64::INFINITY };
    let seen = from_start::point(ray, sphere, &line, root == Root::Near);
    // Takes the value with the smaller bound.
    let estimated = |axis: usize| match seen {
        Some((value, error)) if error[axis % 3] < of_point => (value[axis % 3], error[axis % 3]),
        _ => (value[axis % 3], of_point),
    };

    let rounded = |axis: usize, of: Surveyed| {
        let (value, of_point) = estimated(axis);
        let (value, error, most) = match of {
            Surveyed::Point => (value, of_point, sphere.radius),
            Surveyed::Normal => {
                let value = value * per_radius;
                (value, of_point * per_radius * (1.0 + 8.0 * U) + 8.0 * U * value.abs(), 1.0)
            }
        };
        let (low, high) = ((value - error) as f32, (value + error) as f32);
        if low == high {
            return low + 0.0;
        }
        let (low, high) = (low.max(-most), high.min(most));
        SurfaceCoordinate { terms: &terms, axis, root, of }.rounded(low, high)
    };
    let all = |of: Surveyed| Vec3::from_array([0, 1, 2].map(|axis| rounded(axis, of)));
    let point = all(Surveyed::Point);
    let rest = axes!(i => (estimated(i).0 - f64::from(point[i])) as f32);
    Surface { normal: all(Surveyed::Normal), point, rest: Vec3::from_array(rest) }
}

/// The error of a coordinate of the normal, from the error of the point's coordinate and 1/r.
#[inline(always)]
fn normal_error<D: DoubleLanes>(of_point: D, per_radius: D) -> D {
    of_point * per_radius * per_radius.like(1.0 + 8.0 * U) + per_radius.like(8.0 * U)
}

/// The surface in lanes, and the lanes of `active` in which double precision decides it.
#[inline(always)]
pub(super) fn in_lanes<L: Lanes>(
    rays: &RayLanes<L>,
    t: L,
    center: [L; 3],
    radius: L,
    active: L::Mask,
) -> (SurfaceLanes<L>, L::Mask) {
    let (first, known) = estimated::<L, false>(rays, t, center, radius, active);
    let open = active & !known;
    if !open.any() {
        return (first, known);
    }
    let (rays, token) = (*rays, t.token());
    L::out_of_line(
        token,
        #[inline(always)]
        move || {
            let (second, of_open) = estimated::<L, true>(&rays, t, center, radius, open);
            let surfaces = SurfaceLanes {
                normal: axes!(i => L::select(known, first.normal[i], second.normal[i])),
                point: axes!(i => L::select(known, first.point[i], second.point[i])),
                rest: axes!(i => L::select(known, first.rest[i], second.rest[i])),
            };
            (surfaces, known | of_open)
        },
    )
}

#[inline(always)]
fn estimated<L: Lanes, const IN_TWO_TERMS: bool>(
    rays: &RayLanes<L>,
    t: L,
    center: [L; 3],
    radius: L,
    active: L::Mask,
) -> (SurfaceLanes<L>, L::Mask) {
    let (token, zeros) = (t.token(), L::Array::filled(0.0));
    // From below and from above.
    let [mut normal, mut point] = [[[zeros; 2]; 3]; 2];
    let mut rests = [zeros; 3];
    let mut known = 0_u32;
    let lanes = active.bits();
    for part in 0..L::PARTS {
        let first = part * L::Double::COUNT;
        if (lanes >> first) & ((1 << L::Double::COUNT) - 1) == 0 {
            continue;
        }
        let line = Line::of_part::<L, IN_TWO_TERMS>(rays, center, radius, part);
        let (is_near, is_known) = root_of(&line, t.widen(part));
        known |= is_known.bits() << first;

        let (value, error, per_radius) = line.point(is_near);
        let of_normal = normal_error(error, per_radius);
        for i in 0..3 {
            L::narrow(&mut point[i][0], part, value[i] - error);
            L::narrow(&mut point[i][1], part, value[i] + error);
            L::narrow(&mut rests[i], part, rest(value[i]));
            let value = value[i] * per_radius;
            L::narrow(&mut normal[i][0], part, value - of_normal);
            L::narrow(&mut normal[i][1], part, value + of_normal);
        }
    }

    let mut known = active & L::mask(token, known);
    let zero = t.like(0.0);
    for i in 0..3 {
        let [low, high] = &normal[i];
        known = known & L::load(token, high).le(L::load(token, low));
        let [low, high] = &point[i];
        known = known & L::load(token, high).le(L::load(token, low));
    }
    let surfaces = SurfaceLanes {
        normal: axes!(i => L::load(token, &normal[i][0]) + zero),
        point: axes!(i => L::load(token, &point[i][0]) + zero),
        rest: axes!(i => L::load(token, &rests[i]) + zero),
    };
    (surfaces, known)
}

/// Returns the lanes in which `t` answers the near root, and those in which it is known which root `t` answers. The near
/// root lies before b / a, where the line is closest to the centre, and the far one after it. A root that rounds to t is
/// within 2^-24 |t| of it, or 2^-149.
#[inline(always)]
fn root_of<D: DoubleLanes>(line: &Line<D>, t: D) -> (D::Mask, D::Mask) {
    let at_t = t * line.a;
    let off = line.slope - at_t;
    // b is 5u G off; the margin allows for the least number of single precision too.
    let margin = t.like(f64::from(f32::EPSILON)) * at_t.abs()
        + t.like(8.0 * U) * line.size
        + t.like(f64::from(f32::from_bits(1))) * line.a;
    let is_near = margin.lt(off);
    (is_near, line.error.lt(line.discriminant) & (is_near | margin.lt(-off)))
}
