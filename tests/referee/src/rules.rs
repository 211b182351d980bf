//! What an intersector promises, where its promises differ from the contract of Spherule.
//!
//! Every rule defaults to the contract's. Cases about which an intersector promises nothing are not judged under its rules; under the
//! contract all cases are judged.

use crate::aim::double;
use crate::random::dot;
use spherule_kernel::{Ray, Sphere};
use std::fmt;

/// Which ends of `[t_min, t_max]` count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Interval {
    /// Both.
    #[default]
    Closed,
    /// Neither.
    Open,
    /// The last alone: `t_min < t <= t_max`.
    OpenStart,
    /// The first alone: `t_min <= t < t_max`.
    OpenEnd,
}

/// What a line counts as that touches a sphere in one point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Tangents {
    /// A hit.
    #[default]
    Hit,
    /// A miss.
    Miss,
    /// Either answer is right: not judged.
    Either,
}

/// What a ray meets that starts inside a sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Inside {
    /// The far side: a sphere is a surface.
    #[default]
    Surface,
    /// Nothing of that sphere.
    Miss,
    /// The sphere at t = 0, since it is a ball. A ray that starts on its surface meets it at t = 0 too.
    Solid,
}

/// Which of two spheres is the closest, if neither is in front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Ties {
    /// If the roots are the same real number, the sphere with the lowest index.
    #[default]
    First,
    /// Any sphere whose root is the same real number.
    Equal,
    /// Any sphere whose t is rounded to the same `f32`.
    Rounded,
}

/// Whether the intersector promises anything for a kind of input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Promise {
    /// The intersector promises what the contract promises.
    #[default]
    Judged,
    /// The intersector promises nothing.
    None,
}

/// The lengths of directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Directions {
    /// Any length.
    #[default]
    Any,
    /// Length one, within 2^-20: a trial brings its cases to it.
    Unit,
}

/// The precision of t.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Precision {
    /// The interval applies to t rounded to single precision.
    #[default]
    F32,
    /// The interval applies to t in double precision. The judge checks what single precision can tell: where a root is rounded to an end of
    /// the interval, or overflows, either answer is right, and the error of t is that of t when rounded.
    F64,
}

/// Where intervals begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Starts {
    /// Anywhere.
    #[default]
    Any,
    /// At the origin or after it: `t_min >= 0`.
    NotBehind,
    /// At the origin: `t_min = 0`.
    Zero,
}

/// What an intersector promises. The default is the contract.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields, rename_all = "kebab-case")
)]
pub struct Rules {
    /// Which ends of the interval count.
    pub interval: Interval,
    /// What tangents count as.
    pub tangents: Tangents,
    /// What a ray that starts inside meets.
    pub inside: Inside,
    /// Which of several spheres is the closest.
    pub ties: Ties,
    /// Lengths of directions.
    pub directions: Directions,
    /// Where intervals begin.
    pub starts: Starts,
    /// Whether anything is promised for NaN, infinity (except as an end of the interval), directions of zero, negative radii and empty
    /// intervals.
    pub invalid: Promise,
    /// The precision of t.
    pub precision: Precision,
    /// The smallest magnitude, except zero, of a radius and of a coordinate of origin, direction and centre.
    pub smallest: f32,
    /// The largest such magnitude.
    pub largest: f32,
    /// By how many ulp t may be off.
    pub ulp: u64,
}

impl Default for Rules {
    fn default() -> Self {
        Self::CONTRACT
    }
}

/// Why rules contradict each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contradiction(&'static str);

impl fmt::Display for Contradiction {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.0)
    }
}

impl std::error::Error for Contradiction {}

impl Rules {
    /// The contract of Spherule, t correctly rounded.
    pub const CONTRACT: Self = Self {
        interval: Interval::Closed,
        tangents: Tangents::Hit,
        inside: Inside::Surface,
        ties: Ties::First,
        directions: Directions::Any,
        starts: Starts::Any,
        invalid: Promise::Judged,
        precision: Precision::F32,
        smallest: 0.0,
        largest: f32::MAX,
        ulp: 0,
    };

    /// Returns these rules if no two of them contradict each other.
    ///
    /// # Errors
    /// Returns the first two that do.
    pub fn consistent(self) -> Result<Self, Contradiction> {
        let open_start = matches!(self.interval, Interval::Open | Interval::OpenStart);
        let contradiction = if self.smallest.is_nan() || self.largest.is_nan() {
            "smallest and largest: a size is NaN"
        } else if self.smallest < 0.0 || self.smallest > self.largest {
            "smallest and largest: no size is between them"
        } else if self.inside == Inside::Solid && open_start {
            "inside = \"solid\" answers t = 0, where the interval begins, and interval leaves its beginning out"
        } else if self.inside == Inside::Solid && self.starts == Starts::Any {
            "inside = \"solid\" answers t = 0, and starts = \"any\" what lies before it"
        } else {
            return Ok(self);
        };
        Err(Contradiction(contradiction))
    }

    /// Whether these rules say of every case what the contract says, except at the ends of the interval.
    pub(crate) fn follow_from_roots(&self) -> bool {
        self.tangents == Tangents::Hit
            && self.inside == Inside::Surface
            && self.precision == Precision::F32
    }

    /// The ray whose closed interval means what these rules mean.
    pub(crate) fn closed(&self, ray: &Ray) -> Ray {
        let mut ray = *ray;
        if matches!(self.interval, Interval::Open | Interval::OpenStart) {
            ray.t_min = ray.t_min.next_up();
        }
        if matches!(self.interval, Interval::Open | Interval::OpenEnd) {
            ray.t_max = ray.t_max.next_down();
        }
        ray
    }

    /// Whether these rules promise anything of this ray, whatever the spheres.
    #[must_use]
    pub fn cover_ray(&self, ray: &Ray) -> bool {
        let Ray { origin, direction, t_min, .. } = *ray;
        let is_unit = || {
            let direction = double(direction);
            (dot(direction, direction) - 1.0).abs() <= 2.0 / f64::from(1 << 20)
        };
        (self.invalid == Promise::Judged || ray.is_live())
            && match self.starts {
                Starts::Any => true,
                Starts::NotBehind => t_min >= 0.0 || t_min.is_nan(),
                Starts::Zero => t_min == 0.0,
            }
            && (self.directions == Directions::Any || is_unit())
            && self.have_sizes(&origin.to_array())
            && self.have_sizes(&direction.to_array())
    }

    /// Whether these rules promise anything of this sphere, whatever the ray.
    #[must_use]
    pub fn cover_sphere(&self, sphere: &Sphere) -> bool {
        (self.invalid == Promise::Judged || sphere.is_valid())
            && self.have_sizes(&sphere.center.to_array())
            && self.have_sizes(&[sphere.radius])
    }

    /// NaN and infinities pass here, since another rule judges them.
    fn have_sizes(&self, numbers: &[f32]) -> bool {
        numbers.iter().all(|x| {
            let size = x.abs();
            !size.is_finite() || size == 0.0 || (self.smallest <= size && size <= self.largest)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spherule_kernel::Vec3;

    const RAY: Ray = Ray::new(Vec3::ZERO, Vec3::Z);
    const CONTRACT: Rules = Rules::CONTRACT;

    #[test]
    fn contradictions_are_refused() {
        assert_eq!(CONTRACT.consistent(), Ok(CONTRACT));
        let solid = Rules { inside: Inside::Solid, starts: Starts::Zero, ..CONTRACT };
        assert_eq!(solid.consistent(), Ok(solid));
        for rules in [
            Rules { interval: Interval::Open, ..solid },
            Rules { starts: Starts::Any, ..solid },
            Rules { smallest: 2.0, largest: 1.0, ..CONTRACT },
            Rules { smallest: f32::NAN, ..CONTRACT },
        ] {
            assert!(rules.consistent().is_err(), "{rules:?}");
        }
    }

    #[test]
    fn what_is_not_promised_is_not_covered() {
        let unit = Rules { directions: Directions::Unit, ..CONTRACT };
        let not_behind = Rules { starts: Starts::NotBehind, ..CONTRACT };
        let valid = Rules { invalid: Promise::None, ..CONTRACT };
        for (rules, ray) in [
            (not_behind, Ray { t_min: -1.0, ..RAY }),
            (Rules { starts: Starts::Zero, ..CONTRACT }, Ray { t_min: 1.0, ..RAY }),
            (unit, Ray { direction: Vec3::ONE, ..RAY }),
            (valid, Ray { t_max: f32::NAN, ..RAY }),
            (valid, Ray { direction: Vec3::ZERO, ..RAY }),
            (Rules { largest: 9.0, ..CONTRACT }, Ray { origin: Vec3::X * 10.0, ..RAY }),
            (Rules { smallest: 0.1, ..CONTRACT }, Ray { origin: Vec3::X * 0.01, ..RAY }),
        ] {
            assert!(!rules.cover_ray(&ray) && CONTRACT.cover_ray(&ray), "{rules:?}: {ray:?}");
        }
        let all = Rules { starts: Starts::NotBehind, invalid: Promise::None, ..unit };
        assert!(all.cover_ray(&RAY));
        assert!(!all.cover_sphere(&Sphere::from([0.0, 0.0, 0.0, -1.0])));
    }

    #[test]
    fn an_open_end_leaves_one_number_out() {
        let open = |interval| Rules { interval, ..CONTRACT }.closed(&Ray { t_max: 1.0, ..RAY });
        let ends = |interval| (open(interval).t_min.to_bits(), open(interval).t_max.to_bits());
        let one = 1.0_f32.to_bits();
        assert_eq!(ends(Interval::Closed), (0, one));
        assert_eq!(ends(Interval::Open), (1, one - 1));
        assert_eq!(ends(Interval::OpenStart), (1, one));
        assert_eq!(ends(Interval::OpenEnd), (0, one - 1));
    }
}
