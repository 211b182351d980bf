//! The packets whose rays are in flight, how the next ray begins, and what every ray does next, in rounds.

use super::deferred::{DeferredTests, RayPlace};
use super::prepared_packet::PreparedPacket;
use super::ray_state::RayState;
use crate::Accuracy;
use crate::accuracy::{RayLanes, is_closer};
use crate::bvh::node::{BvhNode, LEAF, NO_CHILD};
use crate::bvh::tree::Bvh;
use crate::count::count;
use crate::filter::ball::may_come_near;
use crate::geometry::hit::Hit;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::linear;
use crate::query::Query;

/// The packets whose rays are in flight.
pub(crate) struct PacketsInFlight<A: LaneArray> {
    prepared: A::Each<PreparedPacket<A>>,
    /// How many rays of each have not ended.
    in_flight: A::Each<u32>,
    /// The packet that rays begin from, and which rays of it have yet to begin.
    current: u32,
    waiting: u32,
    /// The packet that comes next.
    next: usize,
}

impl<A: LaneArray> PacketsInFlight<A> {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        let (prepared, in_flight) = (A::each(PreparedPacket::NONE), A::each(0));
        Self { prepared, in_flight, current: 0, waiting: 0, next: 0 }
    }

    #[inline(always)]
    pub(crate) fn prepared(&self, state: &RayState) -> Option<&PreparedPacket<A>> {
        self.prepared.as_ref().get(state.packet as usize)
    }

    /// Begins the next ray, if there is any.
    #[inline(always)]
    pub(crate) fn begin<T: Accuracy, L: Lanes<Array = A>, Q: Query>(
        &mut self,
        tests: &mut DeferredTests<'_, T, L, Q>,
        state: &mut RayState,
    ) -> bool {
        while self.waiting == 0 {
            if self.next >= tests.packets.len() {
                return false;
            }
            // One place is free: there are as many places as rays can be in flight, and this one is not.
            let places = self.in_flight.as_ref();
            for number in 0..places.len() {
                if places[number] == 0 {
                    self.current = number as u32;
                }
            }
            if let (Some(prepared), Some(in_flight)) = (
                self.prepared.as_mut().get_mut(self.current as usize),
                self.in_flight.as_mut().get_mut(self.current as usize),
            ) {
                begin(tests, self.next, prepared);
                self.waiting = prepared.covered;
                *in_flight = prepared.covered.count_ones();
            }
            self.next += 1;
        }
        let lane = self.waiting.trailing_zeros() as usize;
        let ray = RayPlace { packet: self.next - 1, lane };
        self.waiting &= self.waiting - 1;
        if let Some(prepared) = self.prepared.as_ref().get(self.current as usize) {
            state.begin(prepared, self.current, ray, tests.bvh.root);
        }
        true
    }

    /// Counts a ray that has ended; its state belongs to no ray then.
    #[inline(always)]
    pub(crate) fn end(&mut self, state: &mut RayState) {
        let ended = state.packet as usize;
        state.packet = RayState::OF_NONE;
        if let Some(in_flight) = self.in_flight.as_mut().get_mut(ended) {
            *in_flight = in_flight.saturating_sub(1);
        }
    }
}

/// Prepares the rays of packet `place`, and answers those that do not go into the tree.
#[inline(always)]
pub(crate) fn begin<T: Accuracy, L: Lanes, Q: Query>(
    tests: &mut DeferredTests<'_, T, L, Q>,
    place: usize,
    prepared: &mut PreparedPacket<L::Array>,
) {
    let (tier, token, bvh) = (tests.tier, tests.token, tests.bvh);
    if let (Some(packet), Some(answer)) = (tests.packets.get(place), tests.answers.get_mut(place)) {
        let is_known = match tests.waiting {
            Some(waiting) if !waiting.contains(place) => {
                prepared.covered = 0;
                return;
            }
            Some(_) => true,
            // The spheres outside have been tested.
            None => !bvh.outside.is_empty(),
        };
        if !is_known {
            *answer = Q::none::<L::Array>();
        }
        // Called at one place only, since it is inlined and long. (Out of line, it is a fortieth slower with SSE2.)
        begin_packet::<L, Q>(tier, token, bvh, (packet, answer, is_known), prepared);
    }
}

/// Prepares the rays of a packet, given its answers so far, and whether any of them may be known; answers the rays
/// that do not go into the tree.
#[inline(always)]
fn begin_packet<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    (packet, answer, is_known): (&RayPacket<L::Array>, &mut Q::Packet<L::Array>, bool),
    prepared: &mut PreparedPacket<L::Array>,
) {
    count!(RayPacket);
    let rays = RayLanes::<L>::load(token, packet);
    let of_tier = (tier.spread(), tier.squares());
    prepared.prepare::<L>(&rays, bvh.scale.factor, bvh.extent, of_tier);
    let rest = rays.live.bits() & !prepared.covered;
    if rest != 0 {
        let mut rays = rays;
        rays.live = L::mask(token, rest) & !Q::done::<L>(token, answer);
        test_from_afar::<L, Q>(tier, token, bvh, (packet, &rays), answer);
    }
    if is_known {
        prepared.covered &= !Q::done::<L>(token, answer).bits();
        let [t, _] = Q::lanes::<L>(token, answer);
        let mut known = t.lt(t.like(f32::INFINITY)).bits() & prepared.covered;
        while known != 0 {
            let lane = known.trailing_zeros() as usize;
            known &= known - 1;
            prepared.shorten(lane, Q::limit::<L::Array>(answer, lane));
        }
    }
    if bvh.root == NO_CHILD {
        prepared.covered = 0;
    }
}

/// Tests the live rays of a packet, none of which the bounds cover: they begin so far away that a tree is a ball to
/// them. Rays that come near the ball are tested against all spheres of the tree.
#[inline(always)]
pub(super) fn test_from_afar<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    (packet, rays): (&RayPacket<L::Array>, &RayLanes<L>),
    answer: &mut Q::Packet<L::Array>,
) {
    let near = rays.live & may_come_near(token, rays, bvh.radius());
    if !near.any() {
        return;
    }
    let mut those = *packet;
    let never = L::splat(token, f32::NAN);
    those.t_min = L::select(near, L::load(token, &those.t_min), never).store();
    let mut found = [Q::none::<L::Array>()];
    linear::traverse_some::<L, Q>(tier, token, &bvh.inside(), &[those], &mut found);
    let [t, spheres] = Q::lanes::<L>(token, &found[0]);
    let (t, spheres) = (t.store(), spheres.store());
    for lane in 0..L::COUNT {
        let hit = Hit { t: t.get(lane), sphere: spheres.get(lane).to_bits() };
        if hit.t < f32::INFINITY {
            Q::take::<L::Array>(
                answer,
                lane,
                hit,
                #[inline(always)]
                |old| is_closer(tier, &bvh.spheres, &packet.ray(lane), hit.t, [hit.sphere, old]),
            );
        }
    }
}

/// A ray in flight, and the node or leaf that it looks into next.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    pub(crate) state: u32,
    pub(crate) child: u32,
}

impl Step {
    const NONE: Self = Self { state: 0, child: NO_CHILD };
}

/// Steps, one a ray in flight at most.
pub(crate) struct Steps<A: LaneArray> {
    steps: A::Each<Step>,
    pub(crate) count: usize,
}

impl<A: LaneArray> Steps<A> {
    #[inline(always)]
    fn none() -> Self {
        Self { steps: A::each(Step::NONE), count: 0 }
    }

    /// Adds a step if it is `wanted`, without a branch.
    #[inline(always)]
    pub(crate) fn append(&mut self, step: Step, wanted: bool) {
        if let Some(place) = self.steps.as_mut().get_mut(self.count % A::COUNT) {
            *place = step;
            self.count += usize::from(wanted);
        }
    }

    #[inline(always)]
    pub(crate) fn get(&self, at: usize) -> Step {
        match self.steps.as_ref().get(at % A::COUNT) {
            Some(step) => *step,
            None => Step::NONE,
        }
    }
}

/// What the rays do next: the rounds of the loop.
pub(crate) struct Round<A: LaneArray> {
    pub(crate) nodes: Steps<A>,
    pub(crate) leaves: Steps<A>,
    /// Rays that have ended.
    pub(crate) ended: Steps<A>,
}

impl<A: LaneArray> Round<A> {
    #[inline(always)]
    pub(crate) fn empty() -> Self {
        Self { nodes: Steps::none(), leaves: Steps::none(), ended: Steps::none() }
    }

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        (self.nodes.count, self.leaves.count, self.ended.count) = (0, 0, 0);
    }

    /// Takes what is next from the stack of a ray.
    #[inline(always)]
    pub(crate) fn go_on(&mut self, nodes: &[BvhNode], number: u32, state: &mut RayState) {
        let child = state.stack.pop(nodes);
        let ended = child == NO_CHILD;
        let leaf = child & LEAF != 0;
        self.nodes.append(Step { state: number, child }, !leaf & !ended);
        self.leaves.append(Step { state: number, child: child & !LEAF }, leaf & !ended);
        self.ended.append(Step { state: number, child }, ended);
    }
}
