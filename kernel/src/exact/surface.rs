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
//! as seen from the centre, and the normal that by r. So how a coordinate compares with a number m is the sign of
//! A -+ d_i sqrt D, A = alpha_i - m a (times r for a normal): that of both parts, if they agree, else that of the larger one,
//! by the sign of A^2 - d_i^2 D. All of these are sums of products.

use super::long_accumulator::{Product, SumOfEights, SumOfSixes};
use super::quadratic::{QuadraticTerms, Root, midpoint};
use core::cmp::Ordering;

/// What a coordinate is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surveyed {
    /// The unit normal that points out of the sphere.
    Normal,
    /// The point, as seen from the centre.
    Point,
}

/// A coordinate of the surface where a line enters or leaves a sphere of positive radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceCoordinate {
    terms: QuadraticTerms,
    /// What alpha is the sum of, and what a is, times r for a normal.
    alpha: [Product; 8],
    scale: [Product; 3],
    /// d_i, and whether the root of D counts with its sign: at the far root.
    along: Product,
    root: Root,
}

impl SurfaceCoordinate {
    /// Coordinate `axis` for a line that meets the sphere.
    pub(crate) fn new(
        terms: &QuadraticTerms,
        radius: f32,
        axis: usize,
        root: Root,
        of: Surveyed,
    ) -> Self {
        let [[di, ci, oi], [dj, cj, oj], [dk, ck, ok]] =
            [axis, axis + 1, axis + 2].map(|axis| terms.axis(axis));
        let (ij, ik) = (di.times(dj), di.times(dk));
        let (jj, kk) = (dj.times(dj).negated(), dk.times(dk).negated());
        let alpha = [
            ij.times(cj),
            ij.times(oj),
            ik.times(ck),
            ik.times(ok),
            jj.times(ci),
            jj.times(oi),
            kk.times(ci),
            kk.times(oi),
        ];
        let by = if of == Surveyed::Normal { Product::of(radius) } else { Product::ONE };
        let scale = [di, dj, dk].map(|d| d.times(d).times(by).negated());
        Self { terms: *terms, alpha, scale, along: di, root }
    }

    /// The coordinate, correctly rounded, which is from `low` to `high`.
    pub(crate) fn rounded(&self, low: f32, high: f32) -> f32 {
        // What is rounded to the lowest may lie below it.
        let (mut low, mut high) = (place(low) - 1, place(high));
        // The last number that it is not below.
        while low < high {
            let middle = high - (high - low) / 2;
            if self.compare_with(f64::from(number(middle))) == Ordering::Less {
                high = middle - 1;
            } else {
                low = middle;
            }
        }
        let (below, above) = (number(low), number(low + 1));
        let up = match self.compare_with(midpoint(below, above)) {
            Ordering::Less => false,
            Ordering::Greater => true,
            Ordering::Equal => below.to_bits() & 1 == 1,
        };
        (if up { above } else { below }) + 0.0
    }

    /// How the coordinate compares with a number of at most 25 significant bits.
    fn compare_with(&self, number: f64) -> Ordering {
        let m = Product::of_double(number);
        let [x, y, z] = self.scale.map(|scale| scale.times(m));
        let [a, b, c, d, e, f, g, h] = self.alpha;
        let terms = [a, b, c, d, e, f, g, h, x, y, z];
        let mut sum = SumOfSixes::zero();
        terms.into_iter().for_each(|term| sum.add(term));
        let (whole, mut along) = (sum.sign(), self.along.sign());
        if self.root == Root::Near {
            along = along.reverse();
        }
        if whole == along || along == Ordering::Equal {
            return whole;
        }
        let mut difference = SumOfEights::zero();
        difference.add_wide_square(&terms);
        self.terms.add_minus_discriminant(&mut difference, self.along.times(self.along));
        match difference.sign() {
            Ordering::Greater => whole,
            Ordering::Less => along,
            Ordering::Equal => Ordering::Equal,
        }
    }
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
