//! From candidates to answers: tests of spheres that wait for company.
//!
//! Candidates of any rays wait until there is one for every lane; then the tier tests all of
//! them at once.

use crate::Accuracy;
use crate::accuracy::{RayLanes, test_lanes};
use crate::geometry::hit::Hit;
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::Sphere;
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// Where spheres lie until a tier tests them: by place in a structure, each with its index.
pub(crate) trait SphereSource {
    /// The sphere at a place, and its index.
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)>;
    /// Sphere `number` of those that every ray must be tested against; `None` past the last.
    fn outside(&self, number: usize) -> Option<(Sphere, u32)>;
}

/// A ray of a list of packets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RayPlace {
    pub(crate) packet: usize,
    pub(crate) lane: usize,
}

impl RayPlace {
    pub(crate) const FIRST: Self = Self { packet: 0, lane: 0 };
}

/// Rays and spheres that the tier will test, one of each a lane.
pub(crate) struct DeferredTests<L: Lanes> {
    rays: RayPacket<L::Array>,
    center: [L::Array; 3],
    radius: L::Array,
    index: <L::Array as LaneArray>::Ids,
    whose: <L::Array as LaneArray>::Each<RayPlace>,
    count: usize,
}

impl<L: Lanes> DeferredTests<L> {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self {
            rays: RayPacket::inactive(),
            center: [L::Array::filled(0.0); 3],
            radius: L::Array::filled(0.0),
            index: L::Array::ids(0),
            whose: L::Array::each(RayPlace::FIRST),
            count: 0,
        }
    }

    /// Adds a ray and the sphere at `place` of a structure; tests, if that makes as many as there
    /// are lanes.
    #[inline(always)]
    pub(crate) fn add<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        (packets, whose): (&[RayPacket<L::Array>], RayPlace),
        (source, place): (&impl SphereSource, u32),
        answers: &mut [Q::Packet<L::Array>],
    ) {
        let (Some(packet), Some((sphere, index))) =
            (packets.get(whose.packet), source.sphere_at(place))
        else {
            return;
        };
        let lane = self.count;
        let (there, center) = (whose.lane, sphere.center.to_array());
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
            (*number, *place) = (index, whose);
            self.count += 1;
        }
        if self.count == L::COUNT {
            self.test::<Q>(tier, token, answers);
        }
    }

    /// Tests what there is, and hands the answers on.
    #[inline(always)]
    pub(crate) fn test<Q: Query>(
        &mut self,
        tier: impl Accuracy,
        token: L::Token,
        answers: &mut [Q::Packet<L::Array>],
    ) {
        if self.count == 0 {
            return;
        }
        let asked = (1_u64 << self.count) - 1;
        self.count = 0;
        let rays = RayLanes::<L>::load(token, &self.rays);
        let asked = rays.live & L::mask(token, asked as u32);
        let center = axes!(i => L::load(token, &self.center[i]));
        let radius = L::load(token, &self.radius);
        let infinity = L::splat(token, f32::INFINITY);
        let t = test_lanes(tier, &rays, center, radius, asked, infinity).store();
        let (indices, whose) = (self.index.as_ref(), self.whose.as_ref());
        for lane in 0..L::COUNT {
            let t = t.get(lane);
            if t < f32::INFINITY
                && let (Some(&sphere), Some(ray)) = (indices.get(lane), whose.get(lane))
                && let Some(answer) = answers.get_mut(ray.packet)
            {
                Q::take::<L::Array>(answer, ray.lane, Hit { t, sphere });
            }
        }
    }
}

/// Tests the spheres that every ray must be tested against, for the rays of a packet in `lanes`.
#[inline(always)]
pub(crate) fn test_outside<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    rays: &RayLanes<L>,
    source: &impl SphereSource,
    lanes: u32,
    answer: &mut Q::Packet<L::Array>,
) {
    let token = rays.t_min.token();
    let asked = rays.live & L::mask(token, lanes);
    let mut number = 0;
    while let Some((sphere, index)) = source.outside(number) {
        number += 1;
        if !sphere.is_valid() {
            continue;
        }
        let center = axes!(i => L::splat(token, sphere.center[i]));
        let radius = L::splat(token, sphere.radius);
        let infinity = L::splat(token, f32::INFINITY);
        let t = test_lanes(tier, rays, center, radius, asked, infinity).store();
        for lane in 0..L::COUNT {
            let t = t.get(lane);
            if t < f32::INFINITY {
                Q::take::<L::Array>(answer, lane, Hit { t, sphere: index });
            }
        }
    }
}
