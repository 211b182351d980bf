//! What lanes of one number have in common, whatever the number is.

/// What one lane says of itself: of both precisions, or, besides, of single precision alone. Comparisons see the number that the method
/// `$number` returns.
macro_rules! one_lane {
    (Lanes, $number:ident) => {
        $crate::proofs::one_lane::one_lane!(DoubleLanes, $number);

        type Array = [f32; 1];

        #[inline(always)]
        fn load((): (), array: &[f32; 1]) -> Self {
            <Self as Lanes>::splat((), array[0])
        }

        #[inline(always)]
        fn out_of_line<R>((): (), work: impl FnOnce() -> R) -> R {
            work()
        }

        #[inline(always)]
        fn compress(self, _: bool) -> Self {
            self
        }
    };
    (DoubleLanes, $number:ident) => {
        const COUNT: usize = 1;
        type Token = ();
        type Mask = bool;

        #[inline(always)]
        fn token(self) {}

        #[inline(always)]
        fn sqrt(self) -> Self {
            self.root()
        }

        #[inline(always)]
        fn lt(self, other: Self) -> bool {
            self.$number() < other.$number()
        }

        #[inline(always)]
        fn le(self, other: Self) -> bool {
            self.$number() <= other.$number()
        }

        #[inline(always)]
        fn select(mask: bool, yes: Self, no: Self) -> Self {
            if mask { yes } else { no }
        }
    };
}

pub(crate) use one_lane;
