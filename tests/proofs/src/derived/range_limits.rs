//! The raise of D and the margin of a limit, derived from the source.
//!
//! Put in by hand: no component of d is longer than d; r |d| and |d.p| are no more than the size; and the error of
//! `Stable`.

use super::{U, find, name_differences, operands, ray, roots, rules_of};
use crate::accuracy::range_limits::{RAISE, RangeLimits};
use crate::proofs::polynomial::{Monomial, Polynomial};
use crate::proofs::recorded::{Operation, record};
use std::vec::Vec;

/// In u: the least raise, and the least margin of the size and of limit a.
pub(in crate::proofs) fn needs() -> [f64; 3] {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r", "limit"];
    let witness = [0.5, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5, 0.5];
    let ((), graph) = record(witness, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r, limit]| {
        let rays = ray([ox, oy, oz], [dx, dy, dz]);
        let _ = RangeLimits::new(&rays).limit(&rays, [cx, cy, cz], r, limit);
    });
    let operands = |node: usize| operands(&graph, node);
    // |d|, and the root of D.
    let roots = roots(&graph);
    // The last sum is end + margin; margin is MARGIN (size + |end|) and what covers underflow.
    let [end, margin] = operands(graph.len() - 1);
    let [size, _] = operands(operands(operands(margin)[0])[1]);
    let [larger, raise] = operands(operands(roots[1])[0]);
    let discriminant = operands(larger)[0];
    let [later, a] = operands(end);
    let is_entry =
        |operation: Operation| matches!(operation, Operation::Difference(_, b) if b == roots[1]);
    let [b, _] = operands(find(&graph, is_entry));

    let mut rules = rules_of(names, &[], &["r"]);
    name_differences(&mut rules, &graph, &["px", "py", "pz", "xx", "xy", "xz"]);
    rules.name(a, "a");
    rules.name(roots[0], "|d|");
    rules.name(end, "end");
    rules.name_and_charge(later, "later");
    rules.run(&graph);
    let [error_of_d, error_of_b] = [discriminant, b].map(|node| rules.bound(node).error().clone());
    let [raised, sized] = [raise, size].map(|node| rules.bound(node).low.clone());
    let high = rules.bound(size).high.clone();

    // Counted in lengths: x by what it is made of; d by its length, whose square is a.
    let [length, end] = ["|d|", "end"].map(|name| rules.symbol(name));
    let d = Polynomial::of(1.0 + 8.0 * U, Monomial::of(&[(length, 1)]));
    let mut bounds: Vec<_> = ["xx", "xy", "xz"]
        .map(|name| rules.symbol(name))
        .map(|symbol| (symbol, rules.upper[&symbol].clone()))
        .to_vec();
    bounds.extend(["dx", "dy", "dz"].map(|name| (rules.symbol(name), d.clone())));
    bounds.push((rules.symbol("a"), &d * &d));
    let in_lengths = |polynomial: &Polynomial| {
        bounds.iter().fold(polynomial.clone(), |sum, (symbol, bound)| sum.with(*symbol, bound))
    };

    // D, and its sum with the raise, which is rounded; D is at most a r^2.
    let r = Polynomial::symbol(rules.symbol("r"));
    let reach = &(&d * &d) * &(&r * &r);
    let raise = &in_lengths(&error_of_d) + &(&reach + &raised).scaled(2.0 * U);
    let raise = raise.over(&in_lengths(&raised)) * f64::from(RAISE);

    // b; the root, and its difference with b: each is the size at most, except for the raise; and the error of
    // `Stable`, 24u r + 4u |p|. What of the raise D does not need, of size^2, lowers b - root by half as much of the size, since
    // the root of D is at most the size.
    let stable = 24.0 * U - 0.499 * (f64::from(RAISE) - raise);
    let need = &in_lengths(&error_of_b) + &high.scaled(3.0 * U * (1.0 + 1.0 / 256.0) + stable);
    let of_size = need.over(&in_lengths(&sized));
    // limit a; half of what is between t and the next one; the sum with the margin.
    let off = rules.off_by(end) + 2.0 * U;
    [raise, of_size, off].map(|part| part * (1.0 + 64.0 * U) / U)
}
