//! The regimes in which the error of a tier is measured: for the budget table and the reports.
//!
//! They are those of the project's first measurements, so that figures can be compared: one ray,
//! one sphere, `t` in `[0, +inf]`. Unlike the [families](crate::families) of hard cases, these
//! regimes resemble the content of scenes, so a rate of wrong answers in them means something.

use crate::aim::{Aim, line_distance, single};
use crate::case::Case;
use crate::random::{Random, dot, power_of_two};
use spherule_kernel::{Ray, Sphere};

/// A kind of scene.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Its name in tables.
    pub name: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Distance / radius between these; the closest points of the lines up to 1.5 radii away.
    Aimed { nearest: f64, furthest: f64 },
    /// The line's distance from the centre is the radius times 1 +- 2^-exponent.
    Grazing { exponent: i64 },
    /// The direction is 2^exponent long.
    Length { exponent: i64 },
    /// The origin this far from zero.
    Translated { by: f64 },
    /// Everything is multiplied by this.
    Scaled { by: f64 },
    /// The origin 2^-6 to 2^-26 radii under the surface.
    Inside,
    /// The origin is as far over the surface, and the ray looks down.
    Outside,
    /// A radius of 6.4e6, the origin 0.1 to 1e4 over the ground at zero.
    Planet,
}

/// The seed of all measured regimes: changing it changes every pinned figure.
const SEED: u64 = 6;

/// All regimes, in the order of the tables.
pub const MEASURED: [Measured; 19] = [
    measured("ordinary", Kind::Aimed { nearest: 1.5, furthest: 20.0 }),
    measured("dist/r 1e2", Kind::Aimed { nearest: 50.0, furthest: 200.0 }),
    measured("dist/r 1e4", Kind::Aimed { nearest: 5e3, furthest: 2e4 }),
    measured("dist/r 1e6", Kind::Aimed { nearest: 5e5, furthest: 2e6 }),
    measured("grazing 2^-8", Kind::Grazing { exponent: 8 }),
    measured("grazing 2^-12", Kind::Grazing { exponent: 12 }),
    measured("grazing 2^-16", Kind::Grazing { exponent: 16 }),
    measured("grazing 2^-20", Kind::Grazing { exponent: 20 }),
    measured("grazing 2^-24", Kind::Grazing { exponent: 24 }),
    measured("inside near surface", Kind::Inside),
    measured("|d| 2^20", Kind::Length { exponent: 20 }),
    measured("|d| 2^-20", Kind::Length { exponent: -20 }),
    measured("|d| 2^60", Kind::Length { exponent: 60 }),
    measured("|d| 2^-60", Kind::Length { exponent: -60 }),
    measured("translated 1e6", Kind::Translated { by: 1e6 }),
    measured("tiny r 1e-20", Kind::Scaled { by: 1e-20 }),
    measured("huge r 1e20", Kind::Scaled { by: 1e20 }),
    measured("planet r 6.4e6", Kind::Planet),
    measured("outside near surface", Kind::Outside),
];

const fn measured(name: &'static str, kind: Kind) -> Measured {
    Measured { name, kind }
}

impl Measured {
    /// Case `index`, the same for ever.
    #[must_use]
    pub fn case(&self, index: u64) -> Case {
        // The regimes share the random stream of an index, so they are the same scene made hard in
        // different ways.
        let mut random = Random::new(SEED, index);
        self.kind.case(&mut random)
    }

    /// The first `count` cases.
    pub fn cases(&self, count: u64) -> impl Iterator<Item = Case> + use<> {
        let measured = *self;
        (0..count).map(move |index| measured.case(index))
    }
}

impl Kind {
    fn case(self, random: &mut Random) -> Case {
        let radius = random.log_uniform(-2, 1);
        let ordinary = Aim::ordinary(random, radius);
        match self {
            Self::Aimed { nearest, furthest } => {
                let distance = radius * random.uniform(nearest, furthest);
                Aim { distance, ..ordinary }.case(random)
            }
            Self::Grazing { exponent } => {
                let mut case = Aim { offset: 1.0, ..ordinary }.case(random);
                let off = random.sign() * power_of_two(-exponent);
                case.sphere.radius = (line_distance(&case) * (1.0 + off)) as f32;
                case
            }
            Self::Length { exponent } => {
                let length = random.uniform(1.0, 2.0) * power_of_two(exponent);
                Aim { length, ..ordinary }.case(random)
            }
            Self::Translated { by } => {
                Aim { origin: random.unit().map(|x| by * x), ..ordinary }.case(random)
            }
            Self::Scaled { by } => {
                let Aim { origin, distance, .. } = ordinary;
                let origin = origin.map(|x| x * by);
                Aim { origin, distance: distance * by, radius: radius * by, ..ordinary }
                    .case(random)
            }
            Self::Inside => near_surface(random, -1.0),
            Self::Outside => near_surface(random, 1.0),
            Self::Planet => {
                let ground = 6.4e6_f32;
                let height = random.log_uniform(-3, 12).clamp(0.1, 1e4);
                let origin = [random.uniform(-100.0, 100.0), height, random.uniform(-100.0, 100.0)];
                let center = [0.0, -f64::from(ground), 0.0];
                Case {
                    ray: Ray::new(single(origin), single(random.unit())),
                    sphere: Sphere { center: single(center), radius: ground },
                }
            }
        }
    }
}

/// The origin is 2^-6 to 2^-26 radii over the surface, and the ray looks down; with `side` -1 the
/// origin is under the surface. Both also hold after rounding.
fn near_surface(random: &mut Random, side: f64) -> Case {
    loop {
        let off = side * power_of_two(-random.integer(6, 26));
        let radius = random.log_uniform(-2, 1) as f32;
        let center = single(random.unit().map(|x| x * random.uniform(0.0, 10.0)));
        let outward = random.unit().map(|x| x * f64::from(radius) * (1.0 + off));
        let origin = single(std::array::from_fn(|i| f64::from(center[i]) + outward[i]));

        // Double precision holds the squares, and their sum except its last bit.
        let p: [f64; 3] = std::array::from_fn(|i| f64::from(origin[i]) - f64::from(center[i]));
        if (dot(p, p) - f64::from(radius) * f64::from(radius)) * side <= 0.0 {
            continue;
        }

        let toward = random.unit();
        let turn = if side > 0.0 && dot(toward, outward) > 0.0 { -1.0 } else { 1.0 };
        let length = turn * random.uniform(0.5, 2.0);
        return Case {
            ray: Ray::new(origin, single(toward.map(|x| x * length))),
            sphere: Sphere { center, radius },
        };
    }
}
