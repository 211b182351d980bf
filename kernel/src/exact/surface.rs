//! The surface where a line meets a sphere: coordinates of the unit normal, and of the point as seen from the centre,
//! correctly rounded.
//!
//! # Method
//!
//! With p = c - o, a = d.d and D = a r^2 - |d x p|^2, the point of either root is
//!
//! ```text
//! t d - p = (alpha -+ d sqrt D) / a,  alpha = d x (d x p)
//! ```
//!
//! as seen from the centre, and the normal is that divided by r. So a coordinate compares with a number m by the sign
//! of A -+ d_i sqrt D, A = alpha_i - m a (times r for a normal). That is the sign of both parts, if they agree, else
//! the sign of the larger part, which the sign of A^2 - d_i^2 D tells. All of these are sums of products.

use super::long_accumulator::{Product, SumOfEights, SumOfSixes};
use super::quadratic::{QuadraticTerms, Root};
use core::cmp::Ordering;

/// What the coordinate belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surveyed {
    /// The unit normal that points out of the sphere.
    Normal,
    /// The point, as seen from the centre.
    Point,
}

/// A coordinate of the surface where a line enters or leaves a sphere of positive radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceCoordinate<'a> {
    pub(crate) terms: &'a QuadraticTerms,
    /// 0, 1 or 2.
    pub(crate) axis: usize,
    pub(crate) root: Root,
    pub(crate) of: Surveyed,
}

impl SurfaceCoordinate<'_> {
    /// The correctly rounded coordinate, which is from `low` to `high`.
    pub(crate) fn rounded(&self, low: f32, high: f32) -> f32 {
        // A coordinate that rounds to the lowest number may lie below it.
        let (mut low, mut high) = (place(low) - 1, place(high));
        // Finds the last number that the coordinate is not below.
        while low < high {
            let middle = high - (high - low) / 2;
            if self.compare_with(&Product::of(number(middle))) == Ordering::Less {
                high = middle - 1;
            } else {
                low = middle;
            }
        }
        let (below, above) = (number(low), number(low + 1));
        let up = match self.compare_with(&Product::between(below, above)) {
            Ordering::Less => false,
            Ordering::Greater => true,
            Ordering::Equal => below.to_bits() & 1 == 1,
        };
        (if up { above } else { below }) + 0.0
    }

    /// How the coordinate compares with a number of at most 25 bits.
    fn compare_with(&self, number: &Product) -> Ordering {
        let whole_terms = self.whole(number);
        let along = self.terms.d(self.axis);
        let whole = sign_of_sum(&whole_terms);
        let mut part = along.sign();
        if self.root == Root::Near {
            part = part.reverse();
        }
        if whole == part || part == Ordering::Equal {
            return whole;
        }
        match self.sign_of_difference(&whole_terms, &along.times(&along)) {
            Ordering::Greater => whole,
            Ordering::Less => part,
            Ordering::Equal => Ordering::Equal,
        }
    }

    /// The terms of A. (Made anew for each number: kept, they are most of the stack.)
    fn whole(&self, m: &Product) -> [Product; 11] {
        let (terms, i, j, k) = (self.terms, self.axis, self.axis + 1, self.axis + 2);
        let (di, dj, dk) = (terms.d(i), terms.d(j), terms.d(k));
        let (ci, cj, ck) = (terms.c(i), terms.c(j), terms.c(k));
        let (oi, oj, ok) = (terms.o(i), terms.o(j), terms.o(k));
        let (ij, ik) = (di.times(&dj), di.times(&dk));
        let (jj, kk) = (dj.times(&dj).negated(), dk.times(&dk).negated());
        let scale = match self.of {
            Surveyed::Normal => m.times(&self.terms.radius()),
            Surveyed::Point => *m,
        };
        let scale = scale.negated();
        [
            ij.times(&cj),
            ij.times(&oj),
            ik.times(&ck),
            ik.times(&ok),
            jj.times(&ci),
            jj.times(&oi),
            kk.times(&ci),
            kk.times(&oi),
            di.times(&di).times(&scale),
            dj.times(&dj).times(&scale),
            dk.times(&dk).times(&scale),
        ]
    }

    /// The sign of A^2 - d_i^2 D.
    #[inline(never)]
    fn sign_of_difference(&self, whole: &[Product; 11], square: &Product) -> Ordering {
        let mut sum = SumOfEights::zero();
        sum.add_wide_square(whole);
        self.terms.add_minus_discriminant(&mut sum, square);
        sum.sign()
    }
}

#[inline(never)]
fn sign_of_sum(terms: &[Product; 11]) -> Ordering {
    let mut sum = SumOfSixes::zero();
    for term in terms {
        sum.add(term);
    }
    sum.sign()
}

/// The place of a number among all, in their order; both zeros at 0.
fn place(x: f32) -> i64 {
    let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// The number at a place.
fn number(place: i64) -> f32 {
    let x = f32::from_bits(place.unsigned_abs() as u32);
    if place < 0 { -x } else { x }
}
