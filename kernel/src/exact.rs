//! One line and its spheres, decided as in real arithmetic.
//!
//! Cases that double precision cannot prove come here: a few tangents, rounding ties and roots that nearly coincide.
//! The code is slow, scalar, and right for every finite `f32`.

pub(crate) mod long_accumulator;
mod order;
mod quadratic;
mod surface;

#[cfg(all(test, proofs))]
pub(crate) use long_accumulator::{Product, SumOfSixes};
pub(crate) use order::compare_roots;
pub(crate) use quadratic::{Quadratic, QuadraticTerms, Root};
pub(crate) use surface::{SurfaceCoordinate, Surveyed};
