//! Where spheres lie until a tier tests them, and the tests of those that every ray must meet.

use crate::Accuracy;
use crate::accuracy::{RayLanes, test_lanes};
use crate::geometry::hit::Hit;
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
