//! Packets that look the same way, traced through the tree together.
//!
//! # Method
//!
//! Up to four packets - 64 rays of 16 lanes - go down the tree as one group: a node's children are
//! tested against the group's [frustum](super::frustum), not against rays, nearest first; so are the
//! spheres of a leaf, and those inside against the narrower planes of each packet; what is left
//! is tested against the packet's rays, a ray a lane (`packet_state.rs`). The depth beyond which nothing
//! matters shrinks with every hit.
//!
//! A group is traced so if its rays start at t >= 0, run the same way along an axis, and are
//! narrow (`fit.rs`); a run of others goes ray by ray (`bvh/traverse/wavefront.rs`).

use super::fit::Fit;
use super::frustum::Inside;
use super::packet_group::{GROUP, approach, meet_block};
use super::packet_source::PacketSource;
use super::packet_state::PacketState;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::leaf::Leaf;
use crate::bvh::node::{DEPTH, LEAF, NO_CHILD, WIDTH};
use crate::bvh::traverse::stream::{self, StreamMemory};
use crate::bvh::traverse::wavefront;
use crate::bvh::tree::Bvh;
use crate::geometry::ray::RayPacket;
use crate::lanes::{LaneMask, Lanes};
use crate::linear;
use crate::query::Query;
use crate::scale::rays::ScaledRays;
use crate::trace::Coherence;
use core::ops::Range;

/// The widest range of slopes that is traced as one.
const NARROW: f32 = 0.5;
/// How many boxes can wait: fifteen a node on the way, and the last node's.
const STACK: usize = 256;
const _: () = assert!(STACK >= (WIDTH - 1) * DEPTH + WIDTH);
/// When coherence is detected: after so many groups in turn that do not fit, only every so manieth is
/// tried.
const TRIES: usize = 4;

/// Answers every ray: incoherent ones ray by ray; of others the groups that fit together. If coherence is
/// detected, groups that follow many others without a fit are seldom tried.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    (coherence, mut stream): (Coherence, Option<StreamMemory<'_>>),
    mut source: PacketSource<'_, L::Array>,
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = source.count().min(answers.len());
    // What no bound sees is met first, by all packets: all begin with what they have hit of it.
    // (Tiles are made once more below then: such spheres are rare, and whether tiles are whole is told as they are made.)
    if !bvh.outside.is_empty() || coherence == Coherence::Incoherent {
        source.make::<L>(token, 0..count);
    }
    if !bvh.outside.is_empty()
        && let Some(answers) = answers.get_mut(..count)
    {
        let rays = source.packets(0..count);
        linear::traverse_some::<L, Q>(tier, token, &bvh.outside(), rays, answers);
    }
    if coherence == Coherence::Incoherent {
        return by_rays::<L, Q>(tier, token, bvh, stream.as_mut(), (0, count), &source, answers);
    }
    let mut boxes = Boxes::new();
    let nobody = RayPacket::inactive();
    // Groups from `unfit` on have not been answered: they go ray by ray, in one run.
    let (mut at, mut unfit, mut misfits) = (0, 0, 0);
    while at < count {
        let end = (at + GROUP).min(count);
        let are_tiles = source.make::<L>(token, at..end);
        let group = source.packets(at..end);
        let tried = coherence == Coherence::Coherent || misfits < TRIES || misfits % TRIES == 0;
        let mut states = states_of::<L>(token, group, &nobody, bvh.scale.factor);
        let states = states.get_mut(..group.len()).unwrap_or_default();
        let known = answers.get(at..end).unwrap_or_default();
        let tiles = if are_tiles { Some((&source, at..end)) } else { None };
        if tried && boxes.trace::<L, Q>(tier, token, states, known, bvh, tiles) {
            by_rays::<L, Q>(tier, token, bvh, stream.as_mut(), (unfit, at), &source, answers);
            for place in 0..group.len() {
                if let (Some(state), Some(answer)) =
                    (states.get_mut(place), answers.get_mut(at + place))
                {
                    *answer = state.finish::<Q>(tier, bvh);
                }
            }
            (unfit, misfits) = (end, 0);
        } else {
            misfits += 1;
        }
        at = end;
    }
    by_rays::<L, Q>(tier, token, bvh, stream.as_mut(), (unfit, count), &source, answers);
}

/// Answers a run of packets ray by ray.
#[inline(always)]
fn by_rays<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    stream: Option<&mut StreamMemory<'_>>,
    (from, to): (usize, usize),
    source: &PacketSource<'_, L::Array>,
    answers: &mut [Q::Packet<L::Array>],
) {
    if from < to
        && let Some(answers) = answers.get_mut(from..to)
    {
        let rays = source.packets(from..to);
        match stream {
            Some(memory) => stream::traverse::<L, Q>(tier, token, bvh, memory, rays, answers),
            None => wavefront::traverse::<L, Q>(tier, token, bvh, rays, answers),
        }
    }
}

/// The packets of a group; those past its end are `nobody`. (In a loop, or by a function of its own, the kernel takes
/// a twentieth less to compile, and a tenth longer on u10k.)
#[inline(always)]
fn states_of<'a, L: Lanes>(
    token: L::Token,
    rays: &'a [RayPacket<L::Array>],
    nobody: &'a RayPacket<L::Array>,
    factor: f32,
) -> [PacketState<'a, L>; GROUP] {
    let [a, b, c, d] = match *rays {
        [ref a, ref b, ref c, ref d] => [a, b, c, d],
        [ref a, ref b, ref c] => [a, b, c, nobody],
        [ref a, ref b] => [a, b, nobody, nobody],
        [ref a] => [a, nobody, nobody, nobody],
        _ => [nobody; GROUP],
    };
    [
        state_of(token, a, factor),
        state_of(token, b, factor),
        state_of(token, c, factor),
        state_of(token, d, factor),
    ]
}

#[inline(always)]
fn state_of<L: Lanes>(
    token: L::Token,
    packet: &RayPacket<L::Array>,
    factor: f32,
) -> PacketState<'_, L> {
    PacketState::new(packet, &ScaledRays::new(&RayLanes::load(token, packet), factor))
}

/// The boxes that are yet to be looked into, the nearest on top.
struct Boxes {
    depths: [f32; STACK],
    children: [u32; STACK],
    top: usize,
}

impl Boxes {
    #[inline(always)]
    fn new() -> Self {
        Self { depths: [0.0; STACK], children: [NO_CHILD; STACK], top: 0 }
    }

    /// Traces one group, of which the answers outside of the tree are `known`, if there are any; returns false, and
    /// does nothing, if its rays do not look the same way.
    #[inline(always)]
    fn trace<L: Lanes, Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        states: &mut [PacketState<'_, L>],
        known: &[Q::Packet<L::Array>],
        bvh: &Bvh<'_>,
        tiles: Option<(&PacketSource<'_, L::Array>, Range<usize>)>,
    ) -> bool {
        approach(states, bvh.scale.factor, bvh.extent, tier.spread());
        let by_corners = match tiles {
            Some((source, at)) => {
                source.enclose(at, states, (bvh.scale.factor, bvh.extent, tier.spread(), NARROW))
            }
            None => None,
        };
        let (fit, mut frustum) = match by_corners {
            Some(both) => both,
            None => {
                let Some(fit) = Fit::of(states, bvh.extent, tier.spread()) else { return false };
                let Some(frustum) = fit.enclose(states, NARROW) else { return false };
                (fit, frustum)
            }
        };
        if !bvh.outside.is_empty() {
            for place in 0..states.len().min(known.len()) {
                states[place].take_known::<Q>(&known[place]);
            }
            frustum.end = fit.end(states);
        }

        for state in &mut *states {
            state.depth = if state.live.any() { frustum.end } else { f32::NEG_INFINITY };
        }
        self.depths[0] = f32::NEG_INFINITY;
        self.children[0] = bvh.root;
        self.top = 1;
        let mut inside = Inside { places: 0, depths: [0.0; WIDTH] };
        while self.top > 0 {
            self.top -= 1;
            let at = self.top & (STACK - 1);
            let (depth, child) = (self.depths[at], self.children[at]);
            if depth > frustum.end {
                continue;
            }
            if child & LEAF == 0 {
                if let Some(node) = bvh.nodes.get(child as usize) {
                    frustum.enter::<L>(token, node, &mut inside);
                    self.push(&inside, &node.child);
                }
                continue;
            }
            let number = child & !LEAF;
            let Some(Leaf { columns: spheres, lanes }) = bvh.leaf(number) else { continue };
            let mut end = frustum.end;
            let places = frustum.look::<L>(token, &spheres, 0.0) & lanes;
            if places == 0 {
                continue;
            }
            meet_block::<L, Q>(
                tier,
                bvh,
                states,
                (number, &spheres, depth),
                (places, 0.0),
                #[inline(always)]
                |state| fit.end(core::slice::from_ref(state)),
                &mut end,
            );
            frustum.end = end;
        }
        true
    }

    #[inline(always)]
    fn push(&mut self, inside: &Inside, children: &[u32; WIDTH]) {
        let base = self.top;
        let mut places = inside.places;
        while places != 0 {
            let place = places.trailing_zeros() as usize % WIDTH;
            places &= places - 1;
            let depth = inside.depths[place];
            // Sink below what is nearer.
            let mut at = self.top;
            while at > base && self.depths[(at - 1) & (STACK - 1)] < depth {
                self.depths[at & (STACK - 1)] = self.depths[(at - 1) & (STACK - 1)];
                self.children[at & (STACK - 1)] = self.children[(at - 1) & (STACK - 1)];
                at -= 1;
            }
            self.depths[at & (STACK - 1)] = depth;
            self.children[at & (STACK - 1)] = children[place];
            self.top += 1;
        }
    }
}
