//! How far off r^2 - l^2 is, as it follows from the source.

extern crate std;

use super::{RayLanes, TierFormula};
use crate::Geometric;
use crate::testing::polynomial::{Monomial, Polynomial};
use crate::testing::recorded::{Operation, record};
use crate::testing::running_error::{Input, RunningError};
use std::println;

const U: f64 = 1.0 / 16_777_216.0;

/// The most that r^2 - l^2 is off, over u, of |p|^2 and of r^2: the row of `Geometric` in `docs/numerics.md`.
pub(crate) fn geometric_row() -> [f64; 2] {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];
    let witness = [0.0, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5];
    let (rays, graph) = record(witness, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let rays = RayLanes { origin, direction, t_min: ox, t_max: r, live: true };
        let prepared = Geometric::prepare(&rays);
        super::roots(&prepared, [cx, cy, cz], r);
        prepared
    });

    // r^2 - (p.p - s^2) under the last root; the first is |d|.
    let root = graph.iter().rev().find_map(|operation| match operation {
        Operation::Root(left) => Some(*left),
        _ => None,
    });
    let left = root.expect("a root");
    let Operation::Difference(_, ll) = graph[left] else { unreachable!("r^2 - l^2") };
    let Operation::Difference(_, square) = graph[ll] else { unreachable!("p.p - s^2") };
    let Operation::Product(middle, _) = graph[square] else { unreachable!("s^2") };

    let mut rules = RunningError::new(24, &names.map(Input::named));
    let differences =
        (0..graph.len()).filter(|node| matches!(graph[*node], Operation::Difference(..)));
    for (name, node) in ["px", "py", "pz"].into_iter().zip(differences) {
        rules.name(node, name);
    }
    for (name, node) in ["vx", "vy", "vz"].into_iter().zip(rays.unit) {
        rules.name(node.0, name);
    }
    rules.name(middle, "s");
    rules.name_and_charge(ll, "l^2");
    rules.name_and_charge(left, "h^2");
    let v = rules.vector(["vx", "vy", "vz"], "|v|");
    let p = rules.vector(["px", "py", "pz"], "|p|");
    rules.run(&graph);

    let [vx, s, ll, own, r] = ["vx", "s", "l^2", "h^2", "r"].map(|name| rules.symbol(name));
    let mut error = rules.bound(left).error().clone();
    error = rules.in_lengths(&error.with(s, &rules.in_lengths(&rules.upper[&s])));
    // |v| = 1 in real arithmetic, and l^2 at most |p|^2; h^2 no larger than the larger of r^2 and that. Their own
    // errors are less than 64 u of them.
    error = error.with(v, &Polynomial::constant(1.0 + 2.0 * rules.off_by(vx)));
    let [pp, rr] =
        [p, r].map(|length| Polynomial::of(1.0 + 64.0 * U, Monomial::of(&[(length, 2)])));
    error = error.with(ll, &pp).with(own, &(&pp + &rr));
    assert_eq!(error.terms().count(), 2, "{error:?}");
    [p, r].map(|length| error.coefficient(&[(length, 2)]) / U)
}

#[test]
fn the_row_is_no_smaller_than_what_the_source_needs() {
    let row = geometric_row();
    println!("{row:?}");
    // As published in `docs/proofs.md`, which is the row.
    for (found, published) in row.into_iter().zip([25.0, 2.0]) {
        assert!((found - published).abs() < 1e-3, "{row:?}");
    }
    // The spread of the tier.
    assert!(row[0].max(row[1]) < f64::from(Geometric::SPREAD * Geometric::SPREAD) / U);
}
