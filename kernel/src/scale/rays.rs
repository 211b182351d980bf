//! Rays as a structure sees them: their origins are scaled as its spheres are, and their directions are brought to
//! some unit length where their squares would over- or underflow.

use crate::accuracy::RayLanes;
use crate::lanes::Lanes;
use crate::numeric::axes::{axes, largest};
use crate::numeric::power_of_two::inverse_powers_of_two;

/// Rays whose origins and directions are scaled; their t are as given.
#[derive(Clone, Copy)]
pub(crate) struct ScaledRays<L: Lanes> {
    pub(crate) rays: RayLanes<L>,
    /// How many multiples of the scaled direction, in the units of the structure, a t of 1 is: a power of two. NaN
    /// where no such power can be said: there all t of the scene are too large for numbers, or all are nearly
    /// zero.
    pub(crate) per_t: L,
    /// At least the distance between the least numbers that t can be, in multiples of the scaled direction.
    pub(crate) step: L,
    /// Where `per_t` is NaN: no point at a finite t is farther from the origin, in the units of the structure.
    pub(crate) reach: L,
}

/// 2^40: added to `per_t`, it keeps a step from being subnormal.
const LEAST_PER_T: f32 = (1_u64 << 40) as f32;
/// 2^-89 and 2^-60: their product is the least number.
const LEAST: [f32; 2] = [1.0 / (1_u128 << 89) as f32, 1.0 / (1_u64 << 60) as f32];
/// 2^-20: f of 2^-150 at most, times a t below 2^128, times a direction of length 2 sqrt 3 at most.
pub(crate) const NEAR: f32 = 1.0 / (1_u64 << 20) as f32;

impl<L: Lanes> ScaledRays<L> {
    /// Scales rays whose directions have a usual length.
    #[inline(always)]
    pub(crate) fn new(rays: &RayLanes<L>, factor: f32) -> Self {
        let origin = axes!(i => rays.origin[i] * rays.t_min.like(factor));
        Self::at(origin, rays, factor)
    }

    /// Scales such rays as if they began in the coordinates' origin.
    #[inline(always)]
    pub(crate) fn from_zero(rays: &RayLanes<L>, factor: f32) -> Self {
        Self::at([rays.t_min.like(0.0); 3], rays, factor)
    }

    #[inline(always)]
    fn at(origin: [L; 3], rays: &RayLanes<L>, factor: f32) -> Self {
        let per_t = rays.t_min.like(factor);
        let (step, reach) = (step_of(per_t), per_t.like(f32::INFINITY));
        Self { rays: RayLanes { origin, ..*rays }, per_t, step, reach }
    }

    /// Scales rays whose directions have any length.
    #[inline(always)]
    pub(crate) fn of_any_length(rays: &RayLanes<L>, factor: f32) -> Self {
        let scale = inverse_powers_of_two(largest(rays.direction));
        let Self { rays, per_t, reach, .. } = Self::new(rays, factor);
        let (zero, none) = (per_t.like(0.0), per_t.like(f32::NAN));
        let per_t = per_t / scale;
        let short = per_t.le(zero);
        let known = zero.lt(per_t) & per_t.lt(reach);
        Self {
            rays: RayLanes { direction: axes!(i => rays.direction[i] * scale), ..rays },
            per_t: L::select(known, per_t, none),
            step: L::select(known, step_of(per_t), zero),
            reach: L::select(short, per_t.like(NEAR), reach),
        }
    }
}

/// At least the distance between the least numbers that t can be, in multiples of a direction. (The number added
/// avoids subnormal numbers, which cost some CPUs a hundred cycles: a sixth of a depth list's time.)
#[inline(always)]
pub(crate) fn step_of<L: Lanes>(per_t: L) -> L {
    (per_t + per_t.like(LEAST_PER_T)) * per_t.like(LEAST[0]) * per_t.like(LEAST[1])
}
