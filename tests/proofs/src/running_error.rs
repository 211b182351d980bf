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
    /// By symbol: its upper bound.
    pub(crate) upper: BTreeMap<Symbol, Polynomial>,
    names: BTreeMap<usize, &'static str>,
    vectors: Vec<([Symbol; 3], Symbol)>,
    charged: BTreeSet<usize>,
    free: BTreeSet<usize>,
    given: BTreeMap<usize, Polynomial>,
    bounds: Vec<Bound>,
    /// By symbol: the node whose magnitude it is.
    nodes: BTreeMap<Symbol, usize>,
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
            nodes: BTreeMap::new(),
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

    fn named(&mut self, bound: Bound, name: &str) -> Bound {
        let symbol = self.symbol(name);
        self.nodes.insert(symbol, self.bounds.len());
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
