//! The filter over toy floats: every hit of `Fast`, `Geometric` or real arithmetic passes, for all rays and spheres of
//! a set, in a plane.
//!
//! kappa is 114 u, so the floats have eleven bits: with fewer, the filter would let everything pass. Spheres are
//! prepared for `f32` alone; here their centres are shifted by a lane, as rays are.

use super::case::{Case, lanes};
use super::pairs;
use crate::accuracy::TierFormula;
use crate::filter::block::{FilterGroup, excess};
use crate::filter::frame::Frame;
use crate::filter::rays::FilterRays;
use crate::filter::{KAPPA, LEAST_SIZE};
use crate::numeric::rounding::U;
use crate::proofs::toy::floats::Format;
use crate::{Fast, Geometric};
use std::println;

formats! {
    Fused: 11, Self, FUSED: bool = true;
    Unfused: 11, Self;
}

/// kappa.
const KAPPA_IN_U: f64 = (KAPPA / U) as f64;

impl Case {
    /// Whether the tier sees a hit, and whether the filter, with that origin, lets the sphere pass.
    fn judged<A: TierFormula, F: Format>(&self, shift: [i64; 2], kappa: f32) -> [bool; 2] {
        let rays = self.rays::<F>([f64::NEG_INFINITY, f64::INFINITY]);
        let (center, r) = self.sphere::<F>();
        let shift = lanes::<F>([shift[0], shift[1], 0]);
        let shifted = [0, 1, 2].map(|i| center[i] - shift[i]);
        let mut group = FilterGroup::EMPTY;
        for i in 0..3 {
            group.center[i][0] = shifted[i].get() as f32;
        }
        group.excess[0] = excess(shifted, r, kappa, LEAST_SIZE).get() as f32;
        let shift = shift.map(|k| k.get() as f32);
        let frame = Frame { scale: 1.0, shift, least_size: LEAST_SIZE, least_length: 0.0 };
        let passes = FilterRays::widened((), &rays, &frame, kappa).may_meet(&group, 0);
        let t = A::first_root(&rays, &A::prepare(&rays), center, r, true, rays.t_max, false);
        [t.get().is_finite(), passes]
    }
}

/// All cases of the sets: radii are less than the distance of the line, down to where no tier sees a hit any more, or
/// as large.
fn all(mut work: impl FnMut(&Case, [i64; 2])) {
    let directions = [[4, 1], [5, 3], [7, 0], [6, -5], [3, 7], [-1, 5], [2047, 1023], [-999, 1]];
    let numbers = [-2001, -1021, -515, -100, -3, 0, 2, 33, 257, 701, 1501, 2047];
    for (d, o) in pairs(&directions, &[[0, 0], [37, -5], [-1023, 513], [1999, 1777], [-3, 1001]]) {
        for (x, y) in pairs(&numbers, &numbers) {
            let across = Case::in_plane(o, d, [x, y], 0).truth().distance().ceil() as i64;
            for (shift, less) in
                pairs(&[[0, 0], [x, y], [y, 77]], &[-2, 0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 144, 377])
            {
                if (0..2048).contains(&(across - less)) {
                    work(&Case::in_plane(o, d, [x, y], across - less), shift);
                }
            }
        }
    }
}

/// With kappa in u, counts hits, hits of the tier that are none, misses that are ruled out, and hits that are ruled
/// out.
fn counts<A: TierFormula, F: Format>(kappa: f64) -> [u64; 4] {
    let mut counts = [0; 4];
    all(|case, shift| {
        let [seen, passes] = case.judged::<A, F>(shift, (kappa * F::U) as f32);
        let hit = case.truth().discriminant >= 0;
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
