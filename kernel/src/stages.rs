//! How far `Exact` has to go: which share of its tests the filter does not settle, and which share double precision does not
//! settle either.
//!
//! The count goes once more through the filter, limits and brackets of a traversal of [`Spheres`]. So the kernel itself holds
//! no counters.

use crate::accuracy::Exact;
use crate::accuracy::{TierFormula, TierWork};
use crate::filter::GROUP;
use crate::filter::block::FilterBlock;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::lanes::{LaneMask, Lanes};
use crate::linear::{Candidates, GroupTest, for_candidates};
use crate::numeric::axes::axes;
use crate::query::Query;
use core::ops::AddAssign;
use wide::f32x16;

/// How many tests of a ray against a sphere reached which stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// All tests: every ray that may hit anything against every sphere.
    pub tests: u64,
    /// Tests that needed double precision, or more.
    pub double: u64,
    /// Tests that needed exact sums.
    pub expansions: u64,
}

impl AddAssign for Stages {
    fn add_assign(&mut self, other: Self) {
        self.tests += other.tests;
        self.double += other.double;
        self.expansions += other.expansions;
    }
}

/// Counts the stages of `Exact` for these rays and spheres. This is for reports: it takes several times as long as the answers.
///
/// The counts differ a little between instruction sets: a filter with fused operations is sharper.
///
/// ```
/// use spherule_kernel::{ClosestHit, Ray, RayPacket, Spheres, Stages, Vec3, stages};
///
/// let spheres = Spheres::new(&[0.0], &[0.0], &[5.0], &[1.0])?;
/// let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z), Ray::new(Vec3::ZERO, Vec3::X)])];
/// let counted = stages(ClosestHit, &rays, spheres);
/// assert_eq!(counted, Stages { tests: 2, double: 1, expansions: 0 });
/// # Ok::<(), spherule_kernel::SpheresError>(())
/// ```
#[must_use]
pub fn stages<Q: Query>(_query: Q, rays: &[RayPacket], spheres: Spheres<'_>) -> Stages {
    let mut sum = Stages::default();
    for packet in rays {
        let live = (0..RayPacket::COUNT).filter(|&lane| packet.ray(lane).is_live()).count();
        sum.tests += live as u64 * spheres.len() as u64;
        let mut counted = [(Q::none::<[f32; 16]>(), Stages::default())];
        for_candidates::<f32x16, _, _>(
            (),
            core::slice::from_ref(packet),
            &mut counted,
            (&spheres, &mut FilterBlock::empty()),
            Exact::UNDERFLOW,
            |(answer, _)| Q::done::<f32x16>((), answer),
            |(answer, stages), candidates| {
                count::<f32x16, Q>((), candidates, answer, stages);
                GroupTest::<f32x16, Q> { token: (), candidates, answer }.run::<Exact>();
            },
        );
        sum += counted[0].1;
    }
    sum
}

/// Counts a group of candidates before it is tested. Within the group, limits move as they do in the test.
fn count<L: Lanes, Q: Query>(
    token: L::Token,
    candidates: Candidates<'_, L>,
    answer: &Q::Packet<L::Array>,
    stages: &mut Stages,
) {
    let Candidates { rays, filter, group, .. } = candidates;
    let mut limit = Q::limits::<L>(token, answer);
    for slot in 0..GROUP {
        let Some((sphere, _)) = candidates.sphere(slot) else { continue };
        let active = rays.live & filter.may_meet(group, slot);
        if !sphere.is_valid() || !active.any() {
            continue;
        }
        let center = axes!(i => L::splat(token, sphere.center[i]));
        let radius = L::splat(token, sphere.radius);
        let [double, expansions] = Exact::reached(rays, center, radius, active, limit);
        stages.double += u64::from(double.bits().count_ones());
        stages.expansions += u64::from(expansions.bits().count_ones());
        if !Q::ANY {
            limit = Exact::nearer(rays, center, radius, active, limit);
        }
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;
    use crate::{AnyHit, ClosestHit, Ray, Vec3};

    /// Counts rays along z, so far from the axis: through the unit sphere, touching it, and past it.
    fn counted(distances: &[f32], spheres: Spheres<'_>, query: impl Query) -> Stages {
        let mut packet = RayPacket::inactive();
        for (lane, &x) in distances.iter().enumerate() {
            packet.set(lane, &Ray::new(Vec3::new(x, 0.0, -3.0), Vec3::Z));
        }
        stages(query, &[packet], spheres)
    }

    #[test]
    fn a_tangent_needs_expansions_and_a_clear_miss_nothing() {
        let unit = Spheres::new(&[0.0], &[0.0], &[0.0], &[1.0]).expect("one sphere");
        for any in [false, true] {
            let of = |distances: &[f32]| match any {
                false => counted(distances, unit, ClosestHit),
                true => counted(distances, unit, AnyHit),
            };
            assert_eq!(of(&[]), Stages::default());
            assert_eq!(of(&[5.0, -7.0]), Stages { tests: 2, double: 0, expansions: 0 });
            assert_eq!(of(&[0.3, 5.0]), Stages { tests: 2, double: 1, expansions: 0 });
            assert_eq!(of(&[1.0, 0.3, 5.0]), Stages { tests: 3, double: 2, expansions: 1 });
        }
    }

    #[test]
    fn a_limit_saves_double_precision_and_so_does_an_answer() {
        let z: [f32; 40] = core::array::from_fn(|i| i as f32 * 3.0);
        let (zero, r) = ([0.0; 40], [1.0; 40]);
        let row = Spheres::new(&zero, &zero, &z, &r).expect("equal lengths");
        let nearest = counted(&[0.25], row, ClosestHit);
        let any = counted(&[0.25], row, AnyHit);
        assert_eq!((nearest.tests, any.tests), (40, 40));
        assert!(nearest.double <= 2 && any.double <= 4, "{nearest:?} {any:?}");
    }
}
