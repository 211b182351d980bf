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
//! with e = -1 for a near root and 1 for a far one. The sign of x is known from those of e, or of D_1 - D_2. Where B
//! has the other sign, that of |B| - |x| decides, which is that of
//!
//! ```text
//! B^2 - x^2 = M + 2 e_1 e_2 sqrt(D_1 D_2),  M = B^2 - D_1 - D_2 = a (k_1 + k_2) - 2 b_1 b_2.
//! ```
//!
//! Where M has another sign than e_1 e_2, that of M^2 - 4 D_1 D_2 decides, which is a times the resultant of the two
//! quadratics,
//!
//! ```text
//! R = a (k_1 - k_2)^2 + 4 (b_1 - b_2) (b_1 k_2 - b_2 k_1):
//! ```
//!
//! zero exactly if they share a root. So four signs of polynomials decide, the last of degree six, and each is a sum in
//! a [`LongAccumulator`](super::long_accumulator::LongAccumulator).

use super::long_accumulator::{Product, SumOfSixes};
use super::quadratic::{QuadraticTerms, Root};
use core::cmp::Ordering;

/// How a root of the first sphere compares with one of the second, on one line that meets both.
#[cold]
#[inline(never)]
pub(crate) fn compare_roots(
    first: (&QuadraticTerms, Root),
    second: (&QuadraticTerms, Root),
) -> Ordering {
    let spheres = TwoSpheres::new(first.0, second.0);
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
        // x may be zero yet: where both lines are tangents, and then M is.
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

/// What the coefficients of two quadratics of one line are sums of.
struct TwoSpheres {
    /// a.
    square: [Product; 3],
    /// b of each.
    half_slope: [[Product; 6]; 2],
    /// b of the first, and -b of the second, without what they share.
    slopes: [Product; 6],
    /// k of each, without |o|^2.
    power: [[Product; 7]; 2],
    /// k of the first, and -k of the second.
    powers: [Product; 14],
    /// |o|^2.
    origin: [Product; 3],
}

impl TwoSpheres {
    fn new(first: &QuadraticTerms, second: &QuadraticTerms) -> Self {
        let half_slope = [first.half_slope(), second.half_slope()];
        let ((one, origin), (other, _)) = (first.power(), second.power());
        // The last three terms of b do not depend on the sphere.
        let [[a, b, c, ..], [d, e, f, ..]] = half_slope;
        let mut powers = [Product::ONE; 14];
        for (place, term) in
            powers.iter_mut().zip(one.into_iter().chain(other.map(Product::negated)))
        {
            *place = term;
        }
        Self {
            square: [0, 1, 2].map(|axis| {
                let [d, ..] = first.axis(axis);
                d.times(d)
            }),
            half_slope,
            slopes: [a, b, c, d.negated(), e.negated(), f.negated()],
            power: [one, other],
            powers,
            origin,
        }
    }

    /// B.
    fn difference_of_slopes(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        self.slopes.into_iter().for_each(|term| sum.add(term));
        sum.sign()
    }

    /// D_1 - D_2 = B (b_1 + b_2) - a (k_1 - k_2).
    fn difference_of_discriminants(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for half_slope in &self.half_slope {
            sum.add_products(&self.slopes, half_slope);
        }
        sum.add_products(&self.powers, &self.square.map(Product::negated));
        sum.sign()
    }

    /// M.
    fn middle(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for power in &self.power {
            sum.add_products(power, &self.square);
        }
        sum.add_products(&self.origin.map(|term| term.scaled(1)), &self.square);
        let [first, second] = &self.half_slope;
        sum.add_products(first, &second.map(|term| term.scaled(1).negated()));
        sum.sign()
    }

    /// R. The products of four are whole, the other two factors come last.
    fn resultant(&self) -> Ordering {
        let mut sum = SumOfSixes::zero();
        for square in self.square {
            sum.add_square(&self.powers, square);
        }
        let [first, second] = &self.half_slope;
        let [one, other] = &self.power;
        let slopes = self.slopes.map(|term| term.scaled(2));
        for (half_slope, power, negated) in [(first, other, false), (second, one, true)] {
            for &power in power.iter().chain(&self.origin) {
                let power = if negated { power.negated() } else { power };
                for half_slope in half_slope {
                    sum.add_products(&[half_slope.times(power)], &slopes);
                }
            }
        }
        sum.sign()
    }
}

#[cfg(test)]
mod against_integers;
