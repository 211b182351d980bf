//! Lengths and directions of vectors as short or as long as single precision has. The squares of such vectors leave its range, so glam's
//! lengths end at 2^64, and lose digits from 2^-63 on. Scenes in metres of atoms' nuclei, or of galaxies, are beyond that.

use spherule_kernel::Vec3;

/// As `Vec3::length`, with the same bits where no square leaves the range of numbers. Returns `+inf` where the length leaves it.
pub(crate) fn length(vector: Vec3) -> f32 {
    let (scaled, power) = scaled(vector);
    scaled.length() * power
}

/// As `Vec3::try_normalize`, with the same bits where no square leaves the range of numbers. Returns `None` if a component is not finite,
/// or all are zero.
pub(crate) fn direction(vector: Vec3) -> Option<Vec3> {
    scaled(vector).0.try_normalize()
}

/// Returns `vector` divided by a power of two, and that power. The largest component is then from 1 to 2, or less than 1 if it was less
/// than a normal number. The division is exact, except of components that are less than 2^-126 of the largest. A vector that is not finite is returned as it is.
fn scaled(vector: Vec3) -> (Vec3, f32) {
    let largest = vector.abs().max_element();
    if !largest.is_finite() {
        return (vector, 1.0);
    }
    let power = f32::from_bits(largest.to_bits() & f32::INFINITY.to_bits()).max(f32::MIN_POSITIVE);
    (vector / power, power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn powers_of_two_change_the_exponent_alone(
            [x, y, z] in [-9.0_f32..9.0, -9.0_f32..9.0, -9.0_f32..9.0],
            exponent in -100..120,
        ) {
            let vector = Vec3::new(x, y, z);
            prop_assert_eq!(length(vector), vector.length());
            prop_assert_eq!(direction(vector), vector.try_normalize());
            let power = 2.0_f32.powi(exponent);
            // Components that are not numbers of full length any more have other directions.
            prop_assume!(vector.abs().min_element() > 1e-4);
            prop_assert_eq!(length(vector * power), vector.length() * power);
            prop_assert_eq!(direction(vector * power), vector.try_normalize());
        }
    }

    #[test]
    fn vectors_without_a_direction() {
        for none in [Vec3::ZERO, Vec3::splat(f32::NAN), Vec3::X * f32::INFINITY] {
            assert_eq!(direction(none), None, "{none}");
        }
        assert_eq!(length(Vec3::ZERO), 0.0);
        assert_eq!(length(Vec3::splat(f32::MAX)), f32::INFINITY);
        let least = f32::from_bits(1);
        assert_eq!((length(Vec3::X * least), direction(Vec3::Y * least)), (least, Some(Vec3::Y)));
    }
}
