//! A group of packets through the spheres in the order of their depth.
//!
//! # Method
//!
//! Up to four packets go through a list together, block by block, as packets go through the leaves of a tree (`tree_group.rs`): spheres are
//! tested against the group's planes, then against each packet's, then against its rays. The group ends where the next sphere begins
//! deeper than all that its rays have hit. Packets that run different ways have no planes around them. They end there, too, unless that
//! is too far: then they are tested against all spheres, since a sphere takes twice as long in this order as in the list's.

use super::depth_list::DepthList;
use super::effort::Effort;
use super::fit::{Fit, greatest_of, spread_of};
use super::frustum::{Outline, Sides};
use super::listed::Listed;
use super::packet_group::{GROUP, meet_block};
use super::packet_state::PacketState;
use super::patience::Patience;
use super::survey::reaches;
use super::view::View;
use crate::Accuracy;
use crate::accuracy::RayLanes;
use crate::bvh::source::SphereSource;
use crate::count::count;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneMask, Lanes, WIDTH};
use crate::numeric::rounding::most;
use crate::query::Query;

/// The widest range of slopes that goes through a list together.
const NARROW: f32 = 2.0;
/// Packets that fit no frustum are tested against the nearest eighth of the spheres, and 128 at least.
const NEAREST: usize = 8;
const LEAST_BLOCKS: usize = 8;
/// How many of these go without a try after one in vain, at least and at most.
const GAPS: [u8; 2] = [1, 63];

/// The spheres of a short list, by their places in it.
pub(super) struct ListSource<'a> {
    pub(super) list: &'a DepthList<'a>,
    pub(super) view: &'a View,
    pub(super) listed: &'a Listed<'a>,
    /// Which packets that fit no frustum are tried.
    pub(super) patience: Patience,
    /// What its groups have done.
    pub(super) work: u64,
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
    pub(super) fn trace<L: Lanes, Q: Query>(
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
            let Some((sides, blocks)) = self.planes(tier, states) else { return false };
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

    /// Lays planes around a group and its packets, where they run the same way, and returns those of the group, with how many blocks of the
    /// list it looks into at most. Returns `None` if the group is better tested against all spheres: so are packets that fit no frustum in a
    /// short list, and by tiers with a spread, whose false hits must not depend on the packets before.
    #[inline(always)]
    fn planes<L: Lanes>(
        &mut self,
        tier: impl Accuracy,
        states: &mut [PacketState<'_, L>],
    ) -> Option<(Sides, usize)> {
        for state in states.iter() {
            if !state.covered {
                return None;
            }
        }
        match Fit::of(states, self.list.extent, tier.spread()) {
            Some(fit) => {
                if let Some(frustum) = fit.enclose(states, NARROW) {
                    return Some((frustum.sides, usize::MAX));
                }
            }
            None => {
                for state in states.iter_mut() {
                    state.sides = Sides::ALL;
                }
            }
        }
        let blocks = self.list.listed.count / WIDTH;
        let tries = tier.spread() == 0.0 && blocks > LEAST_BLOCKS && self.patience.tries();
        tries.then_some((Sides::ALL, (blocks / NEAREST).max(LEAST_BLOCKS)))
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

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests {
    extern crate std;

    use crate::coherent::ray_order::tests::point;
    use crate::proofs::climb::Random;
    use crate::proofs::work::{Kind, Work};
    use crate::{
        DepthList, Exact, HitPacket, Intersect, Ray, RayPacket, SphereList, Trace, Vec3, Viewpoint,
    };
    use std::vec;
    use std::vec::Vec;

    /// Blocks of sixteen spheres, and groups of four by the list's filter, that so many packets meet whose rays run in all directions, and hit
    /// nothing.
    fn met(spheres: usize, packets: usize) -> [u64; 2] {
        let mut random = Random(137);
        let list: SphereList =
            (0..spheres).map(|_| (3.0 * Vec3::X + point(&mut random), 1e-4)).collect();
        let mut memory = vec![0.0; DepthList::needed(spheres)];
        let list = DepthList::sort(list.spheres(), Viewpoint::Origin(Vec3::ZERO), &mut memory);
        let list = list.expect("enough memory");
        let packet = |_| {
            let rays: [Ray; 16] =
                core::array::from_fn(|_| Ray::new(Vec3::ZERO, point(&mut random)));
            RayPacket::new(&rays)
        };
        let packets: Vec<_> = (0..packets).map(packet).collect();
        let mut hits = vec![HitPacket::none(); packets.len()];
        let work =
            Work::of(|| list.closest_hit_packets(Exact, &mut Trace::new(), &packets, &mut hits));
        [Kind::GroupLeaf, Kind::ListGroup].map(|kind| work.count(kind))
    }

    /// As `DepthList` says: an eighth, 128 at least; and then against all.
    #[test]
    fn packets_in_all_directions_meet_the_nearest_spheres_first() {
        for (spheres, blocks) in [(128, 0), (144, 8), (1024, 8), (1600, 12), (16_000, 125)] {
            let [nearest, all] = met(spheres, 1);
            assert_eq!(nearest, blocks, "{spheres}");
            assert!(all >= spheres as u64 / 8, "{all} of {spheres}");
        }
        // After tries in vain 1, 3, 7, .. 63 packets go without one.
        assert_eq!(met(1600, 192)[0], 8 * 12);
    }
}
