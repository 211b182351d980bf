//! The 22 regimes in which ray-sphere intersection goes wrong, and cases for each.
//!
//! The legend is that of the [vectors](crate::vectors); the constructions are our own, so that
//! what one hand forgot the other may have. Case `index` of a regime is the same on every machine
//! and for ever: [`crate::kept`] keeps some with their answers.

mod ends;
mod lattice;
mod plain;
mod surface;

use crate::case::Case;
use crate::random::Random;
use std::fmt;

/// A way to be hard.
#[derive(Clone, Copy)]
pub struct Regime {
    /// Its number in the legend.
    pub number: u8,
    /// Its name in the legend.
    pub name: &'static str,
    draw: fn(&mut Random) -> Case,
}

/// The seed of all regimes: changing it changes every kept case.
const SEED: u64 = 22;

/// All regimes, each at the place of its number.
pub const REGIMES: [Regime; 22] = [
    regime(0, "ordinary", plain::ordinary),
    regime(1, "distance/radius 1e2", plain::far::<2>),
    regime(2, "distance/radius 1e4", plain::far::<4>),
    regime(3, "distance/radius 1e6", plain::far::<6>),
    regime(4, "grazing", plain::grazing),
    regime(5, "exact tangent", lattice::tangent),
    regime(6, "next to tangent", lattice::next_to_tangent),
    regime(7, "inside near the surface", surface::inside),
    regime(8, "on the surface", surface::on),
    regime(9, "direction length 2^+-20..120", plain::direction_length),
    regime(10, "translated by 1e6", plain::translated),
    regime(11, "tiny radius", plain::tiny_radius),
    regime(12, "huge radius", plain::huge_radius),
    regime(13, "subnormals", ends::subnormals),
    regime(14, "near overflow", ends::near_overflow),
    regime(15, "t range at the root", surface::range_at_root),
    regime(16, "degenerate", ends::degenerate),
    regime(17, "rounding ties", lattice::tie),
    regime(18, "extreme t", ends::extreme_t),
    regime(19, "random bits", ends::random_bits),
    regime(20, "wide exponents, aimed", ends::wide_exponents),
    regime(21, "origin just outside", surface::outside),
];

const fn regime(number: u8, name: &'static str, draw: fn(&mut Random) -> Case) -> Regime {
    Regime { number, name, draw }
}

impl Regime {
    /// Case `index` of the regime.
    #[must_use]
    pub fn case(&self, index: u64) -> Case {
        (self.draw)(&mut Random::new(SEED + (u64::from(self.number) << 32), index))
    }

    /// The first `count` cases.
    pub fn cases(&self, count: u64) -> impl Iterator<Item = Case> + use<> {
        let regime = *self;
        (0..count).map(move |index| regime.case(index))
    }
}

impl fmt::Debug for Regime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "regime {} ({})", self.number, self.name)
    }
}
