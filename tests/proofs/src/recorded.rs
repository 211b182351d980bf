//! Lanes that record the expression as it runs: the kernel's own formula as a graph of + - * / and roots.
//!
//! A lane is a node of the graph and carries a number besides, which answers comparisons: the record follows the way of
//! a witness. A multiply-add is recorded as a product and a sum, which covers the fused one.

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

    /// The result of a product with 1, which is not rounded: structures scale by powers of two, here by none.
    fn same_as_product(self, other: Self, operation: Operation) -> Option<Self> {
        let is_one = |node: Self| {
            NODES.with_borrow(|nodes| nodes[node.0].operation == Operation::Constant(1.0))
        };
        match operation {
            Operation::Product(..) if is_one(other) => Some(self),
            Operation::Product(..) if is_one(self) => Some(other),
            _ => None,
        }
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
                if let Some(same) = self.same_as_product(other, Operation::$record(0, 0)) {
                    return same;
                }
                push(Operation::$record(self.0, other.0), self.witness() $sign other.witness())
            }
        }
    )*};
}

operations!(Add add + Sum, Sub sub - Difference, Mul mul * Product, Div div / Quotient);

impl Neg for Recorded {
    type Output = Self;
    fn neg(self) -> Self {
        push(Operation::Negated(self.0), -self.witness())
    }
}

/// What both precisions record alike.
macro_rules! common {
    () => {
        fn token(self) {}

        fn sqrt(self) -> Self {
            push(Operation::Root(self.0), libm::sqrt(self.witness()))
        }

        fn lt(self, other: Self) -> bool {
            self.witness() < other.witness()
        }

        fn le(self, other: Self) -> bool {
            self.witness() <= other.witness()
        }

        fn select(mask: bool, yes: Self, no: Self) -> Self {
            if mask { yes } else { no }
        }

        fn abs(self) -> Self {
            push(Operation::Magnitude(self.0), self.witness().abs())
        }
    };
}

impl Lanes for Recorded {
    const COUNT: usize = 1;
    type Token = ();
    type Array = [f32; 1];
    type Mask = bool;
    type Double = Self;

    common!();

    fn splat((): (), value: f32) -> Self {
        let node = Self((value.to_bits() & 0x003f_ffff) as usize);
        if value.to_bits() == node.tag().to_bits() {
            return node;
        }
        push(Operation::Constant(f64::from(value)), f64::from(value))
    }

    fn load((): (), array: &[f32; 1]) -> Self {
        <Self as Lanes>::splat((), array[0])
    }

    fn store(self) -> [f32; 1] {
        [self.tag()]
    }

    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn filter_max(self, other: Self) -> Self {
        let witness = self.witness().max(other.witness());
        push(Operation::Larger(self.0, other.0), witness)
    }

    fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
        work()
    }

    fn compress(self, _: bool) -> Self {
        self
    }

    fn widen(self, _: usize) -> Self {
        self
    }

    fn narrow(_: &mut [f32; 1], _: usize, _: Self) {
        unreachable!("rounding to single precision is not recorded")
    }
}

impl DoubleLanes for Recorded {
    const COUNT: usize = 1;
    type Token = ();
    type Mask = bool;

    common!();

    fn splat((): (), value: f64) -> Self {
        push(Operation::Constant(value), value)
    }
}
