//! How a run of spheres is cut into the children of a node.
//!
//! A node begins with one run and cuts one part after another in two, always the one that costs most (surface times
//! spheres), until there are sixteen or none is longer than what makes a node of leaves. In slots that are still free
//! then, parts are opened: they are cut on, and become leaves of this node, so that a ray has one node less to look
//! into. The part that saves most a slot is opened first, if all of its leaves find room. A leaf is cut where its
//! parts have less surface together. (When parts were cut until all sixteen slots were taken, nodes had 3.3 children
//! on 10,000 uniform spheres.)
//!
//! # Depth
//!
//! For a node of n spheres, let q = n/8, rounded up, but at least 256. Let a part of s spheres *want* s/q, rounded
//! up, less one, cuts: seven at most at the beginning, zero once no part is longer than q. A cut never adds to the
//! sum of what is wanted: the s/q of its two parts, each rounded up, exceed that of the whole by one at most, and one
//! more is taken off, since each part wants one less. So the heuristic chooses as long as more cuts are left than
//! wanted. From then on a part longer than q is cut behind q spheres, which takes one off each time. After fifteen
//! cuts no child is longer than q; nor is one where cuts stop before.

use super::bounds::{Bounds, Corners};
use super::budget::Budget;
use super::join::Join;
use super::run::Run;
use crate::bvh::node::WIDTH;

/// No part that is longer stays whole where the heuristic chooses: what sixteen leaves hold if they are seven eighths
/// full. (With 128 to 256, the surface of nodes and leaves is 0.85 to 0.90 instead of 0.86.)
const OF_LEAVES: usize = 224;
/// A part is opened if there would be room for its leaves even with one sphere more for every so many.
const SLACK: usize = 8;

/// A part that will be a child.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) bounds: Bounds,
    /// What a ray pays for this part, except a constant.
    cost: f32,
    /// How many cuts it wants, so that none of its parts is too long.
    wanted: usize,
    /// Whether its leaves become children of the node itself.
    opened: bool,
    /// Whether it is a leaf that is best left as it is.
    whole: bool,
}

impl Part {
    /// Spheres `first..first + count` of all.
    pub(super) fn new(join: &impl Join, all: &[[f32; 4]], first: usize, count: usize) -> Self {
        let spheres = all.get(first..first + count).unwrap_or_default();
        Self::within(Bounds::of(join, spheres), first, count)
    }

    /// Spheres whose bounds are known.
    fn within(bounds: Bounds, first: usize, count: usize) -> Self {
        Self {
            first,
            count,
            bounds,
            cost: bounds.half_area() * count as f32,
            wanted: 0,
            opened: false,
            whole: false,
        }
    }

    /// Whether all of its spheres are the same.
    pub(super) fn is_one_sphere(&self) -> bool {
        let Corners { low, high } = self.bounds.centers;
        low.to_array() == high.to_array()
    }

    pub(super) fn is_leaf(&self) -> bool {
        self.count <= WIDTH || self.is_one_sphere()
    }
}

/// The parts of a node, and what is left to spend.
pub(super) struct Children {
    pub(super) parts: [Part; WIDTH],
    pub(super) number: usize,
    pub(super) left: Budget,
}

/// Cuts a run that is no leaf into up to sixteen.
pub(super) fn children(
    join: &impl Join,
    all: &mut Run<'_>,
    whole: Part,
    budget: Budget,
) -> Children {
    let mut made = by_heuristic(join, all, whole, budget)
        .unwrap_or_else(|| in_equal_parts(join, all, whole, budget));
    // In the order of their spheres.
    if let Some(parts) = made.parts.get_mut(..made.number) {
        parts.sort_unstable_by_key(|part| part.first);
    }
    made
}

/// Cuts where the heuristic chooses; `None` if that costs more than is there.
fn by_heuristic(
    join: &impl Join,
    all: &mut Run<'_>,
    whole: Part,
    mut left: Budget,
) -> Option<Children> {
    let longest = if leaves(whole.count) > WIDTH {
        whole.count.div_ceil(8).max(WIDTH * WIDTH)
    } else {
        WIDTH
    };
    // `longest` is at least one, so that nothing divides by zero.
    let part = |opened, bounds, first, count: usize| {
        let part = Part { opened, ..Part::within(bounds, first, count) };
        let wanted = if part.is_leaf() { 0 } else { count.div_ceil(longest.max(1)) - 1 };
        Part { wanted, ..part }
    };
    let mut parts = [part(false, whole.bounds, whole.first, whole.count); WIDTH];
    let mut number = 1;
    while number < WIDTH {
        let (made, rest) = parts.split_at_mut(number);
        let Some(Next { part: next, behind, free }) = next_to_cut(made, longest) else { break };
        let Some(next) = made.get_mut(next) else { break };
        let Part { first, count, bounds, opened, .. } = *next;
        let mut run = all.part(first, count);
        // An opened part must find room as leaves.
        let most = if opened { leaves(count) + free } else { usize::MAX };
        let best = if behind.is_some() { None } else { run.best_cut(join, &bounds, most) };
        let (at, [one, other]) = match best {
            Some(cut) => {
                if count <= WIDTH && cut.cost > LEAST_GAIN * bounds.half_area() {
                    next.whole = true;
                    continue;
                }
                left = left.cut(count, cut.first)?;
                (cut.first, run.cut(&bounds, &cut))
            }
            None if count <= WIDTH => {
                next.whole = true;
                continue;
            }
            None => {
                let at = behind.unwrap_or((count / 2).next_multiple_of(WIDTH));
                left = left.cut(count, at)?;
                run.order_about(at, bounds.longest_axis());
                let (one, other) = run.spheres.split_at_checked(at).unwrap_or_default();
                (at, [one, other].map(|spheres| Bounds::of(join, spheres)))
            }
        };
        *next = part(opened, one, first, at);
        if let Some(place) = rest.first_mut() {
            *place = part(opened, other, first + at, count - at);
        }
        number += 1;
    }
    // The node itself.
    left.nodes = left.nodes.checked_sub(1)?;
    Some(Children { parts, number, left })
}

/// A leaf is cut if its parts have less than this share of its surface.
const LEAST_GAIN: f32 = 0.9;

/// Parts of sixteen spheres times a power of sixteen, along the longest axis.
pub(super) fn in_equal_parts(
    join: &impl Join,
    all: &mut Run<'_>,
    whole: Part,
    left: Budget,
) -> Children {
    let mut length = WIDTH;
    while length.saturating_mul(WIDTH) < whole.count {
        length *= WIDTH;
    }
    let mut parts = [whole; WIDTH];
    let (mut number, mut first, end) = (0, whole.first, whole.first + whole.count);
    for place in &mut parts {
        if first >= end {
            break;
        }
        let count = length.min(end - first);
        let mut rest = all.part(first, end - first);
        let bounds = Bounds::of(join, rest.spheres);
        rest.order_about(count, bounds.longest_axis());
        *place = Part::new(join, all.spheres, first, count);
        (first, number) = (first + count, number + 1);
    }
    Children { parts, number, left }
}

/// What is cut next.
struct Next {
    /// Which of the parts.
    part: usize,
    /// Behind how many spheres it is cut, wherever the heuristic would cut it.
    behind: Option<usize>,
    /// How many slots its leaves may take beyond what they need.
    free: usize,
}

/// Which of a node's parts is cut next, so that none is longer than `longest` in the end; `None` if they are best
/// left as they are.
fn next_to_cut(parts: &mut [Part], longest: usize) -> Option<Next> {
    if parts.iter().map(|part| part.wanted).sum::<usize>() >= WIDTH - parts.len() {
        let part = costliest(parts, |part| part.wanted > 0)?;
        return Some(Next { part, behind: Some(longest), free: 0 });
    }
    // An opened part will take a slot a leaf.
    let taken = |part: &Part| if part.opened { leaves(part.count) } else { 1 };
    let free = WIDTH.saturating_sub(parts.iter().map(taken).sum());
    let next = |part| Next { part, behind: None, free };
    let long = OF_LEAVES;
    if let Some(part) = costliest(parts, |part| !part.is_leaf() && part.count > long) {
        return Some(next(part));
    }
    if let Some(part) = costliest(parts, |part| !part.is_leaf() && part.opened) {
        return Some(next(part));
    }
    let parts_are_one = parts.len() == 1;
    // The part that saves most a slot, if there are slots for leaves that are not full.
    let fits = |part: &Part| {
        !part.is_leaf()
            && (leaves(part.count + part.count / SLACK) <= free + 1
                || longest == WIDTH && parts_are_one)
    };
    let saved = |part: &Part| part.bounds.half_area() / (leaves(part.count) - 1).max(1) as f32;
    if let Some(part) = most(parts, fits, saved) {
        if let Some(part) = parts.get_mut(part) {
            part.opened = true;
        }
        return next_to_cut(parts, longest);
    }
    costliest(parts, |part| part.wanted > 0)
        // Then leaves are cut, as long as there are slots.
        .or_else(|| costliest(parts, |part| part.count <= WIDTH && part.count > 1 && !part.whole))
        .map(next)
}

/// The costliest of the parts that are wanted.
fn costliest(parts: &[Part], wanted: impl Fn(&Part) -> bool) -> Option<usize> {
    most(parts, wanted, |part| part.cost)
}

/// Which part that is wanted has most of something.
fn most(
    parts: &[Part],
    wanted: impl Fn(&Part) -> bool,
    of: impl Fn(&Part) -> f32,
) -> Option<usize> {
    let candidates = parts.iter().enumerate().filter(|(_, part)| wanted(part));
    Some(candidates.max_by(|(_, a), (_, b)| of(a).total_cmp(&of(b)))?.0)
}

/// How many leaves so many spheres fill at least.
pub(super) const fn leaves(count: usize) -> usize {
    count.div_ceil(WIDTH)
}
