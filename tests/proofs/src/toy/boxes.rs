//! Boxes and leaves over toy floats never leave out the answer of a ray, for all rays and spheres of small sets, in a
//! plane.
//!
//! Margins are up to 48 u, so that floats of five bits would leave nothing to be tested: numbers are integers
//! of few bits, and the floats have ten. The answer is the root, rounded as `Exact` does.
//!
//! Rays that are moved, from far away, have twelve bits: the 2^-11 T of their error covers 2 u T from there on. The
//! build of the tree is written for `f32` alone, and repeated here.

use super::case::Case;
use super::pairs;
use crate::accuracy::Squares;
use crate::bvh::build::bounds::PAD;
use crate::bvh::node::{BvhNode, NO_CHILD};
use crate::bvh::traverse::deferred::RayPlace;
use crate::bvh::traverse::prepared_packet::PreparedPacket;
use crate::bvh::traverse::prepared_ray::PreparedLanes;
use crate::bvh::traverse::ray_state::RayState;
use crate::bvh::traverse::root_interval::Pass;
use crate::numeric::rounding::U;
use crate::proofs::toy::floats::{Format, Toy};
use crate::query::ClosestHit;
use std::println;

formats! {
    Fused: 10, Self, FUSED: bool = true;
    Unfused: 10, Self;
    Sixteenth: 10, Self, MARGIN: f64 = 0.0625;
    Without: 10, Self, MARGIN: f64 = 0.001;
    FarFused: 12, Self, FUSED: bool = true;
    FarUnfused: 12, Self;
    FarWithout: 12, Self, MARGIN: f64 = 0.001;
}

/// The pad of a box.
const PAD_IN_U: f64 = (PAD / U) as f64;
/// Before a scene of extent `ENDLESS` no ray is moved; `EXTENT` is that of the scenes here.
const ENDLESS: f32 = 1_048_576.0;
const EXTENT: f32 = 2048.0;

impl Case {
    /// A box that holds the sphere, farther out by `pad` u of its size, as the build makes it.
    fn node<F: Format>(&self, pad: f64) -> BvhNode {
        let (c, r) = (self.c.map(|x| x as f64), self.r as f64);
        let step = |x: f64, sign: f64| F::round(x + sign * x.abs().max(1e-9) * F::U * 1.01);
        let low = [0, 1, 2].map(|i| step(F::round(c[i] - r), -1.0));
        let high = [0, 1, 2].map(|i| step(F::round(c[i] + r), 1.0));
        let largest = low.iter().chain(&high).fold(0.0_f64, |most, x| most.max(x.abs()));
        let pad = F::round(pad * F::U * largest);
        let mut node = BvhNode::EMPTY;
        for i in 0..3 {
            node.low[i][0] = step(F::round(low[i] - pad), -1.0) as f32;
            node.high[i][0] = step(F::round(high[i] + pad), 1.0) as f32;
        }
        node.child[0] = 0;
        node
    }

    /// Whether a ray whose interval is no more than that answer enters the box.
    fn enters<F: Format>(&self, extent: f32, t: f64, pad: f64) -> bool {
        let mut packet = PreparedPacket::<[f32; 1]>::NONE;
        packet.prepare(&self.rays::<F>([t, t]), 1.0, extent, (0.0, Squares::None));
        let mut state = RayState::NEW;
        state.begin(&packet, 0, RayPlace::FIRST, 0);
        state.stack.clear();
        let node = self.node::<F>(pad);
        state.enter::<Toy<F>, ClosestHit>((), &packet, (0, &node));
        state.stack.pop(&[node]) != NO_CHILD
    }

    /// What a leaf gets wrong of an answer t, one bit each: the ray with no more than that answer sees no candidate;
    /// its entry is later; a bound is sooner, or there is a bound without an answer.
    fn leaf<F: Format>(&self, extent: f32, interval: [f64; 2], roots: Option<[f64; 2]>) -> u32 {
        let rays = self.rays::<F>(interval);
        let prepared = PreparedLanes::of_any_length(&rays, 1.0, Some(extent));
        // In multiples of the direction as it was given.
        let shift = prepared.time.shift.get() / prepared.time.per_t.get();
        assert_eq!(shift > 0.0, extent < ENDLESS, "{self:?}");
        let (center, radius) = self.sphere::<F>();
        let PreparedLanes { origin, direction, absolute_error, .. } = prepared;
        let pass = Pass::new(origin, direction, absolute_error, center, radius);
        let zero = Toy::new(0.0);
        let found = pass.root_interval::<false>(prepared.start, prepared.end, zero, 0.0);
        let may = pass.may_hit::<false>(prepared.start[0], prepared.end[1], 0.0);
        let accepted = |t: &f64| (interval[0]..=interval[1]).contains(&F::round(*t));
        let answer = roots.and_then(|roots| roots.into_iter().find(accepted));
        let Some(root) = answer else {
            return u32::from(found.bound.get() < f64::INFINITY) << 2;
        };
        // Of a ray that was moved the ends of the interval have the error of t; entry and bound are a root's.
        let t = if shift == 0.0 { F::round(root) } else { root };
        let length = (self.truth().a as f64).sqrt();
        let [s, root] = [t, root].map(|t| (t - shift) * length);
        // What doubles may be off.
        let hair = (root.abs() + shift * length) * 1e-12;
        u32::from(!found.candidates || !may)
            | u32::from(found.entry.get() > s.min(root) + hair) << 1
            | u32::from(found.bound.get() < s.max(root) - hair) << 2
    }
}

/// What is done with each case, in a scene of some extent.
type Each<'a> = &'a mut dyn FnMut(&Case, f32);

/// All cases of those rays and centres: radii are about the distance of the line, so that lines are tangents, or miss or
/// meet by little.
fn cases(o: [i64; 2], d: [i64; 2], centers: &[i64], extent: f32, each: Each<'_>) {
    for (cx, cy) in pairs(centers, centers) {
        let across = Case::in_plane(o, d, [cx, cy], 0).truth().distance().ceil() as i64;
        for more in [-1, 0, 1, 3, across / 64, across / 8, across] {
            if (0..1024).contains(&(across + more)) {
                each(&Case::in_plane(o, d, [cx, cy], across + more), extent);
            }
        }
    }
}

/// Directions into every quadrant.
fn directions() -> impl Iterator<Item = [i64; 2]> {
    pairs(&[4, 5, 6, 7], &[-6, -3, 0, 1, 2, 3, 5, 7]).flat_map(|(x, y)| [[x, y], [y, -x]])
}

/// Near the origin.
fn all(each: Each<'_>) {
    let centers = [-1021, -777, -100, -3, 0, 1, 2, 33, 101, 701, 999];
    for d in directions() {
        for o in [[0, 0], [37, 0], [-1023, 513], [0, -5], [-511, 37]] {
            cases(o, d, &centers, ENDLESS, each);
        }
    }
}

/// From far away: the ray is moved.
fn far(each: Each<'_>) {
    for d in directions() {
        // Lines beside the coordinates' origin have origins of more bits than few: a multiple of 64.
        for (away, [ox, oy]) in
            pairs(&[1 << 14, 3 << 14, 1 << 16], &[[0, 0], [64, -192], [-1024, 512]])
        {
            let o = [ox - away * d[0], oy - away * d[1]]
                .map(|x| Toy::<FarFused>::new(x as f64).get() as i64);
            cases(o, d, &[-1021, -100, -3, 0, 2, 33, 701], EXTENT, each);
        }
    }
}

/// Answers, and those whose box is not entered.
fn boxes<F: Format>(pad: f64, set: fn(Each<'_>)) -> [u64; 2] {
    let mut counts = [0; 2];
    set(&mut |case, extent| {
        let truth = case.truth();
        for root in truth.roots(|root| truth.about(root)).into_iter().flatten() {
            counts[0] += 1;
            counts[1] += u64::from(!case.enters::<F>(extent, F::round(root), pad));
        }
    });
    counts
}

/// Answers, and what leaves get wrong of them: [`Case::leaf`].
fn leaves<F: Format>(set: fn(Each<'_>)) -> (u64, [u64; 3]) {
    let (mut count, mut wrong) = (0, [0; 3]);
    set(&mut |case, extent| {
        let truth = case.truth();
        // As real numbers: doubles are that, beside floats of ten bits.
        let roots = truth.roots(|root| truth.about(root));
        let [near, far] = roots.map_or([0.0, 1.0], |roots| roots.map(F::round));
        let behind = near + near.abs() * 2.1 * F::U;
        let all = f64::INFINITY;
        for interval in
            [[near, near], [far, far], [-all, all], [near, far], [0.0, near], [behind, all]]
        {
            count += 1;
            let found = case.leaf::<F>(extent, interval.map(F::round), roots);
            for (bit, wrong) in wrong.iter_mut().enumerate() {
                *wrong += u64::from(found >> bit & 1);
            }
        }
    });
    (count, wrong)
}

#[test]
fn no_box_of_an_answer_is_passed() {
    for (name, [answers, passed]) in [
        ("fused", boxes::<Fused>(PAD_IN_U, all)),
        ("not fused", boxes::<Unfused>(PAD_IN_U, all)),
        ("from afar, fused", boxes::<FarFused>(PAD_IN_U, far)),
        ("from afar, not fused", boxes::<FarUnfused>(PAD_IN_U, far)),
    ] {
        println!("{name}: {answers} answers, {passed} passed");
        assert!(passed == 0 && answers > 100_000, "{name}: {passed} of {answers}");
    }
    // Either pad covers for the other: without both, boxes are passed.
    let [_, passed] = boxes::<Without>(0.0, all);
    let [_, from_afar] = boxes::<FarWithout>(0.0, far);
    println!("without pads: {passed} passed, {from_afar} from afar");
    assert!(passed > 0 && from_afar > 0, "no box is hard");
}

#[test]
fn no_leaf_loses_an_answer() {
    for (name, (tests, wrong)) in [
        ("fused", leaves::<Fused>(all)),
        ("not fused", leaves::<Unfused>(all)),
        ("from afar, fused", leaves::<FarFused>(far)),
        ("from afar, not fused", leaves::<FarUnfused>(far)),
    ] {
        println!("{name}: {tests} tests, wrong {wrong:?}");
        assert!(wrong == [0; 3] && tests > 100_000, "{name}: {wrong:?} of {tests}");
    }
    let (_, wrong) = leaves::<Sixteenth>(all);
    println!("with a sixteenth of the margins: {wrong:?}");
    assert!(wrong.iter().all(|wrong| *wrong > 0), "nothing is hard: {wrong:?}");
}
