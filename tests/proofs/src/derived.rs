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
    RunningError::new(24, &names.map(Input::named))
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
