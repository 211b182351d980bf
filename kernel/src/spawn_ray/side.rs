//! On which side of a sphere a point lies, and from which a ray came.

use crate::exact::QuadraticTerms;
use crate::geometry::sphere::Sphere;
use crate::geometry::surface::Surface;
use crate::numeric::axes::dot;
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

pub(super) fn terms(origin: Vec3, direction: Vec3, sphere: &Sphere) -> QuadraticTerms {
    let [o, d, c] = [origin, direction, sphere.center].map(|v| v.to_array());
    QuadraticTerms::new(o, d, c, sphere.radius)
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

    /// The normal, away from the centre: a caller may have turned it towards the ray.
    pub(super) fn outward(&self) -> Vec3 {
        // Only the sign is asked, and all three products have it.
        if dot(self.normal.to_array(), self.point.to_array()) < 0.0 {
            -self.normal
        } else {
            self.normal
        }
    }
}

/// 2^-22: the coordinates of a normal are off by 2^-25 at most by `Exact`, by 2^-24 by other tiers, except of tangents from afar.
pub(super) const GRAZING: f64 = 2.0 * f32::EPSILON as f64;
