//! The rows of `Fast` and `Geometric` in `docs/numerics.md`: the error of what is under a tier's root.

use super::{NAMES, U, WITNESS, name_differences, operands, ray, roots, rules};
use crate::accuracy::{TierFormula, fast, geometric};
use crate::proofs::polynomial::{Monomial, Polynomial, Symbol};
use crate::proofs::recorded::record;
use crate::{Fast, Geometric};

/// |p|^2 and r^2, times other lengths squared, and more: second order is less than 64 u of them.
fn squares(lengths: [Symbol; 2], others: &[(Symbol, i32)]) -> [Polynomial; 2] {
    lengths.map(|length| {
        Polynomial::of(1.0 + 64.0 * U, Monomial::of(&[&[(length, 2)], others].concat()))
    })
}

/// The largest error of D, over u |d|^2: its parts of |p|^2 and of r^2.
pub(in crate::proofs) fn fast_row() -> [f64; 2] {
    let (_, graph) = record(WITNESS, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        fast::roots(&Fast::prepare(&ray([ox, oy, oz], [dx, dy, dz])), [cx, cy, cz], r)
    });
    // D = b^2 - a c under the root, and a, which is divided by.
    let [discriminant, _] = operands(&graph, roots(&graph)[0]);
    let [bb, ac] = operands(&graph, discriminant);
    let ([b, _], [a, c]) = (operands(&graph, bb), operands(&graph, ac));

    let mut rules = rules(NAMES);
    name_differences(&mut rules, &graph, &["px", "py", "pz"]);
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
    // D = a r^2 - |d x p|^2: no larger than the larger of both.
    let [r, own] = ["r", "D"].map(|name| rules.symbol(name));
    let [pp, rr] = squares([p, r], &[(d, 2)]);
    error = rules.in_lengths(&error.with(own, &(&pp + &rr)));
    assert_eq!(error.terms().count(), 2, "{error:?}");
    [p, r].map(|length| error.coefficient(&[(d, 2), (length, 2)]) / U)
}

/// The largest error of r^2 - l^2, over u: its parts of |p|^2 and of r^2.
pub(in crate::proofs) fn geometric_row() -> [f64; 2] {
    let (rays, graph) = record(WITNESS, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        let prepared = Geometric::prepare(&ray([ox, oy, oz], [dx, dy, dz]));
        geometric::roots(&prepared, [cx, cy, cz], r);
        prepared
    });
    // r^2 - (p.p - s^2) under the last root; the first is |d|.
    let roots = roots(&graph);
    let [left, _] = operands(&graph, roots[roots.len() - 1]);
    let [_, ll] = operands(&graph, left);
    let [_, square] = operands(&graph, ll);
    let [middle, _] = operands(&graph, square);

    let mut rules = rules(NAMES);
    name_differences(&mut rules, &graph, &["px", "py", "pz"]);
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
    // |v| = 1 in real arithmetic, and l^2 at most |p|^2; h^2 no larger than the larger of r^2 and that.
    error = error.with(v, &Polynomial::constant(1.0 + 2.0 * rules.off_by(vx)));
    let [pp, rr] = squares([p, r], &[]);
    error = error.with(ll, &pp).with(own, &(&pp + &rr));
    assert_eq!(error.terms().count(), 2, "{error:?}");
    [p, r].map(|length| error.coefficient(&[(length, 2)]) / U)
}
