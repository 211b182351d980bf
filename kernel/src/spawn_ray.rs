//! Rays spawned on a sphere, without an epsilon.
//!
//! # Method
//!
//! A point of a surface, rounded to `f32`, lies on one side of it or the other, and a ray from there may meet the sphere that it
//! leaves. So the point is computed in double precision and rounded, and the sign of |x - c|^2 - r^2 tells exactly on which side
//! it lies. If that is the wrong side, the point is moved along the normal: by half a step, a step, two steps, where a step is an
//! ulp of its largest coordinate. A step is enough if r is more than some 14 steps: rounding moves a point by 0.87 steps at most,
//! and the sphere curves away by 1.87^2 / 2r.
//!
//! From outside, a ray that goes away from the centre meets the sphere nowhere: where |x - c|^2 > r^2 and
//! d.(x - c) >= 0, both roots are below zero. From inside one root is below zero, and one above. The interval begins a little
//! above zero, 2^-42 r from the origin. Rounding has moved the origin by more, so double precision can tell that the ray leaves
//! the sphere. (If the interval begins at the least number above zero, it cannot: a picture of marbles took three times as long.)
//! Tiers that know less are asked whether they see the sphere there, or, from inside, its far side no more. If so, the ray begins
//! a step farther away, then two, then four.
//!
//! Nor may the interval begin behind the far side, which along the surface is as near as the origin is deep, or nearly. The origin
//! is at least -(|x - c|^2 - r^2) / 2r from the surface. If that is more than t_min |d|, no root needs to be computed.

pub(crate) mod packets;
mod until;

use crate::accuracy::{Accuracy, Tier};
use crate::exact::QuadraticTerms;
use crate::geometry::ray::Ray;
use crate::geometry::sphere::Sphere;
use crate::geometry::surface::Surface;
use crate::lanes::Lanes;
use crate::linear::roots;
use crate::numeric::axes::{axes, dot};
use crate::numeric::power_of_point::power_of;
use core::cmp::Ordering;
use glam::Vec3;

/// A side of a sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Where |x - c| > r.
    Outside,
    /// Where |x - c| < r.
    Inside,
}

impl Side {
    /// Returns the other side: where a refracted ray goes.
    ///
    /// ```
    /// use spherule_kernel::Side;
    ///
    /// assert_eq!(Side::Inside.opposite(), Side::Outside);
    /// ```
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Outside => Self::Inside,
            Self::Inside => Self::Outside,
        }
    }
}

/// Where the interval begins: 2^-42 r from the origin, or a little more, but above zero.
#[inline(always)]
fn start_of<L: Lanes>(direction: [L; 3], radius: L) -> L {
    let start = radius * radius.like(NEAREST) / largest_of(direction);
    start.filter_max(radius.like(f32::from_bits(1)))
}

/// The largest coordinate.
#[inline(always)]
fn largest_of<L: Lanes>(vector: [L; 3]) -> L {
    vector[0].abs().filter_max(vector[1].abs()).filter_max(vector[2].abs())
}

/// 2^-42.
const NEAREST: f32 = 1.0 / (1_u64 << 42) as f32;
/// u, of double precision.
const U: f64 = f64::EPSILON / 2.0;

/// Returns the side of `sphere` on which `point` lies, exactly; `None` if it lies on the surface, or either is not valid.
///
/// Cost: some 20 double-precision operations; half a microsecond if they cannot tell.
///
/// ```
/// use spherule_kernel::{Side, Sphere, Vec3, side};
///
/// let sphere = Sphere::from([0.0, 0.0, 0.0, 1.0]);
/// let least = f32::from_bits(1);
/// assert_eq!(side(Vec3::new(1.0, 0.0, least), &sphere), Some(Side::Outside));
/// assert_eq!(side(Vec3::X, &sphere), None);
/// ```
#[must_use]
pub fn side(point: Vec3, sphere: &Sphere) -> Option<Side> {
    if !point.is_finite() || !sphere.is_valid() {
        return None;
    }
    let [x, c] = [point, sphere.center].map(|v| v.to_array().map(f64::from));
    let (power, margin) = power_of(x, c, f64::from(sphere.radius));
    let sign = if power.abs() > margin {
        power.total_cmp(&0.0)
    } else {
        terms(point, Vec3::ZERO, sphere).start()[0]
    };
    match sign {
        Ordering::Less => Some(Side::Inside),
        Ordering::Equal => None,
        Ordering::Greater => Some(Side::Outside),
    }
}

impl Surface {
    /// Returns the side of the sphere from which a ray along `direction` came here: inside if it goes out, by more than the
    /// normal's rounding may hide. A tangent came from outside, as any ray within 2^-21 radians of one may. (Of
    /// the other tiers' normals this holds near the sphere: of tangents from afar they are off by more.)
    ///
    /// ```
    /// use spherule_kernel::{Exact, Ray, Side, Sphere, Vec3, surface};
    ///
    /// let (inner, sphere) = (Ray::new(Vec3::ZERO, Vec3::Z), Sphere::from([0.0, 0.0, 0.0, 1.0]));
    /// let surface = surface(Exact, &inner, 1.0, &sphere);
    /// assert_eq!(surface.incident_side(inner.direction), Side::Inside);
    /// ```
    #[must_use]
    pub fn incident_side(&self, direction: Vec3) -> Side {
        let [n, d] = [self.outward(), direction].map(|v| v.to_array().map(f64::from));
        let length = d[0].abs() + d[1].abs() + d[2].abs();
        if dot(n, d) > GRAZING * length { Side::Inside } else { Side::Outside }
    }

    /// Returns a ray from here along `direction`. It begins on `side` of `sphere`, the sphere that was hit, and does not meet it
    /// where it starts. Returns `None` if none of 64 origins along the normal will do: always inside a sphere with r = 0, seldom
    /// where a sphere is as small as the spacing of numbers, and where the origin would be past the largest number.
    ///
    /// [`side`](crate::side()) proves that the origin is on that side. If `tier` is `Exact`, r is at least 2^10 ulps of the
    /// origin's largest coordinate, and `direction` points to `side`, the origin is one or two of these ulps from the point. (Near
    /// the coordinates' zero, where an ulp is below 2^-45 r, it is as near as double precision knows the point, and as its far side
    /// needs. If the ray goes back by a cosine below 2^-20, it is up to 2^-41 r higher, to pass over the sphere.) For the other
    /// tiers it is as far away as they need in order not to see the sphere there. The interval begins 2^-42 r from the origin, or at
    /// 2^-149 if that is more (2^-149 |d| is long only for very long directions), and has no end.
    ///
    /// If `direction` points to `side`, an outside ray never meets the sphere again, and an inside ray meets its far side,
    /// unless the t of that hit is rounded to zero or infinity, or squares of another tier overflow or underflow. Else the ray
    /// meets whatever is there.
    ///
    /// Cost: some 100 double-precision operations; the other tiers add a test of the sphere.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, Side, SphereList, Vec3, surface};
    ///
    /// let spheres = SphereList::from([[4.0e5, 3.0e5, 0.0, 1.0], [4.0e5, 3.0e5, 4.0, 1.0]]);
    /// let ray = Ray::new(Vec3::new(4.0e5, 3.0e5, -9.0), Vec3::new(0.01, 0.0, 1.0));
    /// let hit = spheres.closest_hit(Exact, &ray).expect("a hit");
    /// let sphere = spheres.spheres().get(hit.sphere as usize).expect("its sphere");
    /// let surface = surface(Exact, &ray, hit.t, &sphere);
    /// let shadow = surface.spawn_ray(Exact, &sphere, Side::Outside, Vec3::NEG_Z).expect("an origin");
    /// assert!(!spheres.any_hit(Exact, &shadow));
    /// ```
    #[must_use]
    pub fn spawn_ray(
        &self,
        tier: impl Accuracy,
        sphere: &Sphere,
        side: Side,
        direction: Vec3,
    ) -> Option<Ray> {
        self.spawn(tier.tier(), sphere, side, |origin| Ray::new(origin, direction))
    }

    /// Returns a ray as [`spawn_ray`](Surface::spawn_ray) does, but towards `target`. The target is at t = 1, where the interval
    /// ends. Returns `None`, too, if the target is finite, but the way to it leaves the range of numbers. If the target lies on a
    /// sphere of the scene, as that of a light that is one, end the ray before it: [`Ray::until`].
    ///
    /// ```
    /// use spherule_kernel::{Exact, Ray, Side, Sphere, Vec3, surface};
    ///
    /// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
    /// let surface = surface(Exact, &Ray::new(Vec3::ZERO, Vec3::Z), 4.0, &sphere);
    /// let ray = surface.spawn_ray_to(Exact, &sphere, Side::Outside, Vec3::Y).expect("an origin");
    /// assert_eq!((ray.at(1.0), ray.t_max), (Vec3::Y, 1.0));
    /// ```
    #[must_use]
    pub fn spawn_ray_to(
        &self,
        tier: impl Accuracy,
        sphere: &Sphere,
        side: Side,
        target: Vec3,
    ) -> Option<Ray> {
        let ray = |origin| Ray { t_max: 1.0, ..Ray::new(origin, target - origin) };
        let spawned = self.spawn(tier.tier(), sphere, side, ray);
        spawned.filter(|ray| ray.direction.is_finite() || !target.is_finite())
    }

    /// Returns the point in the units of the scene, every coordinate rounded once from double precision. It may lie on either
    /// side of `sphere`, the one that was hit, so start no rays there: call [`spawn_ray`](Surface::spawn_ray).
    ///
    /// ```
    /// use spherule_kernel::{Exact, Ray, Sphere, Vec3, surface};
    ///
    /// let sphere = Sphere::from([0.0, 0.0, 5.0, 1.0]);
    /// let surface = surface(Exact, &Ray::new(Vec3::ZERO, Vec3::Z), 4.0, &sphere);
    /// assert_eq!(surface.position(&sphere), Vec3::new(0.0, 0.0, 4.0));
    /// ```
    #[must_use]
    pub fn position(&self, sphere: &Sphere) -> Vec3 {
        Vec3::from_array(self.in_scene(sphere).map(|x| x as f32))
    }

    fn in_scene(&self, sphere: &Sphere) -> [f64; 3] {
        axes!(i => f64::from(sphere.center()[i]) + (f64::from(self.point[i]) + f64::from(self.rest[i])))
    }

    /// The normal, away from the centre: a caller may have turned it towards his ray.
    fn outward(&self) -> Vec3 {
        if along(self.normal.to_array(), self.point.to_array()) < 0.0 {
            -self.normal
        } else {
            self.normal
        }
    }

    fn spawn(
        &self,
        tier: Tier,
        sphere: &Sphere,
        to: Side,
        from: impl Fn(Vec3) -> Ray,
    ) -> Option<Ray> {
        let point = self.in_scene(sphere);
        let outward = self.outward().to_array().map(f64::from);
        let rounded = point.map(|x| x as f32);
        let step = step_of(rounded, sphere.radius);
        let step = f64::from(if to == Side::Outside { step } else { -step });

        let mut steps = 0.0;
        for _ in 0..MOST_STEPS {
            let origin =
                Vec3::from_array(axes!(i => (point[i] + steps * step * outward[i]) as f32));
            let ray = from(origin);
            let t_min = start_of(ray.direction.to_array(), sphere.radius);
            let ray = Ray { t_min, ..ray };
            if side(origin, sphere) == Some(to) && !sees_start(tier, &ray, sphere, to, outward) {
                return Some(ray);
            }
            steps = next(steps);
        }
        None
    }
}

/// n.p in single precision: its sign alone is asked, and all three products have it.
#[inline(always)]
fn along<L: Lanes>(normal: [L; 3], point: [L; 3]) -> L {
    normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2]
}

/// How many steps from the surface the next origin is tried: 0, 1/2, 1, 2, 4 ...
#[inline(always)]
fn next(steps: f64) -> f64 {
    if steps > 0.0 { 2.0 * steps } else { 0.5 }
}

/// 2^-22: the coordinates of a normal are off by 2^-25 at least, and by 2^-24 by most tiers.
const GRAZING: f64 = 2.0 * f32::EPSILON as f64;

/// 2^-20: a ray goes back if the cosine of direction and normal is below minus this.
const BACK: f64 = 8.0 * f32::EPSILON as f64;
/// A step: an ulp of the largest coordinate; more near zero, where a point is not known so well.
#[inline(always)]
fn step_of<L: Lanes>(point: [L; 3], radius: L) -> L {
    let largest = largest_of(point);
    // Between half an ulp and one, so that the sum is rounded to the next number; of the half, since the largest number has no next.
    let half = largest * largest.like(0.5);
    let ulp = (half + half * half.like(MORE_THAN_HALF)) - half;
    let ulp = (ulp + ulp).filter_max(largest.like(f32::from_bits(1)));
    ulp.filter_max(radius * radius.like(LEAST_STEP))
}

/// 2^-24, and a little more.
const MORE_THAN_HALF: f32 = f32::EPSILON * 0.500_5;
/// 2^-47 of the radius.
const LEAST_STEP: f32 = 1.0 / (1_u64 << 47) as f32;
/// Half a step, doubled 62 times: past the size of any sphere.
const MOST_STEPS: u32 = 64;

/// Whether `tier` sees `sphere` where a ray starts that begins on its side `to`.
fn sees_start(tier: Tier, ray: &Ray, sphere: &Sphere, to: Side, outward: [f64; 3]) -> bool {
    let d = ray.direction.to_array().map(f64::from);
    let is_seen = |t: f32| ray.t_min <= t && t < f32::INFINITY;
    match to {
        // A ray that goes back meets the sphere, as it should. (If it goes back by less, it passes over the sphere from a step
        // above.)
        Side::Outside if dot(d, outward) < -BACK * libm::sqrt(dot(d, d)) => false,
        Side::Outside => {
            (tier != Tier::Exact || !goes_away(ray, sphere))
                && roots(tier, ray, sphere).is_some_and(|both| both.into_iter().any(is_seen))
        }
        Side::Inside if tier == Tier::Exact && is_deep(ray, sphere) => false,
        // Where a tier's squares leave the range of numbers, it sees nothing from anywhere.
        Side::Inside => match roots(tier, ray, sphere) {
            Some([near, far]) => {
                is_seen(near) || (far < ray.t_min && !is_rounded_to_zero(far, ray, sphere))
            }
            None => {
                ray.direction.length_squared().is_normal()
                    && (sphere.radius * sphere.radius).is_normal()
            }
        },
    }
}

/// Whether a far root is zero because it is rounded: that of another tier may be zero by cancellation.
fn is_rounded_to_zero(far: f32, ray: &Ray, sphere: &Sphere) -> bool {
    far == 0.0 && roots(Tier::Exact, ray, sphere).is_none_or(|[_, far]| far == 0.0)
}

/// Whether the far side is surely not before t_min: the origin is deeper than t_min |d| <= t_min √3 max |d_i|.
fn is_deep(ray: &Ray, sphere: &Sphere) -> bool {
    let r = f64::from(sphere.radius);
    let [x, c] = [ray.origin, sphere.center].map(|v| v.to_array().map(f64::from));
    let (power, margin) = power_of(x, c, r);
    let start = f64::from(ray.t_min) * f64::from(largest_of(ray.direction.to_array()));
    power < -(margin + DEEP * r * start)
}

/// 2√3, and a little more for what is rounded.
const DEEP: f64 = 3.5;

/// Whether a ray goes away from the centre of `sphere` where it starts, or around it: d.(o - c) >= 0.
fn goes_away(ray: &Ray, sphere: &Sphere) -> bool {
    let d = ray.direction.to_array().map(f64::from);
    let q = from_center(ray.origin, sphere);
    let (slope, size) = (dot(d, q), dot(d.map(f64::abs), q.map(f64::abs)));
    // A coordinate of q is off by u, a product and two sums by 3u.
    if slope.abs() > 8.0 * U * size {
        slope > 0.0
    } else {
        terms(ray.origin, ray.direction, sphere).start()[1] != Ordering::Less
    }
}

/// A point as seen from the centre, every coordinate rounded once.
fn from_center(point: Vec3, sphere: &Sphere) -> [f64; 3] {
    axes!(i => f64::from(point[i]) - f64::from(sphere.center()[i]))
}

fn terms(origin: Vec3, direction: Vec3, sphere: &Sphere) -> QuadraticTerms {
    let [o, d, c] = [origin, direction, sphere.center].map(|v| v.to_array());
    QuadraticTerms::new(o, d, c, sphere.radius)
}
