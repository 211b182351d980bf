//! The margins of a leaf, derived from the source.
//!
//! The roundings of the middle, of q and of l^2 are summed from the recorded formula. The geometry is put in by hand,
//! as the proof does: the error of the middle is at right angles to l, and l^2 + h^2 = r^2. The errors of o' and of the
//! tiers are taken from the text.
//!
//! The results are polynomials in M = |m|, r and the absolute error: the polynomials of the source must be larger, term
//! by term.

use super::{NAMES, U, WITNESS, name_differences, operands, ray, rules, rules_of};
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::bvh::traverse::root_interval::Pass;
use crate::proofs::polynomial::Polynomial;
use crate::proofs::recorded::{Operation, record};
use crate::proofs::running_error::RunningError;
use crate::scale::rays::ScaledRays;
use std::vec::Vec;

/// What is computed of a line beside a box may be off, in u of the largest |f| times |n_i| + |n_j|. (The right-hand side is off by some
/// u of r: less than the u that is left, where r is below a quarter of |f|; nearer, either an n_i is nearly zero, and roundings keep the
/// order of what is compared, or |n_i| + |n_j| is larger than their length.)
pub(in crate::proofs) fn border() -> f64 {
    let witness = [0.1, 0.2, 0.3, 0.8, 0.6, 0.1, 3.0, 2.0, 1.0, 1.5, 1e-6];
    let ((), graph) = record(witness, |[ox, oy, oz, nx, ny, nz, cx, cy, cz, r, error]| {
        let _ = Pass::new([ox, oy, oz], [nx, ny, nz], error, [cx, cy, cz], r).meets_box();
    });
    let names = ["ox", "oy", "oz", "nx", "ny", "nz", "cx", "cy", "cz", "r", "error"];
    let mut rules = rules_of(names, &["nx", "ny", "nz"], &[]);
    name_differences(&mut rules, &graph, &["fx", "fy", "fz"]);
    rules.run(&graph);
    let is_product = |node: usize| matches!(graph[node], Operation::Product(..));
    let across = (0..graph.len()).filter(|node| match graph[*node] {
        Operation::Difference(a, b) => is_product(a) && is_product(b),
        _ => false,
    });
    let errors: Vec<_> = across.map(|node| rules.bound(node).error()).collect();
    assert_eq!(errors.len(), 3, "two axes at a time");
    let coefficients = errors.iter().flat_map(|error| error.terms().map(|(_, of)| of / U));
    coefficients.fold(0.0, f64::max)
}

/// The formula of a leaf, and its nodes.
struct Leaf {
    graph: Vec<Operation>,
    middle: usize,
    square: usize,
    delta: usize,
    /// r + delta, squared.
    reach: usize,
    /// W.
    slack: usize,
    q: [usize; 3],
}

impl Leaf {
    fn record() -> Self {
        let witness = [0.1, 0.2, 0.3, 0.8, 0.6, 0.1, 3.0, 2.0, 1.0, 1.5, 1e-6, -100.0, 100.0, 0.0];
        let ((pass, interval), graph) = record(witness, |inputs| {
            let [ox, oy, oz, nx, ny, nz, cx, cy, cz, r, error, start, end, raise] = inputs;
            let pass = Pass::new([ox, oy, oz], [nx, ny, nz], error, [cx, cy, cz], r);
            let _ = pass.may_hit::<false>(start, end, 0.0);
            (pass, pass.root_interval::<false>([start; 2], [end; 2], raise, 0.0))
        });
        let operands = |node: usize| operands(&graph, node);
        // entry = middle - long; long = root(max(left + slack, 0)) + delta.
        let [_, long] = operands(interval.entry.0);
        let [root, _] = operands(long);
        let [larger, _] = operands(root);
        let [longest, _] = operands(larger);
        let [_, slack] = operands(longest);
        let squares = (0..graph.len()).filter(|node| match graph[*node] {
            Operation::Product(a, b) => a == b && matches!(graph[a], Operation::Sum(..)),
            _ => false,
        });
        let is_reach = |node: &usize| operands(operands(*node)[0])[1] == pass.delta.0;
        let reach = squares.clone().find(is_reach).expect("the square of r + delta");
        let q = squares.filter(|node| *node < pass.ll.0).map(|node| operands(node)[0]);
        let q: Vec<usize> = q.collect();
        Self {
            middle: pass.middle.0,
            square: pass.ll.0,
            delta: pass.delta.0,
            reach,
            slack,
            q: q.try_into().expect("three components"),
            graph,
        }
    }

    /// With another number in place of a constant.
    fn with(mut self, from: f64, to: f64) -> Self {
        assert!(self.graph.contains(&Operation::Constant(from)), "no constant {from}");
        for operation in &mut self.graph {
            if *operation == Operation::Constant(from) {
                *operation = Operation::Constant(to);
            }
        }
        self
    }

    fn rules(&self) -> RunningError {
        let names = [
            "ox", "oy", "oz", "nx", "ny", "nz", "cx", "cy", "cz", "r", "error", "start", "end",
            "raise",
        ];
        // n is v, rounded.
        let mut rules = rules_of(names, &["nx", "ny", "nz"], &["r", "error"]);
        name_differences(&mut rules, &self.graph, &["fx", "fy", "fz"]);
        rules.name(self.middle, "M");
        for (name, node) in ["qx", "qy", "qz"].into_iter().zip(self.q) {
            rules.name(node, name);
        }
        rules
    }

    /// In u: 1 / |d|; m and q, of |p|, where q is for the m that was computed; l^2 of itself, for the q that was computed.
    fn roundings(&self) -> [f64; 4] {
        let length = length_off();
        let mut rules = self.rules();
        let [f, n] =
            [rules.vector(["fx", "fy", "fz"], "|f|"), rules.vector(["nx", "ny", "nz"], "|n|")];
        rules.run(&self.graph);
        let m = rules.symbol("M");
        let middle = rules.in_lengths(rules.bound(self.middle).error());
        let middle = middle.coefficient(&[(f, 1), (n, 1)]) + middle.coefficient(&[(m, 1)]);

        let mut rules = self.rules();
        rules.free(self.middle);
        rules.run(&self.graph);
        let error = rules.bound(self.q[0]).error();
        // Of f, of m n and of q: all of them |p| at most.
        let q: f64 = error.terms().map(|(_, coefficient)| coefficient).sum();

        let mut rules = self.rules();
        for q in self.q {
            rules.free(q);
        }
        let q_length = rules.vector(["qx", "qy", "qz"], "|q|");
        rules.run(&self.graph);
        let square =
            rules.in_lengths(rules.bound(self.square).error()).coefficient(&[(q_length, 2)]);
        // From p.v to the part of |v|^2 of it.
        let part = 2.0 * length + length * length;
        [length, middle + part, q, square].map(|off| off / U)
    }
}

/// How far off 1 / |d| is, as rays are prepared.
fn length_off() -> f64 {
    let (prepared, graph) = record(WITNESS, |[ox, oy, oz, dx, dy, dz, ..]| {
        PreparedLanes::as_they_are(&ScaledRays::new(&ray([ox, oy, oz], [dx, dy, dz]), 1.0))
    });
    let mut rules = rules(NAMES);
    rules.run(&graph);
    let Operation::Product(_, per_length) = graph[prepared.direction[0].0] else {
        unreachable!("d / |d|")
    };
    let per_length = rules.bound(per_length);
    per_length.error().over(&per_length.low)
}

/// Errors counted of |p| are counted of |f|, |q| and |m n|, as computed: these are no more than this times |p|.
const SECOND: f64 = 1.0 + 64.0 * U;

/// Whether the proof holds with `to` in place of a constant.
pub(in crate::proofs) fn holds(constant: f32, to: f64) -> bool {
    let leaf = Leaf::record().with(constant.into(), to);
    parts(&leaf).iter().all(|part| part * (1.0 + 1e-9) <= 1.0)
}

/// In u: 1 / |d|; m and q, of |p|; l^2 of itself.
pub(in crate::proofs) fn roundings() -> [f64; 4] {
    Leaf::record().roundings()
}

/// For each statement, the part of the margin that is needed by the term that needs most. The statements: a hit passes
/// the test of W; a hit passes the test of r + delta; what passes the test of -W is a hit; half the chord is in its
/// interval; the roots are in their intervals.
fn parts(leaf: &Leaf) -> [f64; 5] {
    let [length, middle, q, square] = leaf.roundings().map(|count| count * U * SECOND);
    let mut rules = leaf.rules();
    rules.run(&leaf.graph);
    let [m, r, error] = ["M", "r", "error"].map(|name| Polynomial::symbol(rules.symbol(name)));
    let [delta, slack, reach] =
        [leaf.delta, leaf.slack, leaf.reach].map(|node| &rules.bound(node).low);

    // l, with the errors of o' and of the tier; |p| <= |m| |v| + l.
    let far = &r + &error.scaled(0.25);
    let p = (&m + &far).scaled(1.0 + 2.0 * middle + 2.0 * length);
    // l^2 as computed, less r^2: (l + q |p|)^2 + (middle |p|)^2, and the roundings of the squares and of r^2.
    let rr = &r * &r;
    let mixed = (&p * &far).scaled(2.0 * q);
    let across = (&p * &p).scaled((middle + q) * (middle + q));
    let more = &(&r * &error).scaled(0.5) + &(&error * &error).scaled(1.0 / 16.0);
    let own = &(&far * &far).scaled(square) + &rr.scaled(U);
    let largest = &(&more + &own) + &(&mixed + &across).scaled(1.0 + square);
    let met = largest.over(slack);
    let may = (&largest + &rr).over(reach);
    // l^2 as computed is no smaller than (r - error / 4 - q |p|)^2.
    let smallest =
        &(&(&r * &error).scaled(0.5) + &rr.scaled(square + U)) + &(&p * &r).scaled(2.0 * q);
    let sure = smallest.over(slack);
    // h^2: r^2 - l^2 and the sum with W are rounded besides.
    let rounded = &rr.scaled(2.0 * U) + &rules.bound(leaf.slack).high.scaled(3.0 * U);
    let chord = (&largest + &rounded).over(slack).max((&smallest + &rounded).over(slack));

    // The ends: the middle; h by |v|, root and sum; the last sum; the tier's t of 24 r + 4 |p|; where o' is.
    let per_p = middle + 4.0 * U;
    let per_h = length + 3.0 * U;
    // |p| <= |m| + l and l^2 + h^2 = r^2.
    let of_r = libm::hypot(per_p, per_h) + 24.0 * U;
    let ends =
        &(&m.scaled(per_p + U) + &r.scaled(of_r)).scaled(SECOND) + &error.scaled(0.25 + per_p);
    let ends = (&ends + &rules.bound(leaf.delta).high.scaled(2.0 * U)).over(delta);
    [met, may, sure, chord, ends]
}
