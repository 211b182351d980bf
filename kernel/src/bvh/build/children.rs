//! How a run of leaves is cut into the children of a node.
//!
//! A node begins with one run of leaves and cuts one run after another in two, always the one
//! that costs most (surface times leaves), until there are sixteen or none is longer than sixteen
//! leaves, so that it makes a node whose children are leaves. In slots that are still free then, runs
//! are opened: their leaves become children of this node, and a ray has one node less to look into;
//! first the run that saves most a slot (surface by leaves, less one), if all of it finds room.
//! (Cut until all sixteen slots are taken, nodes had 3.3 children on 10,000 uniform spheres, now
//! 10.6, and rays look into 0.7 as many.)
//!
//! # Depth
//!
//! Of a node's m leaves let q = m/8, rounded up, but at least sixteen, and let a run of s leaves
//! *want* s/q, rounded up, less one, cuts: seven at most at the beginning, zero once no run is longer
//! than q. A cut never adds to the sum of what is wanted, since the parts' s/q, rounded up, exceed
//! their sum's by one at most, and one is paid. So as long as more cuts are left than wanted the
//! heuristic chooses; from then on a run longer than q is cut behind q leaves, which takes one off
//! each time. After fifteen cuts no child is longer than q; nor is one where cuts stop before.

use super::bounds::Bounds;
use super::join::Join;
use super::sah_split::Run;
use crate::bvh::node::{BvhLeaf, WIDTH};

/// A run of leaves that will be a child.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) first: usize,
    pub(super) leaves: usize,
    pub(super) bounds: Bounds,
    /// What a ray pays here, except a constant; nothing for a leaf.
    cost: f32,
    /// Whether its leaves become children of the node itself.
    opened: bool,
}

impl Part {
    /// Leaves `first..first + leaves` of all, which hold `count` spheres.
    pub(super) fn new(
        join: &impl Join,
        all: &[BvhLeaf],
        count: usize,
        first: usize,
        leaves: usize,
    ) -> Self {
        let run = all.get(first..first + leaves).unwrap_or(&[]);
        let bounds = Bounds::of(join, run, (count - first * WIDTH).min(leaves * WIDTH));
        let cost = if leaves > 1 { bounds.half_area() * leaves as f32 } else { -1.0 };
        Self { first, leaves, bounds, cost, opened: false }
    }
}

/// Cuts a run of two leaves or more into up to sixteen.
pub(super) fn children(
    join: &impl Join,
    leaves: &mut [BvhLeaf],
    count: usize,
    whole: Part,
) -> ([Part; WIDTH], usize) {
    let mut parts = [whole; WIDTH];
    let longest = whole.leaves.div_ceil(8).max(WIDTH);
    for number in 1..WIDTH {
        let (made, rest) = parts.split_at_mut(number);
        let Some((part, forced)) = next_to_cut(made, longest) else { return (parts, number) };
        let Part { first, leaves: length, bounds, opened, .. } = *part;
        let mut run = Run {
            leaves: leaves.get_mut(first..first + length).unwrap_or(&mut []),
            count: (count - first * WIDTH).min(length * WIDTH),
        };
        let cut = if forced { run.split_at(longest, &bounds) } else { run.split(join, &bounds) };
        *part = Part { opened, ..Part::new(join, leaves, count, first, cut) };
        if let Some(place) = rest.first_mut() {
            let behind = Part::new(join, leaves, count, first + cut, length - cut);
            *place = Part { opened, ..behind };
        }
    }
    (parts, WIDTH)
}

/// Which of a node's parts is cut next, and whether behind `longest` leaves; `None` if they are best
/// left as they are.
fn next_to_cut(parts: &mut [Part], longest: usize) -> Option<(&mut Part, bool)> {
    let free = WIDTH - parts.len();
    // At least one: nothing divides by zero.
    let longest = longest.max(1);
    let wanted = |part: &Part| part.leaves.div_ceil(longest) - 1;
    let forced = parts.iter().map(wanted).sum::<usize>() >= free;
    let least = if forced { longest } else { WIDTH };
    let is_cut = |part: &Part| part.leaves > least || part.opened && part.leaves > 1;
    if !parts.iter().any(is_cut) {
        // What a slot saves.
        let saved = |part: &Part| part.bounds.half_area() / (part.leaves - 1) as f32;
        let fits = parts.iter_mut().filter(|part| part.leaves > 1 && part.leaves - 1 <= free);
        fits.max_by(|a, b| saved(a).total_cmp(&saved(b)))?.opened = true;
    }
    let candidates = parts.iter_mut().filter(|part| is_cut(part));
    Some((candidates.max_by(|a, b| a.cost.total_cmp(&b.cost))?, forced))
}
