//! How far off D is, as it follows from the source.

extern crate std;

use super::{RayLanes, TierFormula};
use crate::Fast;
use crate::testing::polynomial::{Monomial, Polynomial};
use crate::testing::recorded::{Operation, record};
use crate::testing::running_error::{Input, RunningError};
use std::println;

/// The most that D is off, over u |d|^2, of |p|^2 and of r^2: the row of `Fast` in `docs/numerics.md`.
pub(crate) fn fast_row() -> [f64; 2] {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];
    let witness = [0.0, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5];
    let (_, graph) = record(witness, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let rays = RayLanes { origin, direction, t_min: ox, t_max: r, live: true };
        super::roots(&Fast::prepare(&rays), [cx, cy, cz], r)
    });

    // D = b^2 - a c under the root, and a, which is divided by.
    let root = graph.iter().find_map(|operation| match operation {
        Operation::Root(discriminant) => Some(*discriminant),
        _ => None,
    });
    let discriminant = root.expect("a root");
    let Operation::Difference(bb, ac) = graph[discriminant] else { unreachable!("D") };
    let (Operation::Product(b, _), Operation::Product(a, c)) = (graph[bb], graph[ac]) else {
        unreachable!("b^2 and a c")
    };

    let mut rules = RunningError::new(24, &names.map(Input::named));
    let differences =
        (0..graph.len()).filter(|node| matches!(graph[*node], Operation::Difference(..)));
    for (name, node) in ["px", "py", "pz"].into_iter().zip(differences) {
        rules.name(node, name);
    }
    for (name, node) in [("a", a), ("b", b), ("c", c)] {
        rules.name(node, name);
    }
    rules.name_and_charge(discriminant, "D");
    let d = rules.vector(["dx", "dy", "dz"], "|d|");
    let p = rules.vector(["px", "py", "pz"], "|p|");
    rules.run(&graph);

    let mut error = rules.bound(discriminant).error().clone();
    for name in ["a", "b", "c"] {
        let symbol = rules.symbol(name);
        error = error.with(symbol, &rules.in_lengths(&rules.upper[&symbol]));
    }
    // D = a r^2 - |d x p|^2: no larger than the larger of both. Its own error is less than 64 u of them.
    let [r, own] = ["r", "D"].map(|name| rules.symbol(name));
    let most = 1.0 + 64.0 / 16_777_216.0;
    let [pp, rr] = [p, r].map(|length| Polynomial::of(most, Monomial::of(&[(d, 2), (length, 2)])));
    error = rules.in_lengths(&error.with(own, &(&pp + &rr)));
    assert_eq!(error.terms().count(), 2, "{error:?}");
    [p, r].map(|length| error.coefficient(&[(d, 2), (length, 2)]) * 16_777_216.0)
}

#[test]
fn the_row_is_no_smaller_than_what_the_source_needs() {
    let row = fast_row();
    println!("{row:?}");
    // As published in `docs/proofs.md`; 20 and 10 are the row.
    for (found, published) in row.into_iter().zip([20.0, 7.0]) {
        assert!((found - published).abs() < 1e-3, "{row:?}");
    }
    // The spread of the tier.
    assert!(row[0].max(row[1]) < f64::from(Fast::SPREAD * Fast::SPREAD) * 16_777_216.0);
}
