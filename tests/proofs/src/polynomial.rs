//! Polynomials in magnitudes: no coefficient is negative, but exponents may be.
//!
//! One with smaller coefficients, monomial by monomial, is smaller wherever the symbols stand for magnitudes.
//! Coefficients are computed in `f64`, which loses less than 2^-40 of them: comparisons leave more room than that.

use core::ops::{Add, Mul};
use std::collections::BTreeMap;
use std::vec::Vec;

/// The number of a magnitude.
pub(crate) type Symbol = usize;

/// Symbols to powers, in their order, none to the power of zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Monomial(Vec<(Symbol, i32)>);

impl Monomial {
    pub(crate) fn of(powers: &[(Symbol, i32)]) -> Self {
        let mut sums = BTreeMap::new();
        for (symbol, power) in powers {
            *sums.entry(*symbol).or_insert(0) += power;
        }
        Self(sums.into_iter().filter(|(_, power)| *power != 0).collect())
    }

    pub(crate) fn powers(&self) -> &[(Symbol, i32)] {
        &self.0
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let powers: Vec<_> = self.0.iter().chain(&other.0).copied().collect();
        Self::of(&powers)
    }

    pub(crate) fn inverse(&self) -> Self {
        Self(self.0.iter().map(|(symbol, power)| (*symbol, -power)).collect())
    }

    fn power_of(&self, symbol: Symbol) -> i32 {
        self.0.iter().find(|(other, _)| *other == symbol).map_or(0, |(_, power)| *power)
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Polynomial(BTreeMap<Monomial, f64>);

impl Polynomial {
    pub(crate) fn zero() -> Self {
        Self::default()
    }

    pub(crate) fn of(coefficient: f64, monomial: Monomial) -> Self {
        let mut one = Self::zero();
        if coefficient > 0.0 {
            one.0.insert(monomial, coefficient);
        }
        one
    }

    pub(crate) fn constant(number: f64) -> Self {
        Self::of(number, Monomial::default())
    }

    pub(crate) fn symbol(symbol: Symbol) -> Self {
        Self::of(1.0, Monomial::of(&[(symbol, 1)]))
    }

    pub(crate) fn scaled(&self, by: f64) -> Self {
        let scaled =
            self.0.iter().map(|(monomial, coefficient)| (monomial.clone(), coefficient * by));
        Self(scaled.filter(|(_, coefficient)| *coefficient > 0.0).collect())
    }

    pub(crate) fn terms(&self) -> impl Iterator<Item = (&Monomial, f64)> {
        self.0.iter().map(|(monomial, coefficient)| (monomial, *coefficient))
    }

    /// Its value where symbols stand for these numbers.
    pub(crate) fn value(&self, of: impl Fn(Symbol) -> f64) -> f64 {
        let power = |(symbol, power): &(Symbol, i32)| of(*symbol).powi(*power);
        let term = |(monomial, coefficient): (&Monomial, &f64)| {
            coefficient * monomial.0.iter().map(power).product::<f64>()
        };
        self.0.iter().map(term).sum()
    }

    /// The coefficient of a product of powers.
    pub(crate) fn coefficient(&self, powers: &[(Symbol, i32)]) -> f64 {
        self.0.get(&Monomial::of(powers)).copied().unwrap_or(0.0)
    }

    /// The least factor by which `other` must be multiplied to be no smaller, monomial by monomial.
    pub(crate) fn over(&self, other: &Self) -> f64 {
        let part = |(monomial, coefficient): (&Monomial, &f64)| {
            other.0.get(monomial).map_or(f64::INFINITY, |bound| coefficient / bound)
        };
        self.0.iter().map(part).fold(0.0, f64::max)
    }

    /// The polynomial with `bound` instead of a symbol that is at most `bound`.
    pub(crate) fn with(&self, symbol: Symbol, bound: &Self) -> Self {
        let mut sum = Self::zero();
        for (monomial, coefficient) in &self.0 {
            let power = monomial.power_of(symbol);
            assert!(power >= 0, "a bound of a divisor");
            let rest = monomial.times(&Monomial::of(&[(symbol, -power)]));
            let mut term = Self::of(*coefficient, rest);
            for _ in 0..power {
                term = &term * bound;
            }
            sum = &sum + &term;
        }
        sum
    }

    /// A bound on it in lengths of vectors, by Cauchy: the sum of k_i |v_i| |w_i| over the axes is at most the largest
    /// k_i times |v| |w|. None if a monomial has components, but not two of one axis.
    pub(crate) fn contracted(&self, vectors: &[([Symbol; 3], Symbol)]) -> Option<Self> {
        // What is left of a monomial, with lengths, and its coefficients axis by axis.
        let mut largest: BTreeMap<Monomial, [f64; 3]> = BTreeMap::new();
        let mut sum = Self::zero();
        for (monomial, coefficient) in &self.0 {
            let (mut rest, mut axes) = (Vec::new(), Vec::new());
            for &(symbol, power) in &monomial.0 {
                let found = vectors.iter().find_map(|(components, length)| {
                    components
                        .iter()
                        .position(|component| *component == symbol)
                        .map(|axis| (axis, *length))
                });
                let Some((axis, length)) = found else {
                    rest.push((symbol, power));
                    continue;
                };
                for _ in 0..power {
                    axes.push(axis);
                }
                rest.push((length, power));
            }
            match axes[..] {
                [] => sum = &sum + &Self::of(*coefficient, monomial.clone()),
                [one, other] if one == other => {
                    largest.entry(Monomial::of(&rest)).or_default()[one] += coefficient;
                }
                _ => return None,
            }
        }
        for (monomial, [x, y, z]) in largest {
            sum = &sum + &Self::of(x.max(y).max(z), monomial);
        }
        Some(sum)
    }
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: Self) -> Polynomial {
        let mut sum = self.0.clone();
        for (monomial, coefficient) in &other.0 {
            *sum.entry(monomial.clone()).or_insert(0.0) += coefficient;
        }
        Polynomial(sum)
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: Self) -> Polynomial {
        let mut sum = BTreeMap::new();
        for (one, factor) in &self.0 {
            for (two, coefficient) in &other.0 {
                *sum.entry(one.times(two)).or_insert(0.0) += factor * coefficient;
            }
        }
        Polynomial(sum)
    }
}
