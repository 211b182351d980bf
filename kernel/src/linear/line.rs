//! One line and a sphere: both roots, and the discriminant; and which of two roots comes first.

use crate::accuracy::{TierFormula, TierWork};
use crate::geometry::ray::Ray;
use crate::geometry::sphere::Sphere;
use crate::{Accuracy, Exact};
use core::cmp::Ordering;

/// Returns where the whole line enters and leaves the sphere, whatever the ray's interval: the smaller root first (by `Stable`, in its
/// domain).
///
/// Returns `None` if the line misses the sphere, or if either is invalid. A root that is too large for a number is an
/// infinity of its sign; by `Fast` and `Geometric`, whose squares may leave the range of numbers, it may be NaN, which is no hit. t counts
/// in multiples of the ray's direction.
///
/// ```
/// use spherule_kernel::{Exact, Ray, Sphere, Vec3, roots};
///
/// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
/// assert_eq!(roots(Exact, &Ray::new(Vec3::ZERO, Vec3::Z), &sphere), Some([4.0, 6.0]));
/// ```
#[must_use]
pub fn roots(tier: impl Accuracy, ray: &Ray, sphere: &Sphere) -> Option<[f32; 2]> {
    let line = valid_line(ray, sphere)?;
    tier.with_formula(LineRoots { line: &line, sphere })
}

/// Returns the discriminant of the whole line and a sphere, in double precision as [`Exact`] computes it, and the most
/// that it is off. Together they say by how much the line meets the sphere, or misses it.
///
/// In real numbers it is D = a r^2 - |d x p|^2, with d the direction, a = d.d, and p from the ray's origin to the centre.
/// D differs from the first number by no more than the second, for every valid ray and sphere; the proof stands in
/// `docs/numerics.md`. So where the first is larger than the second in magnitude, it has the sign of D: positive where the
/// line meets the sphere, negative where it misses. Else exact sums decide, and [`roots`] returns their answer.
///
/// Returns `None` if ray or sphere is invalid. Neither number is ever NaN or infinite.
///
/// ```
/// use spherule_kernel::{Ray, Sphere, Vec3, discriminant};
///
/// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
/// let (d, bound) = discriminant(&Ray::new(Vec3::ZERO, Vec3::Z), &sphere).expect("a valid ray and sphere");
/// assert_eq!(d, 1.0);
/// assert!(bound < 1e-15);
///
/// // A tangent: double precision cannot tell.
/// let (d, bound) = discriminant(&Ray::new(Vec3::X, Vec3::Z), &sphere).expect("a valid ray and sphere");
/// assert!(d.abs() <= bound);
/// ```
#[must_use]
pub fn discriminant(ray: &Ray, sphere: &Sphere) -> Option<(f64, f64)> {
    let line = valid_line(ray, sphere)?;
    Some(Exact::discriminant(&line, sphere))
}

/// The ray without its interval; `None` if it or the sphere is invalid.
fn valid_line(ray: &Ray, sphere: &Sphere) -> Option<Ray> {
    let line = Ray { t_min: f32::NEG_INFINITY, t_max: f32::INFINITY, ..*ray };
    (line.is_live() && sphere.is_valid()).then_some(line)
}

/// The arguments of [`roots`].
struct LineRoots<'a> {
    line: &'a Ray,
    sphere: &'a Sphere,
}

impl TierWork for LineRoots<'_> {
    type Output = Option<[f32; 2]>;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> Option<[f32; 2]> {
        F::line_roots(self.line, self.sphere)
    }
}

/// Returns `Less` if the first of two hits is closer, for callers who keep the closest themselves. Each hit is a root by `tier`, and its
/// sphere; if both roots are t, the near one is meant.
///
/// [`Exact`](crate::Exact) compares the roots as real numbers, which may differ where t are equal. `Equal` means that they
/// are the same number; then the lower index is the closer hit. The other tiers compare t. If t is no root of its sphere by
/// the tier, the result has no meaning. Cost: nothing if the two t differ; else some 50 ns, and some microseconds
/// where double precision cannot tell.
///
/// ```
/// use spherule_kernel::{Exact, Ray, Sphere, Vec3, compare_hits, roots};
///
/// // A million away, f32 tells nothing less than 1/16 apart.
/// let ray = Ray::new(Vec3::new(0.0, 0.0, -1e6), Vec3::Z);
/// let spheres = [1.0, 1.015625].map(|radius| Sphere { center: Vec3::ZERO, radius });
/// let [Some([t, _]), Some([u, _])] = spheres.map(|sphere| roots(Exact, &ray, &sphere)) else { panic!() };
/// assert_eq!(t, u);
/// assert!(compare_hits(Exact, &ray, [(t, &spheres[0]), (u, &spheres[1])]).is_gt());
/// ```
#[must_use]
pub fn compare_hits(tier: impl Accuracy, ray: &Ray, hits: [(f32, &Sphere); 2]) -> Ordering {
    let [(t, first), (other, second)] = hits;
    match t.partial_cmp(&other) {
        Some(Ordering::Equal) => tier.compare_at(ray, t, [first, second]),
        order => order.unwrap_or(Ordering::Equal),
    }
}
