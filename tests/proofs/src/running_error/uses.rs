//! What nodes of a graph are used for.

use crate::proofs::recorded::Operation;
use std::collections::BTreeSet;
use std::vec::Vec;

/// The node itself, without its sign.
fn magnitude(graph: &[Operation], node: usize) -> usize {
    match graph[node] {
        Operation::Negated(a) | Operation::Magnitude(a) => magnitude(graph, a),
        _ => node,
    }
}

pub(super) fn is_product(graph: &[Operation], node: usize) -> bool {
    matches!(graph[magnitude(graph, node)], Operation::Product(..))
}

/// Nodes that are multiplied.
pub(super) fn factors(graph: &[Operation]) -> BTreeSet<usize> {
    let operands = graph.iter().flat_map(|operation| match *operation {
        Operation::Product(a, b) => [Some(a), Some(b)],
        _ => [None, None],
    });
    operands.flatten().map(|node| magnitude(graph, node)).collect()
}

/// Nodes that are divisors, or factors of divisors.
pub(super) fn divisors(graph: &[Operation]) -> BTreeSet<usize> {
    let mut open: Vec<usize> = graph
        .iter()
        .filter_map(|operation| match *operation {
            Operation::Quotient(_, b) => Some(b),
            _ => None,
        })
        .collect();
    let mut found = BTreeSet::new();
    while let Some(node) = open.pop() {
        found.insert(node);
        if let Operation::Product(a, b) = graph[magnitude(graph, node)] {
            open.extend([a, b]);
        }
    }
    found
}
