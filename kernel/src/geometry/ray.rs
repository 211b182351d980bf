//! A ray.

use glam::Vec3;

/// The half-line (or, by its interval, any part of the line) `origin + t * direction`.
///
/// `direction` need not have unit length; `t` is counted in multiples of it. Only `t` in the closed
/// interval `[t_min, t_max]` counts. An empty interval (`t_min > t_max`, or NaN at either end)
/// accepts nothing, and switches off a lane of a packet. A ray with NaN or infinity in `origin` or
/// `direction`, or with `direction` zero, hits nothing.
// In this order, so that a ray's numbers are loaded as one row.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Ray {
    /// Where `t` is zero, in the units of the scene.
    pub origin: Vec3,
    /// Towards greater `t`; any length except zero.
    pub direction: Vec3,
    /// The least accepted `t`; may be negative or `-inf`.
    pub t_min: f32,
    /// The greatest accepted `t`; may be `+inf`.
    pub t_max: f32,
}

impl Ray {
    /// A ray that hits nothing.
    pub const INACTIVE: Self = Self {
        origin: Vec3::ZERO,
        direction: Vec3::ZERO,
        t_min: f32::INFINITY,
        t_max: f32::NEG_INFINITY,
    };

    /// The half-line from `origin`: `t` in `[0, +inf]`.
    ///
    /// ```
    /// use spherule_kernel::{Ray, Vec3};
    ///
    /// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    /// assert_eq!((ray.t_min, ray.t_max), (0.0, f32::INFINITY));
    /// ```
    #[must_use]
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f32::INFINITY }
    }

    /// Whether rule 1 lets the ray hit anything, and `t_min <= t_max`. (An interval without a finite number, which no hit has, counts as
    /// live.)
    ///
    /// ```
    /// use spherule_kernel::{Ray, Vec3};
    ///
    /// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    /// assert!(ray.is_live() && !Ray { t_max: -1.0, ..ray }.is_live());
    /// assert!(!Ray::new(Vec3::ZERO, Vec3::ZERO).is_live());
    /// assert!(Ray { t_min: f32::INFINITY, ..ray }.is_live());
    /// ```
    #[must_use]
    pub fn is_live(&self) -> bool {
        self.origin.is_finite()
            && self.direction.is_finite()
            && self.direction != Vec3::ZERO
            && self.t_min <= self.t_max
    }

    /// The ray's numbers, in the order in which they lie in memory.
    #[inline(always)]
    pub(super) fn row(&self) -> [f32; 8] {
        let Self { origin: o, direction: d, t_min, t_max } = *self;
        [o.x, o.y, o.z, d.x, d.y, d.z, t_min, t_max]
    }

    /// The point at `t`, each coordinate with two roundings.
    ///
    /// ```
    /// use spherule_kernel::{Ray, Vec3};
    ///
    /// assert_eq!(Ray::new(Vec3::X, Vec3::Z).at(2.0), Vec3::new(1.0, 0.0, 2.0));
    /// ```
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + t * self.direction
    }
}

/// Origin and direction, as [`Ray::new`] takes them.
///
/// ```
/// use spherule_kernel::{Ray, Vec3};
///
/// let ray = Ray::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
/// assert_eq!(ray, Ray::new(Vec3::X, Vec3::Y));
/// ```
impl From<[[f32; 3]; 2]> for Ray {
    #[inline]
    fn from([origin, direction]: [[f32; 3]; 2]) -> Self {
        Self::new(Vec3::from_array(origin), Vec3::from_array(direction))
    }
}
