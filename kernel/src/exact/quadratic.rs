//! The line x(t) = o + t d and the surface |x - c| = r, exactly.
//!
//! # Method
//!
//! With p = c - o, a = d.d, b = d.p and the power of the origin k = p.p - r^2, the line meets the
//! sphere where a t^2 - 2 b t + k = 0: at t = (b -+ sqrt D) / a with
//! D = b^2 - a k = a r^2 - |d x p|^2 (Lagrange). The second form has fewer terms.
//!
//! The sign of D, exactly, decides whether there are roots. A root is then estimated to 16 u
//! (u = 2^-53), which leaves one `f32` it can round to, or two neighbours. Of two, the side of
//! their midpoint m on which the root lies tells which, without a square root: with v = m d - p,
//! f = |v|^2 - r^2 and g = d.v, half the slope of f along the line,
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
pub(crate) struct Quadratic<'a> {
    terms: &'a QuadraticTerms,
    /// t1 and t2, each within 10 u of itself.
    estimates: [f64; 2],
}

/// A line and a sphere, as what the coefficients of their quadratic are sums of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadraticTerms {
    /// d, -d, c and -o along the axes, r and -r: every term is a product of two of them.
    numbers: [f32; 14],
}

/// Where in these numbers each begins.
const MINUS_D: usize = 3;
const C: usize = 6;
const MINUS_O: usize = 9;
const RADIUS: usize = 12;

/// The sign that tells on which side of a root a number lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SideBy {
    /// f.
    Power,
    /// g.
    Slope,
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
    /// Domain: a valid ray and a valid sphere. For anything else it returns too, but the result has
    /// no meaning.
    pub(crate) const fn new(
        origin: [f32; 3],
        direction: [f32; 3],
        center: [f32; 3],
        radius: f32,
    ) -> Self {
        let ([a, b, c], [d, e, f], [g, h, i]) = (direction, center, origin);
        Self { numbers: [a, b, c, -a, -b, -c, d, e, f, -g, -h, -i, radius, -radius] }
    }

    /// One of the numbers. (Made anew where it is needed, as are products of them: kept, they are most of the stack.)
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn number(&self, place: usize) -> Product {
        Product::of(self.numbers.get(place).copied().unwrap_or(0.0))
    }

    /// The product of two of the numbers.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn pair(&self, one: usize, other: usize) -> Product {
        self.number(one).times(&self.number(other))
    }

    /// d along an axis.
    pub(super) fn d(&self, axis: usize) -> Product {
        self.number(axis % 3)
    }

    /// c along an axis.
    pub(super) fn c(&self, axis: usize) -> Product {
        self.number(C + axis % 3)
    }

    /// -o along an axis.
    pub(super) fn o(&self, axis: usize) -> Product {
        self.number(MINUS_O + axis % 3)
    }

    /// r.
    pub(super) fn radius(&self) -> Product {
        self.number(RADIUS)
    }

    /// -r^2.
    fn minus_square(&self) -> Product {
        self.pair(RADIUS, RADIUS + 1)
    }

    /// Adds -D = |d x p|^2 - a r^2, times `factor`, of 64 bits at most.
    #[inline(never)]
    pub(super) fn add_minus_discriminant<const LIMBS: usize>(
        &self,
        sum: &mut LongAccumulator<LIMBS>,
        factor: &Product,
    ) {
        // The axes after one, in turn.
        let (mut i, mut j) = (1, 2);
        for k in 0..3 {
            self.add_minus_component(sum, [i, j, k], factor);
            (i, j) = (j, k);
        }
    }

    /// Adds the part of axis k in -D: a component of d x p comes from the two axes after its own.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_minus_component<const LIMBS: usize>(
        &self,
        sum: &mut LongAccumulator<LIMBS>,
        [i, j, k]: [usize; 3],
        factor: &Product,
    ) {
        let component = [
            self.pair(i, C + j),
            self.pair(i, MINUS_O + j),
            self.pair(MINUS_D + j, C + i),
            self.pair(MINUS_D + j, MINUS_O + i),
        ];
        sum.add_square(&component, factor);
        sum.add_product(&self.minus_square().times(&self.pair(k, k)), factor);
    }

    /// Term `number` of a coefficient, which is a sum.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(super) fn term(&self, of: Coefficient, number: usize) -> Product {
        let mut term = match (of, number) {
            // d with c, then with -o, which follows it.
            (Coefficient::HalfSlope, _) => self.pair(number % 3, C + number),
            (_, 0..3) => self.pair(C + number, C + number),
            (_, 3..6) => self.pair(C + number - 3, C + number),
            (_, 6) => self.minus_square(),
            _ => self.pair(MINUS_O + number - 7, MINUS_O + number - 7),
        };
        if of != Coefficient::HalfSlope && (3..6).contains(&number) {
            term.scale(1);
        }
        term
    }

    /// A coefficient, estimated.
    #[inline(never)]
    fn estimate(&self, of: Coefficient) -> f64 {
        let mut sum = SumOfSixes::zero();
        for number in 0..of.terms() {
            sum.add(&self.term(of, number));
        }
        sum.estimate()
    }

    /// D, estimated; `None` if it is negative.
    #[inline(never)]
    fn discriminant(&self) -> Option<f64> {
        let mut sum = SumOfSixes::zero();
        self.add_minus_discriminant(&mut sum, &Product::ONE);
        (sum.sign() != Ordering::Greater).then(|| -sum.estimate())
    }

    /// Whether the origin is outside of the sphere, and whether the line goes away from its centre there: the signs of
    /// |o - c|^2 - r^2 and d.(o - c).
    pub(crate) fn start(&self) -> [Ordering; 2] {
        let zero = &Product::ZERO;
        [self.sign_at(zero, SideBy::Power), self.sign_at(zero, SideBy::Slope)]
    }

    /// The sign of f = |m d - p|^2 - r^2, or of g = d.(m d - p).
    #[inline(never)]
    fn sign_at(&self, m: &Product, of: SideBy) -> Ordering {
        let mut sum = SumOfSixes::zero();
        if of == SideBy::Power {
            sum.add(&self.minus_square());
        }
        for axis in 0..3 {
            self.add_beside(&mut sum, axis, m, of);
        }
        sum.sign()
    }

    /// Adds the part of one axis in f or g: p - m d squared, or times -d.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_beside(&self, sum: &mut SumOfSixes, axis: usize, m: &Product, of: SideBy) {
        let minus_d = self.number(MINUS_D + axis);
        let beside = [m.times(&minus_d), self.number(C + axis), self.number(MINUS_O + axis)];
        match of {
            SideBy::Power => sum.add_square(&beside, &Product::ONE),
            SideBy::Slope => {
                for term in &beside {
                    sum.add_product(term, &minus_d);
                }
            }
        }
    }
}

impl<'a> Quadratic<'a> {
    /// `None` if the line misses the sphere; a tangent does not miss it.
    ///
    /// Domain: a valid ray and a valid sphere. For anything else it returns too, but the result has no meaning.
    pub(crate) fn new(terms: &'a QuadraticTerms) -> Option<Self> {
        // q = b + sign(b) sqrt D is the larger of both, and does not cancel: 2 u of b, 2 u of the root, 1 u of the sum.
        // a is within 2 u, k within 2 u; so q / a within 8 u, k / q within 8 u.
        let root = libm::sqrt(terms.discriminant()?);
        let (b, k) = (terms.estimate(Coefficient::HalfSlope), terms.estimate(Coefficient::Power));
        let mut a = -0.0;
        for i in 0..3 {
            let d = f64::from(terms.numbers[i]);
            a += d * d;
        }
        let q = b + root.copysign(b);
        let mut estimates = [q / a; 2];
        // q is zero only where b and D are, and then so is k: both roots are zero.
        let other = if k.to_bits() == 0 { 0.0 } else { k / q };
        estimates[usize::from(b.is_sign_negative())] = other;
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
            match self.compare_with(&Product::between(low, high), root) {
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

    /// How a root compares with `m`, a number of at most 25 bits: those and 24 more, squared, are no more than 128.
    fn compare_with(&self, m: &Product, root: Root) -> Ordering {
        let outward = if root == Root::Near { Ordering::Less } else { Ordering::Greater };
        match (self.terms.sign_at(m, SideBy::Power), self.terms.sign_at(m, SideBy::Slope)) {
            (Ordering::Greater, slope) if slope == outward => outward.reverse(),
            (Ordering::Equal, slope) if slope == outward || slope == Ordering::Equal => {
                Ordering::Equal
            }
            _ => outward,
        }
    }
}
