//! Searches for how much of a leaf's margins is used. Doubles count as the truth: beside a margin of some 2^-20 their
//! error is nothing.

use super::{Numbers, cross, distance, dot, lane, line, numbers, or_none, square, wide};
use crate::accuracy::TierFormula;
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::bvh::traverse::root_interval::Pass;
use crate::proofs::climb::{Random, assert_published, climb_twice};
use crate::scale::rays::ScaledRays;
use crate::{Exact, Ray, Sphere, Stable};

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
        let (line, sphere) = line(numbers);
        let rays = lane(&line);
        let prepared = PreparedLanes::as_they_are(&ScaledRays::new(&rays, 1.0));
        if !prepared.covered {
            return None;
        }
        let error = prepared.absolute_error;
        let center = sphere.center.to_array();
        let pass = Pass::new(prepared.origin, prepared.direction, error, center, sphere.radius);
        let all = f32::INFINITY;
        let found = pass.root_interval::<false>([-all; 2], [all; 2], 0.0, 0.0);
        let middle = f64::from(pass.middle);

        let ((d, p, r), a) =
            (wide(&line, &sphere), square(line.direction.to_array().map(f64::from)));
        Some(Self {
            line,
            sphere,
            pass,
            slack: f64::from(pass.slack()),
            ends: [f64::from(found.entry), 2.0 * middle - f64::from(found.entry)],
            length: libm::sqrt(a),
            middle: dot(d, p) / a,
            discriminant: r * r / a - square(cross(d, p)) / (a * a),
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

/// The part of W that is used: by a hit that is computed to pass by its sphere, or, unless `hits`,
/// by a miss that is computed to meet it.
fn of_slack(numbers: &Numbers, hits: bool) -> f64 {
    let Some(case) = Case::new(numbers).filter(|case| case.meets() == hits) else { return -1.0 };
    let used = if hits { -case.left() } else { case.left() };
    or_none(used / case.slack)
}

/// The part that the s of a tier's answer uses of the distance between a root as computed without margins and the end
/// of its interval.
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
    or_none(used)
}

/// Tangents, lines that pass by or meet by little, lines through the centre; near, far, within.
fn start(random: &mut Random) -> Numbers {
    let (o, d) = (random.point(0), random.point(0));
    let scale = random.wide(-6, 8);
    let aside = random.wide(-8, 2);
    let c = [0, 1, 2].map(|i| o[i] + scale * d[i] + aside * random.about(0));
    let distance = distance(o, d, c) as f32;
    let r = match random.below(3) {
        0 => distance * (1.0 + random.wide(-22, 0)),
        1 => distance,
        _ => random.wide(-10, 4),
    };
    numbers(o, d, c, r.abs())
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
