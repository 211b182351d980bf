//! The filter over toy floats: every hit of `Fast`, `Geometric` or real arithmetic passes, for all rays and spheres of
//! a set, in a plane.
//!
//! kappa is 114 u, so the floats have eleven bits: with fewer, the filter would let everything pass. Spheres are
//! prepared for `f32` alone; here their centres are shifted by a lane, as rays are.

use super::pairs;
use crate::accuracy::{RayLanes, TierFormula};
use crate::filter::block::{FilterGroup, excess};
use crate::filter::frame::Frame;
use crate::filter::rays::FilterRays;
use crate::filter::{KAPPA, LEAST_SIZE};
use crate::numeric::rounding::U;
use crate::proofs::toy::floats::{Format, Toy};
use crate::{Fast, Geometric};
use std::println;

formats! {
    Fused: 11, Self, FUSED: bool = true;
    Unfused: 11, Self;
}

/// kappa.
const KAPPA_IN_U: f64 = (KAPPA / U) as f64;

/// o, d, c, r and the filter's origin, in a plane.
#[derive(Clone, Copy, Debug)]
struct Case {
    o: [i64; 2],
    d: [i64; 2],
    c: [i64; 2],
    r: i64,
    shift: [i64; 2],
}

impl Case {
    /// D >= 0.
    fn is_hit(&self) -> bool {
        let [a, x] = self.terms();
        a * self.r * self.r >= x * x
    }

    /// d.d and d x p.
    fn terms(&self) -> [i64; 2] {
        let Self { o, d, c, .. } = *self;
        [d[0] * d[0] + d[1] * d[1], d[0] * (c[1] - o[1]) - d[1] * (c[0] - o[0])]
    }

    /// Whether the tier sees a hit, and whether the filter lets the sphere pass.
    fn judged<A: TierFormula, F: Format>(&self, kappa: f32) -> [bool; 2] {
        let vector = |v: [i64; 2]| [v[0], v[1], 0].map(|x| Toy::<F>::new(x as f64));
        let (infinity, r) = (Toy::new(f64::INFINITY), Toy::new(self.r as f64));
        let (origin, direction) = (vector(self.o), vector(self.d));
        let rays = RayLanes { origin, direction, t_min: -infinity, t_max: infinity, live: true };
        let (center, shift) = (vector(self.c), vector(self.shift));
        let shifted = [0, 1, 2].map(|i| center[i] - shift[i]);
        let mut group = FilterGroup::EMPTY;
        for i in 0..3 {
            group.center[i][0] = shifted[i].get() as f32;
        }
        group.excess[0] = excess(shifted, r, kappa, LEAST_SIZE).get() as f32;
        let shift = shift.map(|k| k.get() as f32);
        let frame = Frame { scale: 1.0, shift, least_size: LEAST_SIZE, least_length: 0.0 };
        let passes = FilterRays::widened((), &rays, &frame, kappa).may_meet(&group, 0);
        let t = A::first_root(&rays, &A::prepare(&rays), center, r, true, infinity);
        [t.get().is_finite(), passes]
    }
}

/// All cases of the sets: radii are less than the distance of the line, down to where no tier sees a hit any more, or
/// as large.
fn all(mut work: impl FnMut(&Case)) {
    let directions = [[4, 1], [5, 3], [7, 0], [6, -5], [3, 7], [-1, 5], [2047, 1023], [-999, 1]];
    let numbers = [-2001, -1021, -515, -100, -3, 0, 2, 33, 257, 701, 1501, 2047];
    for (d, o) in pairs(&directions, &[[0, 0], [37, -5], [-1023, 513], [1999, 1777], [-3, 1001]]) {
        for (x, y) in pairs(&numbers, &numbers) {
            let mut case = Case { o, d, c: [x, y], r: 0, shift: [0; 2] };
            let [a, side] = case.terms();
            let across = (side.abs() as f64 / (a as f64).sqrt()).ceil() as i64;
            for (shift, less) in
                pairs(&[[0, 0], [x, y], [y, 77]], &[-2, 0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 144, 377])
            {
                (case.r, case.shift) = (across - less, shift);
                if (0..2048).contains(&case.r) {
                    work(&case);
                }
            }
        }
    }
}

/// With kappa in u, counts hits, hits of the tier that are none, misses that are ruled out, and hits that are ruled
/// out.
fn counts<A: TierFormula, F: Format>(kappa: f64) -> [u64; 4] {
    let mut counts = [0; 4];
    all(|case| {
        let ([seen, passes], hit) = (case.judged::<A, F>((kappa * F::U) as f32), case.is_hit());
        counts[0] += u64::from(hit);
        counts[1] += u64::from(seen && !hit);
        counts[2] += u64::from(!passes && !hit && !seen);
        counts[3] += u64::from(!passes && (hit || seen));
    });
    counts
}

#[test]
fn no_hit_is_ruled_out() {
    for (name, counts) in [
        ("Fast, fused", counts::<Fast, Fused>(KAPPA_IN_U)),
        ("Fast, not fused", counts::<Fast, Unfused>(KAPPA_IN_U)),
        ("Geometric, fused", counts::<Geometric, Fused>(KAPPA_IN_U)),
        ("Geometric, not fused", counts::<Geometric, Unfused>(KAPPA_IN_U)),
    ] {
        let [hits, false_hits, ruled_out, lost] = counts;
        println!(
            "{name}: {hits} hits and {false_hits} false ones; {ruled_out} misses are ruled out, {lost} hits"
        );
        assert!(lost == 0, "{name}: {lost} hits are ruled out");
        assert!(hits > 10_000 && false_hits > 5_000 && ruled_out > 10_000, "{name}: {counts:?}");
    }
    let [.., lost] = counts::<Fast, Unfused>(KAPPA_IN_U / 16.0);
    println!("with a sixteenth of kappa: {lost} hits are ruled out");
    assert!(lost > 0, "no hit is hard");
}
