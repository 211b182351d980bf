//! The rules against numbers: at every node of a recorded formula what single precision computes is between the
//! polynomials `low` and `high`, and within `error` of what double precision does, for random inputs.

use super::{Input, RunningError};
use crate::proofs::climb::Random;
use crate::proofs::recorded::{Operation, Recorded, record};
use std::println;
use std::vec::Vec;

/// What is computed at every node, and the truth.
fn values(graph: &[Operation], inputs: &[f32]) -> Vec<(f32, f64)> {
    let mut values: Vec<(f32, f64)> = Vec::new();
    for operation in graph {
        let of = |node: usize| values[node];
        let two = |a, b, single: fn(f32, f32) -> f32, double: fn(f64, f64) -> f64| {
            (single(of(a).0, of(b).0), double(of(a).1, of(b).1))
        };
        let value = match *operation {
            Operation::Input(number) => (inputs[number], f64::from(inputs[number])),
            Operation::Constant(number) => (number as f32, number),
            Operation::Sum(a, b) => two(a, b, |a, b| a + b, |a, b| a + b),
            Operation::Difference(a, b) => two(a, b, |a, b| a - b, |a, b| a - b),
            Operation::Product(a, b) => two(a, b, |a, b| a * b, |a, b| a * b),
            Operation::Quotient(a, b) => two(a, b, |a, b| a / b, |a, b| a / b),
            Operation::Larger(a, b) => two(a, b, f32::max, f64::max),
            Operation::Root(a) => (of(a).0.sqrt(), of(a).1.sqrt()),
            Operation::Negated(a) => (-of(a).0, -of(a).1),
            Operation::Magnitude(a) => (of(a).0.abs(), of(a).1.abs()),
        };
        values.push(value);
    }
    values
}

/// The part of an error that is used at most, by nodes whose error is known, and how many comparisons there were; a
/// formula is left out where it has no root.
fn used<const N: usize>(
    bits: u32,
    formula: impl Fn([Recorded; N]),
    draw: impl Fn(&mut Random) -> [f32; N],
) -> (f64, u32) {
    let mut random = Random(81);
    let witness = draw(&mut random).map(f64::from);
    let ((), graph) = record(witness, formula);
    let names = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10"];
    let inputs: Vec<Input> = names[..N].iter().map(|name| Input::named(name)).collect();
    let mut rules = RunningError::new(bits, &inputs);
    rules.run(&graph);
    let (mut worst, mut count) = (0.0_f64, 0);
    for _ in 0..10_000 {
        let values = values(&graph, &draw(&mut random));
        if values.iter().any(|(single, double)| !single.is_finite() || !double.is_finite()) {
            continue;
        }
        let magnitude = |symbol| f64::from(values[rules.nodes[&symbol]].0.abs());
        for ((single, double), bound) in values.iter().zip(&rules.bounds) {
            let single = f64::from(*single);
            let Some(error) = &bound.error else { continue };
            let [low, high, error] =
                [&bound.low, &bound.high, error].map(|bound| bound.value(magnitude));
            // Doubles are off, too, by some 2^-50.
            let (size, off) = (single.abs(), (single - double).abs() - high * 1e-14);
            assert!(bits > 24 || low * (1.0 - 1e-12) <= size && size <= high * (1.0 + 1e-12));
            count += 1;
            worst = worst.max(if off > 0.0 { off / error } else { 0.0 });
        }
    }
    (worst, count)
}

/// Sums, differences, products, quotients and roots, with what is named, charged and cancelled.
fn formula([a, b, c, d, e, f]: [Recorded; 6]) {
    use crate::Lanes;
    let (x, y, z) = (a - b, c - d, e - f);
    let sum = x * c + y * e + z * a;
    let cross = x * e - z * c;
    let squares = x * x + y * y + z * z;
    let length = Lanes::sqrt(squares);
    let unit = length.like(1.0) / length;
    let inverse = length.like(1.0) / (squares * length);
    let cancels = length * inverse;
    let root = Lanes::sqrt(squares * (c * c) + cross * cross);
    let numerator = sum - root;
    let _ =
        numerator * cancels + (x * unit) * (cross * cross) + numerator.abs() * length.like(11.0);
}

#[test]
fn no_number_is_farther_off_than_the_rules_say() {
    let draw = |random: &mut Random| [(); 6].map(|()| random.wide(-6, 6));
    let all = |bits| used(bits, formula, draw);
    let (worst, count) = all(24);
    println!("{worst:.3} of an error is used, {count} comparisons");
    assert!(0.5 < worst && worst <= 1.0 && count > 250_000, "{worst}, {count}");
    // The control: roundings of half the size.
    assert!(all(25).0 > 1.0);
}
