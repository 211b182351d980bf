//! The pads of boxes: a slab is entered no later than the answer, at the corner that is farther out by the box's pad, with the
//! ray's pad besides.

use super::{U, find, rules, sum_of};
use crate::accuracy::{RayLanes, Squares};
use crate::bvh::node::BvhNode;
use crate::bvh::traverse::prepared_packet::PreparedPacket;
use crate::bvh::traverse::ray_state::RayState;
use crate::proofs::polynomial::Symbol;
use crate::proofs::recorded::{Operation, Recorded, record};
use crate::query::ClosestHit;

/// How far the answer may be outside of the box, in u: of C; and, with o', of F. From the text.
const OUTSIDE: [f64; 2] = [31.0, 8.0];

/// In u: the least pad of C, and of F.
pub(in crate::proofs) fn needs() -> [f64; 2] {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max", "low"];
    let witness = [-9.0, -8.0, -7.0, 1.0, 0.5, 0.25, 0.0, 100.0, 1.0];
    let (low, graph) = record(witness, |[ox, oy, oz, dx, dy, dz, t_min, t_max, low]| {
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let rays = RayLanes { origin, direction, t_min, t_max, live: true };
        let mut packet = PreparedPacket::<[f32; 1]>::NONE;
        packet.prepare::<Recorded>(&rays, 1.0, 1e12, (0.0, Squares::None));
        let mut node = BvhNode::EMPTY;
        (node.low[0][0], node.high[0][0]) = (low.tag(), low.tag());
        let mut state = RayState::NEW;
        state.enter::<Recorded, ClosestHit>((), &packet, (0, &node));
        low
    });
    // The largest coordinate of the origin, and the error that it has; 1 / |d|, which is the first division.
    let pair = find(&graph, |operation| matches!(operation, Operation::Larger(..)));
    let far = find(&graph, |operation| matches!(operation, Operation::Larger(a, _) if a == pair));
    let product = |factor: usize| {
        find(&graph, |operation| matches!(operation, Operation::Product(a, _) if a == factor))
    };
    let absolute_error = sum_of(&graph, product(far));
    let per_length = find(&graph, |operation| matches!(operation, Operation::Quotient(..)));
    // low * inverse, and what is subtracted from it.
    let entry = sum_of(&graph, product(low.0));

    let mut rules = rules(names);
    rules.name(far, "F");
    rules.name(per_length, "1/|d|");
    rules.free(per_length);
    rules.free(absolute_error);
    rules.run(&graph);
    let [d, per, low, origin, far] =
        ["dx", "1/|d|", "low", "ox", "F"].map(|name| rules.symbol(name));
    let error = rules.bound(entry).error();
    // Times |v|, which is d / |d|: as a place along the axis. |o'| is F at most.
    let of = |symbol: Symbol| error.coefficient(&[(symbol, 1), (d, -1), (per, -1)]) / U;
    [of(low) + OUTSIDE[0], of(origin) + of(far) + OUTSIDE[1]]
}
