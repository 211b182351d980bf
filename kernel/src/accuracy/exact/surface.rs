//! The surface at a hit, correctly rounded.
//!
//! In double precision with its bound; then exactly, a coordinate at a time.

use super::estimate::Estimate;
use super::order::Answered;
use crate::accuracy::RayLanes;
use crate::accuracy::surface::{Line, SurfaceLanes, line};
use crate::exact::{QuadraticTerms, Root, SurfaceCoordinate, Surveyed};
use crate::geometry::surface::Surface;
use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::{Ray, Sphere};
use glam::Vec3;

/// u, of double precision.
const U: f64 = f64::EPSILON / 2.0;

/// The surface of a sphere of positive radius where `ray` hits it at `t`.
pub(super) fn at(ray: &Ray, t: f32, sphere: &Sphere) -> Surface {
    let root = Answered::new(ray, t, sphere).root;
    let line = line(ray, sphere);
    let from_center = line.point(root == Root::Near);
    let known = line.estimate.error < line.estimate.discriminant;
    let of_point = if known { line.error() } else { f64::INFINITY };
    let per_radius = 1.0 / f64::from(sphere.radius);

    let terms = QuadraticTerms::new(
        ray.origin.to_array(),
        ray.direction.to_array(),
        sphere.center.to_array(),
        sphere.radius,
    );
    let rounded = |axis: usize, of: Surveyed| {
        let value = from_center[axis % 3];
        let (value, error, most) = match of {
            Surveyed::Point => (value, of_point, sphere.radius),
            Surveyed::Normal => (value * per_radius, normal_error(of_point, per_radius), 1.0),
        };
        let (low, high) = ((value - error) as f32, (value + error) as f32);
        if low == high {
            return low + 0.0;
        }
        let (low, high) = (low.max(-most), high.min(most));
        SurfaceCoordinate::new(&terms, sphere.radius, axis, root, of).rounded(low, high)
    };
    let all = |of: Surveyed| Vec3::from_array([0, 1, 2].map(|axis| rounded(axis, of)));
    Surface { normal: all(Surveyed::Normal), point: all(Surveyed::Point), from_center }
}

/// What a coordinate of the normal may be off, by that of the point and 1/r.
#[inline(always)]
fn normal_error<D: DoubleLanes>(of_point: D, per_radius: D) -> D {
    of_point * per_radius * per_radius.like(1.0 + 8.0 * U) + per_radius.like(4.0 * U)
}

/// The same in lanes, and those of the lanes `asked` in which double precision knows it.
#[inline(always)]
pub(super) fn in_lanes<L: Lanes>(
    rays: &RayLanes<L>,
    t: L,
    center: [L; 3],
    radius: L,
    asked: L::Mask,
) -> (SurfaceLanes<L>, L::Mask) {
    let (token, zeros) = (t.token(), L::Array::filled(0.0));
    // From below and from above.
    let [mut normal, mut point] = [[[zeros; 2]; 3]; 2];
    let mut known = 0_u32;
    for part in 0..L::PARTS {
        let line = Line::of_part(rays, center, radius, part);
        let (is_near, is_known) = root_of(&line, t.widen(part));
        known |= is_known.bits() << (part * L::Double::COUNT);

        let (value, error) = (line.point(is_near), line.error());
        let per_radius = error.like(1.0) / radius.widen(part);
        let of_normal = normal_error(error, per_radius);
        for i in 0..3 {
            L::narrow(&mut point[i][0], part, value[i] - error);
            L::narrow(&mut point[i][1], part, value[i] + error);
            let value = value[i] * per_radius;
            L::narrow(&mut normal[i][0], part, value - of_normal);
            L::narrow(&mut normal[i][1], part, value + of_normal);
        }
    }

    let mut known = asked & L::mask(token, known);
    let zero = t.like(0.0);
    for ends in [&normal, &point] {
        for [low, high] in ends {
            known = known & L::load(token, high).le(L::load(token, low));
        }
    }
    let surfaces = SurfaceLanes {
        normal: axes!(i => L::load(token, &normal[i][0]) + zero),
        point: axes!(i => L::load(token, &point[i][0]) + zero),
    };
    (surfaces, known)
}

/// Where `t` answers the near root, and where it is known which root it answers: by rule 4 the near one, if that is rounded
/// to t.
#[inline(always)]
fn root_of<D: DoubleLanes>(line: &Line<D>, t: D) -> (D::Mask, D::Mask) {
    let Estimate { discriminant, error, near: (near, of_near), far: (far, of_far), .. } =
        line.estimate;
    // What rounds to t lies within half an ulp: 2^-25 |t| at least; 2^-24 |t| at most, or 2^-150.
    let most = t.abs() * t.like(1.001 / 16_777_216.0) + t.like(f64::from(f32::from_bits(1)));
    let least = t.abs() * t.like(0.499 / 16_777_216.0);
    let (from_near, from_far) = ((t - near).abs(), (t - far).abs());
    let is_near = (from_near + of_near).lt(least) | (most + of_far).lt(from_far);
    (is_near, error.lt(discriminant) & (is_near | (most + of_near).lt(from_near)))
}
