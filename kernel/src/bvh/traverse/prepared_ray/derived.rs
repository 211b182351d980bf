//! The pads of boxes as they follow from the source: a slab is entered no later than the answer, at the corner that
//! is farther out by 40 u C, with 2 absolute errors more of the ray's.
//!
//! How far off o' and the answer are, 31 u C and 8 u F, is taken from the text.

extern crate std;

use super::super::ray_state::RayState;
use super::PreparedPacket;
use crate::accuracy::RayLanes;
use crate::bvh::node::BvhNode;
use crate::query::ClosestHit;
use crate::testing::polynomial::Symbol;
use crate::testing::recorded::{Operation, Recorded, record};
use crate::testing::running_error::{Input, RunningError};
use std::println;

const U: f64 = 1.0 / 16_777_216.0;

/// The box is farther out by 40 u C.
const BOX_PAD: f64 = 40.0;
/// By how much the answer may be outside of the box, of C; and of F, with o'.
const OUTSIDE: [f64; 2] = [31.0, 8.0];

/// In u: what the roundings of a slab come to, of C and of F, and the pad of the ray, of F.
#[derive(Clone, Copy, Debug)]
struct Derived {
    of_box: f64,
    of_ray: f64,
    pad: f64,
}

impl Derived {
    fn holds(&self) -> bool {
        self.of_box + OUTSIDE[0] < BOX_PAD && self.of_ray + OUTSIDE[1] < self.pad
    }
}

/// With that multiple of u in the place of the 8 of the absolute error.
fn derive(multiple: f64) -> Derived {
    let names = ["ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max", "low", "high"];
    let witness = [-9.0, -8.0, -7.0, 1.0, 0.5, 0.25, 0.0, 100.0, 1.0, 2.0];
    let (low, mut graph) = record(witness, |[ox, oy, oz, dx, dy, dz, t_min, t_max, low, high]| {
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let rays = RayLanes { origin, direction, t_min, t_max, live: true };
        let mut packet = PreparedPacket::<[f32; 1]>::none();
        packet.prepare::<Recorded>(&rays, 1.0, 1e12, 0.0);
        let mut node = BvhNode::EMPTY;
        (node.low[0][0], node.high[0][0]) = (low.tag(), high.tag());
        let mut state = RayState::NEW;
        state.enter::<Recorded, ClosestHit>((), &packet, (0, &node));
        low
    });
    for operation in &mut graph {
        if *operation == Operation::Constant(8.0 * U) {
            *operation = Operation::Constant(multiple * U);
        }
    }

    let find = |wanted: &dyn Fn(&Operation) -> bool| {
        graph.iter().position(wanted).expect("what is looked for is recorded")
    };
    // The largest coordinate of the origin, and 8 u of it; 1 / |d|, which is the first division.
    let pair = find(&|operation| matches!(operation, Operation::Larger(..)));
    let far = find(&|operation| matches!(*operation, Operation::Larger(a, _) if a == pair));
    let product = find(&|operation| matches!(*operation, Operation::Product(a, _) if a == far));
    let absolute_error =
        find(&|operation| matches!(*operation, Operation::Sum(a, _) if a == product));
    let per_length = find(&|operation| matches!(operation, Operation::Quotient(..)));
    // low * inverse, and what is subtracted from it.
    let product = find(&|operation| matches!(*operation, Operation::Product(a, _) if a == low.0));
    let entry = find(&|operation| matches!(*operation, Operation::Sum(a, _) if a == product));

    let mut rules = RunningError::new(24, &names.map(Input::named));
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
    let pad = 2.0 * rules.bound(absolute_error).low.coefficient(&[(far, 1)]) / U;
    Derived { of_box: of(low), of_ray: of(origin) + of(far), pad }
}

#[test]
fn pads_are_no_smaller_than_what_the_source_needs() {
    let derived = derive(8.0);
    println!("{derived:?}");
    assert!(derived.holds(), "{derived:?}");
    // As published in `docs/proofs.md`.
    let Derived { of_box, of_ray, pad } = derived;
    for (found, published) in [(of_box, 4.0), (of_ray, 5.0), (pad, 16.0)] {
        assert!((found - published).abs() < 1e-4, "{derived:?}");
    }
    // The control.
    assert!(!derive(6.0).holds(), "{:?}", derive(6.0));
}
