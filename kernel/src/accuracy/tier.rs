//! The choice of a tier: by type at build time, or by value at run time.
//!
//! Traversals are compiled once, not once a tier: a tier changes only one number in them, its
//! [`spread`](TierFormula::SPREAD). The tests of spheres are compiled for each tier, as a [`TierWork`], and the tier
//! chooses among them: at build time if it is a type, by one branch if it is a [`Tier`].

use super::formula::{Squares, Tier, TierFormula, TierWork, Underflow};
use super::roots::RayLanes;
use super::{Exact, Fast, Geometric, Stable};
use crate::count::count;
use crate::geometry::sphere::Spheres;
use crate::numeric::rounding::U;
use crate::{Lanes, Ray, Sphere};
use core::cmp::Ordering;
use core::fmt::Debug;

mod sealed {
    /// Calls the formula of a tier.
    pub trait Chosen: Copy {
        /// [`TierFormula::SPREAD`](super::TierFormula::SPREAD).
        fn spread(self) -> f32;
        /// How far two answers may contradict the order of their roots, in units of T: zero if roots are ordered.
        fn answer_error(self) -> f32;
        /// [`TierFormula::UNDERFLOW`](super::TierFormula::UNDERFLOW).
        fn underflow(self) -> super::Underflow;
        /// [`TierFormula::SQUARES`](super::TierFormula::SQUARES).
        fn squares(self) -> super::Squares;
        /// Does `work` by the formula of the tier.
        fn with_formula<W: super::TierWork>(self, work: W) -> W::Output;
        /// [`TierFormula::compare_at`](super::TierFormula::compare_at).
        fn compare_at(
            self,
            ray: &super::Ray,
            t: f32,
            spheres: [&super::Sphere; 2],
        ) -> super::Ordering;
    }
}

/// A tier: [`Fast`], [`Geometric`], [`Stable`] or [`Exact`], known at build time, or a [`Tier`], known at run time.
///
/// Sealed: the scene structures prove their bounds tier by tier.
pub trait Accuracy: sealed::Chosen + Copy + Debug {
    /// The tier as a value.
    fn tier(self) -> Tier;
}

impl<F: TierFormula> sealed::Chosen for F {
    #[inline(always)]
    fn spread(self) -> f32 {
        F::SPREAD
    }

    #[inline(always)]
    fn underflow(self) -> Underflow {
        F::UNDERFLOW
    }

    #[inline(always)]
    fn squares(self) -> Squares {
        F::SQUARES
    }

    #[inline(always)]
    fn answer_error(self) -> f32 {
        if F::ORDERS_ROOTS { 0.0 } else { 8.0 * U }
    }

    #[inline(always)]
    fn with_formula<W: TierWork>(self, work: W) -> W::Output {
        work.run::<F>()
    }

    #[inline(always)]
    fn compare_at(self, ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
        F::compare_at(ray, t, spheres)
    }
}

impl<F: TierFormula> Accuracy for F {
    #[inline(always)]
    fn tier(self) -> Tier {
        F::TIER
    }
}

/// The value of an expression in which a name stands for the type of a tier.
macro_rules! by_tier {
    ($tier:expr, $formula:ident => $value:expr) => {
        match $tier {
            Tier::Fast => {
                type $formula = Fast;
                $value
            }
            Tier::Geometric => {
                type $formula = Geometric;
                $value
            }
            Tier::Stable => {
                type $formula = Stable;
                $value
            }
            Tier::Exact => {
                type $formula = Exact;
                $value
            }
        }
    };
}

impl sealed::Chosen for Tier {
    #[inline(always)]
    fn spread(self) -> f32 {
        by_tier!(self, F => F::SPREAD)
    }

    #[inline(always)]
    fn underflow(self) -> Underflow {
        by_tier!(self, F => F::UNDERFLOW)
    }

    #[inline(always)]
    fn squares(self) -> Squares {
        by_tier!(self, F => F::SQUARES)
    }

    #[inline(always)]
    fn answer_error(self) -> f32 {
        if self == Self::Exact { 0.0 } else { 8.0 * U }
    }

    #[inline(always)]
    fn with_formula<W: TierWork>(self, work: W) -> W::Output {
        by_tier!(self, F => work.run::<F>())
    }

    #[inline(always)]
    fn compare_at(self, ray: &Ray, t: f32, spheres: [&Sphere; 2]) -> Ordering {
        by_tier!(self, F => <F as TierFormula>::compare_at(ray, t, spheres))
    }
}

impl Accuracy for Tier {
    #[inline(always)]
    fn tier(self) -> Tier {
        self
    }
}

/// Whether `new` is the closer of two spheres of a list that `ray` hits at the same `t` (rule 5): by real numbers if
/// the tier tells them apart, else by index.
#[cold]
#[inline(never)]
pub(crate) fn is_closer(
    tier: impl Accuracy,
    spheres: &Spheres<'_>,
    ray: &Ray,
    t: f32,
    [new, old]: [u32; 2],
) -> bool {
    // A ray that went on by itself may meet the same sphere once more.
    if new == old {
        return false;
    }
    let compared = match (sphere(spheres, new), sphere(spheres, old)) {
        (Some(new), Some(old)) => tier.compare_at(ray, t, [&new, &old]),
        _ => Ordering::Equal,
    };
    compared.then(new.cmp(&old)).is_lt()
}

/// A sphere of a list; a call on 32-bit targets, where code is dear.
#[cfg_attr(target_pointer_width = "32", inline(never))]
fn sphere(spheres: &Spheres<'_>, index: u32) -> Option<Sphere> {
    spheres.get(index as usize)
}

/// Tests one sphere a lane: t if there is a hit in a lane that is `active`, else `+inf`. If `any` hit will do, t may be another number.
///
/// Scene structures test spheres only here, in one function for each tier: a tier is long, and would be compiled into
/// every traversal several times.
#[inline(always)]
pub(crate) fn test_lanes<L: Lanes>(
    tier: impl Accuracy,
    rays: &RayLanes<L>,
    center: [L; 3],
    radius: L,
    active: L::Mask,
    limit: L,
    any: bool,
) -> L {
    tier.with_formula(LaneTest { rays, center, radius, active, limit, any })
}

/// Tests a live ray against a valid sphere: t if there is a hit, else `+inf`.
#[cfg(feature = "std")]
#[inline(always)]
pub(crate) fn test_one(tier: impl Accuracy, ray: &Ray, sphere: &Sphere) -> f32 {
    tier.with_formula(OneTest { ray, sphere })
}

/// The arguments of [`test_one`].
#[cfg(feature = "std")]
struct OneTest<'a> {
    ray: &'a Ray,
    sphere: &'a Sphere,
}

#[cfg(feature = "std")]
impl TierWork for OneTest<'_> {
    type Output = f32;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> f32 {
        F::first_root_of(self.ray, self.sphere)
    }
}

/// The arguments of [`test_lanes`].
struct LaneTest<'a, L: Lanes> {
    rays: &'a RayLanes<L>,
    center: [L; 3],
    radius: L,
    active: L::Mask,
    limit: L,
    any: bool,
}

impl<L: Lanes> TierWork for LaneTest<'_, L> {
    type Output = L;

    #[inline(always)]
    fn run<F: TierFormula>(self) -> L {
        count!(TierLanes);
        let Self { rays, center, radius, active, limit, any } = self;
        L::out_of_line(
            limit.token(),
            #[inline(always)]
            || {
                let prepared = F::prepare(rays);
                let t = F::first_root(rays, &prepared, center, radius, active, limit, any);
                L::select(active, t, limit.like(f32::INFINITY))
            },
        )
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;

    /// What traversals read of a tier.
    fn numbers(tier: impl Accuracy) -> ([f32; 4], Squares) {
        let Underflow { length, size } = tier.underflow();
        ([tier.spread(), tier.answer_error(), length, size], tier.squares())
    }

    #[test]
    fn a_value_has_the_numbers_of_its_type() {
        let types = [numbers(Fast), numbers(Geometric), numbers(Stable), numbers(Exact)];
        assert_eq!(Tier::ALL.map(numbers), types);
    }
}
