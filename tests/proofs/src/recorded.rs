//! Lanes that record the expression as it runs: the kernel's own formula as a graph of + - * / and roots.
//!
//! A lane is a node of the graph and carries a number besides, which answers comparisons: the record follows the way of
//! a witness. A multiply-add is recorded as a product and a sum, which covers the fused one.

use super::one_lane::one_lane;
use crate::{DoubleLanes, Lanes};
use core::cell::RefCell;
use core::ops::{Add, Div, Mul, Neg, Sub};
use std::thread_local;
use std::vec::Vec;

/// The operation that makes a node; operands are nodes that were recorded before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Operation {
    /// The input of that number.
    Input(usize),
    Constant(f64),
    Sum(usize, usize),
    Difference(usize, usize),
    Product(usize, usize),
    Quotient(usize, usize),
    Root(usize),
    Negated(usize),
    Magnitude(usize),
    Larger(usize, usize),
}

#[derive(Clone, Copy, Debug)]
struct Node {
    operation: Operation,
    witness: f64,
}

thread_local! {
    static NODES: RefCell<Vec<Node>> = const { RefCell::new(Vec::new()) };
}

/// Records what `work` does to inputs with those witnesses; returns its result, and the graph.
pub(crate) fn record<R, const N: usize>(
    inputs: [f64; N],
    work: impl FnOnce([Recorded; N]) -> R,
) -> (R, Vec<Operation>) {
    NODES.with_borrow_mut(Vec::clear);
    let mut number = 0;
    let inputs = inputs.map(|witness| {
        number += 1;
        push(Operation::Input(number - 1), witness)
    });
    let result = work(inputs);
    (result, NODES.with_borrow(|nodes| nodes.iter().map(|node| node.operation).collect()))
}

fn push(operation: Operation, witness: f64) -> Recorded {
    NODES.with_borrow_mut(|nodes| {
        nodes.push(Node { operation, witness });
        Recorded(nodes.len() - 1)
    })
}

/// A node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recorded(pub(crate) usize);

impl Recorded {
    fn witness(self) -> f64 {
        NODES.with_borrow(|nodes| nodes[self.0].witness)
    }

    fn root(self) -> Self {
        push(Operation::Root(self.0), libm::sqrt(self.witness()))
    }

    fn magnitude(self) -> Self {
        push(Operation::Magnitude(self.0), self.witness().abs())
    }

    /// The node as a number that can lie among others in memory: a NaN that tells which one.
    pub(crate) fn tag(self) -> f32 {
        f32::from_bits(f32::NAN.to_bits() | self.0 as u32)
    }
}

macro_rules! operations {
    ($($operation:ident $name:ident $sign:tt $record:ident),*) => {$(
        impl $operation for Recorded {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                push(Operation::$record(self.0, other.0), self.witness() $sign other.witness())
            }
        }
    )*};
}

operations!(Add add + Sum, Sub sub - Difference, Div div / Quotient);

impl Mul for Recorded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // A product with 1 is not rounded: structures scale by powers of two, here by none.
        let is_one = |node: Self| {
            NODES.with_borrow(|nodes| nodes[node.0].operation == Operation::Constant(1.0))
        };
        if is_one(other) {
            return self;
        }
        if is_one(self) {
            return other;
        }
        push(Operation::Product(self.0, other.0), self.witness() * other.witness())
    }
}

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        push(Operation::Negated(self.0), -self.witness())
    }
}

impl Lanes for Recorded {
    one_lane!(Lanes, witness);
    type Double = Self;

    fn splat((): (), value: f32) -> Self {
        let node = Self((value.to_bits() & 0x003f_ffff) as usize);
        if value.to_bits() == node.tag().to_bits() {
            return node;
        }
        push(Operation::Constant(f64::from(value)), f64::from(value))
    }

    fn store(self) -> [f32; 1] {
        [self.tag()]
    }

    fn abs(self) -> Self {
        self.magnitude()
    }

    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn filter_max(self, other: Self) -> Self {
        let witness = self.witness().max(other.witness());
        push(Operation::Larger(self.0, other.0), witness)
    }

    fn widen(self, _: usize) -> Self {
        self
    }

    fn narrow(_: &mut [f32; 1], _: usize, _: Self) {
        unreachable!("rounding to single precision is not recorded")
    }
}

impl DoubleLanes for Recorded {
    one_lane!(DoubleLanes, witness);

    fn splat((): (), value: f64) -> Self {
        push(Operation::Constant(value), value)
    }

    fn abs(self) -> Self {
        self.magnitude()
    }
}
