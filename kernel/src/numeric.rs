//! Arithmetic: vectors of three, sums and products without error, the power of a point, rounding outward, powers of
//! two, sorts of whole numbers, places on a Z curve, and whether the machine rounds as the proofs assume.

pub(crate) mod axes;
pub(crate) mod error_free;
pub(crate) mod float_environment;
pub(crate) mod heap_sort;
pub(crate) mod power_of_point;
pub(crate) mod power_of_two;
pub(crate) mod radix_sort;
pub(crate) mod rounding;
#[cfg(feature = "alloc")]
pub(crate) mod z_curve;
