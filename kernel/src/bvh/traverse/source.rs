//! Where spheres lie until a tier tests them, and the tests of those that every ray must meet.

use crate::Accuracy;
use crate::accuracy::{RayLanes, is_closer, test_lanes};
use crate::geometry::hit::Hit;
use crate::geometry::ray::RayPacket;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::lanes::{LaneArray, Lanes};
use crate::numeric::axes::axes;
use crate::query::Query;

/// Where spheres lie until a tier tests them: by place in a structure, each with its index.
pub(crate) trait SphereSource {
    /// The list that the structure is made of.
    fn spheres(&self) -> Spheres<'_>;
    /// The sphere at a place, and its index.
    fn sphere_at(&self, place: u32) -> Option<(Sphere, u32)>;
    /// Sphere `number` of those that every ray must be tested against; `None` past the last.
    fn outside(&self, number: usize) -> Option<(Sphere, u32)>;
}

/// Tests the spheres that every ray must be tested against, for the rays of a packet in `lanes`.
#[inline(always)]
pub(crate) fn test_outside<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    packet: &RayPacket<L::Array>,
    source: &impl SphereSource,
    lanes: u32,
    answer: &mut Q::Packet<L::Array>,
) {
    let rays = &RayLanes::<L>::load(token, packet);
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
                Q::take::<L::Array>(
                    answer,
                    lane,
                    Hit { t, sphere: index },
                    #[inline(always)]
                    |old| is_closer(tier, source.spheres(), &packet.ray(lane), t, [index, old]),
                );
            }
        }
    }
}

/// One sphere a lane.
pub(crate) struct SphereLanes<L: Lanes> {
    pub(crate) center: [L; 3],
    pub(crate) radius: L,
    /// As bits.
    pub(crate) index: L,
}

impl<L: Lanes> SphereLanes<L> {
    /// The spheres whose places are the bits of `places`, or the `shared` one.
    #[inline(always)]
    pub(crate) fn gather(source: &impl SphereSource, places: L, shared: Option<u32>) -> Self {
        let token = places.token();
        if let Some(place) = shared
            && let Some((sphere, index)) = source.sphere_at(place)
        {
            return Self {
                center: axes!(i => L::splat(token, sphere.center[i])),
                radius: L::splat(token, sphere.radius),
                index: L::splat(token, f32::from_bits(index)),
            };
        }

        let places = places.store();
        let none = L::Array::filled(0.0);
        let (mut center, mut radius, mut index) = ([none; 3], none, none);
        for lane in 0..L::COUNT {
            let place = places.get(lane).to_bits();
            let Some((sphere, number)) = source.sphere_at(place) else { continue };
            for axis in 0..3 {
                center[axis].set(lane, sphere.center[axis]);
            }
            radius.set(lane, sphere.radius);
            index.set(lane, f32::from_bits(number));
        }
        Self {
            center: axes!(i => L::load(token, &center[i])),
            radius: L::load(token, &radius),
            index: L::load(token, &index),
        }
    }
}
