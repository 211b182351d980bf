//! The surface at a hit, from the sphere's centre and never through t, which from afar is rounded to more than the sphere's size.
//!
//! # Method
//!
//! With p = c - o, a = d.d and D = a r^2 - |d x p|^2, the roots are t = (b -+ sqrt D) / a, and the point as seen from the
//! centre is
//!
//! ```text
//! t d - p = (d x (d x p) -+ d sqrt D) / a.
//! ```
//!
//! In double precision d x p loses some 2^-51 |d| |p|: a normal is off by some 2^-50 |p| / r, 2^-27 from 10^7 radii away.
//! By `Exact` that has a bound (`docs/numerics.md`).

use super::exact::estimate::{Constants, Estimate};
use super::roots::RayLanes;
use crate::geometry::surface::Surface;
use crate::lanes::{DoubleLanes, LaneArray, Lanes};
use crate::numeric::axes::{axes, dot};
use crate::{Ray, Sphere};
use glam::Vec3;

/// [`Surface`]s in registers.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceLanes<L> {
    pub(crate) normal: [L; 3],
    pub(crate) point: [L; 3],
}

/// 16 ulp of t, at least.
const NEAR: f64 = 16.0 / 8_388_608.0;

/// A line and a sphere in double precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<D> {
    direction: [D; 3],
    radius: D,
    pub(super) estimate: Estimate<D>,
}

impl<D: DoubleLanes> Line<D> {
    #[inline(always)]
    pub(super) fn new(origin: [D; 3], direction: [D; 3], center: [D; 3], radius: D) -> Self {
        let estimate = Estimate::new(origin, direction, center, radius, &Constants::PROVEN);
        Self { direction, radius, estimate }
    }

    /// Part `part` of the lanes.
    #[inline(always)]
    pub(super) fn of_part<L: Lanes<Double = D>>(
        rays: &RayLanes<L>,
        center: [L; 3],
        radius: L,
        part: usize,
    ) -> Self {
        Self::new(
            axes!(i => rays.origin[i].widen(part)),
            axes!(i => rays.direction[i].widen(part)),
            axes!(i => center[i].widen(part)),
            radius.widen(part),
        )
    }

    /// The point of the near root in the lanes `is_near`, else of the far one, as seen from the centre; where the line
    /// misses, the point of it that is closest to the centre.
    #[inline(always)]
    pub(super) fn point(&self, is_near: D::Mask) -> [D; 3] {
        let (d, x) = (self.direction, self.estimate.cross);
        let Estimate { a, root, .. } = self.estimate;
        let zero = a.like(0.0);
        let root = D::select(zero.le(root), root, zero);
        let root = D::select(is_near, -root, root);
        let per_a = a.like(1.0) / a;
        let across =
            [d[1] * x[2] - d[2] * x[1], d[2] * x[0] - d[0] * x[2], d[0] * x[1] - d[1] * x[0]];
        axes!(i => (across[i] + d[i] * root) * per_a)
    }

    /// What every coordinate of that point may be off, where D is above its bound: `docs/numerics.md`.
    #[inline(always)]
    pub(super) fn error(&self) -> D {
        let Estimate { error, a, sizes: [length, g], root, .. } = self.estimate;
        let u = |count: f64| a.like(count * f64::EPSILON / 2.0);
        length * (u(8.0) * g + a.like(1.25) * error / root + u(4.0) * root) / a
            + u(16.0) * self.radius
    }

    /// Where `t` is near the near root, as near as a tier gets, or nearer to it than to the far one.
    #[inline(always)]
    fn answers_near(&self, t: D) -> D::Mask {
        let from_near = (t - self.estimate.near.0).abs();
        from_near.le((t - self.estimate.far.0).abs()) | from_near.le(t.abs() * t.like(NEAR))
    }

    /// The unit normal, and the point at the radius over it: `point` may be off the sphere, where a tier saw
    /// what the line misses.
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

/// One ray and one sphere.
pub(super) fn line(ray: &Ray, sphere: &Sphere) -> Line<f64> {
    let [o, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(f64::from));
    Line::new(o, d, c, f64::from(sphere.radius))
}

/// Where `ray` hits a sphere of positive radius at `t`, in double precision.
pub(super) fn at(ray: &Ray, t: f32, sphere: &Sphere) -> Surface {
    let line = line(ray, sphere);
    let [normal, point] = line.projected(line.point(line.answers_near(f64::from(t))));
    let single = |v: [f64; 3]| Vec3::from_array(v.map(|x| x as f32 + 0.0));
    Surface { normal: single(normal), point: single(point), from_center: point }
}

/// The same in lanes.
#[inline(always)]
pub(super) fn in_lanes<L: Lanes>(
    rays: &RayLanes<L>,
    t: L,
    center: [L; 3],
    radius: L,
) -> SurfaceLanes<L> {
    let zeros = L::Array::filled(0.0);
    let mut surfaces = [[zeros; 3]; 2];
    for part in 0..L::PARTS {
        let line = Line::of_part(rays, center, radius, part);
        let found = line.projected(line.point(line.answers_near(t.widen(part))));
        for i in 0..3 {
            L::narrow(&mut surfaces[0][i], part, found[0][i]);
            L::narrow(&mut surfaces[1][i], part, found[1][i]);
        }
    }
    let zero = t.like(0.0);
    SurfaceLanes {
        normal: axes!(i => L::load(t.token(), &surfaces[0][i]) + zero),
        point: axes!(i => L::load(t.token(), &surfaces[1][i]) + zero),
    }
}
