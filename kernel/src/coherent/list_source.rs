//! Packets of a common origin or direction, traced through spheres in the order of their depth.
//!
//! A thousand packets share a list of the spheres inside their frustum, some tens share a shorter one. Four packets go
//! through it together, block by block, as packets go through the leaves of a tree (`tree_source.rs`). Packets that run different ways go
//! alone, with no planes around them. They, too, end where the next sphere begins deeper than their hits; if that is far, they are tested
//! against all spheres.

use super::depth_list::DepthList;
use super::effort::Effort;
use super::fit::{Fit, greatest_of, spread_of};
use super::frustum::{Outline, Sides};
use super::learnt::Learnt;
use super::listed::Listed;
use super::packet_group::{GROUP, meet_block};
use super::packet_state::PacketState;
use super::patience::Patience;
use super::survey::{Survey, reaches};
use super::view::View;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::source::SphereSource;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes, WIDTH};
use crate::linear;
use crate::numeric::rounding::most;
use crate::query::Query;
use core::ops::Range;

/// How many packets share the larger list.
const LARGE: usize = 1024;
/// How many packets share the shorter list.
const MIDDLE: usize = 64;
/// A list of so many spheres is short enough: looking at its blocks costs less than a survey.
const SHORT: usize = 64;
/// The widest range of slopes that goes through a list together.
const NARROW: f32 = 2.0;

/// Packets that fit no frustum are tested against the nearest eighth of the spheres, and 128 at least; if a ray then goes on, against all. (A
/// sphere takes twice as long in this order as in the list's.)
const NEAREST: usize = 8;
const LEAST_BLOCKS: usize = 8;
/// How many go without a try after one in vain, at least and at most.
const GAPS: [u8; 2] = [1, 63];

/// Answers every ray.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    list: &DepthList<'_>,
    (scratch, learnt): (&mut [f32], &mut Learnt),
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = rays.len().min(answers.len());
    let Some(view) = &list.view else {
        return test_all::<L, Q>(tier, token, list, learnt, (rays, 0..count), answers);
    };
    let (longer, shorter) = scratch.split_at_mut(scratch.len() / 2);
    let size = (list.scale.factor, list.extent, tier.spread());
    // Packets from `unanswered` to `from` are to be tested against all spheres, in one run.
    let (mut from, mut unanswered) = (0, 0);
    let mut patience = Patience::NEW;
    while from < count {
        let large = rays.get(from..count.min(from + LARGE)).unwrap_or_default();
        let survey = Survey::new::<L>(token, view, large, size);
        let end = from + survey.packets.max(1);
        // A packet that does not run with the next pays for no block of spheres outside.
        if survey.packets == 0 && (list.outside > 0 || !view.is_shared_by::<L>(token, &rays[from]))
        {
            from = end;
            continue;
        }
        // Spheres that no bound sees are tested first: packets begin with these hits.
        if list.outside > 0
            && let (Some(rays), Some(answers)) = (rays.get(from..end), answers.get_mut(from..end))
        {
            linear::traverse_some::<L, Q>(tier, token, &list.outside(), rays, answers);
        }
        let mut listed = list.listed;
        if survey.packets > MIDDLE && listed.count > SHORT {
            listed = listed.inside::<L>(token, &survey, longer).unwrap_or(listed);
        }
        while from < end {
            let to = end.min(from + MIDDLE);
            let middle = rays.get(from..to).unwrap_or_default();
            let mut shorter_list = listed;
            if middle.len() > GROUP && listed.count > SHORT {
                let survey = Survey::new::<L>(token, view, middle, size);
                // The first of these rays may show another way, in which not all of them run.
                if survey.packets == middle.len() {
                    shorter_list = listed.inside::<L>(token, &survey, shorter).unwrap_or(listed);
                }
            }
            let mut source = ListSource { list, view, listed: &shorter_list, patience, work: 0 };
            while from < to {
                let next = to.min(from + GROUP);
                if let (Some(group), Some(of_group)) =
                    (rays.get(from..next), answers.get_mut(from..next))
                {
                    let is_answered = source.trace::<L, Q>(tier, token, group, of_group);
                    if is_answered {
                        let run = (rays, unanswered..from);
                        test_all::<L, Q>(tier, token, list, learnt, run, answers);
                        unanswered = next;
                    }
                }
                from = next;
            }
            patience = source.patience;
            learnt.add_work(source.work);
        }
    }
    test_all::<L, Q>(tier, token, list, learnt, (rays, unanswered..count), answers);
}

/// Tests some packets against all spheres, except where the caller does otherwise.
#[inline(always)]
fn test_all<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    list: &DepthList<'_>,
    learnt: &mut Learnt,
    (rays, run): (&[RayPacket<L::Array>], Range<usize>),
    answers: &mut [Q::Packet<L::Array>],
) {
    if !run.is_empty()
        && !learnt.leaves(run.clone())
        && let (Some(rays), Some(answers)) = (rays.get(run.clone()), answers.get_mut(run))
    {
        linear::traverse::<L, Q>(tier, token, list.spheres, rays, answers);
    }
}

/// The spheres of a short list, by their places in it.
struct ListSource<'a> {
    list: &'a DepthList<'a>,
    view: &'a View,
    listed: &'a Listed<'a>,
    /// Which packets that fit no frustum are tried.
    patience: Patience,
    /// What its groups have done.
    work: u64,
}

impl SphereSource for ListSource<'_> {
    #[inline(always)]
    fn spheres(&self) -> Spheres<'_> {
        self.list.spheres
    }

    #[inline(always)]
    fn is_tree(&self) -> bool {
        false
    }

    #[inline(always)]
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)> {
        let index = self.listed.indices().get(place as usize)?.to_bits();
        Some((self.list.spheres.get(index as usize)?, index))
    }
}

impl ListSource<'_> {
    /// Answers the rays of up to four packets; returns `false`, and answers nothing, if they are too far apart, and go too deep.
    #[inline(always)]
    fn trace<L: Lanes, Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        rays: &[RayPacket<L::Array>],
        answers: &mut [Q::Packet<L::Array>],
    ) -> bool {
        let inactive = RayPacket::inactive();
        let mut states = [self.state_of::<L>(token, &inactive); GROUP];
        let (factor, extent, squares) = (self.list.scale.factor, self.list.extent, tier.squares());
        let (mut live, mut usual, mut is_tried) = (false, true, false);
        for place in 0..rays.len().min(GROUP) {
            states[place] = self.state_of(token, &rays[place]);
            let state = &states[place];
            let overflows = state.live & state.rays.may_overflow(squares, factor, extent);
            live |= state.live.any();
            usual &= state.covered & !overflows.any();
        }
        let states = states.get_mut(..rays.len()).unwrap_or_default();
        if !usual {
            L::out_of_line(
                token,
                #[inline(always)]
                || {
                    for place in 0..states.len().min(rays.len()) {
                        let rays = self.view.in_frame(&RayLanes::load(token, &rays[place]));
                        states[place].begin_again(&rays, (factor, extent), (squares, false));
                    }
                },
            );
        }
        if live {
            count!(GroupFit);
            let (mut sides, mut blocks, mut is_fit) = (Sides::ALL, usize::MAX, false);
            let mut covered = true;
            for state in states.iter() {
                covered &= state.covered;
            }
            if let Some(fit) = Fit::of(states, self.list.extent, tier.spread()) {
                is_fit = true;
                match fit.enclose(states, NARROW) {
                    Some(frustum) => sides = frustum.sides,
                    None => blocks = self.nearest_blocks(tier),
                }
            } else {
                blocks = self.nearest_blocks(tier);
            }
            if !covered || blocks == 0 {
                return false;
            }
            if !is_fit {
                for state in states.iter_mut() {
                    state.sides = Sides::ALL;
                }
            }
            is_tried = blocks != usize::MAX;
            let absolute_error = greatest_of!(states, s => s.rays.absolute_error);
            let outline = Outline::in_list(tier.spread(), absolute_error);
            let slack = spread_of(tier.spread(), self.list.extent, absolute_error);
            let mut reach = f32::NEG_INFINITY;
            for place in 0..states.len() {
                let state = &mut states[place];
                if self.list.outside > 0
                    && let Some(known) = answers.get(place)
                {
                    state.take_known::<Q>(known);
                }
                state.depth = self.depth_of(state, slack);
                reach = most(reach, state.depth);
            }

            let mut effort = Effort::of(states.len());
            // From the front: all spheres after a block begin as deep, or deeper.
            let mut number = 0;
            while let Some((spheres, depth)) = self.listed.block(number)
                && depth <= reach
            {
                if number == blocks {
                    self.work += u64::from(effort.work);
                    self.patience.take((false, true), GAPS);
                    return false;
                }
                let block = (number as u32, &spheres, depth);
                number += 1;
                count!(GroupLeaf);
                // Short lists leave out already what lies before the rays.
                effort.leaf();
                let places = sides.look::<L>(token, &spheres, outline);
                if places == 0 {
                    continue;
                }
                meet_block::<L, Q>(
                    tier,
                    self,
                    states,
                    block,
                    (places, outline),
                    #[inline(always)]
                    |state| self.depth_of(state, slack),
                    (&mut reach, &mut effort),
                );
            }
            self.work += u64::from(effort.work);
        }
        for place in 0..states.len() {
            if let (Some(state), Some(answer)) = (states.get_mut(place), answers.get_mut(place)) {
                *answer = state.finish::<Q>(tier, self);
            }
        }
        if is_tried {
            self.patience.take((true, false), GAPS);
        }
        true
    }

    /// How many blocks packets look into that fit no frustum; 0 if the next such is better tested against all spheres. So it is in a short
    /// list, and by tiers with a spread, whose false hits must not depend on the packets before.
    #[inline(always)]
    fn nearest_blocks(&mut self, tier: impl Accuracy) -> usize {
        let blocks = self.list.listed.count / WIDTH;
        if tier.spread() == 0.0 && blocks > LEAST_BLOCKS && self.patience.tries() {
            (blocks / NEAREST).max(LEAST_BLOCKS)
        } else {
            0
        }
    }

    /// Returns how deep the rays of a packet still go.
    #[inline(always)]
    fn depth_of<L: Lanes>(&self, state: &PacketState<'_, L>, slack: f32) -> f32 {
        let states = [state];
        let best = greatest_of!(states, s => {
            reaches(self.view, s.best, s.rays.origin, s.rays.absolute_error)
        });
        best + slack
    }

    #[inline(always)]
    fn state_of<'a, L: Lanes>(
        &self,
        token: L::Token,
        packet: &'a RayPacket<L::Array>,
    ) -> PacketState<'a, L> {
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                let rays = RayLanes::load(token, packet);
                PacketState::new(packet, &self.view.scaled_in_frame(&rays, self.list.scale.factor))
            },
        )
    }
}
