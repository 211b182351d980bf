//! How far from the surface origins are tried.

use crate::lanes::Lanes;
use crate::numeric::axes::largest;

/// A step: an ulp of the largest coordinate; more near zero, where a point is not known so well.
#[inline(always)]
pub(super) fn step_of<L: Lanes>(point: [L; 3], radius: L) -> L {
    let largest = largest(point);
    // Between half an ulp and one, so that the sum is rounded to the next number; of the half, since the largest number has no next.
    let half = largest * largest.like(0.5);
    let ulp = (half + half * half.like(MORE_THAN_HALF)) - half;
    let ulp = (ulp + ulp).filter_max(largest.like(f32::from_bits(1)));
    ulp.filter_max(radius * radius.like(LEAST_STEP))
}

/// 2^-24, and a little more.
const MORE_THAN_HALF: f32 = f32::EPSILON * 0.500_5;
/// 2^-47 of the radius.
const LEAST_STEP: f32 = 1.0 / (1_u64 << 47) as f32;

/// How many steps from the surface the next origin is tried: 0, 1/2, 1, 2, 4 ...
#[inline(always)]
pub(super) fn next(steps: f64) -> f64 {
    if steps > 0.0 { 2.0 * steps } else { 0.5 }
}

/// Half a step, doubled 62 times: past the size of any sphere.
pub(super) const MOST_STEPS: u32 = 64;
