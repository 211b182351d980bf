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

use super::long_accumulator::{LongAccumulator, Product, SumOfSixes};
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

/// A line and a sphere, as what the coefficients of their quadratic are sums of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadraticTerms {
    origin: [f32; 3],
    direction: [f32; 3],
    center: [f32; 3],
    radius: f32,
}

/// A coefficient of the quadratic, or a part of one, that is a sum of products of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coefficient {
    /// b = d.p: the terms with c, then those with o.
    HalfSlope,
    /// k = p.p - r^2: what depends on the sphere, then |o|^2.
    Power,
    /// k without |o|^2.
    PowerOfSphere,
}

impl Coefficient {
    /// How many terms.
    pub(super) const fn terms(self) -> usize {
        match self {
            Self::HalfSlope => 6,
            Self::PowerOfSphere => 7,
            Self::Power => 10,
        }
    }
}

impl QuadraticTerms {
    /// Domain: a valid ray and a valid sphere. Anything else returns too, with no meaning.
    pub(crate) const fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        center: [f32; 3],
        radius: f32,
    ) -> Self {
        Self { origin, direction, center, radius }
    }

    /// d along an axis. (Made anew where it is needed, as are the others: kept, they are most of the stack.)
    pub(super) fn d(&self, axis: usize) -> Product {
        Product::of(self.direction[axis % 3])
    }

    /// c along an axis.
    pub(super) fn c(&self, axis: usize) -> Product {
        Product::of(self.center[axis % 3])
    }

    /// -o along an axis.
    pub(super) fn o(&self, axis: usize) -> Product {
        Product::of(-self.origin[axis % 3])
    }

    /// r.
    pub(super) fn radius(&self) -> Product {
        Product::of(self.radius)
    }

    /// -r^2.
    pub(super) fn minus_square(&self) -> Product {
        self.radius().times(self.radius()).negated()
    }

    /// Adds -D = |d x p|^2 - a r^2, times `factor`, of 64 bits at most.
    #[inline(never)]
    pub(super) fn add_minus_discriminant<const LIMBS: usize>(
        &self,
        sum: &mut LongAccumulator<LIMBS>,
        factor: Product,
    ) {
        for k in 0..3 {
            self.add_minus_component(sum, k, factor);
        }
    }

    /// Of that the part of one axis: a component of d x p comes from the two axes after its own.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_minus_component<const LIMBS: usize>(
        &self,
        sum: &mut LongAccumulator<LIMBS>,
        k: usize,
        factor: Product,
    ) {
        let (i, j) = (k + 1, k + 2);
        let component = [
            self.d(i).times(self.c(j)),
            self.d(i).times(self.o(j)),
            self.d(j).times(self.c(i)).negated(),
            self.d(j).times(self.o(i)).negated(),
        ];
        sum.add_square(&component, factor);
        sum.add_product(self.minus_square().times(self.d(i).times(self.d(i))), factor);
    }

    /// Term `number` of those that a coefficient is the sum of.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(super) fn term(&self, of: Coefficient, number: usize) -> Product {
        let (one, other) = match (of, number) {
            (Coefficient::HalfSlope, 0..3) => (self.d(number), self.c(number)),
            (Coefficient::HalfSlope, _) => (self.d(number), self.o(number)),
            (_, 0..3) => (self.c(number), self.c(number)),
            (_, 3..6) => (self.c(number).scaled(1), self.o(number)),
            (_, 6) => (self.radius(), self.radius().negated()),
            _ => (self.o(number), self.o(number)),
        };
        one.times(other)
    }

    /// A coefficient, estimated.
    #[inline(never)]
    fn estimate(&self, of: Coefficient) -> f64 {
        let mut sum = SumOfSixes::zero();
        for number in 0..of.terms() {
            sum.add(self.term(of, number));
        }
        sum.estimate()
    }

    /// D, estimated; `None` if it is negative.
    #[inline(never)]
    fn discriminant(&self) -> Option<f64> {
        let mut sum = SumOfSixes::zero();
        self.add_minus_discriminant(&mut sum, Product::ONE);
        (sum.sign() != Ordering::Greater).then(|| -sum.estimate())
    }

    /// Whether the origin is outside of the sphere, and whether the line goes away from its centre there: the signs of
    /// |o - c|^2 - r^2 and d.(o - c).
    pub(crate) fn start(&self) -> [Ordering; 2] {
        [self.sign_of_power_at(Product::ZERO), self.sign_of_slope_at(Product::ZERO)]
    }

    /// m d - p along an axis.
    fn beside(&self, axis: usize, m: Product) -> [Product; 3] {
        [m.times(self.d(axis)), self.c(axis).negated(), self.o(axis).negated()]
    }

    /// Adds its square.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_square_beside(&self, sum: &mut SumOfSixes, axis: usize, m: Product) {
        sum.add_square(&self.beside(axis, m), Product::ONE);
    }

    /// Adds its product with d.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_slope_beside(&self, sum: &mut SumOfSixes, axis: usize, m: Product) {
        sum.add_products(&self.beside(axis, m), &[self.d(axis)]);
    }

    /// The sign of f = |m d - p|^2 - r^2.
    #[inline(never)]
    fn sign_of_power_at(&self, m: Product) -> Ordering {
        let mut sum = SumOfSixes::zero();
        sum.add(self.minus_square());
        for axis in 0..3 {
            self.add_square_beside(&mut sum, axis, m);
        }
        sum.sign()
    }

    /// The sign of g = d.(m d - p).
    #[inline(never)]
    fn sign_of_slope_at(&self, m: Product) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for axis in 0..3 {
            self.add_slope_beside(&mut sum, axis, m);
        }
        sum.sign()
    }
}

impl Quadratic {
    /// `None` if the line misses the sphere; a tangent does not miss it.
    ///
    /// Domain: a valid ray and a valid sphere. Anything else returns too, with no meaning.
    pub(crate) fn new(terms: QuadraticTerms) -> Option<Self> {
        // q = b + sign(b) sqrt D does not cancel: 2 u of b, 2 u of the root, 1 u of the sum.
        // a is within 2 u, k within 2 u; so q / a within 8 u, k / q within 8 u.
        let root = libm::sqrt(terms.discriminant()?);
        let (b, k) = (terms.estimate(Coefficient::HalfSlope), terms.estimate(Coefficient::Power));
        let a: f64 = terms.direction.iter().map(|&d| f64::from(d) * f64::from(d)).sum();
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
    fn compare_with(&self, t: f64, root: Root) -> Ordering {
        // 25 bits and 24, squared, are no more than 128.
        let m = Product::of_double(t);
        let outward = if root == Root::Near { Ordering::Less } else { Ordering::Greater };
        match (self.terms.sign_of_power_at(m), self.terms.sign_of_slope_at(m)) {
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
pub(super) fn midpoint(low: f32, high: f32) -> f64 {
    let end = |single: f32| {
        if single.is_finite() { f64::from(single) } else { TWO_128.copysign(f64::from(single)) }
    };
    (end(low) + end(high)) * 0.5
}

const TWO_128: f64 = 2.0 * (1u128 << 127) as f64;

#[cfg(test)]
mod by_hand;
