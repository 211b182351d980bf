//! Climbing towards the worst, for tests that ask how large something can become.

extern crate std;

/// Random numbers that never change: `SplitMix64` (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// One of `0 .. end`.
    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.bits() % end
    }

    /// Either sign, 2^`exponent` up to its double.
    pub(crate) fn about(&mut self, exponent: i32) -> f32 {
        let bits = self.bits() as u32;
        f32::from_bits(bits & 0x807f_ffff | ((exponent + 127) as u32) << 23)
    }

    /// About 2^`low` to 2^`high`.
    pub(crate) fn wide(&mut self, low: i32, high: i32) -> f32 {
        let exponent = low + self.below((high - low + 1) as u64) as i32;
        self.about(exponent)
    }

    /// A point whose coordinates are about 2^`exponent`, some of them smaller, some zero.
    pub(crate) fn point(&mut self, exponent: i32) -> [f32; 3] {
        [(); 3].map(|()| match self.below(6) {
            0 => 0.0,
            1 => self.wide(exponent - 12, exponent),
            _ => self.about(exponent),
        })
    }
}

/// The largest `score` found from `starts` beginnings, `steps` small changes each, and where.
pub(crate) fn climb<const N: usize>(
    seed: u64,
    starts: u32,
    steps: u32,
    mut start: impl FnMut(&mut Random) -> [f32; N],
    mut score: impl FnMut(&[f32; N]) -> f64,
) -> (f64, [f32; N]) {
    let mut random = Random(seed);
    let mut worst = (f64::NEG_INFINITY, [0.0; N]);
    for _ in 0..starts {
        let mut here = start(&mut random);
        let mut height = score(&here);
        for _ in 0..steps {
            let mut there = here;
            for _ in 0..=random.below(2) {
                let number = &mut there[random.below(N as u64) as usize];
                // The last few bits, or some more, or all of the fraction; the size stays,
                // and so does zero: a subnormal would be outside most domains.
                let kept = random.below(24);
                if *number != 0.0 {
                    let flipped = random.bits() as u32 >> 9 >> kept;
                    *number = f32::from_bits(number.to_bits() ^ flipped);
                }
            }
            let reached = score(&there);
            if reached >= height || height.is_nan() {
                (here, height) = (there, reached);
            }
        }
        if height > worst.0 {
            worst = (height, here);
        }
    }
    worst
}
