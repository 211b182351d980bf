//! The families of cases in which ray-sphere intersection goes wrong.
//!
//! The first 22, [`HARD`], have the numbers of the legend of 100,000 cases that another hand made. The constructions are our own, so that
//! one hand may have what the other forgot. The other families are of small integers, so that a failing case is readable. Family, seed and
//! index determine a case, which is the same on every machine and for ever.

mod ends;
mod lattice;
mod plain;
mod small;
mod surface;
mod unit_direction;

use crate::case::Case;
use crate::random::Random;
use std::fmt;

/// A way to be hard.
#[derive(Clone, Copy)]
pub struct Family {
    /// Its place among [`FAMILIES`].
    pub number: u8,
    /// Its name: lower case, words joined by hyphens.
    pub name: &'static str,
    /// What it attacks, in a line.
    pub attacks: &'static str,
    draw: fn(&mut Random) -> Case,
}

/// The seed of the kept and pinned cases: changing it changes all of them.
pub const SEED: u32 = 22;

/// How many families are [`HARD`].
const HARD_ONES: usize = 22;

/// All families, each at the place of its number.
pub const FAMILIES: [Family; 24] = [
    family(0, "ordinary", "nothing: a scene of a few units, for comparison", plain::ordinary),
    family(1, "far-1e2", "p.p - r^2 where the centre is 100 radii away", plain::far::<2>),
    family(2, "far-1e4", "p.p - r^2 where r^2 is below the last bit of p.p", plain::far::<4>),
    family(
        3,
        "far-1e6",
        "c - o, rounded where the radius is a millionth of the way",
        plain::far::<6>,
    ),
    family(
        4,
        "grazing",
        "the sign of D where the line passes within 2^-6 to 2^-26 of the radius",
        plain::grazing,
    ),
    family(5, "tangent", "D = 0 exactly, by integer quaternions", lattice::tangent),
    family(
        6,
        "near-tangent",
        "D next to zero: a tangent with one number one to three ulp off",
        lattice::next_to_tangent,
    ),
    family(
        7,
        "inside",
        "t near zero: starts 2^-4 to 2^-26 radii under the surface, give or take rounding",
        surface::inside,
    ),
    family(
        8,
        "on-surface",
        "t = 0: starts on the surface, exactly or as rounding put it",
        surface::on,
    ),
    family(
        9,
        "direction-length",
        "d.d that overflows or underflows: directions 2^20 to 2^120 long, or as short",
        plain::direction_length,
    ),
    family(
        10,
        "translated",
        "products of c and o that cancel: a common scene, a million units from zero",
        plain::translated,
    ),
    family(11, "tiny-radius", "r^2 that underflows: radii of 2^-93 to 2^-37", plain::tiny_radius),
    family(
        12,
        "huge-radius",
        "r^2 that overflows, and standing on a planet: radii of 2^37 to 2^93",
        plain::huge_radius,
    ),
    family(
        13,
        "subnormal",
        "subnormal numbers, which some machines flush to zero",
        ends::subnormals,
    ),
    family(
        14,
        "overflow",
        "lengths of 2^100 and more, whose squares are beyond single precision",
        ends::near_overflow,
    ),
    family(
        15,
        "interval-at-root",
        "the ends of the interval: at a root, or an ulp or two beside it",
        surface::range_at_root,
    ),
    family(
        16,
        "degenerate",
        "what the contract judges by name: NaN, infinity, zero directions, points, empty intervals",
        ends::degenerate,
    ),
    family(
        17,
        "tie",
        "the rounding of t: roots midway between two neighbouring numbers",
        lattice::tie,
    ),
    family(
        18,
        "extreme-t",
        "t about the largest and the least number; 6 in 100 directions overflow, so hit nothing",
        ends::extreme_t,
    ),
    family(19, "random-bits", "any bits in all places", ends::random_bits),
    family(
        20,
        "wide-exponents",
        "every size of its own power of two, and yet most lines meet",
        ends::wide_exponents,
    ),
    family(
        21,
        "outside",
        "t near zero: starts 2^-4 to 2^-26 radii over the surface, give or take rounding, looking down",
        surface::outside,
    ),
    family(
        22,
        "small-integers",
        "tangents and ties that can be read: integers of one digit",
        small::integers,
    ),
    family(
        23,
        "near-small-integers",
        "the same with one number an ulp or two away",
        small::near_integers,
    ),
];

const fn family(
    number: u8,
    name: &'static str,
    attacks: &'static str,
    draw: fn(&mut Random) -> Case,
) -> Family {
    Family { number, name, attacks, draw }
}

/// The families of the legend.
pub static HARD: &[Family] = FAMILIES.split_at(HARD_ONES).0;

impl Family {
    /// The family of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        FAMILIES.into_iter().find(|family| family.name == name)
    }

    /// Case `index` of the pinned [`SEED`].
    #[must_use]
    pub fn case(&self, index: u64) -> Case {
        self.seeded(SEED, index)
    }

    /// Case `index` of a seed.
    #[must_use]
    pub fn seeded(&self, seed: u32, index: u64) -> Case {
        (self.draw)(&mut Random::new(u64::from(seed) + (u64::from(self.number) << 32), index))
    }

    /// Case `index` of a seed, its direction brought to length one, as near as `f32` does: for what promises nothing of other lengths.
    ///
    /// An end of the interval stays as many ulp from the root that it was made for; other ends keep their places on the ray. Rounding moves
    /// the line, so tangents and ties are near ones, except along an axis.
    #[must_use]
    pub fn seeded_unit(&self, seed: u32, index: u64) -> Case {
        unit_direction::with_unit_direction(&self.seeded(seed, index))
    }

    /// The first `count` cases of the pinned [`SEED`].
    pub fn cases(&self, count: u64) -> impl Iterator<Item = Case> + use<> {
        let family = *self;
        (0..count).map(move |index| family.case(index))
    }
}

impl fmt::Debug for Family {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "family {} ({})", self.number, self.name)
    }
}
