//! How much of a leaf's margins is used, as far as a search finds it. Doubles are the truth: beside a margin of some
//! 2^-20 their error is nothing.

extern crate std;

use super::Pass;
use crate::accuracy::{RayLanes, TierFormula};
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::scale::rays::ScaledRays;
use crate::testing::climb::{Random, assert_published, climb_twice};
use crate::{Exact, Ray, RayPacket, Sphere, Stable, Vec3};

/// o, d, c, r.
type Numbers = [f32; 10];

/// What a leaf computes, and the truth.
struct Case {
    line: Ray,
    sphere: Sphere,
    pass: Pass<f32>,
    /// W.
    slack: f64,
    /// The intervals of both roots.
    ends: [f64; 2],
    /// |d|.
    length: f64,
    /// b / a and D / a^2.
    middle: f64,
    discriminant: f64,
}

impl Case {
    fn new(numbers: &Numbers) -> Option<Self> {
        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = *numbers;
        let line = Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
        let line = Ray { t_min: f32::NEG_INFINITY, ..line };
        let sphere = Sphere { center: Vec3::new(cx, cy, cz), radius: r.abs() };
        let rays = RayLanes::<f32>::load((), &RayPacket::<[f32; 1]>::new(&[line]));
        let prepared = PreparedLanes::as_they_are(&ScaledRays::new(&rays, 1.0));
        if !prepared.covered {
            return None;
        }
        let error = prepared.absolute_error;
        let center = sphere.center.to_array();
        let pass = Pass::new(prepared.origin, prepared.direction, error, center, sphere.radius);
        let all = f32::INFINITY;
        let found = pass.root_interval::<false>([-all; 2], [all; 2], 0.0, 0.0);
        let [delta, middle] = [pass.delta, pass.middle].map(f64::from);

        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = numbers.map(f64::from);
        let (d, p) = ([dx, dy, dz], [cx - ox, cy - oy, cz - oz]);
        let x = [d[1] * p[2] - d[2] * p[1], d[2] * p[0] - d[0] * p[2], d[0] * p[1] - d[1] * p[0]];
        let dot = |v: [f64; 3], w: [f64; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
        let a = dot(d, d);
        Some(Self {
            line,
            sphere,
            pass,
            slack: delta * (0.3125 * delta + 0.5 * r.abs()),
            ends: [f64::from(found.entry), 2.0 * middle - f64::from(found.entry)],
            length: libm::sqrt(a),
            middle: dot(d, p) / a,
            discriminant: r * r / a - dot(x, x) / (a * a),
        })
    }

    /// r^2 - l^2, as computed.
    fn left(&self) -> f64 {
        let [r, ll] = [self.pass.radius, self.pass.ll].map(f64::from);
        r * r - ll
    }

    fn meets(&self) -> bool {
        self.discriminant >= 0.0
    }
}

/// Of W by a hit that is computed to pass by its sphere, and by a miss that is computed to meet it.
fn of_slack(numbers: &Numbers, hits: bool) -> f64 {
    let Some(case) = Case::new(numbers).filter(|case| case.meets() == hits) else { return -1.0 };
    let used = if hits { -case.left() } else { case.left() };
    if used.is_finite() { used / case.slack } else { -1.0 }
}

/// Of what lies between a root as computed without margins and the end of its interval, by the s of a tier's answer.
fn of_ends<A: TierFormula>(numbers: &Numbers) -> f64 {
    let Some(case) = Case::new(numbers).filter(Case::meets) else { return -1.0 };
    let Some([near, far]) = A::line_roots(&case.line, &case.sphere) else { return -1.0 };
    let half = libm::sqrt(case.left().max(0.0));
    let middle = f64::from(case.pass.middle);
    let root = libm::sqrt(case.discriminant);
    let near = (middle - half) - case.length * f64::from(near).min(case.middle - root);
    let far = case.length * f64::from(far).max(case.middle + root) - (middle + half);
    let used =
        (near / ((middle - half) - case.ends[0])).max(far / (case.ends[1] - (middle + half)));
    if used.is_finite() { used } else { -1.0 }
}

/// Tangents, lines that pass by or meet by little, lines through the centre; near, far, within.
fn start(random: &mut Random) -> Numbers {
    let (o, d) = (random.point(0), random.point(0));
    let scale = random.wide(-6, 8);
    let aside = random.wide(-8, 2);
    let c = [0, 1, 2].map(|i| o[i] + scale * d[i] + aside * random.about(0));
    let w = d.map(f64::from);
    let p = [0, 1, 2].map(|i| f64::from(c[i]) - f64::from(o[i]));
    let a: f64 = w.iter().map(|x| x * x).sum();
    let b: f64 = (0..3).map(|i| w[i] * p[i]).sum();
    let pp: f64 = p.iter().map(|x| x * x).sum();
    let distance = (pp - b * b / a.max(1e-30)).max(0.0).sqrt() as f32;
    let r = match random.below(3) {
        0 => distance * (1.0 + random.wide(-22, 0)),
        1 => distance,
        _ => random.wide(-10, 4),
    };
    let ([ox, oy, oz], [dx, dy, dz], [cx, cy, cz]) = (o, d, c);
    [ox, oy, oz, dx, dy, dz, cx, cy, cz, r.abs()]
}

#[test]
fn what_is_used_of_a_leafs_margins() {
    let found = |seed, score: fn(&Numbers) -> f64| {
        climb_twice(seed, [1500, 300], [-24, 24], start, score).0
    };
    assert_published("W, by hits", found(61, |numbers| of_slack(numbers, true)), 0.115);
    assert_published("W, by misses", found(62, |numbers| of_slack(numbers, false)), 0.097);
    assert_published("delta, Exact", found(63, of_ends::<Exact>), 0.309);
    assert_published("delta, Stable", found(64, of_ends::<Stable>), 0.317);
}
