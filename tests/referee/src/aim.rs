//! Rays aimed at spheres: the geometry in double precision, the case in single.

use crate::case::Case;
use crate::random::{Random, cross, dot};
use spherule_kernel::{Ray, Sphere, Vec3};

/// The geometry of a case before it is rounded to single precision.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Where the ray starts.
    pub origin: [f64; 3],
    /// The length of the direction.
    pub length: f64,
    /// From the origin to the point of the line closest to the centre; negative if that point is
    /// behind the origin.
    pub distance: f64,
    /// The radius.
    pub radius: f64,
    /// From the centre to the line, in radii: a line with less than 1 hits.
    pub offset: f64,
}

impl Aim {
    /// At a sphere of this radius, in a scene of a few units: two of three rays hit.
    pub(crate) fn ordinary(random: &mut Random, radius: f64) -> Self {
        Self {
            origin: random.unit().map(|x| 10.0 * x),
            length: random.log_uniform(-2, 1),
            distance: radius * random.uniform(1.5, 20.0),
            radius,
            offset: random.uniform(0.0, 1.5),
        }
    }

    /// The case in a random orientation, `t` in `[0, +inf]`.
    #[must_use]
    pub fn case(&self, random: &mut Random) -> Case {
        let along = random.unit();
        let across = random.perpendicular(along);
        // Aims the rounded ray, not the ray before rounding.
        let origin = single(self.origin);
        let direction = single(along.map(|x| x * self.length));
        let along = normalized(double(direction)).unwrap_or(along);
        let center = core::array::from_fn(|i| {
            f64::from(origin[i]) + self.distance * along[i] + self.offset * self.radius * across[i]
        });
        let sphere = Sphere { center: single(center), radius: self.radius as f32 };
        Case { ray: Ray::new(origin, direction), sphere }
    }
}

/// The line's distance from the centre, in double precision.
#[must_use]
pub fn line_distance(case: &Case) -> f64 {
    let (o, d) = (double(case.ray.origin), double(case.ray.direction));
    let c = double(case.sphere.center);
    let x = cross(d, [c[0] - o[0], c[1] - o[1], c[2] - o[2]]);
    (dot(x, x) / dot(d, d)).sqrt()
}

/// Rounded to single precision.
#[must_use]
pub fn single(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}

/// Widened to double precision.
#[must_use]
pub fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// The length, in double precision.
pub(crate) fn length(v: Vec3) -> f64 {
    let v = double(v);
    dot(v, v).sqrt()
}

/// The vector scaled to length one; `None` if its length is zero or infinite.
fn normalized(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}
