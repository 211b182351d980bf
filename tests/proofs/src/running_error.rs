//! The largest error of a recorded expression: the sum of all roundings, of every order, for all inputs at once.
//!
//! Every node has three polynomials in magnitudes: its computed value is between `low` and `high`, and within `error`
//! of what real arithmetic makes of the true inputs. So bounds are homogeneous, as those of the proofs are, and hold
//! for inputs of any size, as long as nothing over- or underflows.
//!
//! A difference that may cancel is *named*: where it is a factor later, its magnitude becomes a symbol of its own. So
//! do a root, a sum that is divided by, and the nodes that the caller names. The rounding of a named sum is u of that
//! symbol, but of a difference of two products it is u of both: either is true, and the proofs choose so.
//!
//! A product of symbols to powers, some roundings away from it, has a relative error: what cancels there, as in
//! root / (a root), is not counted. Errors are then those of the symbols that are left.

mod against_numbers;
mod rules;
mod uses;

use self::uses::{divisors, factors, is_product};
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
    /// `None` if it is not known.
    error: Option<Polynomial>,
    /// Not below zero, as computed.
    positive: bool,
    /// Significant bits, where they are so few that products may be exact.
    bits: Option<u32>,
    form: Option<Form>,
}

impl Bound {
    /// What is known of a value whose magnitude is a symbol.
    fn of_symbol(symbol: Symbol, error: Option<Polynomial>) -> Self {
        let monomial = Monomial::of(&[(symbol, 1)]);
        Self {
            high: Polynomial::symbol(symbol),
            low: Polynomial::symbol(symbol),
            error,
            positive: false,
            bits: None,
            form: Some(Form { factor: 1.0, monomial, roundings: 0 }),
        }
    }

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
#[derive(Debug, Default)]
pub(crate) struct RunningError {
    u: f64,
    bits: u32,
    inputs: Vec<Input>,
    symbols: Vec<String>,
    /// By symbol: its error, relative to its computed value.
    off: BTreeMap<Symbol, f64>,
    /// By symbol: its upper bound.
    pub(crate) upper: BTreeMap<Symbol, Polynomial>,
    names: BTreeMap<usize, &'static str>,
    vectors: Vec<([Symbol; 3], Symbol)>,
    charged: BTreeSet<usize>,
    given: BTreeMap<usize, Polynomial>,
    bounds: Vec<Bound>,
    /// By symbol: the node whose magnitude it is.
    nodes: BTreeMap<Symbol, usize>,
}

impl RunningError {
    /// In a precision of `bits` bits.
    pub(crate) fn new(bits: u32, inputs: &[Input]) -> Self {
        let u = 1.0 / (1_u64 << bits) as f64;
        let mut new = Self { u, bits, inputs: inputs.to_vec(), ..Self::default() };
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

    /// Names a node, and counts its rounding as u of that symbol.
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

    /// A bound, in lengths, on a polynomial of sums over axes.
    pub(crate) fn in_lengths(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.contracted(&self.vectors).expect("sums over axes")
    }

    /// The relative error of a symbol, as computed.
    pub(crate) fn off_by(&self, symbol: Symbol) -> f64 {
        self.off[&symbol]
    }

    /// Takes what is computed at a node for the truth.
    pub(crate) fn free(&mut self, node: usize) {
        self.given(node, Polynomial::zero());
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
                    let products = is_product(graph, a) && is_product(graph, b);
                    let is_used = factors.contains(&node) || divisors.contains(&node);
                    let is_named = is_used || self.names.contains_key(&node);
                    let charged = is_named && cancels && !products || self.charged.contains(&node);
                    let charged = charged.then(|| self.symbol_of(node));
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
            let cancels =
                signed && !bound.positive && bound.form.is_none() && factors.contains(&node);
            let divides = signed && divisors.contains(&node);
            if cancels || divides || self.names.contains_key(&node) {
                bound = self.named(bound, node);
            }
            self.bounds.push(bound);
        }
    }

    /// The symbol of a node: that of its name, if it has one.
    fn symbol_of(&mut self, node: usize) -> Symbol {
        match self.names.get(&node).copied() {
            Some(name) => self.symbol(name),
            None => self.symbol(&format!("node {node}")),
        }
    }

    /// What is known of a node whose magnitude becomes a symbol.
    fn named(&mut self, bound: Bound, node: usize) -> Bound {
        let symbol = self.symbol_of(node);
        self.nodes.insert(symbol, node);
        let Bound { positive, bits, .. } = bound;
        let own = Bound { positive, bits, ..Bound::of_symbol(symbol, bound.error.clone()) };
        let (error, high) = match self.relative(&bound).or_else(|| self.relative(&own)) {
            Some(off) => {
                self.off.insert(symbol, off);
                (Some(own.high.scaled(off)), bound.high)
            }
            // Sums over axes, so that they can be multiplied.
            None => (
                bound.error.map(|error| error.contracted(&self.vectors).unwrap_or(error)),
                bound.high.contracted(&self.vectors).unwrap_or(bound.high),
            ),
        };
        self.upper.insert(symbol, high);
        Bound { error, ..own }
    }
}
