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
pub(crate) mod side;
mod start;
mod steps;
mod until;

use crate::accuracy::{Accuracy, Tier};
use crate::geometry::ray::Ray;
use crate::geometry::sphere::Sphere;
use crate::geometry::surface::Surface;
use crate::numeric::axes::axes;
use glam::Vec3;
use side::{Side, side};
use start::{sees_start, start_of};
use steps::{MOST_STEPS, next, step_of};

impl Surface {
    /// Returns a ray from here along `direction`. It begins on `side` of `sphere`, the sphere that was hit, and does not meet it
    /// where it starts. Returns `None` if none of 64 origins along the normal will do: always inside a sphere with r = 0, seldom
    /// where a sphere is as small as the spacing of numbers, and where the origin would be past the largest number.
    ///
    /// [`side`](crate::side()) proves that the origin is on that side. If `tier` is `Exact`, r is at least 2^10 ulps of the origin's
    /// largest coordinate, and `direction` points to `side`, the origin is one or two of these ulps from the surface, and as near the point
    /// as double precision knows it, some 2^-50 of the ray's way. (Near the coordinates' zero, where an ulp is below 2^-45 r, it is as far
    /// from the surface as its far side needs. If the ray goes back by a cosine below 2^-20, it is up to 2^-40 r and an ulp higher, to pass over
    /// the sphere.) For the other tiers it is as far away as they need in order not to see the sphere there. The interval begins 2^-42 r from
    /// the origin, or at 2^-149 if that is more (2^-149 |d| is long only for very long directions), and has no end.
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
