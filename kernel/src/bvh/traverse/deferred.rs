//! From candidates to answers: what all rays of a traversal share, and tests that wait for others.
//!
//! Candidates of any rays wait until there is one for every lane; then the tier tests all of
//! them at once.

use super::packet_set::PacketSet;
use crate::Accuracy;
use crate::accuracy::{RayLanes, is_closer, test_lanes};
use crate::bvh::source::SphereSource;
use crate::bvh::tree::Bvh;
use crate::geometry::hit::Hit;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// A ray of a list of packets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RayPlace {
    pub(crate) packet: usize,
    pub(crate) lane: usize,
}

impl RayPlace {
    pub(crate) const FIRST: Self = Self { packet: 0, lane: 0 };
}

/// Rays and spheres that the tier will test, one of each a lane, and where the answers go.
pub(crate) struct DeferredTests<'a, T, L: Lanes, Q: Query> {
    pub(crate) tier: T,
    pub(crate) token: L::Token,
    pub(crate) bvh: &'a Bvh<'a>,
    pub(crate) packets: &'a [RayPacket<L::Array>],
    pub(crate) answers: &'a mut [Q::Packet<L::Array>],
    /// The packets to answer, of which something may be known. If it is `None`, all are to answer, and nothing is known.
    pub(crate) waiting: Option<&'a PacketSet>,
    rays: RayPacket<L::Array>,
    center: [L::Array; 3],
    radius: L::Array,
    index: <L::Array as LaneArray>::Ids,
    whose: <L::Array as LaneArray>::Each<RayPlace>,
    count: usize,
}

impl<'a, T: Accuracy, L: Lanes, Q: Query> DeferredTests<'a, T, L, Q> {
    #[inline(always)]
    pub(crate) fn new(
        tier: T,
        token: L::Token,
        bvh: &'a Bvh<'a>,
        packets: &'a [RayPacket<L::Array>],
        answers: &'a mut [Q::Packet<L::Array>],
        waiting: Option<&'a PacketSet>,
    ) -> Self {
        Self {
            tier,
            token,
            bvh,
            packets,
            answers,
            waiting,
            rays: RayPacket::inactive(),
            center: [L::Array::filled(0.0); 3],
            radius: L::Array::filled(0.0),
            index: L::Array::ids(0),
            whose: L::Array::each(RayPlace::FIRST),
            count: 0,
        }
    }

    /// The t above which nothing matters any more to a ray, as far as the tier has answered: `-inf` if it is done.
    #[inline(always)]
    pub(crate) fn limit(&self, ray: RayPlace) -> f32 {
        match self.answers.get(ray.packet) {
            Some(answer) => Q::limit::<L::Array>(answer, ray.lane),
            None => f32::INFINITY,
        }
    }

    /// Adds a ray and the sphere at `place` in the leaves; tests all, if there are then as many as lanes.
    #[inline(always)]
    pub(crate) fn add(&mut self, ray: RayPlace, place: u32) {
        let (Some(packet), Some((sphere, index))) =
            (self.packets.get(ray.packet), self.bvh.sphere_at(place))
        else {
            return;
        };
        let (lane, there, center) = (self.count, ray.lane, sphere.center.to_array());
        for axis in 0..3 {
            self.rays.origin[axis].set(lane, packet.origin[axis].get(there));
            self.rays.direction[axis].set(lane, packet.direction[axis].get(there));
            self.center[axis].set(lane, center[axis]);
        }
        self.rays.t_min.set(lane, packet.t_min.get(there));
        self.rays.t_max.set(lane, packet.t_max.get(there));
        self.radius.set(lane, sphere.radius);
        if let (Some(number), Some(place)) =
            (self.index.as_mut().get_mut(lane), self.whose.as_mut().get_mut(lane))
        {
            (*number, *place) = (index, ray);
            self.count += 1;
        }
        if self.count == L::COUNT {
            self.test();
        }
    }

    /// Tests what there is, and hands the answers on. (Out of line it is compiled once, not in seventeen places; ray by ray
    /// then runs at 0.97 of the speed, with AVX2.)
    #[inline(always)]
    pub(crate) fn test(&mut self) {
        if self.count == 0 {
            return;
        }
        let (token, active) = (self.token, (1_u64 << self.count) - 1);
        self.count = 0;
        let rays = RayLanes::<L>::load(token, &self.rays);
        let active = rays.live & L::mask(token, active as u32);
        let center = axes!(i => L::load(token, &self.center[i]));
        let radius = L::load(token, &self.radius);
        let infinity = L::splat(token, f32::INFINITY);
        let t = test_lanes(self.tier, &rays, center, radius, active, infinity, Q::ANY).store();
        for lane in 0..L::COUNT {
            let t = t.get(lane);
            if t < f32::INFINITY
                && let (Some(&sphere), Some(ray)) =
                    (self.index.as_ref().get(lane), self.whose.as_ref().get(lane))
                && let Some(answer) = self.answers.get_mut(ray.packet)
            {
                let (tier, spheres, packets) = (self.tier, self.bvh.spheres, self.packets);
                Q::take::<L::Array>(
                    answer,
                    ray.lane,
                    Hit { t, sphere },
                    #[inline(always)]
                    |old| match packets.get(ray.packet) {
                        Some(packet) => {
                            let ray = packet.ray(ray.lane);
                            is_closer(tier, &spheres, &ray, t, [sphere, old])
                        }
                        None => false,
                    },
                );
            }
        }
    }
}
