//! Arithmetic that knows no geometry: vectors of three, sums and products without error, rounding
//! outward, and whether the machine rounds as the proofs assume.

pub(crate) mod axes;
pub(crate) mod error_free;
pub(crate) mod float_environment;
pub(crate) mod rounding;
