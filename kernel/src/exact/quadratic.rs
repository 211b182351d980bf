//! The line x(t) = o + t d and the surface |x - c| = r, exactly.
//!
//! # Method
//!
//! With p = c - o, a = d.d, b = d.p and the power of the origin k = p.p - r^2, the line meets the
//! sphere where a t^2 - 2 b t + k = 0: at t = (b -+ sqrt D) / a with
//! D = b^2 - a k = a r^2 - |d x p|^2 (Lagrange). The second form has fewer terms.
//!
//! The sign of D, exactly, decides whether there are roots. A root is then estimated to
//! 16 u (u = 2^-53), which leaves one `f32` it can round to, or two neighbours. Which of two is
//! told by the side of their midpoint m that the root lies on, for which no root need be taken:
//! with v = m d - p, f = |v|^2 - r^2 and g = d.v, half the slope of f along the line,
//!
//! ```text
//! m < t1  iff f > 0 and g < 0        m > t2  iff f > 0 and g > 0
//! m = t1  iff f = 0 and g <= 0       m = t2  iff f = 0 and g >= 0
//! ```
//!
//! All sums are exact, in a [`LongAccumulator`]. Two roots of one line are compared by the same means
//! (`order.rs`).

use super::long_accumulator::{LongAccumulator, Product};
use core::cmp::Ordering;

/// Which of the two roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Root {
    /// t1, the smaller.
    Near,
    /// t2.
    Far,
}

/// A line that meets a sphere, and estimates of its roots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quadratic {
    terms: QuadraticTerms,
    /// t1 and t2, each within 10 u of itself.
    estimates: [f64; 2],
}

/// What the coefficients of a quadratic are sums of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadraticTerms {
    /// d, c and -o, axis by axis.
    pub(super) direction: [Product; 3],
    pub(super) center: [Product; 3],
    pub(super) minus_origin: [Product; 3],
    /// -r^2.
    pub(super) minus_square: Product,
}

impl QuadraticTerms {
    /// Domain: a valid ray and a valid sphere. Anything else returns too, with no meaning.
    pub(crate) fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        center: [f32; 3],
        radius: f32,
    ) -> Self {
        let radius = Product::of(radius);
        Self {
            direction: direction.map(Product::of),
            center: center.map(Product::of),
            minus_origin: origin.map(|o| Product::of(o).negated()),
            minus_square: radius.times(radius).negated(),
        }
    }

    /// -D = |d x p|^2 - a r^2.
    fn minus_discriminant(&self) -> LongAccumulator {
        let mut sum = LongAccumulator::zero();
        let Self { direction: d, center: c, minus_origin: o, minus_square } = self;
        // Each component of d x p from the two axes after its own.
        for (i, j) in [(1, 2), (2, 0), (0, 1)] {
            let minus = d[j].negated();
            let component =
                [d[i].times(c[j]), d[i].times(o[j]), minus.times(c[i]), minus.times(o[i])];
            sum.add_square(&component, Product::ONE);
        }
        for d in d {
            sum.add_product(*minus_square, d.times(*d));
        }
        sum
    }

    /// What b = d.p is the sum of.
    pub(super) fn half_slope(&self) -> [Product; 6] {
        let Self {
            direction: [dx, dy, dz], center: [cx, cy, cz], minus_origin: [ox, oy, oz], ..
        } = *self;
        [dx.times(cx), dy.times(cy), dz.times(cz), dx.times(ox), dy.times(oy), dz.times(oz)]
    }

    /// What k = p.p - r^2 is the sum of: what the sphere alone decides, and |o|^2.
    pub(super) fn power(&self) -> ([Product; 7], [Product; 3]) {
        let Self { center: [cx, cy, cz], minus_origin: [ox, oy, oz], minus_square, .. } = *self;
        let twice = |c: Product, o: Product| c.times(o).scaled(1);
        let squares = [cx.times(cx), cy.times(cy), cz.times(cz)];
        let [x, y, z] = squares;
        let of_sphere = [x, y, z, twice(cx, ox), twice(cy, oy), twice(cz, oz), minus_square];
        (of_sphere, [ox.times(ox), oy.times(oy), oz.times(oz)])
    }
}

impl Quadratic {
    /// `None` if the line misses the sphere; a tangent does not miss it.
    ///
    /// Domain: a valid ray and a valid sphere. Anything else returns too, with no meaning.
    pub(crate) fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        center: [f32; 3],
        radius: f32,
    ) -> Option<Self> {
        let terms = QuadraticTerms::new(origin, direction, center, radius);
        let minus_discriminant = terms.minus_discriminant();
        if minus_discriminant.sign() == Ordering::Greater {
            return None;
        }

        // q = b + sign(b) sqrt D does not cancel: 2 u of b, 2 u of the root, 1 u of the sum.
        // a is within 2 u, k within 2 u; so q / a within 8 u, k / q within 8 u.
        let root = libm::sqrt(-minus_discriminant.estimate());
        let (mut b, mut k) = (LongAccumulator::zero(), LongAccumulator::zero());
        terms.half_slope().into_iter().for_each(|term| b.add(term));
        let (of_sphere, of_origin) = terms.power();
        of_sphere.into_iter().chain(of_origin).for_each(|term| k.add(term));
        let (b, k) = (b.estimate(), k.estimate());
        let a: f64 = direction.iter().map(|&d| f64::from(d) * f64::from(d)).sum();
        let q = if b < 0.0 { b - root } else { b + root };
        // q is zero only where b and D are, and then so is k: both roots are zero.
        let other = if k == 0.0 { 0.0 } else { k / q };
        let estimates = if b < 0.0 { [q / a, other] } else { [other, q / a] };
        Some(Self { terms, estimates })
    }

    /// The correctly rounded root; +0 for zero, infinite where it rounds so.
    pub(crate) fn rounded(&self, root: Root) -> f32 {
        let estimate = self.estimates[usize::from(root == Root::Far)];
        let error = estimate.abs() * (16.0 * f64::EPSILON / 2.0);
        let (low, high) = ((estimate - error) as f32, (estimate + error) as f32);
        let rounded = if low == high {
            low
        } else {
            match self.compare_with(midpoint(low, high), root) {
                Ordering::Less => low,
                Ordering::Greater => high,
                // The one with an even last bit.
                Ordering::Equal if low.to_bits() & 1 == 0 => low,
                Ordering::Equal => high,
            }
        };
        // Adding zero turns -0 into +0.
        rounded + 0.0
    }

    /// How a root compares with `t`, a number of at most 25 significant bits.
    #[inline(never)]
    fn compare_with(&self, t: f64, root: Root) -> Ordering {
        let QuadraticTerms { direction, center, minus_origin, minus_square } = self.terms;
        // 25 bits and 24, squared, are no more than 128.
        let t = Product::of_double(t);
        let (mut f, mut g) = (LongAccumulator::zero(), LongAccumulator::zero());
        f.add(minus_square);
        for ((d, c), o) in direction.into_iter().zip(center).zip(minus_origin) {
            // m d - p, with p = c - o.
            let component = [t.times(d), c.negated(), o.negated()];
            f.add_square(&component, Product::ONE);
            g.add_products(&component, &[d]);
        }
        let outward = if root == Root::Near { Ordering::Less } else { Ordering::Greater };
        match (f.sign(), g.sign()) {
            (Ordering::Greater, slope) if slope == outward => outward.reverse(),
            (Ordering::Equal, slope) if slope == outward || slope == Ordering::Equal => {
                Ordering::Equal
            }
            _ => outward,
        }
    }
}

/// The number half-way between neighbours, exactly; an infinity stands for the `f32` that would
/// come next, 2^128, as it does in rounding.
fn midpoint(low: f32, high: f32) -> f64 {
    let end = |single: f32| {
        if single.is_finite() { f64::from(single) } else { TWO_128.copysign(f64::from(single)) }
    };
    (end(low) + end(high)) * 0.5
}

const TWO_128: f64 = 2.0 * (1u128 << 127) as f64;

#[cfg(test)]
mod by_hand;
