//! The packets of a call through the tree: which go down together, and which ray by ray.
//!
//! # Method
//!
//! Packets are tried in groups of four (`tree_group.rs`), since a group that looks the same way does the work of one
//! ray for all of its rays. A group that does not fit, or gives up since it does not pay, is tried packet by packet. Rays
//! of what is left go by themselves (`bvh/traverse/wavefront.rs`), with what their group has learnt, in runs that are as
//! long as can be; or, with memory for it, as a stream. Where tries do not pay, few are made (`patience.rs`): rays that
//! have nothing in common hardly pay for being asked.

use super::packet_group::GROUP;
use super::packet_source::PacketSource;
use super::patience::{LONGEST, LONGEST_IF_COHERENT, PacketPatience, Patience, Places};
use super::tree_group::{Boxes, Ended, states_of};
use crate::Accuracy;
use crate::bvh::traverse::packet_set::{PacketSet, RUN};
use crate::bvh::traverse::stream::{self, Sharing, StreamMemory};
#[cfg(feature = "alloc")]
use crate::bvh::traverse::stream::{KeptMemory, MOST_SORTED};
use crate::bvh::traverse::wavefront;
use crate::bvh::tree::Bvh;
use crate::coherence::Coherence;
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::Lanes;
use crate::linear;
use crate::query::Query;
use core::ops::Range;

/// What a caller says of the rays, memory for streams, and what is learnt of rays.
#[derive(Debug)]
#[cfg_attr(not(feature = "std"), expect(unreachable_pub, reason = "a trait of levels names it"))]
pub struct Ways<'a> {
    pub(crate) coherence: Coherence,
    /// Of the caller's.
    pub(crate) lent: Option<StreamMemory<'a>>,
    /// Taken if none is lent.
    #[cfg(feature = "alloc")]
    pub(crate) kept: &'a mut KeptMemory,
    pub(crate) learnt: &'a mut Learnt,
    /// Of few packets: those that do not go together are left to the caller, a bit each.
    #[cfg(feature = "std")]
    pub(crate) alone: Option<&'a mut u32>,
}

impl Ways<'_> {
    /// Memory for streams of so many rays that go by themselves; what is said to be incoherent gets what is lent alone.
    #[inline(always)]
    fn memory<Q: Query>(&mut self, bvh: &Bvh<'_>, rays: usize) -> Option<StreamMemory<'_>> {
        #[cfg(feature = "alloc")]
        if self.lent.is_none() && self.coherence != Coherence::Incoherent {
            let sharing = &self.learnt.sharing[usize::from(Q::ANY)];
            return self.kept.lend::<Q>(bvh, sharing, rays);
        }
        let _ = (bvh, rays);
        self.lent.as_mut().map(StreamMemory::again)
    }
}

/// So few spheres are met as a list is. (AVX-512 and AVX2, rays that have nothing in common: one takes 0.35 of the time as a
/// list, two 0.7, four 0.8 to 1.0, eight 1.2.)
const LISTED: usize = 4;
/// So many packets at a time, which are still in the nearest cache when they are answered.
const LISTED_PACKETS: usize = 16;

/// Answers every ray: incoherent ones ray by ray; of others the groups and packets that pay together.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    mut ways: Ways<'_>,
    mut source: PacketSource<'_, L::Array>,
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = source.count().min(answers.len());
    let (coherence, is_listed) = (ways.coherence, bvh.spheres.len() <= LISTED);
    // What no bound sees is met first, by all packets: all begin with what they have hit of it.
    // (Tiles are made once more below then: such spheres are rare, and whether tiles are whole is told as they are made.)
    let is_met_first = is_listed | !bvh.outside.is_empty();
    if coherence == Coherence::Incoherent && !is_listed {
        source.make::<L>(token, 0..count);
    }
    if is_met_first {
        let outside = bvh.outside();
        let spheres: &dyn SphereRun = if is_listed { &bvh.spheres } else { &outside };
        let at_once = if is_listed { LISTED_PACKETS } else { count.max(1) };
        let mut from = 0;
        while from < count {
            let to = count.min(from + at_once);
            source.make::<L>(token, from..to);
            if let Some(answers) = answers.get_mut(from..to) {
                let rays = source.packets(from..to);
                linear::traverse_some::<L, Q>(tier, token, spheres, rays, answers);
            }
            from = to;
        }
    }
    if is_listed {
        return;
    }

    let is_coherent = coherence == Coherence::Coherent;
    let longest = if is_coherent { LONGEST_IF_COHERENT } else { LONGEST };
    let mut boxes = Boxes::new();
    // Packets from `from` on are not answered; those before `run` go ray by ray, and nothing is known of them.
    let (mut from, mut run) = (0, 0);
    #[cfg(feature = "alloc")]
    {
        ways.learnt.apart = [0, count];
    }
    while from < count {
        let mut apart = Apart { packets: PacketSet::EMPTY, are_all: true };
        let mut end = count;
        if coherence != Coherence::Incoherent {
            end = count.min(run + RUN);
            let at = run..end;
            let mut together = Together { boxes: &mut boxes, learnt: &mut *ways.learnt, longest };
            together.answer::<L, Q>(tier, token, bvh, (&mut source, at), answers, &mut apart);
        }
        if apart.are_all && end < count {
            run = end;
            continue;
        }
        let whole = if apart.are_all { end } else { run };
        #[cfg(feature = "std")]
        if let Some(alone) = &mut ways.alone {
            for number in from..end {
                let is_alone = number < whole || apart.packets.contains(number - run);
                **alone |= u32::from(is_alone) << (number % 32);
            }
            (from, run) = (end, end);
            continue;
        }
        // One call, since it is compiled where it is called.
        let runs = [(from, whole, None), (whole, end, Some(&apart.packets))];
        for number in 0..runs.len() {
            let (from, to, waiting) = runs[number];
            if let Some(answers) = answers.get_mut(from..to)
                && from < to
                && !waiting.is_some_and(PacketSet::is_empty)
            {
                let rays = (source.packets(from..to), waiting);
                #[cfg(feature = "alloc")]
                {
                    ways.learnt.apart[0] += waiting.map_or(to - from, PacketSet::count);
                }
                let kind = usize::from(Q::ANY) % KINDS;
                let mut sharing = ways.learnt.sharing[kind];
                match &mut ways.memory::<Q>(bvh, L::COUNT * (to - from)) {
                    Some(memory) => {
                        let how = (memory, &mut sharing);
                        stream::traverse::<L, Q>(tier, token, bvh, how, rays, answers);
                    }
                    None => {
                        sharing.pass_over(L::COUNT * (to - from));
                        wavefront::traverse::<L, Q>(tier, token, bvh, rays, answers);
                    }
                }
                ways.learnt.sharing[kind] = sharing;
            }
        }
        (from, run) = (end, end);
    }
}

/// Packets of a run that go ray by ray.
struct Apart {
    packets: PacketSet,
    /// Whether all do, and nothing is known of any.
    are_all: bool,
}

/// Closest hits and any hits learn apart. Together where memory is short: a trace that a firmware copies by a function is
/// 900 bytes of flash.
const KINDS: usize = if cfg!(feature = "alloc") { 2 } else { 1 };

/// What is learnt of rays as they come: which of them pay together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Learnt {
    groups: [Patience; KINDS],
    packets: [PacketPatience; KINDS],
    sharing: [Sharing; KINDS],
    /// Of the last packets how many went by themselves, and how many they were.
    #[cfg(feature = "alloc")]
    apart: [usize; 2],
}

impl Learnt {
    /// Nothing.
    pub(crate) const NOTHING: Self = Self {
        groups: [Patience::NEW; KINDS],
        packets: [PacketPatience::NEW; KINDS],
        sharing: [Sharing::NOTHING; KINDS],
        #[cfg(feature = "alloc")]
        apart: [0; 2],
    };

    /// Begins a call of so many packets.
    #[inline(always)]
    pub(crate) fn begin_call<Q: Query>(&mut self, packets: usize) {
        let (kind, groups) = (usize::from(Q::ANY) % KINDS, packets.div_ceil(GROUP));
        self.groups[kind].begin(groups);
        self.packets[kind].begin(groups);
    }

    /// How many of the next rays, of which there are so many, a call likes to have at once: more than few where some go by
    /// themselves, and a stream of them may pay.
    #[cfg(feature = "alloc")]
    pub(crate) fn many_at_once<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> Option<usize> {
        let [apart, all] = self.apart;
        let sharing = &self.sharing[usize::from(Q::ANY)];
        if SOME * apart < all || all == 0 || !sharing.may_pay::<Q>(bvh, rays) {
            return None;
        }
        let sorts = sharing.may_sort::<Q>(bvh, rays);
        // Of those some may go together as groups: twice as many as go down as a stream.
        let together = 2 * Sharing::together(rays);
        Some(rays.min(if sorts { MOST_SORTED } else { together }))
    }
}

/// One in so many is some.
#[cfg(feature = "alloc")]
const SOME: usize = 4;

/// Packets that go down together.
struct Together<'a> {
    boxes: &'a mut Boxes,
    learnt: &'a mut Learnt,
    /// The most groups that are passed over.
    longest: u8,
}

impl Together<'_> {
    /// Answers the groups and packets of a run that pay; the others are those `apart` then, with answers so far.
    #[inline(always)]
    fn answer<L: Lanes, Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        bvh: &Bvh<'_>,
        (source, run): (&mut PacketSource<'_, L::Array>, Range<usize>),
        answers: &mut [Q::Packet<L::Array>],
        apart: &mut Apart,
    ) {
        let nobody = RayPacket::inactive();
        let kind = usize::from(Q::ANY) % KINDS;
        let mut at = run.start;
        while at < run.end {
            let end = run.end.min(at + GROUP);
            let are_tiles = source.make::<L>(token, at..end);
            let tries_group = self.learnt.groups[kind].tries();
            let (tried_apart, first) = self.learnt.packets[kind].tries();
            let mut ends = [Ended::Unfit; GROUP];
            if tries_group | (tried_apart != 0) {
                let packets = source.packets(at..end);
                let mut states = states_of::<L>(token, packets, &nobody, bvh.scale.factor);
                let states = states.get_mut(..packets.len()).unwrap_or_default();
                let count = states.len();
                // Four together, then each alone: by one call, since it is compiled where it is called.
                let (mut alone, mut waiting) =
                    (!tries_group, tried_apart & !(Places::MAX << count));
                let (mut tried, mut paid, mut in_vain) = (0, 0, 0);
                loop {
                    let mut these = 0..count;
                    if alone {
                        if waiting == 0 {
                            break;
                        }
                        let ahead = waiting & (Places::MAX << first);
                        let next = if ahead != 0 { ahead } else { waiting };
                        let place = next.trailing_zeros() as usize % GROUP;
                        waiting &= !(1 << place);
                        these = place..place + 1;
                    }
                    // Those that gave up have taken what was known.
                    let is_new = ends[these.start % GROUP] == Ended::Unfit;
                    let known = if is_new { at + these.start..at + these.end } else { 0..0 };
                    let known = answers.get(known).unwrap_or_default();
                    let group = states.get_mut(these.clone()).unwrap_or_default();
                    let tiles = if are_tiles & !alone { Some((&*source, at..end)) } else { None };
                    let boxes = &mut *self.boxes;
                    let ended = L::out_of_line(
                        token,
                        #[inline(always)]
                        || boxes.trace::<L, Q>(tier, token, group, known, bvh, tiles),
                    );
                    for packet in these.clone() {
                        let before = &mut ends[packet % GROUP];
                        if ended != Ended::Unfit {
                            *before = ended;
                        }
                    }
                    if !alone {
                        let outcome = (ended == Ended::Through, ended.is_in_vain());
                        self.learnt.groups[kind].take(outcome, self.longest);
                        // Half of a group that gave up would do so, too.
                        let are_few = count < 2 || (count == 2 && ended == Ended::GaveUp);
                        if ended.is_answered() || are_few {
                            break;
                        }
                        alone = true;
                    } else {
                        let place: Places = 1 << these.start;
                        tried |= place;
                        paid |= if ended == Ended::Through { place } else { 0 };
                        in_vain |= if ended.is_in_vain() { place } else { 0 };
                        // Where the first is too wide, so are most.
                        if ended.is_in_vain() && tried == place {
                            break;
                        }
                    }
                }
                if tried != 0 {
                    self.learnt.packets[kind].take([tried, paid, in_vain], self.longest);
                }
                for place in 0..states.len() {
                    if let (Some(state), Some(answer)) =
                        (states.get_mut(place), answers.get_mut(at + place))
                        && ends[place % GROUP] != Ended::Unfit
                    {
                        *answer = state.finish::<Q>(tier, bvh);
                    }
                }
            }
            for place in at..end {
                let ended = ends[(place - at) % GROUP];
                apart.are_all &= ended == Ended::Unfit;
                if !ended.is_answered() {
                    apart.packets.insert(place - run.start);
                }
                if ended == Ended::Unfit
                    && bvh.outside.is_empty()
                    && let Some(answer) = answers.get_mut(place)
                {
                    *answer = Q::none::<L::Array>();
                }
            }
            at = end;
        }
    }
}
