//! Packets of a common origin or direction, traced through spheres in the order of their depth.
//!
//! A thousand packets share a list of the spheres inside their frustum, some tens share a shorter one. Four packets go
//! through it together, block by block, as packets go through the leaves of a tree (`tree_source.rs`).

use super::depth_list::DepthList;
use super::effort::Effort;
use super::fit::{Fit, greatest_of, spread_of};
use super::frustum::Outline;
use super::listed::Listed;
use super::packet_group::{GROUP, meet_block};
use super::packet_state::PacketState;
use super::survey::{Survey, reaches};
use super::view::View;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::source::SphereSource;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes};
use crate::linear;
use crate::numeric::rounding::most;
use crate::query::Query;

/// How many packets share the larger list.
const LARGE: usize = 1024;
/// How many packets share the shorter list.
const MIDDLE: usize = 64;
/// A list of so many spheres is short enough: looking at its blocks costs less than a survey.
const SHORT: usize = 64;
/// The widest range of slopes that goes through a list together.
const NARROW: f32 = 2.0;

/// Answers every ray.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    list: &DepthList<'_>,
    scratch: &mut [f32],
    rays: &[RayPacket<L::Array>],
    answers: &mut [Q::Packet<L::Array>],
) {
    let Some(view) = &list.view else {
        return linear::traverse::<L, Q>(tier, token, list.spheres, rays, answers);
    };
    let (longer, shorter) = scratch.split_at_mut(scratch.len() / 2);
    let size = (list.scale.factor, list.extent, tier.spread());
    let count = rays.len().min(answers.len());
    let (mut from, mut unfit) = (0, 0);
    while from < count {
        let large = rays.get(from..count.min(from + LARGE)).unwrap_or_default();
        let survey = Survey::new::<L>(token, view, large, size);
        let end = from + survey.packets;
        if survey.packets == 0 {
            from += 1;
        }
        if survey.packets > 0 || from == count {
            // Packets that do not fit are tested against all spheres, in one run.
            if let (Some(rays), Some(answers)) =
                (rays.get(unfit..from), answers.get_mut(unfit..from))
            {
                linear::traverse::<L, Q>(tier, token, list.spheres, rays, answers);
            }
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
            let source = ListSource { list, view, listed: &shorter_list };
            while from < to {
                let next = to.min(from + GROUP);
                if let (Some(rays), Some(answers)) =
                    (rays.get(from..next), answers.get_mut(from..next))
                {
                    source.trace::<L, Q>(tier, token, rays, answers);
                }
                from = next;
            }
        }
        if survey.packets > 0 {
            unfit = from;
        }
    }
}

/// The spheres of a short list, by their places in it.
struct ListSource<'a> {
    list: &'a DepthList<'a>,
    view: &'a View,
    listed: &'a Listed<'a>,
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
    /// Answers the rays of up to four packets.
    #[inline(always)]
    fn trace<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        rays: &[RayPacket<L::Array>],
        answers: &mut [Q::Packet<L::Array>],
    ) {
        let inactive = RayPacket::inactive();
        let mut states = [self.state_of::<L>(token, &inactive); GROUP];
        let (factor, extent, squares) = (self.list.scale.factor, self.list.extent, tier.squares());
        let (mut live, mut usual) = (false, true);
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
            let Some(fit) = Fit::of(states, self.list.extent, tier.spread()) else {
                return linear::traverse::<L, Q>(tier, token, self.list.spheres, rays, answers);
            };
            let Some(frustum) = fit.enclose(states, NARROW) else {
                return linear::traverse::<L, Q>(tier, token, self.list.spheres, rays, answers);
            };
            let outline = Outline::in_list(tier.spread(), fit.absolute_error);
            let slack = spread_of(tier.spread(), self.list.extent, fit.absolute_error);
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
                let block = (number as u32, &spheres, depth);
                number += 1;
                count!(GroupLeaf);
                // Short lists leave out already what lies before the rays.
                let places = frustum.sides.look::<L>(token, &spheres, outline);
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
        }
        for place in 0..states.len() {
            if let (Some(state), Some(answer)) = (states.get_mut(place), answers.get_mut(place)) {
                *answer = state.finish::<Q>(tier, self);
            }
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
