//! What bounds need, derived from the source: its formulas record themselves, and their roundings are summed.

pub(super) mod boxes;
pub(super) mod estimate;
pub(super) mod filter;
pub(super) mod frustum;
pub(super) mod leaves;
pub(super) mod range_limits;
pub(super) mod tiers;

use super::recorded::{Operation, Recorded};
use super::running_error::{Input, RunningError};
use crate::accuracy::RayLanes;
use std::vec::Vec;

/// u of single precision.
pub(super) const U: f64 = 1.0 / 16_777_216.0;

/// A ray, a sphere, and a witness of them.
const NAMES: [&str; 10] = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];
const WITNESS: [f64; 10] = [0.0, 0.1, 0.2, 1.0, 0.5, 0.25, 3.0, 2.0, 1.0, 1.5];

/// A ray without an interval.
fn ray(origin: [Recorded; 3], direction: [Recorded; 3]) -> RayLanes<Recorded> {
    RayLanes { origin, direction, t_min: origin[0], t_max: direction[0], live: true }
}

/// Rules of single precision for inputs without errors.
fn rules<const N: usize>(names: [&'static str; N]) -> RunningError {
    rules_of(names, &[], &[])
}

/// Rules of single precision for inputs of which some are rounded once, and some are not below zero.
fn rules_of<const N: usize>(
    names: [&'static str; N],
    rounded: &[&str],
    positive: &[&str],
) -> RunningError {
    let inputs = names.map(|name| Input {
        off: if rounded.contains(&name) { U } else { 0.0 },
        positive: positive.contains(&name),
        ..Input::named(name)
    });
    RunningError::new(24, &inputs)
}

/// The first node of a graph that is looked for.
fn find(graph: &[Operation], wanted: impl Fn(Operation) -> bool) -> usize {
    let found = graph.iter().position(|operation| wanted(*operation));
    found.expect("what is looked for is recorded")
}

/// The sum whose first term is that node.
fn sum_of(graph: &[Operation], first: usize) -> usize {
    find(graph, |operation| matches!(operation, Operation::Sum(a, _) if a == first))
}

/// The roots of a graph, in their order.
fn roots(graph: &[Operation]) -> Vec<usize> {
    let is_root = |node: &usize| matches!(graph[*node], Operation::Root(_));
    (0..graph.len()).filter(is_root).collect()
}

/// Names the first differences of a graph, in their order.
fn name_differences(rules: &mut RunningError, graph: &[Operation], names: &[&'static str]) {
    let is_difference = |node: &usize| matches!(graph[*node], Operation::Difference(..));
    for (name, node) in names.iter().zip((0..graph.len()).filter(is_difference)) {
        rules.name(node, name);
    }
}

/// The operands of a node: of a sum, difference or product; an operation with one operand has it
/// twice.
fn operands(graph: &[Operation], node: usize) -> [usize; 2] {
    match graph[node] {
        Operation::Sum(a, b) | Operation::Difference(a, b) => [a, b],
        Operation::Product(a, b) | Operation::Quotient(a, b) => [a, b],
        Operation::Larger(a, _) | Operation::Root(a) => [a, a],
        other => unreachable!("{other:?} at {node}"),
    }
}
