//! Sums of products of `f32` that are never rounded: a fixed-point number as wide as all of them, a long
//! accumulator (Kulisch and Miranker 1986, The Arithmetic of the Digital Computer: A New Approach).
//!
//! A finite `f32` is an integer below 2^24 times 2^e, with e from -149 to 104. So a product of six, or four times that,
//! is a multiple of 2^-894 and below 2^770. Times the square of a midpoint, which `surface.rs` has once where lengths
//! cancel, it is a multiple of 2^-1194. Accumulators count in units of 2^-896 or of 2^-1216, and hold 2^50 such
//! products before they reach 2^831, the place of the sign. Nothing is rounded, nothing overflows, and no
//! floating-point environment matters.
//!
//! A limb is as wide as the machine's registers. On targets of 32 bits, the functions that work on products are called,
//! not inlined: that is a third of the flash of `Exact`.

use core::cmp::Ordering;

/// For products of six.
pub(crate) type SumOfSixes = LongAccumulator<{ 27 * NARROW }>;
/// For products of six times the square of a midpoint.
pub(crate) type SumOfEights = LongAccumulator<{ 32 * NARROW }>;

/// What is multiplied at once.
#[cfg(not(target_pointer_width = "32"))]
type Limb = u64;
/// A product of two.
#[cfg(not(target_pointer_width = "32"))]
type Twofold = u128;
/// What is multiplied at once.
#[cfg(target_pointer_width = "32")]
type Limb = u32;
/// A product of two.
#[cfg(target_pointer_width = "32")]
type Twofold = u64;

/// How many limbs make 64 bits.
const NARROW: usize = 64 / Limb::BITS as usize;
/// How many limbs make 128 bits.
const WIDE: usize = 2 * NARROW;

/// A product of numbers, exactly: `mantissa * 2^exponent`, or that negated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Product {
    negative: bool,
    exponent: i32,
    /// The lowest limb first.
    mantissa: [Limb; WIDE],
}

impl Product {
    /// 0.
    pub(crate) const ZERO: Self = Self { negative: false, exponent: 0, mantissa: [0; WIDE] };
    /// 1.
    pub(crate) const ONE: Self = Self { mantissa: narrow(1), ..Self::ZERO };

    /// A finite number.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn of(x: f32) -> Self {
        let bits = x.to_bits();
        let (exponent, fraction) = (bits >> 23 & 0xff, bits & 0x007f_ffff);
        // A subnormal has the exponent of the least normal number, and no leading bit.
        let (mantissa, exponent) =
            if exponent == 0 { (fraction, 1) } else { (fraction | 1 << 23, exponent as i32) };
        Self {
            negative: bits >> 31 == 1,
            exponent: exponent - 150,
            mantissa: narrow(Limb::from(mantissa)),
        }
    }

    /// The number half-way between neighbours, the lower one first; it has 25 bits. An infinity stands for the number
    /// that would come next, 2^128, as it does in rounding.
    pub(crate) fn between(low: f32, high: f32) -> Self {
        // Half a step beyond the neighbour nearer to zero, which may be either.
        let negative = low.to_bits() > (-0.0_f32).to_bits();
        let Self { exponent, mantissa: [mantissa, ..], .. } =
            Self::of(if negative { high } else { low });
        Self { negative, exponent: exponent - 1, mantissa: narrow(mantissa << 1 | 1) }
    }

    /// A double that is finite and not subnormal, with as few bits of mantissa as it has.
    #[cfg(all(test, proofs))]
    pub(crate) fn of_double(x: f64) -> Self {
        let bits = x.to_bits();
        let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i32, bits & ((1 << 52) - 1));
        if exponent == 0 {
            return Self::ZERO;
        }
        let mantissa = fraction | 1 << 52;
        let zeros = mantissa.trailing_zeros();
        Self {
            negative: bits >> 63 == 1,
            exponent: exponent - 1075 + zeros as i32,
            mantissa: narrow(mantissa >> zeros),
        }
    }

    /// The product of both; each mantissa has 64 bits at most.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut mantissa = [0; WIDE];
        multiply(&mut mantissa, &self.mantissa, half(&other.mantissa));
        Self {
            negative: self.negative != other.negative,
            exponent: self.exponent + other.exponent,
            mantissa,
        }
    }

    /// The same with the other sign.
    pub(crate) fn negated(&self) -> Self {
        Self { negative: !self.negative, ..*self }
    }

    /// How it compares with zero.
    pub(crate) fn sign(&self) -> Ordering {
        match self.negative {
            _ if self.mantissa == [0; WIDE] => Ordering::Equal,
            true => Ordering::Less,
            false => Ordering::Greater,
        }
    }

    /// Changes the sign. (In place, as [`Product::scale`]: a copy takes 30 bytes of flash.)
    pub(crate) fn negate(&mut self) {
        self.negative = !self.negative;
    }

    /// Multiplies by 2 to a small power.
    pub(crate) fn scale(&mut self, power: i32) {
        self.exponent += power;
    }

    /// Times 2 to a small power.
    pub(crate) fn scaled(&self, power: i32) -> Self {
        Self { exponent: self.exponent + power, ..*self }
    }
}

/// A mantissa of one limb.
const fn narrow(lowest: Limb) -> [Limb; WIDE] {
    let mut mantissa = [0; WIDE];
    mantissa[0] = lowest;
    mantissa
}

/// The lower 64 bits.
#[inline(always)]
fn half(mantissa: &[Limb; WIDE]) -> &[Limb] {
    mantissa.get(..NARROW).unwrap_or_default()
}

/// Adds a * b, as far as there is room.
#[cfg_attr(target_pointer_width = "32", inline(never))]
#[cfg_attr(not(target_pointer_width = "32"), inline(always))]
fn multiply(sum: &mut [Limb], a: &[Limb; WIDE], b: &[Limb]) {
    for (first, &b) in b.iter().enumerate() {
        let mut carry = 0;
        for (place, &a) in a.iter().enumerate() {
            if let Some(limb) = sum.get_mut(first + place) {
                // Never overflows: a product of two limbs leaves room for two limbs.
                let more = Twofold::from(a) * Twofold::from(b) + Twofold::from(*limb) + carry;
                *limb = more as Limb;
                carry = more >> Limb::BITS;
            }
        }
        if let Some(limb) = sum.get_mut(first + WIDE) {
            *limb = carry as Limb;
        }
    }
}

/// A sum of products, exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LongAccumulator<const LIMBS: usize> {
    /// Two's complement, the lowest limb first.
    pub(crate) limbs: [Limb; LIMBS],
}

impl<const LIMBS: usize> LongAccumulator<LIMBS> {
    /// The lowest bit is worth 2 to this power, the highest 2^831.
    const LOWEST: i32 = 832 - Limb::BITS as i32 * LIMBS as i32;

    /// The empty sum.
    pub(crate) const fn zero() -> Self {
        Self { limbs: [0; LIMBS] }
    }

    /// Adds a product.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add(&mut self, product: &Product) {
        self.add_shifted(&product.mantissa, product.exponent, product.negative);
    }

    /// Adds a product of two, the second of 64 bits at most.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add_product(&mut self, a: &Product, b: &Product) {
        let mut limbs = [0; WIDE + NARROW];
        multiply(&mut limbs, &a.mantissa, half(&b.mantissa));
        self.add_shifted(&limbs, a.exponent + b.exponent, a.negative != b.negative);
    }

    /// Adds a product of two.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_wide_product(&mut self, a: &Product, b: &Product) {
        let mut limbs = [0; 2 * WIDE];
        multiply(&mut limbs, &a.mantissa, &b.mantissa);
        self.add_shifted(&limbs, a.exponent + b.exponent, a.negative != b.negative);
    }

    /// Adds the square of a sum whose terms have 128 bits at most.
    pub(crate) fn add_wide_square(&mut self, terms: &[Product]) {
        for (index, term) in terms.iter().enumerate() {
            self.add_wide_product(term, term);
            for other in terms.iter().skip(index + 1) {
                self.add_wide_product(&term.scaled(1), other);
            }
        }
    }

    /// Adds the square of a sum whose terms have 64 bits at most, times `factor`, which has no more
    /// bits either.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add_square(&mut self, terms: &[Product], factor: &Product) {
        let mut rest = terms;
        while let Some((term, others)) = rest.split_first() {
            let mut twice = 0;
            for other in rest {
                let mut product = term.times(other);
                product.scale(twice);
                self.add_product(&product, factor);
                twice = 1;
            }
            rest = others;
        }
    }

    /// Adds some limbs times 2^exponent, or subtracts them.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_shifted(&mut self, limbs: &[Limb], exponent: i32, negative: bool) {
        let place = (exponent - Self::LOWEST).max(0).unsigned_abs();
        let (limb, shift) = ((place / Limb::BITS) as usize, place % Limb::BITS);
        // x - y is !(!x + y): one loop for both.
        let flip = if negative { Limb::MAX } else { 0 };
        let (mut from_below, mut carry) = (0, false);
        for (number, place) in self.limbs.iter_mut().skip(limb).enumerate() {
            if number > limbs.len() && !carry {
                return;
            }
            #[cfg(all(test, proofs))]
            crate::proofs::work::add(crate::proofs::work::Kind::Limb, 1);
            // Bits that leave a limb at its top come in at the next one's bottom.
            let limb = limbs.get(number).copied().unwrap_or(0);
            let more = limb << shift | from_below;
            from_below = limb >> 1 >> (Limb::BITS - 1 - shift);
            let (sum, first) = (*place ^ flip).overflowing_add(more);
            let (sum, second) = sum.overflowing_add(Limb::from(carry));
            *place = sum ^ flip;
            carry = first | second;
        }
    }

    /// How the sum compares with zero.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn sign(&self) -> Ordering {
        if self.is_negative() {
            Ordering::Less
        } else if self.limbs.iter().all(|&limb| limb == 0) {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }

    fn is_negative(&self) -> bool {
        self.limbs.last().is_some_and(|limb| limb >> (Limb::BITS - 1) == 1)
    }

    /// The sum within 2 u of itself, u = 2^-53. Only for sums of products of four, which neither over- nor underflow as
    /// doubles.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn estimate(&self) -> f64 {
        // The magnitude. Of a negative sum it is a unit less, which is nothing beside a product of four.
        let flip = if self.is_negative() { Limb::MAX } else { 0 };
        let Some(top) = self.limbs.iter().rposition(|&limb| limb != flip) else { return 0.0 };
        let at =
            |below: usize| self.limbs.get(top.wrapping_sub(below)).map_or(0, |limb| limb ^ flip);
        let zeros = at(0).leading_zeros();
        let mut bits: Twofold = 0;
        for below in 0..NARROW {
            let limb = at(below) << zeros | at(below + 1) >> 1 >> (Limb::BITS - 1 - zeros);
            bits = bits << Limb::BITS | Twofold::from(limb);
        }
        // 53 bits: those cut off are below 2 u. A double does not store the first bit, which makes its exponent one
        // more.
        let exponent = Self::LOWEST + (Limb::BITS * (top as u32 + 1) - 1 - zeros) as i32;
        let sign = (Twofold::from(flip & 1) as u64) << 63;
        f64::from_bits(sign + (((exponent + 1022) as u64) << 52) + (bits as u64 >> 11))
    }
}
