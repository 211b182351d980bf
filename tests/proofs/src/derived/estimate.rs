//! The bounds E and T, derived from the source: the formula records itself, its roundings are summed rule by rule, and
//! no constant may be smaller than the sum needs.
//!
//! E is proven first. Then the error of D counts as the part of E that it needs, and T is proven.

use super::{NAMES, WITNESS, name_differences};
use crate::accuracy::constants::Constants;
use crate::accuracy::exact::estimate::Estimate;
use crate::proofs::polynomial::Polynomial;
use crate::proofs::recorded::{Operation, Recorded, record};
use crate::proofs::running_error::{Input, RunningError};

const U: f64 = f64::EPSILON / 2.0;
/// What the test itself may lose.
const SLACK: f64 = 1.0 + 1.0 / (1_u64 << 30) as f64;

/// Whether the proof holds with constants that are changed.
pub(in crate::proofs) fn holds(change: impl FnOnce(&mut Constants)) -> bool {
    let mut constants = Constants::PROVEN;
    change(&mut constants);
    parts(&constants, |r| r)[..2].iter().all(|part| part * SLACK <= 1.0)
}

/// The part of E, and of T, that its most used term needs; and what E i must be multiplied by.
fn parts(constants: &Constants, radius: impl FnOnce(Recorded) -> Recorded) -> [f64; 3] {
    let (estimate, graph) = record(WITNESS, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        Estimate::new([ox, oy, oz], [dx, dy, dz], [cx, cy, cz], radius(r), constants)
    });
    let inputs = NAMES.map(|name| Input { bits: Some(24), ..Input::named(name) });
    let numerators = ["near", "far"].into_iter().zip(numerators(&graph, &estimate));
    let name = |rules: &mut RunningError| {
        name_differences(rules, &graph, &["px", "py", "pz", "xx", "xy", "xz"]);
        for (name, node) in numerators.clone() {
            rules.name(node, name);
        }
    };

    // E.
    let mut rules = RunningError::new(53, &inputs);
    name(&mut rules);
    rules.run(&graph);
    let need = rules.bound(estimate.discriminant.0).error();
    let have = &rules.bound(estimate.error.0).low;
    let part_of_e = need.over(have);

    // T.
    let mut rules = RunningError::new(53, &inputs);
    name(&mut rules);
    rules.name(estimate.error.0, "E");
    let error = rules.symbol("E");
    rules.given(estimate.discriminant.0, Polynomial::symbol(error).scaled(part_of_e.min(1.0)));
    rules.run(&graph);
    let (mut part_of_t, mut error_part) = (0.0_f64, 0.0_f64);
    for (value, bound) in [estimate.near, estimate.far] {
        let (value, bound) = (rules.bound(value.0), rules.bound(bound.0));
        // t minus the bound, and t plus the bound, are rounded.
        let need = value.error() + &(&value.high + &bound.high).scaled(U);
        part_of_t = part_of_t.max(need.over(&bound.low));
        for (monomial, need) in need.terms() {
            if monomial.powers().iter().any(|(symbol, _)| *symbol == error) {
                error_part = error_part.max(need / bound.low.coefficient(monomial.powers()));
            }
        }
    }
    [part_of_e, part_of_t, error_part]
}

/// b -+ sqrt D, which per_a is multiplied by.
fn numerators(graph: &[Operation], estimate: &Estimate<Recorded>) -> [usize; 2] {
    [estimate.near, estimate.far].map(|(t, _)| match graph[t.0] {
        Operation::Product(numerator, _) => numerator,
        _ => unreachable!("t is a product"),
    })
}

/// E i itself is not counted larger than it is: no constant stands before it.
#[test]
fn of_the_error_of_the_discriminant_four_fifths_are_needed() {
    let [.., error] = parts(&Constants::PROVEN, |r| r);
    assert!((error - 0.8).abs() < 1e-6, "{error}");
}

#[test]
fn a_longer_formula_is_refused() {
    let longer = parts(&Constants::PROVEN, |r| r * r / r);
    assert!(longer[0] > 1.0 || longer[1] > 1.0, "two operations more: {longer:?}");
}
