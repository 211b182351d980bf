//! Powers of two from the exponents of numbers: multiplying by them is exact, unless it over- or underflows.

use crate::Lanes;

/// 2^-e for a number in [2^e, 2^(e+1)), as far as that is a normal number.
#[inline(always)]
pub(crate) fn inverse_power_of_two(number: f32) -> f32 {
    let exponent = (number.to_bits() >> 23) & 0xff;
    f32::from_bits((254 - exponent.min(253)) << 23)
}

/// [`inverse_power_of_two`] in every lane.
#[inline(always)]
pub(crate) fn inverse_powers_of_two<L: Lanes>(numbers: L) -> L {
    let mut powers = numbers.store();
    for power in powers.as_mut() {
        *power = inverse_power_of_two(*power);
    }
    L::load(numbers.token(), &powers)
}
