//! Work that tests count: a line stands where it is done, and a build keeps nothing of it.

/// Counts work of a [kind](crate::proofs::work::Kind), once or so many times.
macro_rules! count {
    ($kind:ident) => {
        $crate::count::count!($kind, 1);
    };
    ($kind:ident, $times:expr) => {
        #[cfg(all(test, proofs))]
        $crate::proofs::work::add($crate::proofs::work::Kind::$kind, $times);
    };
}

pub(crate) use count;
