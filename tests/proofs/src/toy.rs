//! The kernel's own formulas over floats of a few bits, for all inputs of a set.

/// Formats: a name, the bits, the format of doubles, and what else is not as usual.
macro_rules! formats {
    ($($name:ident: $bits:literal, $double:ident $(, $constant:ident: $type:ty = $value:expr)*;)*) => {$(
        #[derive(Clone, Copy, Debug)]
        struct $name;
        impl Format for $name {
            const BITS: u32 = $bits;
            $(const $constant: $type = $value;)*
            type Double = $double;
        }
    )*};
}

mod boxes;
mod case;
mod error_free;
mod exact;
mod filter;
mod floats;

/// Every pair of both.
fn pairs<'a, S: Copy, T: Copy>(one: &'a [S], other: &'a [T]) -> impl Iterator<Item = (S, T)> + 'a {
    one.iter().flat_map(|x| other.iter().map(|y| (*x, *y)))
}
