//! Sums of products of `f32` that are never rounded: a fixed-point number as wide as all of them, a long
//! accumulator (Kulisch and Miranker 1986, The Arithmetic of the Digital Computer: A New Approach).
//!
//! A finite `f32` is an integer below 2^24 times 2^e, with e from -149 to 104. So a product of six, and four
//! times that, is a multiple of 2^-894 and below 2^770; times the square of a midpoint, of which `surface.rs` has one
//! where lengths cancel, a multiple of 2^-1194. Accumulators count in units of 2^-896 or of 2^-1216, and hold
//! 2^50 such products before they reach 2^831, where the sign is. Nothing is rounded, nothing overflows, and no
//! floating-point environment matters.
//!
//! On targets of 32 bits, where a product of two limbs is a page of code, what is made of products is called and not
//! inlined: a third of the flash of `Exact`.

use core::cmp::Ordering;

/// For products of six.
pub(crate) type SumOfSixes = LongAccumulator<27>;
/// For products of six times the square of a midpoint.
pub(crate) type SumOfEights = LongAccumulator<32>;

/// A product of numbers, exactly: `mantissa * 2^exponent`, or that negated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Product {
    negative: bool,
    exponent: i32,
    /// Low and high half: as one number it would be aligned to 16 bytes, and take a third more stack.
    mantissa: [u64; 2],
}

impl Product {
    /// 0.
    pub(crate) const ZERO: Self = Self { negative: false, exponent: 0, mantissa: [0; 2] };
    /// 1.
    pub(crate) const ONE: Self = Self { mantissa: [1, 0], ..Self::ZERO };

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
            mantissa: [u64::from(mantissa), 0],
        }
    }

    /// A double that is finite and no subnormal: as few bits of mantissa as it has.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
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
            mantissa: [mantissa >> zeros, 0],
        }
    }

    /// Both together; their mantissas have 128 bits at most.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn times(self, other: Self) -> Self {
        let whole = |[low, high]: [u64; 2]| u128::from(high) << 64 | u128::from(low);
        let product = whole(self.mantissa).wrapping_mul(whole(other.mantissa));
        Self {
            negative: self.negative != other.negative,
            exponent: self.exponent + other.exponent,
            mantissa: [product as u64, (product >> 64) as u64],
        }
    }

    /// The same with the other sign.
    pub(crate) fn negated(self) -> Self {
        Self { negative: !self.negative, ..self }
    }

    /// How it compares with zero.
    pub(crate) fn sign(self) -> Ordering {
        match self.negative {
            _ if self.mantissa == [0; 2] => Ordering::Equal,
            true => Ordering::Less,
            false => Ordering::Greater,
        }
    }

    /// Times 2 to a small power.
    pub(crate) fn scaled(self, power: i32) -> Self {
        Self { exponent: self.exponent + power, ..self }
    }
}

/// A sum of products, exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LongAccumulator<const LIMBS: usize> {
    /// Two's complement, the lowest first.
    limbs: [u64; LIMBS],
}

impl<const LIMBS: usize> LongAccumulator<LIMBS> {
    /// The lowest bit is worth 2 to this power, the highest 2^831.
    const LOWEST: i32 = 832 - 64 * LIMBS as i32;

    /// The empty sum.
    pub(crate) const fn zero() -> Self {
        Self { limbs: [0; LIMBS] }
    }

    /// Adds a product.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add(&mut self, product: Product) {
        let Product { negative, exponent, mantissa: [low, high] } = product;
        self.add_shifted(&[low, high], exponent, negative);
    }

    /// Adds a product of two.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add_product(&mut self, a: Product, b: Product) {
        let halves = |number: u128| (number & u128::from(u64::MAX), number >> 64);
        let ([a_low, a_high], [b_low, b_high]) = (a.mantissa, b.mantissa);
        let [a_low, a_high] = [u128::from(a_low), u128::from(a_high)];
        let [b_low, b_high] = [u128::from(b_low), u128::from(b_high)];
        // No sum overflows: a product of two limbs leaves room for two limbs.
        let (first, low) = halves(a_low * b_low);
        let (second, high) = halves(a_high * b_low + low);
        let (middle, carry) = halves(a_low * b_high + second);
        let (third, fourth) = halves(a_high * b_high + high + carry);
        let limbs = [first as u64, middle as u64, third as u64, fourth as u64];
        self.add_shifted(&limbs, a.exponent + b.exponent, a.negative != b.negative);
    }

    /// Adds the square of a sum whose terms have 128 bits at most.
    pub(crate) fn add_wide_square(&mut self, terms: &[Product]) {
        for (index, &term) in terms.iter().enumerate() {
            self.add_product(term, term);
            for &other in terms.iter().skip(index + 1) {
                self.add_product(term.scaled(1), other);
            }
        }
    }

    /// Adds the square of a sum whose terms have 64 bits at most, times `factor`.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add_square(&mut self, terms: &[Product], factor: Product) {
        for (index, &term) in terms.iter().enumerate() {
            self.add_product(term.times(term), factor);
            for &other in terms.iter().skip(index + 1) {
                self.add_product(term.times(other).scaled(1), factor);
            }
        }
    }

    /// Adds the product of two sums.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn add_products(&mut self, some: &[Product], others: &[Product]) {
        for &term in some {
            for &other in others {
                self.add_product(term, other);
            }
        }
    }

    /// Adds some limbs times 2^exponent, or takes them away.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn add_shifted(&mut self, limbs: &[u64], exponent: i32, negative: bool) {
        let place = (exponent - Self::LOWEST).max(0).unsigned_abs();
        let (limb, shift) = (place as usize / 64, place % 64);
        // x - y is !(!x + y): one loop for both.
        let flip = if negative { u64::MAX } else { 0 };
        let (mut from_below, mut carry) = (0, false);
        for (number, place) in self.limbs.iter_mut().skip(limb).enumerate() {
            if number > limbs.len() && !carry {
                return;
            }
            #[cfg(test)]
            crate::testing::limbs::touch();
            // Bits that leave a limb at its top come in at the next one's bottom.
            let limb = limbs.get(number).copied().unwrap_or(0);
            let more = limb << shift | from_below;
            from_below = limb >> 1 >> (63 - shift);
            let (sum, first) = (*place ^ flip).overflowing_add(more);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            *place = sum ^ flip;
            carry = first | second;
        }
    }

    /// How the sum compares with zero.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn sign(&self) -> Ordering {
        match self.limbs.last() {
            Some(top) if top >> 63 == 1 => Ordering::Less,
            _ if self.lowest().is_none() => Ordering::Equal,
            _ => Ordering::Greater,
        }
    }

    /// The lowest limb that is not zero.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    fn lowest(&self) -> Option<usize> {
        self.limbs.iter().position(|&limb| limb != 0)
    }

    /// A limb of the magnitude, of which the lowest that is not zero is known.
    fn magnitude(&self, number: usize, lowest: usize) -> u64 {
        let limb = self.limbs.get(number).copied().unwrap_or(0);
        match self.sign() {
            Ordering::Less if number > lowest => !limb,
            Ordering::Less => limb.wrapping_neg(),
            _ => limb,
        }
    }

    /// The sum within 2 u of itself, u = 2^-53; for sums of products of four, which no double over- or
    /// underflows.
    #[cfg_attr(target_pointer_width = "32", inline(never))]
    pub(crate) fn estimate(&self) -> f64 {
        let Some(lowest) = self.lowest() else { return 0.0 };
        let mut top = LIMBS - 1;
        while top > lowest && self.magnitude(top, lowest) == 0 {
            top -= 1;
        }
        // 65 bits or more: what is cut off is below 2^-64 of the sum.
        let below = if top == 0 { 0 } else { self.magnitude(top - 1, lowest) };
        let bits = u128::from(self.magnitude(top, lowest)) << 64 | u128::from(below);
        let value = bits as f64 * power_of_two(64 * (top as i32 - 1) + Self::LOWEST);
        if self.sign() == Ordering::Less { -value } else { value }
    }
}

/// 2 to a power that a normal double can be.
fn power_of_two(power: i32) -> f64 {
    f64::from_bits(((power + 1023).clamp(1, 2046) as u64) << 52)
}

#[cfg(test)]
mod against_integers;
