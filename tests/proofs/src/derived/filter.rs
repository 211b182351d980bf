//! The least kappa that lets every hit pass, derived from the source of the filter, of `Fast` and of `Geometric`.
//!
//! With F = D/a + |o|^2 in real arithmetic, the computed value is at least F plus what the widening adds, minus the
//! error; the threshold is at most |o|^2 minus what it is lowered by, plus its error. A hit of either tier has D/a
//! above its row. So a hit passes if both widenings exceed both errors and the row, term by term in |c|^2, |o|^2 and
//! r^2.

use super::tiers::{fast_row, geometric_row};
use super::{U, operands, ray, rules_of};
use crate::filter::block::{FilterGroup, excess};
use crate::filter::frame::Frame;
use crate::filter::rays::FilterRays;
use crate::filter::{KAPPA, LEAST_SIZE};
use crate::proofs::polynomial::Polynomial;
use crate::proofs::recorded::{Operation, Recorded, record};
use std::vec::Vec;

/// In u, of |c|^2, |o|^2 and r^2.
#[derive(Clone, Copy, Debug)]
struct Derived {
    need: [f64; 3],
    have: [f64; 3],
}

impl Derived {
    fn holds(&self) -> bool {
        (0..3).all(|i| self.need[i] * (1.0 + 1e-9) <= self.have[i])
    }
}

/// Whether every hit passes with that kappa.
pub(in crate::proofs) fn holds(kappa: f64) -> bool {
    derive(kappa as f32, |c, _| c).holds()
}

/// Derives with one more operation on one coordinate of a centre.
fn derive(kappa: f32, more: impl FnOnce(Recorded, Recorded) -> Recorded) -> Derived {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r", "kx", "ky", "kz"];
    let witness = [0.5, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5, 0.1, 0.1, 0.1];
    let ((filter, raised), graph) = record(witness, |inputs| {
        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r, kx, ky, kz] = inputs;
        let rays = ray([ox, oy, oz], [dx, dy, dz]);
        let shift = [kx, ky, kz].map(Recorded::tag);
        let frame = Frame { scale: 1.0, shift, least_size: LEAST_SIZE, least_length: 0.0 };
        let filter = FilterRays::widened((), &rays, &frame, kappa);
        let c = [more(cx, r), cy, cz];
        let mut group = FilterGroup::EMPTY;
        for axis in 0..3 {
            group.center[axis][0] = c[axis].tag();
        }
        group.excess[0] = excess(c, r, kappa, LEAST_SIZE).tag();
        let raised = filter.raised(&group, 0);
        (filter, raised)
    });

    // c is the centre less K, rounded.
    let mut rules = rules_of(names, &["cx", "cy", "cz"], &[]);
    for axis in 0..3 {
        rules.name(filter.direction[axis].0, ["nx", "ny", "nz"][axis]);
        let [origin, _] = operands(&graph, filter.twice_origin[axis].0);
        rules.name(origin, ["px", "py", "pz"][axis]);
    }
    // b^2 and the rest.
    let [bb, _] = operands(&graph, raised.0);
    let [b, _] = operands(&graph, bb);
    rules.name(b, "b");
    // The terms that kappa adds and takes away are no errors.
    let constant = Operation::Constant(f64::from(kappa));
    let widenings: Vec<usize> = (0..graph.len())
        .filter(|node| matches!(graph[*node], Operation::Product(a, _) if graph[a] == constant))
        .collect();
    for node in &widenings {
        rules.free(*node);
    }
    let n = rules.vector(["nx", "ny", "nz"], "|n|");
    let o = rules.vector(["px", "py", "pz"], "|o|");
    let c = rules.vector(["cx", "cy", "cz"], "|c|");
    rules.run(&graph);

    let [b, nx, r] = ["b", "nx", "r"].map(|name| rules.symbol(name));
    let mut error = rules.bound(raised.0).error() + rules.bound(filter.threshold.0).error();
    error = rules.in_lengths(&error.with(b, &rules.in_lengths(&rules.upper[&b])));
    // |v| = 1, and n is v except for its error.
    error = error.with(n, &Polynomial::constant(1.0 + 2.0 * rules.off_by(nx)));
    assert_eq!(error.terms().count(), 4, "{error:?}");
    // 2 |c| |o| <= |c|^2 + |o|^2; so |p|^2 <= 2 (|c|^2 + |o|^2), before c and o were rounded.
    let mixed = error.coefficient(&[(c, 1), (o, 1)]) / 2.0;
    let rows = [fast_row(), geometric_row()];
    let [tier_p, tier_r] =
        [0, 1].map(|part| rows[0][part].max(rows[1][part]) * U * (1.0 + 8.0 * U));
    let need = [
        error.coefficient(&[(c, 2)]) + mixed + 2.0 * tier_p,
        error.coefficient(&[(o, 2)]) + mixed + 2.0 * tier_p,
        error.coefficient(&[(r, 2)]) + tier_r,
    ];
    let have = ["cx", "px", "r"].map(|name| {
        let square = [(rules.symbol(name), 2)];
        let lows = widenings.iter().map(|node| rules.bound(*node).low.coefficient(&square));
        lows.fold(0.0, f64::max)
    });
    Derived { need: need.map(|x| x / U), have: have.map(|x| x / U) }
}

#[test]
fn a_longer_formula_is_refused() {
    let longer = derive(KAPPA, |c, r| c * r / r);
    assert!(!longer.holds(), "two operations more: {longer:?}");
}
