//! The bounds E and T as they follow from the source: the formula records itself, rule by rule its roundings are
//! summed, and no constant may be smaller than what comes out.
//!
//! E is proven first. Then the error of D counts as that part of E, and T is.

extern crate std;

use super::{Constants, Estimate};
use crate::testing::polynomial::{Polynomial, Symbol};
use crate::testing::recorded::{Operation, Recorded, record};
use crate::testing::running_error::{Input, RunningError};
use std::println;
use std::vec::Vec;

const U: f64 = f64::EPSILON / 2.0;
const NAMES: [&str; 10] = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];
/// What the test itself may lose.
const SLACK: f64 = 1.0 + 1.0 / (1_u64 << 30) as f64;

/// What follows from the source.
#[derive(Clone, Copy, Debug)]
struct Derived {
    /// The part of E, and of T, that its most used term needs.
    parts: [f64; 2],
    /// The least that the six constants can be, in their order, in u; in u^2 the third.
    constants: [f64; 6],
    /// The least that E i can be multiplied by.
    error: f64,
}

impl Derived {
    fn holds(&self) -> bool {
        self.parts.iter().all(|part| part * SLACK <= 1.0)
    }
}

fn derive(constants: &Constants) -> Derived {
    derive_of(constants, |r| r)
}

fn derive_of(constants: &Constants, radius: impl FnOnce(Recorded) -> Recorded) -> Derived {
    let witness = [0.0, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5];
    let (estimate, graph) = record(witness, |[ox, oy, oz, dx, dy, dz, cx, cy, cz, r]| {
        Estimate::new([ox, oy, oz], [dx, dy, dz], [cx, cy, cz], radius(r), constants)
    });
    let inputs = NAMES.map(|name| Input { bits: Some(24), ..Input::named(name) });
    let differences: Vec<usize> =
        (0..graph.len()).filter(|node| matches!(graph[*node], Operation::Difference(..))).collect();
    let mut names: Vec<_> =
        ["px", "py", "pz", "xx", "xy", "xz"].into_iter().zip(differences).collect();
    names.extend(["near", "far"].into_iter().zip(numerators(&graph, &estimate)));

    // E.
    let mut rules = RunningError::new(53, &inputs);
    for (name, node) in &names {
        rules.name(*node, name);
    }
    rules.run(&graph);
    let x = ["xx", "xy", "xz"].map(|name| rules.symbol(name));
    let degree = |monomial: Powers<'_>| -> i32 {
        monomial.iter().filter(|(symbol, _)| x.contains(symbol)).map(|(_, power)| power).sum()
    };
    let r = rules.symbol("r");
    let need = rules.bound(estimate.discriminant.0).error();
    let have = &rules.bound(estimate.error.0).low;
    let part_of_e = need.over(have);
    let of_e = |class: fn(i32, bool) -> bool| {
        worst(need, have, |monomial| {
            class(degree(monomial), monomial.iter().any(|(symbol, _)| *symbol == r))
        })
    };
    let sums = of_e(|degree, radius| radius || degree == 2);
    let cross = of_e(|degree, radius| !radius && degree == 1);
    let square = of_e(|degree, radius| !radius && degree == 0);

    // T.
    let mut rules = RunningError::new(53, &inputs);
    for (name, node) in names {
        rules.name(node, name);
    }
    rules.name(estimate.error.0, "E");
    let error = rules.symbol("E");
    rules.given(estimate.discriminant.0, Polynomial::symbol(error).scaled(part_of_e.min(1.0)));
    rules.run(&graph);
    let (mut part_of_t, mut error_part) = (0.0_f64, 0.0_f64);
    let [mut slope, mut root, mut t] = [0.0_f64; 3];
    let d = ["dx", "dy", "dz"].map(|name| rules.symbol(name));
    for ((value, bound), numerator) in [(estimate.near, "near"), (estimate.far, "far")] {
        let numerator = rules.symbol(numerator);
        let (value, bound) = (rules.bound(value.0), rules.bound(bound.0));
        // t less the bound, and t and the bound, are rounded.
        let ends = (&value.high + &bound.high).scaled(U);
        let need = value.error() + &ends;
        part_of_t = part_of_t.max(need.over(&bound.low));
        let has = |monomial: Powers<'_>, symbols: &[Symbol]| {
            monomial.iter().any(|(symbol, _)| symbols.contains(symbol))
        };
        t = t.max(worst(&need, &bound.low, |m| has(m, &[numerator])));
        error_part = error_part.max(worst(&need, &bound.low, |m| has(m, &[error])));
        slope = slope.max(worst(&need, &bound.low, |m| has(m, &d)));
        let others = [&[numerator, error], &d[..]].concat();
        root = root.max(worst(&need, &bound.low, |m| !has(m, &others)));
    }
    let in_u = |part: f64, constant: f64| part * constant / U;
    Derived {
        parts: [part_of_e, part_of_t],
        constants: [
            in_u(sums, constants.sums),
            in_u(cross, constants.cross),
            in_u(square, constants.square / U),
            in_u(slope, constants.slope),
            in_u(root, constants.root),
            in_u(t, constants.t),
        ],
        error: error_part,
    }
}

/// b -+ sqrt D, which per_a is multiplied by.
fn numerators(graph: &[Operation], estimate: &Estimate<Recorded>) -> [usize; 2] {
    [estimate.near, estimate.far].map(|(t, _)| match graph[t.0] {
        Operation::Product(numerator, _) => numerator,
        _ => unreachable!("t is a product"),
    })
}

type Powers<'a> = &'a [(Symbol, i32)];

/// The largest part that a term of a class needs of what there is of it.
fn worst(need: &Polynomial, have: &Polynomial, class: impl Fn(Powers<'_>) -> bool) -> f64 {
    let of_class = need.terms().filter(|(monomial, _)| class(monomial.powers()));
    of_class.map(|(monomial, need)| need / have.coefficient(monomial.powers())).fold(0.0, f64::max)
}

#[test]
fn constants_are_no_smaller_than_what_the_source_needs() {
    let derived = derive(&Constants::PROVEN);
    println!("{derived:?}");
    assert!(derived.holds(), "{derived:?}");
    // As published in `docs/proofs.md`.
    for (found, published) in derived.constants.into_iter().zip([4.0, 6.0, 9.0, 4.0, 1.0, 8.0]) {
        assert!((found - published).abs() < 1e-6, "{derived:?}");
    }
    assert!((derived.error - 0.8).abs() < 1e-6, "{derived:?}");
}

/// The control: half of any constant is less than what is needed, but for that of G^2, a quarter of which is.
#[test]
fn smaller_constants_and_longer_formulas_are_refused() {
    type Set = fn(&mut Constants) -> &mut f64;
    let sets: [(&str, Set); 6] = [
        ("sums", |c| &mut c.sums),
        ("cross", |c| &mut c.cross),
        ("square", |c| &mut c.square),
        ("slope", |c| &mut c.slope),
        ("root", |c| &mut c.root),
        ("t", |c| &mut c.t),
    ];
    for (name, set) in sets {
        let mut constants = Constants::PROVEN;
        *set(&mut constants) /= 2.0;
        assert_eq!(derive(&constants).holds(), name == "square", "half of {name}");
        *set(&mut constants) /= 2.0;
        assert!(!derive(&constants).holds(), "a quarter of {name}");
    }
    let longer = derive_of(&Constants::PROVEN, |radius| radius * radius / radius);
    assert!(!longer.holds(), "two operations more: {longer:?}");
}
