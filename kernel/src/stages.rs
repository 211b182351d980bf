//! How far `Exact` had to go: which share of its tests the filter did not settle, and which share
//! double precision did not either.
//!
//! The same filter, limits and brackets as in [`nearest`](crate::nearest) and [`any`](crate::any),
//! walked once more and counted; so the kernel itself holds no counters.

use crate::axes::axes;
use crate::filter::GROUP;
use crate::intersect::{Candidates, any_in_group, for_candidates, nearest_in_group};
use crate::{Exact, HitPacket, LaneMask, Lanes, RayPacket, Spheres};
use core::ops::AddAssign;

/// What rays ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// What they meet first: [`nearest`](crate::nearest).
    Nearest,
    /// Whether they meet anything: [`any`](crate::any).
    Any,
}

/// How many tests of a ray against a sphere reached which stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// All: every ray that may hit anything against every sphere.
    pub tests: u64,
    /// Those that needed double precision, or more.
    pub double: u64,
    /// Those that needed expansions.
    pub expansions: u64,
}

impl AddAssign for Stages {
    fn add_assign(&mut self, other: Self) {
        self.tests += other.tests;
        self.double += other.double;
        self.expansions += other.expansions;
    }
}

/// Counts the stages of `Exact` for these rays and spheres. For reports: it takes several times as
/// long as the answer.
///
/// The counts differ a little between instruction sets: a filter with fused operations is sharper.
#[must_use]
pub fn stages<L: Lanes>(
    token: L::Token,
    rays: &[RayPacket<L>],
    spheres: Spheres<'_>,
    question: Question,
) -> Stages {
    let mut sum = Stages::default();
    for packet in rays {
        let live = (0..L::COUNT).filter(|&lane| packet.ray(lane).is_live()).count();
        sum.tests += live as u64 * spheres.len() as u64;
        let mut walk =
            [Walk::<L> { hit: HitPacket::<L>::none(), met: 0, stages: Stages::default() }];
        for_candidates(
            token,
            core::slice::from_ref(packet),
            &mut walk,
            &spheres,
            |walk| L::mask(token, walk.met),
            |walk, candidates| {
                walk.count(token, candidates, question);
                match question {
                    Question::Nearest => {
                        nearest_in_group::<Exact, L>(token, candidates, &mut walk.hit);
                    }
                    Question::Any => any_in_group::<Exact, L>(token, candidates, &mut walk.met),
                }
            },
        );
        for walk in walk {
            sum += walk.stages;
        }
    }
    sum
}

/// A packet on its way through the list.
struct Walk<L: Lanes> {
    /// The nearest hit so far, where that is asked.
    hit: HitPacket<L>,
    /// The lanes that have met something, where that is asked.
    met: u32,
    stages: Stages,
}

impl<L: Lanes> Walk<L> {
    /// Counts a group of candidates, before it is resolved. Within the group, limits move as they
    /// do when it is.
    fn count(&mut self, token: L::Token, candidates: Candidates<'_, L>, question: Question) {
        let Candidates { rays, filter, group, spheres, first } = candidates;
        let mut limit = L::load(token, &self.hit.t);
        for slot in 0..GROUP {
            let Some(sphere) = spheres.get(first + slot) else { return };
            let asked = rays.live & filter.may_meet(group, slot);
            if !sphere.is_valid() || !asked.any() {
                continue;
            }
            let center = axes!(i => L::splat(token, sphere.center[i]));
            let radius = L::splat(token, sphere.radius);
            let [double, expansions] = Exact::reached(rays, center, radius, asked, limit);
            self.stages.double += u64::from(double.bits().count_ones());
            self.stages.expansions += u64::from(expansions.bits().count_ones());
            if question == Question::Nearest {
                limit = Exact::nearer(rays, center, radius, asked, limit);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ray, Vec3, f32x16};

    /// Rays along z, so far from the axis: through the unit sphere, touching it, and past it.
    fn counted(distances: &[f32], spheres: Spheres<'_>, question: Question) -> Stages {
        let mut packet = RayPacket::<f32x16>::inactive();
        for (lane, &x) in distances.iter().enumerate() {
            packet.set(lane, &Ray::new(Vec3::new(x, 0.0, -3.0), Vec3::Z));
        }
        stages::<f32x16>((), &[packet], spheres, question)
    }

    #[test]
    fn a_tangent_needs_expansions_and_a_clear_miss_nothing() {
        let unit = Spheres::new(&[0.0], &[0.0], &[0.0], &[1.0]).expect("one sphere");
        for question in [Question::Nearest, Question::Any] {
            let of = |distances: &[f32]| counted(distances, unit, question);
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
        let nearest = counted(&[0.25], row, Question::Nearest);
        let any = counted(&[0.25], row, Question::Any);
        assert_eq!((nearest.tests, any.tests), (40, 40));
        assert!(nearest.double <= 2 && any.double <= 4, "{nearest:?} {any:?}");
    }
}
