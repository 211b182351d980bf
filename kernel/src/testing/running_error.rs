//! How far off a recorded expression may be: the sum of all roundings, of every order, for all inputs at once.
//!
//! Every node has three polynomials in magnitudes: its computed value is between `low` and `high`, and within `error` of
//! what real arithmetic makes of the true inputs. So bounds are homogeneous, as those of the proofs are, and hold
//! for inputs of any size, as long as nothing over- or underflows.
//!
//! # Rules
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
//!
//! A difference that may cancel is *named*: where it is a factor later, its magnitude becomes a symbol of its own, and so
//! does a root, a sum that is divided by, and what the caller names. The rounding of a named sum is u of that symbol, but of
//! a difference of two products it is u of both: either is true, and the proofs choose so.
//!
//! A product of symbols to powers, some roundings away from it, has a relative error: what cancels there, as in
//! root / (a root), is not counted. Errors are then those of the symbols that are left.

extern crate std;

use super::polynomial::{Monomial, Polynomial, Symbol};
use super::recorded::Operation;
use std::collections::{BTreeMap, BTreeSet};
use std::format;
use std::string::String;
use std::vec::Vec;

/// A product of symbols to powers, some roundings away.
#[derive(Clone, Debug)]
struct Form {
    factor: f64,
    monomial: Monomial,
    roundings: i32,
}

/// What is known of a node.
#[derive(Clone, Debug)]
pub(crate) struct Bound {
    pub(crate) high: Polynomial,
    pub(crate) low: Polynomial,
    /// None where it is not known.
    error: Option<Polynomial>,
    /// Not below zero, as computed.
    positive: bool,
    /// So few significant bits that products may be exact.
    bits: Option<u32>,
    form: Option<Form>,
}

impl Bound {
    pub(crate) fn error(&self) -> &Polynomial {
        self.error.as_ref().expect("an error that is known")
    }
}

/// An input.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input {
    pub(crate) name: &'static str,
    /// Significant bits, where they are few.
    pub(crate) bits: Option<u32>,
    /// Its relative error.
    pub(crate) off: f64,
    /// Not below zero.
    pub(crate) positive: bool,
}

impl Input {
    /// Of any bits and sign, without error.
    pub(crate) fn named(name: &'static str) -> Self {
        Self { name, bits: None, off: 0.0, positive: false }
    }
}

/// The bounds of all nodes of a graph.
#[derive(Debug)]
pub(crate) struct RunningError {
    u: f64,
    bits: u32,
    inputs: Vec<Input>,
    symbols: Vec<String>,
    /// By symbol: its error, relative to its computed value.
    off: BTreeMap<Symbol, f64>,
    /// By symbol: at most.
    pub(crate) upper: BTreeMap<Symbol, Polynomial>,
    names: BTreeMap<usize, &'static str>,
    vectors: Vec<([Symbol; 3], Symbol)>,
    charged: BTreeSet<usize>,
    free: BTreeSet<usize>,
    given: BTreeMap<usize, Polynomial>,
    bounds: Vec<Bound>,
}

impl RunningError {
    /// In a precision of `bits` bits.
    pub(crate) fn new(bits: u32, inputs: &[Input]) -> Self {
        let u = 1.0 / (1_u64 << bits) as f64;
        let mut new = Self {
            u,
            bits,
            inputs: inputs.to_vec(),
            symbols: Vec::new(),
            off: BTreeMap::new(),
            upper: BTreeMap::new(),
            names: BTreeMap::new(),
            vectors: Vec::new(),
            charged: BTreeSet::new(),
            free: BTreeSet::new(),
            given: BTreeMap::new(),
            bounds: Vec::new(),
        };
        for input in inputs {
            let symbol = new.symbol(input.name);
            new.off.insert(symbol, input.off);
        }
        new
    }

    /// The symbol of that name.
    pub(crate) fn symbol(&mut self, name: &str) -> Symbol {
        if let Some(symbol) = self.symbols.iter().position(|other| other == name) {
            return symbol;
        }
        self.symbols.push(name.into());
        self.symbols.len() - 1
    }

    /// Gives a node a symbol of its own.
    pub(crate) fn name(&mut self, node: usize, name: &'static str) {
        self.names.insert(node, name);
    }

    /// The same, and its rounding is u of that symbol.
    pub(crate) fn name_and_charge(&mut self, node: usize, name: &'static str) {
        self.name(node, name);
        self.charged.insert(node);
    }

    /// Takes three symbols as a vector: its length is a symbol, of that name, and errors are counted in lengths.
    pub(crate) fn vector(&mut self, components: [&'static str; 3], length: &'static str) -> Symbol {
        let (components, length) = (components.map(|name| self.symbol(name)), self.symbol(length));
        self.vectors.push((components, length));
        length
    }

    /// At most, in lengths, a polynomial of sums over axes.
    pub(crate) fn in_lengths(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.contracted(&self.vectors).expect("sums over axes")
    }

    /// The relative error of a symbol, as computed.
    pub(crate) fn off_by(&self, symbol: Symbol) -> f64 {
        self.off[&symbol]
    }

    /// Takes what is computed at a node for the truth.
    pub(crate) fn free(&mut self, node: usize) {
        self.free.insert(node);
    }

    /// Takes the error of a node for known.
    pub(crate) fn given(&mut self, node: usize, error: Polynomial) {
        self.given.insert(node, error);
    }

    pub(crate) fn bound(&self, node: usize) -> &Bound {
        &self.bounds[node]
    }

    pub(crate) fn run(&mut self, graph: &[Operation]) {
        let (factors, divisors) = (factors(graph), divisors(graph));
        for (node, operation) in graph.iter().enumerate() {
            let signed = matches!(operation, Operation::Sum(..) | Operation::Difference(..));
            let mut bound = match *operation {
                Operation::Input(number) => self.input(number),
                Operation::Constant(number) => self.constant(number),
                Operation::Sum(a, b) if a == b => self.scaled(a, 2.0),
                Operation::Sum(a, b) | Operation::Difference(a, b) => {
                    let cancels = !(matches!(operation, Operation::Sum(..))
                        && self.bounds[a].positive
                        && self.bounds[b].positive);
                    let named = self.names.get(&node).copied();
                    let symbol = (cancels && (factors.contains(&node) || divisors.contains(&node))
                        || named.is_some())
                    .then(|| self.symbol(named.unwrap_or(&format!("node {node}"))));
                    let products = is_product(graph, a) && is_product(graph, b);
                    let charged =
                        symbol.filter(|_| cancels && !products || self.charged.contains(&node));
                    self.sum(a, b, cancels, charged)
                }
                Operation::Product(a, b) => self.product(a, b),
                Operation::Quotient(a, b) => self.quotient(a, b),
                Operation::Root(a) => self.root(node, a),
                Operation::Negated(a) => Bound { positive: false, ..self.bounds[a].clone() },
                Operation::Magnitude(a) => Bound { positive: true, ..self.bounds[a].clone() },
                Operation::Larger(a, b) => self.larger(a, b, graph),
            };
            if let Some(error) = self.given.get(&node) {
                bound.error = Some(error.clone());
            }
            if self.free.contains(&node) {
                bound.error = Some(Polynomial::zero());
            }
            let cancels =
                signed && !bound.positive && bound.form.is_none() && factors.contains(&node);
            if let Some(name) = self.names.get(&node) {
                bound = self.named(bound, name);
            } else if cancels || divisors.contains(&node) && signed {
                bound = self.named(bound, &format!("node {node}"));
            }
            self.bounds.push(bound);
        }
    }

    fn input(&mut self, number: usize) -> Bound {
        let Input { name, bits, off, positive } = self.inputs[number];
        let symbol = self.symbol(name);
        let it = Polynomial::symbol(symbol);
        Bound {
            error: Some(it.scaled(off)),
            high: it.clone(),
            low: it,
            positive,
            bits,
            form: Some(Form { factor: 1.0, monomial: Monomial::of(&[(symbol, 1)]), roundings: 0 }),
        }
    }

    fn constant(&self, number: f64) -> Bound {
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

    fn scaled(&self, node: usize, by: f64) -> Bound {
        let bound = &self.bounds[node];
        Bound {
            high: bound.high.scaled(by),
            low: bound.low.scaled(by),
            error: bound.error.as_ref().map(|error| error.scaled(by)),
            form: bound.form.clone().map(|form| Form { factor: form.factor * by, ..form }),
            ..*bound
        }
    }

    fn sum(&self, a: usize, b: usize, cancels: bool, charged: Option<Symbol>) -> Bound {
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

    fn product(&self, a: usize, b: usize) -> Bound {
        for (number, other) in [(a, b), (b, a)] {
            if let Bound { form: Some(form), .. } = &self.bounds[number]
                && form.monomial == Monomial::default()
                && form.roundings == 0
                && form.factor.to_bits() << 12 == 0
            {
                return self.scaled(other, form.factor);
            }
        }
        let squared = a == b;
        let (a, b) = (&self.bounds[a], &self.bounds[b]);
        let bits = a.bits.zip(b.bits).map(|(a, b)| a + b).filter(|bits| *bits <= self.bits);
        let roundings = i32::from(bits.is_none());
        let form = a.form.as_ref().zip(b.form.as_ref()).map(|(a, b)| Form {
            factor: a.factor * b.factor,
            monomial: a.monomial.times(&b.monomial),
            roundings: a.roundings + b.roundings + roundings,
        });
        let product = &a.high * &b.high;
        let errors = a.error.as_ref().zip(b.error.as_ref()).map(|(error_a, error_b)| {
            let errors = &(&a.high * error_b) + &(&b.high * error_a);
            let rounding = product.scaled(self.u * f64::from(roundings));
            &(&errors + &(error_a * error_b)) + &rounding
        });
        Bound {
            high: product.scaled(1.0 + self.u * f64::from(roundings)),
            low: (&a.low * &b.low).scaled(1.0 - self.u * f64::from(roundings)),
            error: form.as_ref().and_then(|form| self.error_of(form)).or(errors),
            positive: squared || a.positive && b.positive,
            bits,
            form,
        }
    }

    fn quotient(&self, a: usize, b: usize) -> Bound {
        let (a, b) = (&self.bounds[a], &self.bounds[b]);
        let divisor = b.form.as_ref().expect("a divisor that is a product");
        let inverse = Form {
            factor: 1.0 / divisor.factor,
            monomial: divisor.monomial.inverse(),
            roundings: divisor.roundings,
        };
        let per =
            Polynomial::of(inverse.factor * self.far(inverse.roundings), inverse.monomial.clone());
        let form = a.form.as_ref().map(|a| Form {
            factor: a.factor * inverse.factor,
            monomial: a.monomial.times(&inverse.monomial),
            roundings: a.roundings + inverse.roundings + 1,
        });
        let quotient = &a.high * &per;
        let errors = a.error.as_ref().zip(self.error_of(&inverse)).map(|(error_a, error_per)| {
            let errors = &(&a.high * &error_per) + &(&per * error_a);
            &(&errors + &(error_a * &error_per)) + &quotient.scaled(self.u)
        });
        let least = Polynomial::of(inverse.factor / self.far(inverse.roundings), inverse.monomial);
        Bound {
            high: quotient.scaled(1.0 + self.u),
            low: (&a.low * &least).scaled(1.0 - self.u),
            error: form.as_ref().and_then(|form| self.error_of(form)).or(errors),
            positive: a.positive && b.positive,
            bits: None,
            form,
        }
    }

    fn root(&mut self, node: usize, a: usize) -> Bound {
        let name = self.names.get(&node).copied();
        let symbol = self.symbol(name.unwrap_or(&format!("node {node}")));
        let (it, a) = (Polynomial::symbol(symbol), &self.bounds[a]);
        let rounding = it.scaled(self.u);
        let error = a.error.as_ref().map(|error| match self.relative(a) {
            // 1 - root (1 - x) is at most x / 2 (1 + x).
            Some(off) => it.scaled(off / 2.0 * (1.0 + off) * (1.0 + self.u) + self.u),
            None => {
                let per = Polynomial::of(1.0 + 2.0 * self.u, Monomial::of(&[(symbol, -1)]));
                &(error * &per) + &rounding
            }
        });
        let bound = Bound {
            high: it.clone(),
            low: it,
            error,
            positive: true,
            bits: None,
            form: Some(Form { factor: 1.0, monomial: Monomial::of(&[(symbol, 1)]), roundings: 0 }),
        };
        if let Some(off) = bound.error.as_ref().and_then(|error| self.multiple(error, symbol)) {
            self.off.insert(symbol, off);
        }
        bound
    }

    /// With a constant it is the other one: where that is smaller, the proofs say so by themselves.
    fn larger(&self, a: usize, b: usize, graph: &[Operation]) -> Bound {
        if matches!(graph[b], Operation::Constant(_)) {
            return Bound { positive: true, form: None, ..self.bounds[a].clone() };
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
    fn off(&self, roundings: i32) -> f64 {
        let first = f64::from(roundings) * self.u;
        first * (1.0 + first)
    }

    /// (1 + u) to that power, and more.
    fn far(&self, roundings: i32) -> f64 {
        1.0 + self.off(roundings)
    }

    /// The error of a product of symbols all of which have a relative error.
    fn error_of(&self, form: &Form) -> Option<Polynomial> {
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
    fn relative(&self, bound: &Bound) -> Option<f64> {
        let off = bound.error.as_ref()?.over(&bound.low);
        (off < 1.0).then_some(off)
    }

    /// The factor by which a polynomial is a multiple of one symbol.
    fn multiple(&self, polynomial: &Polynomial, symbol: Symbol) -> Option<f64> {
        let off = polynomial.over(&Polynomial::symbol(symbol));
        (off < 1.0).then_some(off)
    }

    fn named(&mut self, bound: Bound, name: &str) -> Bound {
        let symbol = self.symbol(name);
        let it = Polynomial::symbol(symbol);
        let off = self
            .relative(&bound)
            .or_else(|| bound.error.as_ref().and_then(|error| self.multiple(error, symbol)));
        let Bound { mut high, mut error, positive, bits, .. } = bound;
        if off.is_none() {
            // A sum over axes, so that it can be multiplied.
            high = high.contracted(&self.vectors).unwrap_or(high);
            error = error.map(|error| error.contracted(&self.vectors).unwrap_or(error));
        }
        self.upper.insert(symbol, high);
        if let Some(off) = off {
            self.off.insert(symbol, off);
        }
        Bound {
            error: off.map(|off| it.scaled(off)).or(error),
            high: it.clone(),
            low: it,
            positive,
            bits,
            form: Some(Form { factor: 1.0, monomial: Monomial::of(&[(symbol, 1)]), roundings: 0 }),
        }
    }
}

/// The node itself, without its sign.
fn magnitude(graph: &[Operation], node: usize) -> usize {
    match graph[node] {
        Operation::Negated(a) | Operation::Magnitude(a) => magnitude(graph, a),
        _ => node,
    }
}

fn is_product(graph: &[Operation], node: usize) -> bool {
    matches!(graph[magnitude(graph, node)], Operation::Product(..))
}

/// Nodes that are multiplied.
fn factors(graph: &[Operation]) -> BTreeSet<usize> {
    let operands = graph.iter().flat_map(|operation| match *operation {
        Operation::Product(a, b) => [Some(a), Some(b)],
        _ => [None, None],
    });
    operands.flatten().map(|node| magnitude(graph, node)).collect()
}

/// Nodes that are divided by, or factors of what is.
fn divisors(graph: &[Operation]) -> BTreeSet<usize> {
    let mut open: Vec<usize> = graph
        .iter()
        .filter_map(|operation| match *operation {
            Operation::Quotient(_, b) => Some(b),
            _ => None,
        })
        .collect();
    let mut found = BTreeSet::new();
    while let Some(node) = open.pop() {
        found.insert(node);
        if let Operation::Product(a, b) = graph[magnitude(graph, node)] {
            open.extend([a, b]);
        }
    }
    found
}
