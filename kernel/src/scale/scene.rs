//! The power of two by which a structure sees lengths.
//!
//! A sphere's size is the largest magnitude among its centre's coordinates and its radius. Of all ranges of 81 exponents,
//! the one that holds the sizes of most spheres is chosen. The power brings the largest of these sizes to some 1, or above
//! if the least would be below 2^-40. No bound sees spheres outside of the range, or spheres that the power would round.

use crate::geometry::sphere::{Sphere, Spheres};
use crate::numeric::power_of_two::inverse_power_of_two;
use wide::f32x4;

/// 2^126: a larger power has no normal inverse.
const MOST: f32 = 1.0 / f32::MIN_POSITIVE;
/// 2^-40: no scaled sphere is smaller, except one of size zero.
pub(crate) const SMALLEST: f32 = 1.0 / (1_u64 << 40) as f32;
/// 2^41: no scaled sphere is larger.
pub(crate) const LARGEST: f32 = (1_u64 << 41) as f32;
/// By how much the largest exponent of a range exceeds the least.
pub(crate) const RANGE: usize = 80;
/// How many exponents of a full range are those of sizes below 1.
const BELOW: usize = 40;
/// How many exponents there are.
const EXPONENTS: usize = 256;

/// The power of two by which a structure sees lengths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneScale {
    /// At least 2^-126 and at most 2^126.
    pub(crate) factor: f32,
    /// 1 over `factor`.
    inverse: f32,
}

impl SceneScale {
    /// Chooses the power for the spheres of a list.
    pub(crate) fn of(spheres: &Spheres<'_>) -> Self {
        let mut counts = [0_u32; EXPONENTS];
        for sphere in spheres.iter() {
            let size = size(&sphere);
            if size > 0.0 {
                counts[exponent_of(size)] += 1;
            }
        }

        // The fullest range is chosen; of equals the one with the smallest spheres, since larger spheres outside cost less.
        let (mut first, mut most, mut held) = (0, 0, 0_u32);
        for (last, count) in counts.iter().enumerate() {
            held = held.wrapping_add(*count);
            if let Some(from) = last.checked_sub(RANGE) {
                if held > most {
                    (first, most) = (from, held);
                }
                held = held.wrapping_sub(counts[from % EXPONENTS]);
            }
        }
        let held = || (first..=first + RANGE).filter(|&at| counts.get(at).is_some_and(|&n| n > 0));
        let (Some(least), Some(largest)) = (held().next(), held().next_back()) else {
            return Self { factor: 1.0, inverse: 1.0 };
        };
        let above = (largest - least).saturating_sub(BELOW);
        // 127 is the exponent of 1. A sum of at most 294, less one of at most 254.
        let exponent = (254 + above).saturating_sub(largest).clamp(1, 253);
        let factor = f32::from_bits((exponent as u32) << 23);
        Self { factor, inverse: 1.0 / factor }
    }

    /// The scale of a structure that was built elsewhere; `None` if `factor` is no such power of two.
    pub(crate) fn from_factor(factor: f32) -> Option<Self> {
        let inverse = 1.0 / factor;
        let is_power = factor.to_bits() << 9 == 0 && (1.0 / MOST..=MOST).contains(&factor);
        is_power.then_some(Self { factor, inverse })
    }

    /// The sphere as bounds see it, exactly; `None` if they do not see it.
    #[inline(always)]
    pub(crate) fn scaled(&self, sphere: &Sphere) -> Option<Sphere> {
        let scaled = times(sphere, self.factor);
        let seen_size = size(&scaled);
        let inside = seen_size <= LARGEST && (seen_size >= SMALLEST || size(sphere) == 0.0);
        (sphere.is_valid() && inside && self.restored(&scaled) == *sphere).then_some(scaled)
    }

    /// Scales four spheres, coordinate by coordinate, as [`scaled`](Self::scaled) does; where that is `None`, the centre is
    /// zero and the radius NaN. Also returns a bit for each sphere that is inside.
    #[inline(always)]
    pub(crate) fn scale_four(&self, own: [f32x4; 4]) -> ([f32x4; 4], u32) {
        let (factor, inverse) = (f32x4::splat(self.factor), f32x4::splat(self.inverse));
        let zero = f32x4::splat(0.0);
        let mut inside = own[3].simd_ge(zero);
        let mut is_point = inside;
        let mut scaled = [zero; 4];
        let mut size = zero;
        for axis in 0..4 {
            let number = own[axis] * factor;
            scaled[axis] = number;
            // A number that is not finite does not fit.
            inside &= number.abs().simd_le(f32x4::splat(LARGEST));
            inside &= (number * inverse).simd_eq(own[axis]);
            is_point &= own[axis].simd_eq(zero);
            size = size.fast_max(number.abs());
        }
        inside &= is_point | size.simd_ge(f32x4::splat(SMALLEST));
        let [x, y, z, radius] = scaled;
        let radius = inside.bitselect(radius, f32x4::splat(f32::NAN));
        ([x & inside, y & inside, z & inside, radius], inside.to_bitmask())
    }

    /// A scaled sphere as it was given.
    #[inline(always)]
    pub(crate) fn restored(&self, scaled: &Sphere) -> Sphere {
        times(scaled, self.inverse)
    }
}

#[inline(always)]
fn times(sphere: &Sphere, factor: f32) -> Sphere {
    Sphere { center: sphere.center * factor, radius: sphere.radius * factor }
}

/// The largest magnitude among centre and radius; zero of a sphere that is not valid.
#[inline(always)]
pub(crate) fn size(sphere: &Sphere) -> f32 {
    if sphere.is_valid() { sphere.center.abs().max_element().max(sphere.radius) } else { 0.0 }
}

/// The power of two that brings a size to some 1, as far as its inverse is a normal number.
#[inline(always)]
pub(crate) fn to_one(size: f32) -> f32 {
    inverse_power_of_two(size).min(MOST)
}

#[inline(always)]
fn exponent_of(size: f32) -> usize {
    (size.to_bits() >> 23) as usize % EXPONENTS
}

#[cfg(all(test, proofs))]
mod tests {
    use super::*;
    use crate::proofs::climb::Random;
    use glam::Vec3;

    /// Bounds see the largest size of the range that begins with the least size, and no larger one.
    #[test]
    fn bounds_see_eighty_powers_of_two() {
        let scale = SceneScale::from_factor(1.0).expect("a power");
        let seen = |radius: f32| scale.scaled(&Sphere { center: Vec3::ZERO, radius }).is_some();
        let largest = 2.0_f32.powi(41);
        assert_eq!([largest, largest.next_up()].map(seen), [true, false]);
        assert_eq!([2.0_f32.powi(-40), 2.0_f32.powi(-40).next_down()].map(seen), [true, false]);
        let [x, y, z, r] = [[0.0; 2], [0.0; 2], [0.0; 2], [2.0_f32.powi(-40), largest.next_down()]];
        let both = Spheres::new(&x, &y, &z, &r).expect("equal lengths");
        let scale = SceneScale::of(&both);
        assert!(both.iter().all(|sphere| scale.scaled(&sphere).is_some()), "{scale:?}");
    }

    /// Four spheres at once are scaled as one by one, whatever their bits.
    #[test]
    fn columns_are_scaled_as_spheres_are() {
        let mut random = Random(31);
        let (mut inside, mut outside) = (0, 0);
        for round in 0..20_000 {
            let exponent = if round % 2 == 0 { 127 } else { 1 + random.below(253) as u32 };
            let scale = SceneScale::from_factor(f32::from_bits(exponent << 23)).expect("a power");
            let mut number = || match random.below(8) {
                0 => f32::from_bits(random.below(1 << 32) as u32),
                1 => 0.0,
                2 => -0.0,
                _ => f32::from_bits((60 + random.below(120) as u32) << 23 | 1),
            };
            let given = [(); 4].map(|()| f32x4::new([(); 4].map(|()| number())));
            let (found, bits) = scale.scale_four(given);
            let (given, found) = (given.map(f32x4::to_array), found.map(f32x4::to_array));
            for lane in 0..4 {
                let [x, y, z, radius] = given.map(|column| column[lane]);
                let there = found.map(|column| column[lane]);
                match scale.scaled(&Sphere { center: Vec3::new(x, y, z), radius }) {
                    Some(Sphere { center, radius }) => {
                        let [x, y, z] = center.to_array();
                        assert_eq!(there.map(f32::to_bits), [x, y, z, radius].map(f32::to_bits));
                        assert_eq!(bits >> lane & 1, 1);
                        inside += 1;
                    }
                    None => {
                        assert!(there[3].is_nan() && there[..3] == [0.0; 3]);
                        assert_eq!(bits >> lane & 1, 0);
                        outside += 1;
                    }
                }
            }
        }
        assert!(inside > 10_000 && outside > 10_000, "{inside}, {outside}");
    }
}
