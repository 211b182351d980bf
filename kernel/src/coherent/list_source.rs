//! Packets of a common origin or direction, traced through spheres in the order of their depth.
//!
//! A thousand packets share a list of what is inside their frustum, some ten a shorter one; four go through
//! it together, block by block, as packets go through the leaves of a tree (`tree_source.rs`).

use super::depth_list::DepthList;
use super::fit::{Fit, greatest_of, spread_of};
use super::listed::Listed;
use super::packet_state::PacketState;
use super::survey::{LARGE, MIDDLE, Survey, reaches, unfit};
use super::view::View;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::traverse::deferred::SphereSource;
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes};
use crate::linear;
use crate::numeric::rounding::most;
use crate::query::Query;

/// How many packets go through a list together.
const SMALL: usize = 4;
/// The widest range of slopes of them.
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
    let through = Through { list, view };
    let (longer, shorter) = scratch.split_at_mut(scratch.len() / 2);
    let count = rays.len().min(answers.len());
    let mut from = 0;
    while from < count {
        let rays = rays.get(from..count).unwrap_or_default();
        let survey = Survey::new::<L>(token, view, rays);
        let group = match &survey {
            Some(survey) => survey.packets,
            None => unfit::<L>(token, view, rays),
        };
        if let (Some(rays), Some(answers)) =
            (rays.get(..group), answers.get_mut(from..from + group))
        {
            match &survey {
                Some(survey) => {
                    through.large_group::<L, Q>(tier, token, survey, rays, longer, shorter, answers)
                }
                None => linear::traverse::<L, Q>(tier, token, list.spheres, rays, answers),
            }
        }
        from += group.max(1);
    }
}

/// What all groups share.
struct Through<'a> {
    list: &'a DepthList<'a>,
    view: &'a View,
}

impl Through<'_> {
    #[expect(clippy::too_many_arguments, reason = "two pieces of scratch memory, reborrowed")]
    #[inline(always)]
    fn large_group<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        survey: &Survey,
        rays: &[RayPacket<L::Array>],
        longer: &mut [f32],
        shorter: &mut [f32],
        answers: &mut [Q::Packet<L::Array>],
    ) {
        let (extent, spread) = (self.list.extent, tier.spread());
        let mut listed = self.list.listed;
        if rays.len() > MIDDLE {
            let (frustum, reach) = survey.frustum(&survey.all(), extent, spread);
            if let Some(inside) = listed.inside::<L>(token, &frustum, reach, longer) {
                listed = inside;
            }
        }
        for part in 0..LARGE / MIDDLE {
            let (from, to) = (part * MIDDLE, ((part + 1) * MIDDLE).min(rays.len()));
            let (Some(rays), Some(answers)) = (rays.get(from..to), answers.get_mut(from..to))
            else {
                return;
            };
            let mut listed = listed;
            if rays.len() > SMALL {
                let (frustum, reach) = survey.frustum(&survey.bounds[part], extent, spread);
                if let Some(inside) = listed.inside::<L>(token, &frustum, reach, shorter) {
                    listed = inside;
                }
            }
            let mut from = 0;
            while from < rays.len() {
                let to = (from + SMALL).min(rays.len());
                if let (Some(rays), Some(answers)) = (rays.get(from..to), answers.get_mut(from..to))
                {
                    self.small_group::<L, Q>(tier, token, rays, &listed, answers);
                }
                from = to;
            }
        }
    }

    #[inline(always)]
    fn small_group<L: Lanes, Q: Query>(
        &self,
        tier: impl Accuracy,
        token: L::Token,
        rays: &[RayPacket<L::Array>],
        listed: &Listed<'_>,
        answers: &mut [Q::Packet<L::Array>],
    ) {
        let Some(first) = rays.first() else { return };
        let (extent, spread) = (self.list.extent, tier.spread());
        let mut states = [self.state_of::<L>(token, first); SMALL];
        for place in 1..SMALL {
            if let Some(packet) = rays.get(place) {
                states[place] = self.state_of(token, packet);
            }
        }
        let states = states.get_mut(..rays.len()).unwrap_or_default();
        let mut live = false;
        for state in &*states {
            live |= state.live.any();
        }
        if !live {
            for answer in answers {
                *answer = Q::none::<L::Array>();
            }
            return;
        }
        let fit = Fit::of(states, extent, spread);
        let enclosed = match &fit {
            Some(fit) => fit.enclose(states, NARROW),
            None => None,
        };
        let (Some(fit), Some(frustum)) = (fit, enclosed) else {
            return linear::traverse::<L, Q>(tier, token, self.list.spheres, rays, answers);
        };
        let source =
            ListSource { listed, spheres: self.list.spheres, outside: self.list.outside() };
        let slack = spread_of(spread, extent, fit.absolute_error);
        let mut reach = f32::NEG_INFINITY;
        for state in &mut *states {
            if self.list.outside > 0 {
                state.test_outside::<Q>(tier, &source);
            }
            state.depth = self.depth_of(state, slack);
            reach = most(reach, state.depth);
        }

        // From the front: all that follows a block begins as deep, or deeper.
        let mut number = 0;
        while let Some((spheres, depth)) = listed.block(number) {
            if depth > reach {
                break;
            }
            let places = frustum.look::<L>(token, &spheres);
            let mut any_changed = false;
            if places != 0 {
                for state in &mut *states {
                    if depth > state.depth {
                        continue;
                    }
                    let mut places = places & state.sides.look::<L>(token, &spheres);
                    let mut changed = false;
                    while places != 0 {
                        let place = places.trailing_zeros() as usize;
                        places &= places - 1;
                        changed |= state.meet::<Q>(tier, &source, (number as u32, &spheres), place);
                    }
                    if changed {
                        state.depth = self.depth_of(state, slack);
                        any_changed = true;
                    }
                }
            }
            if any_changed {
                reach = f32::NEG_INFINITY;
                for state in &*states {
                    reach = most(reach, state.depth);
                }
            }
            number += 1;
        }
        for place in 0..states.len() {
            if let (Some(state), Some(answer)) = (states.get_mut(place), answers.get_mut(place)) {
                *answer = state.finish::<Q>(tier, &source);
            }
        }
    }

    #[inline(always)]
    fn state_of<'a, L: Lanes>(
        &self,
        token: L::Token,
        packet: &'a RayPacket<L::Array>,
    ) -> PacketState<'a, L> {
        PacketState::new(packet, &self.view.in_frame(&RayLanes::load(token, packet)))
    }

    /// How deep the rays of a packet still go.
    #[inline(always)]
    fn depth_of<L: Lanes>(&self, state: &PacketState<'_, L>, slack: f32) -> f32 {
        let states = [state];
        greatest_of!(states, s => reaches(self.view, s.best, s.origin, s.absolute_error)) + slack
    }
}

/// The spheres of a list, by their places in it.
struct ListSource<'a> {
    listed: &'a Listed<'a>,
    spheres: Spheres<'a>,
    /// The indices, as bits, of spheres that every ray must be tested against.
    outside: &'a [f32],
}

impl SphereSource for ListSource<'_> {
    #[inline(always)]
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)> {
        let index = self.listed.index(place as usize)?;
        Some((self.spheres.get(index)?, index as u32))
    }

    #[inline(always)]
    fn outside(&self, number: usize) -> Option<(Sphere, u32)> {
        let index = self.outside.get(number)?.to_bits();
        Some((self.spheres.get(index as usize)?, index))
    }
}
