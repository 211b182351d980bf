//! One line and one sphere, decided as in real arithmetic.
//!
//! What double precision cannot prove, a few tangents and rounding ties, comes here: slow, scalar,
//! and right for every finite `f32`.

mod expansion;
mod quadratic;

#[cfg(test)]
pub(crate) use expansion::Expansion;
pub(crate) use quadratic::{Quadratic, Root};
