//! What is known of a node from its operands.
//!
//! A rounding is at most u of the result as computed, and of the result before it was rounded.
//!
//! | node | error |
//! |---|---|
//! | a + b, a - b | error a + error b + a rounding |
//! | a b | high a error b + high b error a + error a error b + a rounding |
//! | a / b | as a (1/b), without the rounding of 1/b; b must have a relative error |
//! | root of a | error a / root a, where the true a is not negative; half of it, where a has a relative error; + a rounding |
//! | what has few bits, doubled, or multiplied by a power of two | no rounding |

use super::{Bound, Form, Input, RunningError};
use crate::proofs::polynomial::{Monomial, Polynomial, Symbol};
use crate::proofs::recorded::Operation;

impl RunningError {
    pub(super) fn input(&mut self, number: usize) -> Bound {
        let Input { name, bits, off, positive } = self.inputs[number];
        let symbol = self.symbol(name);
        self.nodes.insert(symbol, self.bounds.len());
        let error = Polynomial::symbol(symbol).scaled(off);
        Bound { positive, bits, ..Bound::of_symbol(symbol, Some(error)) }
    }

    pub(super) fn constant(&self, number: f64) -> Bound {
        let it = Polynomial::constant(number.abs());
        Bound {
            high: it.clone(),
            low: it,
            error: Some(Polynomial::zero()),
            positive: number >= 0.0,
            bits: None,
            form: Some(Form { factor: number.abs(), monomial: Monomial::default(), roundings: 0 }),
        }
    }

    pub(super) fn scaled(&self, node: usize, by: f64) -> Bound {
        let bound = &self.bounds[node];
        Bound {
            high: bound.high.scaled(by),
            low: bound.low.scaled(by),
            error: bound.error.as_ref().map(|error| error.scaled(by)),
            form: bound.form.clone().map(|form| Form { factor: form.factor * by, ..form }),
            ..*bound
        }
    }

    pub(super) fn sum(&self, a: usize, b: usize, cancels: bool, charged: Option<Symbol>) -> Bound {
        let (a, b) = (&self.bounds[a], &self.bounds[b]);
        let both = &a.high + &b.high;
        let rounding = charged.map_or_else(|| both.clone(), Polynomial::symbol).scaled(self.u);
        let errors = a.error.as_ref().zip(b.error.as_ref()).map(|(a, b)| a + b);
        Bound {
            high: both.scaled(1.0 + self.u),
            low: if cancels { Polynomial::zero() } else { (&a.low + &b.low).scaled(1.0 - self.u) },
            error: errors.map(|errors| &errors + &rounding),
            positive: !cancels,
            bits: None,
            form: None,
        }
    }

    pub(super) fn product(&self, a: usize, b: usize) -> Bound {
        for (number, other) in [(a, b), (b, a)] {
            if let Bound { form: Some(form), .. } = &self.bounds[number]
                && form.monomial == Monomial::default()
                && form.roundings == 0
                && form.factor.to_bits() << 12 == 0
            {
                return self.scaled(other, form.factor);
            }
        }
        let (one, other) = (&self.bounds[a], &self.bounds[b]);
        Bound { positive: a == b || one.positive && other.positive, ..self.multiplied(one, other) }
    }

    /// A product that is rounded, unless its factors have few bits.
    fn multiplied(&self, a: &Bound, b: &Bound) -> Bound {
        let bits = a.bits.zip(b.bits).map(|(a, b)| a + b).filter(|bits| *bits <= self.bits);
        let roundings = i32::from(bits.is_none());
        let form = a.form.as_ref().zip(b.form.as_ref()).map(|(a, b)| Form {
            factor: a.factor * b.factor,
            monomial: a.monomial.times(&b.monomial),
            roundings: a.roundings + b.roundings + roundings,
        });
        let product = &a.high * &b.high;
        let rounding = self.u * f64::from(roundings);
        let errors = a.error.as_ref().zip(b.error.as_ref()).map(|(error_a, error_b)| {
            let errors = &(&a.high * error_b) + &(&b.high * error_a);
            &(&errors + &(error_a * error_b)) + &product.scaled(rounding)
        });
        Bound {
            high: product.scaled(1.0 + rounding),
            low: (&a.low * &b.low).scaled(1.0 - rounding),
            error: form.as_ref().and_then(|form| self.error_of(form)).or(errors),
            positive: a.positive && b.positive,
            bits,
            form,
        }
    }

    pub(super) fn quotient(&self, a: usize, b: usize) -> Bound {
        let b = &self.bounds[b];
        let divisor = b.form.as_ref().expect("a divisor that is a product");
        let inverse = Form {
            factor: 1.0 / divisor.factor,
            monomial: divisor.monomial.inverse(),
            roundings: divisor.roundings,
        };
        let far = self.far(inverse.roundings);
        let per = Bound {
            high: Polynomial::of(inverse.factor * far, inverse.monomial.clone()),
            low: Polynomial::of(inverse.factor / far, inverse.monomial.clone()),
            error: self.error_of(&inverse),
            positive: b.positive,
            bits: None,
            form: Some(inverse),
        };
        self.multiplied(&self.bounds[a], &per)
    }

    pub(super) fn root(&mut self, node: usize, a: usize) -> Bound {
        let symbol = self.symbol_of(node);
        self.nodes.insert(symbol, node);
        let (it, a) = (Polynomial::symbol(symbol), &self.bounds[a]);
        let error = a.error.as_ref().map(|error| match self.relative(a) {
            // 1 - root (1 - x) is at most x / 2 (1 + x).
            Some(off) => it.scaled(off / 2.0 * (1.0 + off) * (1.0 + self.u) + self.u),
            None => {
                let per = Polynomial::of(1.0 + 2.0 * self.u, Monomial::of(&[(symbol, -1)]));
                &(error * &per) + &it.scaled(self.u)
            }
        });
        let bound = Bound { positive: true, ..Bound::of_symbol(symbol, error) };
        let off = self.relative(&bound);
        self.off.extend(off.map(|off| (symbol, off)));
        bound
    }

    /// The larger of a constant and a node counts as the node: where the node is smaller, the
    /// proofs say so by themselves.
    pub(super) fn larger(&self, a: usize, b: usize, graph: &[Operation]) -> Bound {
        for (constant, other) in [(a, b), (b, a)] {
            if matches!(graph[constant], Operation::Constant(_)) {
                return Bound { positive: true, ..self.bounds[other].clone() };
            }
        }
        let (a, b) = (&self.bounds[a], &self.bounds[b]);
        Bound {
            high: &a.high + &b.high,
            low: Polynomial::zero(),
            error: a.error.as_ref().zip(b.error.as_ref()).map(|(a, b)| a + b),
            positive: a.positive || b.positive,
            bits: None,
            form: None,
        }
    }

    /// (1 + u) to that power, less 1, and more.
    pub(super) fn off(&self, roundings: i32) -> f64 {
        let first = f64::from(roundings) * self.u;
        first * (1.0 + first)
    }

    /// (1 + u) to that power, and more.
    pub(super) fn far(&self, roundings: i32) -> f64 {
        1.0 + self.off(roundings)
    }

    /// The error of a product of symbols all of which have a relative error.
    pub(super) fn error_of(&self, form: &Form) -> Option<Polynomial> {
        let mut true_part = 1.0;
        let mut off = 0.0;
        for (symbol, power) in form.monomial.powers() {
            let own = self.off.get(symbol)?;
            for _ in 0..power.abs() {
                off += own / (1.0 - own) * true_part;
                true_part /= 1.0 - own;
            }
        }
        Some(Polynomial::of(form.factor * (off + self.off(form.roundings)), form.monomial.clone()))
    }

    /// The relative error of a node, if it has one.
    pub(super) fn relative(&self, bound: &Bound) -> Option<f64> {
        let off = bound.error.as_ref()?.over(&bound.low);
        (off < 1.0).then_some(off)
    }
}
