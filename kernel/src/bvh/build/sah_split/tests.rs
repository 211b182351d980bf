//! Cuts, bit for bit as they are found one slice and one sphere after the other.

extern crate std;

use super::super::bounds::{Bounds, Corners};
use super::super::join::InTurn;
use super::super::run::Run;
use super::super::sah_bins::BINS;
use crate::bvh::node::WIDTH;
use crate::proofs::climb::Random;
use std::vec::Vec;

/// Spheres of which many share coordinates, on a grid of `steps`, or on a line of it.
fn spheres(random: &mut Random, count: usize, steps: u64, line: bool) -> Vec<[f32; 4]> {
    let mut at = |least: f32| least + random.below(steps) as f32 / 16.0;
    let mut one = || if line { [1.0, at(-2.0), -0.0, 0.5] } else { [(); 4].map(|()| at(0.0)) };
    (0..count).map(|_| one()).collect()
}

fn half_area(spheres: &[[f32; 4]]) -> f32 {
    let side = |axis: usize| {
        let low = spheres.iter().map(|s| s[axis] - s[3]).fold(f32::INFINITY, f32::min);
        let high = spheres.iter().map(|s| s[axis] + s[3]).fold(f32::NEG_INFINITY, f32::max);
        high - low
    };
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
}

/// Axis, slice, spheres before and cost of the cheapest cut; of equal ones the first.
fn by_hand(spheres: &[[f32; 4]], most: usize) -> Option<(usize, usize, usize, f32)> {
    let mut best = None;
    let mut least_cost = f32::INFINITY;
    for axis in 0..3 {
        let centers = || spheres.iter().map(|s| s[axis]);
        let (low, high) = centers()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let scale = BINS as f32 * (1.0 - 4.0 * f32::EPSILON) / (high - low);
        if scale >= f32::MAX {
            continue;
        }
        let slice = |sphere: &&[f32; 4]| ((sphere[axis] - low) * scale) as usize;
        for bin in 1..BINS {
            let (one, other): (Vec<_>, Vec<_>) =
                spheres.iter().partition(|sphere| slice(sphere) < bin);
            if one.is_empty() || !spheres.iter().any(|sphere| slice(&sphere) == bin) {
                continue;
            }
            let leaves = [&one, &other].map(|part| part.len().div_ceil(WIDTH));
            let cost = half_area(&one) * leaves[0] as f32 + half_area(&other) * leaves[1] as f32;
            if cost < least_cost && leaves[0] + leaves[1] <= most {
                least_cost = cost;
                best = Some((axis, bin, one.len(), cost));
            }
        }
    }
    best
}

#[test]
fn cuts_are_those_found_by_hand() {
    let mut random = Random(7);
    let (mut cuts, mut none) = (0, 0);
    for count in [1, 2, 3, 5, 15, 16, 17, 33, 100, 500, 500, 40_000] {
        for (steps, line) in [(1, false), (3, false), (40, false), (1 << 20, false), (50, true)] {
            let mut all = spheres(&mut random, count, steps, line);
            let mut indices: Vec<u32> = (0..count as u32).collect();
            let before = all.clone();
            let bounds = Bounds::of(&InTurn, &all);
            for most in [count.div_ceil(WIDTH), count.div_ceil(WIDTH) + 1, usize::MAX] {
                let expected = by_hand(&all, most);
                let mut run = Run { spheres: &mut all, indices: &mut indices };
                let cut = run.best_cut(&InTurn, &bounds, most);
                let found = cut.map(|cut| (cut.axis, cut.bin, cut.first, cut.cost));
                assert_eq!(found, expected, "{count}, {steps}, {most}");
                let Some(cut) = cut else {
                    none += 1;
                    continue;
                };
                cuts += 1;
                let parts = run.cut(&bounds, &cut);
                let (one, other) = all.split_at(cut.first);
                for (part, spheres) in parts.iter().zip([one, other]) {
                    let own = Bounds::of(&InTurn, spheres);
                    assert_eq!((part.low, part.high), (own.low, own.high));
                    let corners = |of: Corners| [of.low.to_array(), of.high.to_array()];
                    assert_eq!(corners(part.centers), corners(own.centers));
                }
                // Spheres keep their indices, and none is lost.
                assert!(all.iter().zip(&indices).all(|(s, index)| *s == before[*index as usize]));
                let mut sorted = indices.clone();
                sorted.sort_unstable();
                assert!(sorted.iter().zip(0..).all(|(index, own)| *index == own));
            }
        }
    }
    assert!(cuts > 100 && none > 20, "{cuts} cuts, {none} without");
}
