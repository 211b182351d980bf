//! One line and its spheres, decided as in real arithmetic.
//!
//! What double precision cannot prove, a few tangents, rounding ties and roots that nearly coincide, comes here:
//! slow, scalar, and right for every finite `f32`.

pub(crate) mod long_accumulator;
pub(crate) mod order;
pub(crate) mod quadratic;
mod surface;

#[cfg(all(test, proofs))]
pub(crate) use long_accumulator::{Product, SumOfSixes};
pub(crate) use order::compare_roots;
pub(crate) use quadratic::{Quadratic, QuadraticTerms, Root};
pub(crate) use surface::{SurfaceCoordinate, Surveyed};
