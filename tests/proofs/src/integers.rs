//! What is exact in the kernel, against integers of any size.

mod long_accumulator;
mod order;

use num_bigint::BigInt;

/// A finite number in units of 2^-149.
pub(crate) fn units(x: f32) -> BigInt {
    let (exponent, fraction) = (x.to_bits() >> 23 & 0xff, x.to_bits() & 0x007f_ffff);
    let units = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 0x0080_0000) << (exponent - 1),
    };
    if x < 0.0 { -units } else { units }
}
