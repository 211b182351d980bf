//! One ray's way through the tree.
//!
//! A ray takes a box from its stack. Those of a node's children that it enters go onto the stack, the nearest on top;
//! the tier tests each sphere of a leaf. A box that the ray enters past the closest hit is skipped.

use super::boxes::ROWS;
use super::order::index_in;
use super::shape::{HIGHEST, Place, WIDTH};
use super::tree::Bvh4;
use crate::Accuracy;
use crate::accuracy::{RayLanes, Squares, TierFormula, TierWork};
use crate::bvh::traverse::prepared_packet::PreparedPacket;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::linear::meet_sphere;
use crate::numeric::axes::axes;
use crate::numeric::rounding::{least, most};
use crate::query::Query;

/// Answers every ray, in one lane of the caller's.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    tree: &Bvh4<'_>,
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    if L::COUNT > 1 {
        lane_by_lane::<L::Array, Q>(tier, tree, rays, answers);
        return;
    }
    for (packet, answer) in rays.iter().zip(answers.iter_mut()) {
        *answer = Q::none::<L::Array>();
        tier.with_formula(Walk::<L, Q> { token, tree, packet, answer });
    }
}

/// Answers every ray of wider packets, in one lane.
#[inline(always)]
pub(crate) fn lane_by_lane<A: LaneArray, Q: Query>(
    tier: impl Accuracy,
    tree: &Bvh4<'_>,
    rays: &[RayPacket<A>],
    answers: &mut [Q::Packet<A>],
) {
    for (packet, answer) in rays.iter().zip(answers.iter_mut()) {
        *answer = Q::none::<A>();
        for lane in 0..A::COUNT {
            let packet = &RayPacket::new(&[packet.ray(lane)]);
            let mut one = Q::none::<[f32; 1]>();
            tier.with_formula(Walk::<f32, Q> { token: (), tree, packet, answer: &mut one });
            Q::put(answer, lane, Q::one(&one, 0));
        }
    }
}

/// The packet of one ray, and its answer.
struct Walk<'a, L: Lanes, Q: Query> {
    token: L::Token,
    tree: &'a Bvh4<'a>,
    packet: &'a RayPacket<L::Array>,
    answer: &'a mut Q::Packet<L::Array>,
}

impl<L: Lanes, Q: Query> TierWork for Walk<'_, L, Q> {
    type Output = ();

    #[inline(always)]
    fn run<F: TierFormula>(self) {
        let Self { token, tree, packet, answer } = self;
        let rays = RayLanes::<L>::load(token, packet);
        if !rays.live.any() {
            return;
        }
        let mut ray = PreparedPacket::<L::Array>::NONE;
        // No root is sure before its sphere is tested, so that it need not be known which squares overflow.
        let of_tier = (F::SPREAD, Squares::None);
        ray.prepare::<L>(&rays, tree.boxes.scale.factor, tree.extent, of_tier);
        let tested = F::prepare(&rays);
        let mut limits = Q::limits::<L>(token, answer);
        let (mut stack, mut slabs) = (Stack::EMPTY, Slabs::new(&ray));

        // First come the spheres that no box has: all of them where the bounds do not cover the ray.
        let inside = tree.boxes.shape.count;
        let mut run = [0, tree.valid];
        if ray.covered != 0 {
            run = [inside, tree.valid];
            if inside > 0 {
                stack.push(0, tree.boxes.shape.root(), slabs.start);
            }
        }
        loop {
            let [begin, end] = run;
            for place in begin..end {
                let Some(&word) = tree.order.get(place as usize) else { break };
                let index = index_in(word);
                if let Some(sphere) = tree.boxes.spheres.get(index as usize) {
                    let rays = (packet, &rays, &tested);
                    let (spheres, sphere) = (&tree.boxes.spheres, (sphere, index));
                    limits = meet_sphere::<F, L, Q, false>(
                        rays,
                        spheres,
                        sphere,
                        L::mask(token, 1),
                        limits,
                        answer,
                    );
                    if Q::ANY && Q::done::<L>(token, answer).any() {
                        return;
                    }
                }
            }
            if !Q::ANY {
                slabs.end =
                    least(ray.time(0).after(limits.store().get(0)) + slabs.spread, slabs.end);
            }
            match next_leaf(tree, &slabs, &mut stack) {
                Some(leaf) => run = tree.boxes.shape.run(leaf),
                None => return,
            }
        }
    }
}

/// Takes boxes from the stack, and puts those of their children onto it, until one is a leaf.
#[inline(always)]
fn next_leaf(tree: &Bvh4<'_>, slabs: &Slabs, stack: &mut Stack) -> Option<Place> {
    while let Some((place, entry)) = stack.pop() {
        if entry > slabs.end {
            continue;
        }
        if place.height == 0 {
            return Some(place);
        }
        let Some(rows) = tree.node(place) else { continue };
        let base = stack.count;
        let children = tree.boxes.shape.of_height(place.height.wrapping_sub(1));
        for slot in 0..WIDTH {
            let child = place.child(slot);
            if child.number >= children {
                break;
            }
            let [entry, leave] = slabs.meet(rows, slot);
            if entry <= leave {
                stack.push(base, child, entry);
            }
        }
    }
    None
}

/// A ray as boxes see it: [`PreparedPacket`] of one lane.
struct Slabs {
    inverse: [f32; 3],
    minus_near: [f32; 3],
    far: [f32; 3],
    down: [bool; 3],
    /// Boxes that the ray leaves before `start` do not matter, nor those that it enters behind `end`.
    start: f32,
    end: f32,
    /// By how much the spread of a tier moves `start` and `end`.
    spread: f32,
}

impl Slabs {
    #[inline(always)]
    fn new<A: LaneArray>(ray: &PreparedPacket<A>) -> Self {
        let spread = ray.spread.get(0);
        Self {
            inverse: axes!(i => ray.inverse[i].get(0)),
            minus_near: axes!(i => ray.minus_near[i].get(0)),
            far: axes!(i => ray.far[i].get(0)),
            down: axes!(i => ray.down[i] != 0),
            start: ray.start[0].get(0) - spread,
            end: ray.end[1].get(0) + spread,
            spread,
        }
    }

    /// Where the box of a child is entered, and where it or the ray's interval ends.
    #[inline(always)]
    fn meet(&self, rows: &[[u32; WIDTH]; ROWS], slot: usize) -> [f32; 2] {
        let corner = |row: usize| f32::from_bits(rows[row][slot % WIDTH]);
        let [low, high] = [axes!(i => corner(i)), axes!(i => corner(i + 3))];
        let near = axes!(i => if self.down[i] { high[i] } else { low[i] });
        let far = axes!(i => if self.down[i] { low[i] } else { high[i] });
        let entry = axes!(i => near[i] * self.inverse[i] + self.minus_near[i]);
        let leave = axes!(i => far[i] * self.inverse[i] - self.far[i]);
        [
            most(most(entry[0], entry[1]), most(entry[2], self.start)),
            least(least(leave[0], leave[1]), least(leave[2], self.end)),
        ]
    }
}

/// At every height three children wait while the ray is in the fourth; at the lowest all four do. (A power of two, so
/// that the compiler sees that each place is there.)
const PLACES: usize = (3 * HIGHEST + 1).next_power_of_two();

/// The boxes that a ray has yet to look into, and where it enters them.
struct Stack {
    entries: [f32; PLACES],
    places: [u32; PLACES],
    count: usize,
}

impl Stack {
    const EMPTY: Self = Self { entries: [0.0; PLACES], places: [0; PLACES], count: 0 };

    /// Puts a box among those from `base` on, of which the nearest are on top.
    #[inline(always)]
    fn push(&mut self, base: usize, place: Place, entry: f32) {
        let mut at = self.count;
        while at > base {
            let below = at.wrapping_sub(1);
            if self.entries[below % PLACES] >= entry {
                break;
            }
            self.entries[at % PLACES] = self.entries[below % PLACES];
            self.places[at % PLACES] = self.places[below % PLACES];
            at = below;
        }
        self.entries[at % PLACES] = entry;
        self.places[at % PLACES] = place.number << HEIGHT_BITS | place.height;
        self.count += 1;
    }

    /// Takes the box on top.
    #[inline(always)]
    fn pop(&mut self) -> Option<(Place, f32)> {
        self.count = self.count.checked_sub(1)?;
        let (word, entry) = (self.places[self.count % PLACES], self.entries[self.count % PLACES]);
        let place = Place { number: word >> HEIGHT_BITS, height: word & ((1 << HEIGHT_BITS) - 1) };
        Some((place, entry))
    }
}

/// Heights are below 16.
const HEIGHT_BITS: u32 = 4;
