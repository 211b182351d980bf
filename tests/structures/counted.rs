//! Lanes that count their operations: the cost of a traversal on any machine, however busy.

use spherule_kernel::{DoubleLanes, LaneMask, Lanes};
use std::cell::Cell;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The number of lanes.
pub(super) const COUNT: usize = 8;

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// How many operations on vectors `work` takes on this thread.
pub(super) fn operations(work: impl FnOnce()) -> u64 {
    let before = OPERATIONS.get();
    work();
    OPERATIONS.get() - before
}

/// Eight lanes that count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted<T>([T; COUNT]);

/// Eight truth values.
#[derive(Clone, Copy, Debug)]
pub(super) struct CountedMask([bool; COUNT]);

/// Calls, not inlined: inlined, these lanes are a third of the time that the tests take to compile.
impl<T: Copy> Counted<T> {
    #[inline(never)]
    fn each(self, operation: impl Fn(T) -> T) -> Self {
        OPERATIONS.set(OPERATIONS.get() + 1);
        Self(self.0.map(operation))
    }

    #[inline(never)]
    fn with<R: Copy>(self, other: Self, operation: impl Fn(T, T) -> R) -> [R; COUNT] {
        OPERATIONS.set(OPERATIONS.get() + 1);
        std::array::from_fn(|lane| operation(self.0[lane], other.0[lane]))
    }
}

macro_rules! counted {
    ($number:ty, $trait:ident, $method:ident) => {
        impl $trait for Counted<$number> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                Self(self.with(other, $trait::$method))
            }
        }
    };
    ($number:ty) => {
        counted!($number, Add, add);
        counted!($number, Sub, sub);
        counted!($number, Mul, mul);
        counted!($number, Div, div);

        impl Neg for Counted<$number> {
            type Output = Self;

            fn neg(self) -> Self {
                self.each(Neg::neg)
            }
        }
    };
}

counted!(f32);
counted!(f64);

#[inline(never)]
fn select<T: Copy>(mask: CountedMask, yes: Counted<T>, no: Counted<T>) -> Counted<T> {
    Counted(std::array::from_fn(|lane| if mask.0[lane] { yes.0[lane] } else { no.0[lane] }))
}

impl BitAnd for CountedMask {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        Self(std::array::from_fn(|lane| self.0[lane] & other.0[lane]))
    }
}

impl BitOr for CountedMask {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(std::array::from_fn(|lane| self.0[lane] | other.0[lane]))
    }
}

impl Not for CountedMask {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0.map(Not::not))
    }
}

impl LaneMask for CountedMask {
    fn bits(self) -> u32 {
        (0..COUNT).map(|lane| u32::from(self.0[lane]) << lane).sum()
    }
}

impl Lanes for Counted<f32> {
    const COUNT: usize = COUNT;
    type Token = ();
    type Array = [f32; COUNT];
    type Mask = CountedMask;
    type Double = Counted<f64>;

    fn token(self) {}

    fn splat((): (), value: f32) -> Self {
        Self([value; COUNT])
    }

    fn load((): (), array: &[f32; COUNT]) -> Self {
        Self(*array)
    }

    fn store(self) -> [f32; COUNT] {
        self.0
    }

    fn sqrt(self) -> Self {
        self.each(f32::sqrt)
    }

    fn filter_mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn filter_max(self, other: Self) -> Self {
        Self(self.with(other, |a, b| if a > b { a } else { b }))
    }

    fn lt(self, other: Self) -> CountedMask {
        CountedMask(self.with(other, |a, b| a < b))
    }

    fn le(self, other: Self) -> CountedMask {
        CountedMask(self.with(other, |a, b| a <= b))
    }

    fn select(mask: CountedMask, yes: Self, no: Self) -> Self {
        select(mask, yes, no)
    }

    fn compress(self, mask: CountedMask) -> Self {
        let (mut lanes, mut count) = ([0.0; COUNT], 0);
        for lane in (0..COUNT).filter(|&lane| mask.0[lane]) {
            lanes[count] = self.0[lane];
            count += 1;
        }
        Self(lanes)
    }

    fn widen(self, _: usize) -> Counted<f64> {
        Counted(self.0.map(f64::from))
    }

    fn narrow(array: &mut [f32; COUNT], _: usize, doubles: Counted<f64>) {
        *array = doubles.0.map(|double| double as f32);
    }

    fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
        work()
    }
}

impl DoubleLanes for Counted<f64> {
    const COUNT: usize = COUNT;
    type Token = ();
    type Mask = CountedMask;

    fn token(self) {}

    fn splat((): (), value: f64) -> Self {
        Self([value; COUNT])
    }

    fn sqrt(self) -> Self {
        self.each(f64::sqrt)
    }

    fn lt(self, other: Self) -> CountedMask {
        CountedMask(self.with(other, |a, b| a < b))
    }

    fn le(self, other: Self) -> CountedMask {
        CountedMask(self.with(other, |a, b| a <= b))
    }

    fn select(mask: CountedMask, yes: Self, no: Self) -> Self {
        select(mask, yes, no)
    }
}
