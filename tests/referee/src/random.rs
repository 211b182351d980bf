//! Random numbers that never change. The generator is our own, and, except in [`Random::normal`], only operations are
//! used whose last bit is the same on every machine (no powers, logarithms or sines).

use spherule_kernel::Vec3;

/// `SplitMix64` (Steele, Lea, Flood 2014), and what geometry draws from it.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of `index` within the stream of `seed`: any case can be made again on its own.
    #[must_use]
    pub const fn new(seed: u64, index: u64) -> Self {
        let mut random = Self::seeded(seed);
        // Without mixing, a near seed would give the same stream, one step on.
        random.0 = random.bits() ^ index;
        random.0 = random.bits();
        random
    }

    /// The stream of the published generator for `seed`.
    #[must_use]
    pub const fn seeded(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Any `f32`, including NaN and infinities.
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

    /// True once in `times` on average.
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

    /// A direction of length one, up to rounding, uniform on the sphere.
    pub fn unit(&mut self) -> [f64; 3] {
        loop {
            let v = [(); 3].map(|()| self.uniform(-1.0, 1.0));
            let square = dot(v, v);
            if (0.01..1.0).contains(&square) {
                return v.map(|x| x / square.sqrt());
            }
        }
    }

    /// Uniform in `[low, high]`, on a grid of 2^-24 of the interval's length.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1_u64 << 24) as f32;
        low + unit * (high - low)
    }

    /// Uniform in a cube around the origin, `half` from the centre to a side.
    pub fn in_cube(&mut self, half: f32) -> Vec3 {
        Vec3::from_array([(); 3].map(|()| self.between(-half, half)))
    }

    /// Like [`Random::unit`], but in single precision throughout.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let point = self.in_cube(1.0);
            let square = point.length_squared();
            if (0.01..=1.0).contains(&square) {
                return point / square.sqrt();
            }
        }
    }

    /// Normal, of mean 0 and variance 1 (Box and Muller). The last bits depend on the machine's logarithm and cosine.
    pub fn normal(&mut self) -> f64 {
        let (radius, angle) = (1.0 - self.uniform(0.0, 1.0), self.uniform(0.0, 1.0));
        (-2.0 * radius.ln()).sqrt() * (angle * core::f64::consts::TAU).cos()
    }

    /// A unit vector at right angles, up to rounding, to the unit vector `u`.
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
/// If 2^exponent is no normal `f64`.
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
