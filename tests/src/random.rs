//! Random numbers that never change: our own generator, and only operations whose last bit is
//! the same on every machine (no powers, logarithms or sines).

/// `SplitMix64` (Steele, Lea, Flood 2014), and what geometry draws from it.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of `seed`, and within it of `index`: any case can be made again on its own.
    #[must_use]
    pub fn new(seed: u64, index: u64) -> Self {
        let mut random = Self(seed);
        // Without mixing, the stream of a near seed would be the same stream, a step on.
        random.0 = random.bits() ^ index;
        random.0 = random.bits();
        random
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Any `f32` whatever, NaN and infinities among them.
    pub fn any_f32(&mut self) -> f32 {
        f32::from_bits((self.bits() >> 32) as u32)
    }

    /// An integer in `low ..= high`.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        low + (self.bits() % (high - low + 1) as u64) as i64
    }

    /// One of `choices`.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.integer(0, choices.len() as i64 - 1) as usize]
    }

    /// True once in `times`.
    pub fn one_in(&mut self, times: i64) -> bool {
        self.integer(1, times) == 1
    }

    /// 1 or -1.
    pub fn sign(&mut self) -> f64 {
        if self.one_in(2) { 1.0 } else { -1.0 }
    }

    /// Uniform in `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A number in `[2^low, 2^(high + 1))`, every power of two as likely as every other.
    pub fn log_uniform(&mut self, low: i64, high: i64) -> f64 {
        let exponent = self.integer(low, high);
        self.uniform(1.0, 2.0) * power_of_two(exponent)
    }

    /// A direction of length one (but for rounding), uniform on the sphere.
    pub fn unit(&mut self) -> [f64; 3] {
        loop {
            let v = [(); 3].map(|()| self.uniform(-1.0, 1.0));
            let square = dot(v, v);
            if (0.01..1.0).contains(&square) {
                return v.map(|x| x / square.sqrt());
            }
        }
    }

    /// A unit vector at right angles (but for rounding) to the unit vector `u`.
    pub fn perpendicular(&mut self, u: [f64; 3]) -> [f64; 3] {
        loop {
            let v = cross(u, self.unit());
            let square = dot(v, v);
            if square > 0.01 {
                return v.map(|x| x / square.sqrt());
            }
        }
    }
}

/// 2^exponent, exactly.
///
/// # Panics
/// Where it is no normal `f64`.
#[must_use]
pub fn power_of_two(exponent: i64) -> f64 {
    assert!((-1022..=1023).contains(&exponent), "2^{exponent} is no normal f64");
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// The scalar product.
#[must_use]
pub fn dot(v: [f64; 3], w: [f64; 3]) -> f64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

/// The vector product.
#[must_use]
pub fn cross(v: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of the reference implementation for seed 1234567.
    #[test]
    fn is_splitmix64() {
        let mut random = Random(1_234_567);
        let expected: [u64; 3] =
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([(); 3].map(|()| random.bits()), expected);
    }

    #[test]
    fn both_signs_and_both_ends_occur() {
        let mut random = Random::new(1, 0);
        let draws: Vec<_> = (0..1000).map(|_| (random.sign(), random.integer(-3, 3))).collect();
        for sign in [-1.0, 1.0] {
            assert!(draws.iter().filter(|draw| draw.0 == sign).count() > 400);
        }
        for integer in -3..=3 {
            assert!(draws.iter().filter(|draw| draw.1 == integer).count() > 100);
        }
        assert!(draws.iter().all(|draw| (-3..=3).contains(&draw.1)));
    }

    #[test]
    fn sizes_are_spread_over_the_powers_of_two() {
        let mut random = Random::new(2, 0);
        let mut counts = [0; 5];
        for _ in 0..5000 {
            let size = random.log_uniform(-2, 2);
            let power = (0..5).find(|&i| size < power_of_two(i - 1)).expect("below 2^3");
            counts[power as usize] += 1;
        }
        assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
    }

    #[test]
    fn units_have_length_one_and_perpendiculars_no_part_along_them() {
        let mut random = Random::new(3, 0);
        let mut octants = [0; 8];
        for _ in 0..8000 {
            let u = random.unit();
            let v = random.perpendicular(u);
            assert!((dot(u, u) - 1.0).abs() < 1e-14 && (dot(v, v) - 1.0).abs() < 1e-14);
            assert!(dot(u, v).abs() < 1e-14);
            let octant = u.iter().fold(0, |bits, &x| bits << 1 | usize::from(x < 0.0));
            octants[octant] += 1;
        }
        assert!(octants.iter().all(|count| (850..1150).contains(count)), "{octants:?}");
    }

    #[test]
    fn a_stream_is_its_own() {
        let first = |seed, index| Random::new(seed, index).bits();
        assert_eq!(first(1, 1), first(1, 1));
        assert_ne!(first(1, 1), first(1, 2));
        assert_ne!(first(1, 1), first(2, 1));
    }
}
