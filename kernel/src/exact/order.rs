//! Which of two roots on one line is the smaller, exactly.
//!
//! # Method
//!
//! A line has one a and, with sphere i, roots (b_i -+ sqrt D_i) / a. So a root of the first less one of the second
//! has the sign of
//!
//! ```text
//! S = B + x,  B = b_1 - b_2,  x = e_1 sqrt D_1 - e_2 sqrt D_2
//! ```
//!
//! with e = -1 for a near root and 1 for a far one. The signs of e, or of D_1 - D_2, tell the sign of x. Where B has
//! the other sign, the sign of |B| - |x| decides, which is the sign of
//!
//! ```text
//! B^2 - x^2 = M + 2 e_1 e_2 sqrt(D_1 D_2),  M = B^2 - D_1 - D_2 = a (k_1 + k_2) - 2 b_1 b_2.
//! ```
//!
//! Where M has another sign than e_1 e_2, the sign of M^2 - 4 D_1 D_2 decides. That term is a times the resultant of
//! the two quadratics,
//!
//! ```text
//! R = a (k_1 - k_2)^2 + 4 (b_1 - b_2) (b_1 k_2 - b_2 k_1):
//! ```
//!
//! zero exactly if they share a root. So four signs of polynomials decide, the last of degree six, and each is a sum in
//! a [`LongAccumulator`](super::long_accumulator::LongAccumulator).

use super::long_accumulator::{Product, SumOfSixes};
use super::quadratic::Coefficient::{HalfSlope, Power, PowerOfSphere};
use super::quadratic::{QuadraticTerms, Root};
use core::cmp::Ordering;

/// How a root of the first sphere compares with one of the second, on one line that meets both.
#[cold]
#[inline(never)]
pub(crate) fn compare_roots(
    first: (&QuadraticTerms, Root),
    second: (&QuadraticTerms, Root),
) -> Ordering {
    let spheres = TwoSpheres([first.0, second.0]);
    let difference = spheres.difference_of_slopes();
    let same_roots = first.1 == second.1;
    let roots = match (first.1, second.1) {
        (Root::Near, Root::Near) => spheres.difference_of_discriminants().reverse(),
        (Root::Far, Root::Far) => spheres.difference_of_discriminants(),
        (Root::Near, Root::Far) => Ordering::Less,
        (Root::Far, Root::Near) => Ordering::Greater,
    };
    if roots == Ordering::Equal || roots == difference {
        return difference;
    }
    if difference == Ordering::Equal {
        // x may still be zero: where the line is a tangent of both spheres. Then M is zero too.
        let tangents = !same_roots && spheres.middle() == Ordering::Equal;
        return if tangents { Ordering::Equal } else { roots };
    }

    let product = if same_roots { Ordering::Greater } else { Ordering::Less };
    let middle = spheres.middle();
    let larger = if middle == product {
        middle
    } else {
        match spheres.resultant() {
            Ordering::Greater => middle,
            Ordering::Less => product,
            Ordering::Equal => Ordering::Equal,
        }
    };
    match larger {
        Ordering::Greater => difference,
        Ordering::Less => roots,
        Ordering::Equal => Ordering::Equal,
    }
}

/// Two quadratics of one line. (The terms of their coefficients are made anew where they are needed: kept, they are
/// most of the stack.)
struct TwoSpheres<'a>([&'a QuadraticTerms; 2]);

impl TwoSpheres<'_> {
    /// Adds a times `factor`, of 128 bits at most.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_square(&self, sum: &mut SumOfSixes, factor: &Product) {
        for axis in 0..3 {
            let d = self.0[0].d(axis);
            sum.add_product(factor, &d.times(&d));
        }
    }

    /// Adds B times `factor`, of 128 bits at most: b of the first, and -b of the second, without the last three terms,
    /// which they share.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_slopes(&self, sum: &mut SumOfSixes, factor: &Product) {
        let [first, second] = self.0;
        for axis in 0..3 {
            sum.add_product(factor, &first.term(HalfSlope, axis));
            let mut minus = second.term(HalfSlope, axis);
            minus.negate();
            sum.add_product(factor, &minus);
        }
    }

    /// Term `number` of the fourteen of k_1 - k_2.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn power_difference(&self, number: usize) -> Product {
        let [first, second] = self.0;
        if number < PowerOfSphere.terms() {
            return first.term(PowerOfSphere, number);
        }
        let mut minus = second.term(PowerOfSphere, number - PowerOfSphere.terms());
        minus.negate();
        minus
    }

    /// B.
    #[inline(never)]
    fn difference_of_slopes(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        self.add_slopes(&mut sum, &Product::ONE);
        sum.sign()
    }

    /// D_1 - D_2 = B (b_1 + b_2) - a (k_1 - k_2).
    #[inline(never)]
    fn difference_of_discriminants(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for sphere in self.0 {
            for number in 0..HalfSlope.terms() {
                self.add_slopes(&mut sum, &sphere.term(HalfSlope, number));
            }
        }
        for number in 0..2 * PowerOfSphere.terms() {
            let mut minus = self.power_difference(number);
            minus.negate();
            self.add_square(&mut sum, &minus);
        }
        sum.sign()
    }

    /// M.
    #[inline(never)]
    fn middle(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        let [first, second] = self.0;
        for sphere in self.0 {
            for number in 0..Power.terms() {
                self.add_square(&mut sum, &sphere.term(Power, number));
            }
        }
        for number in 0..HalfSlope.terms() {
            let mut minus_twice = first.term(HalfSlope, number);
            minus_twice.scale(1);
            minus_twice.negate();
            for other in 0..HalfSlope.terms() {
                sum.add_product(&second.term(HalfSlope, other), &minus_twice);
            }
        }
        sum.sign()
    }

    /// The sign of R. Products of four factors are made first, the other two factors come last.
    #[inline(never)]
    fn resultant(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for number in 0..2 * PowerOfSphere.terms() {
            self.add_power_products(&mut sum, number);
        }
        let [first, second] = self.0;
        for number in 0..Power.terms() {
            let mut four_times = second.term(Power, number);
            four_times.scale(2);
            self.add_crossed(&mut sum, first, &four_times);
            let mut minus = first.term(Power, number);
            minus.scale(2);
            minus.negate();
            self.add_crossed(&mut sum, second, &minus);
        }
        sum.sign()
    }

    /// Adds a times the part of (k_1 - k_2)^2 from its term `number`: this term times itself, and
    /// twice times each term after it.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_power_products(&self, sum: &mut SumOfSixes, number: usize) {
        let mut term = self.power_difference(number);
        for other in number..2 * PowerOfSphere.terms() {
            self.add_square(sum, &term.times(&self.power_difference(other)));
            if other == number {
                term.scale(1);
            }
        }
    }

    /// Adds B times b of one sphere times `factor`.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_crossed(&self, sum: &mut SumOfSixes, of: &QuadraticTerms, factor: &Product) {
        for number in 0..HalfSlope.terms() {
            self.add_slopes(sum, &of.term(HalfSlope, number).times(factor));
        }
    }
}
