//! Shadow rays to a light that is a sphere of the scene.

use crate::accuracy::Accuracy;
use crate::geometry::ray::Ray;
use crate::geometry::sphere::Sphere;
use crate::linear::roots;

impl Ray {
    /// Returns the ray, ended just before it meets `sphere`: what it hits lies between. For a shadow ray to a point of a light that
    /// is a sphere of the scene, and would shadow itself. A ray that does not meet the sphere in its interval is as it was; of one
    /// that does so where it begins nothing is left, so it hits nothing.
    ///
    /// If `tier` then traces the ray, it does not hit `sphere`. Cost: a test of the sphere.
    ///
    /// ```
    /// use spherule_kernel::{Exact, Intersect, Ray, Side, SphereList, Vec3, surface};
    ///
    /// let scene = SphereList::from([[0.0, -1000.0, 0.0, 1000.0], [0.0, 5.0, 0.0, 1.0]]);
    /// let (ground, light) = (scene.spheres().get(0).unwrap(), scene.spheres().get(1).unwrap());
    /// let surface = surface(Exact, &Ray::new(3.0 * Vec3::Y, Vec3::NEG_Y), 3.0, &ground);
    /// let of_light = Vec3::new(0.0, 4.0, 0.0);
    /// let ray = surface.spawn_ray_to(Exact, &ground, Side::Outside, of_light).expect("an origin");
    /// assert!(scene.any_hit(Exact, &ray));
    /// assert!(!scene.any_hit(Exact, &ray.until(Exact, &light)));
    /// ```
    #[must_use]
    pub fn until(self, tier: impl Accuracy, sphere: &Sphere) -> Self {
        let both = roots(tier, &self, sphere).into_iter().flatten();
        let met = both.filter(|t| t.is_finite() && self.t_min <= *t && *t <= self.t_max);
        // The less: where squares of `Stable` underflow, its far root may come before the near one.
        met.reduce(f32::min).map_or(self, |t| Self { t_max: t.next_down(), ..self })
    }
}
