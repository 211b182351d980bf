//! Hill climbing towards the worst case, for tests that ask how large something can become.

use std::println;

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

/// Returns the largest `score` found from `starts` beginnings, with `steps` small changes each, and the numbers that
/// reach it.
///
/// A change alters the last few bits of a number or two, or some more bits, or all of the fraction; or the exponent,
/// within `exponents`, unless sizes are to stay. Zero stays zero: a subnormal would be outside of most domains.
pub(crate) fn climb<const N: usize>(
    seed: u64,
    [starts, steps]: [u32; 2],
    exponents: Option<[i32; 2]>,
    mut start: impl FnMut(&mut Random) -> [f32; N],
    mut score: impl FnMut(&[f32; N]) -> f64,
) -> (f64, [f32; N]) {
    let mut random = Random(seed);
    let mut worst = (f64::NEG_INFINITY, [0.0; N]);
    for _ in 0..starts * times() {
        let mut here = start(&mut random);
        let mut height = score(&here);
        for _ in 0..steps {
            let mut there = here;
            for _ in 0..=random.below(2) {
                let number = &mut there[random.below(N as u64) as usize];
                let kept = random.below(24);
                if *number == 0.0 {
                    continue;
                }
                *number = match exponents {
                    Some(exponents) if random.below(4) == 0 => {
                        resized(&mut random, *number, exponents)
                    }
                    _ => f32::from_bits(number.to_bits() ^ (random.bits() as u32 >> 9 >> kept)),
                };
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

/// The higher of two climbs: one that keeps sizes, and one from half as many beginnings that does not.
pub(crate) fn climb_twice<const N: usize>(
    seed: u64,
    [starts, steps]: [u32; 2],
    exponents: [i32; 2],
    start: impl Fn(&mut Random) -> [f32; N],
    score: impl Fn(&[f32; N]) -> f64,
) -> (f64, [f32; N]) {
    let kept = climb(seed, [starts, steps], None, &start, &score);
    let changed = climb(seed, [starts / 2, steps], Some(exponents), &start, &score);
    if kept.0 > changed.0 { kept } else { changed }
}

/// Fails if a search finds a tenth less or more than is published, in `docs/proofs.md` or at the test. More means a
/// better search, and is worth publishing; a longer search may find more.
pub(crate) fn assert_published(what: &str, found: f64, published: f64) {
    println!("{what}: {found:.3} found, {published} published");
    let part = found / published;
    assert!(
        part >= 0.9 && (part <= 1.1 || times() > 1),
        "{what}: {found} found, {published} published"
    );
}

/// The factor by which the usual number of beginnings is multiplied: `SPHERULE_CLIMB`.
fn times() -> u32 {
    std::env::var("SPHERULE_CLIMB").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
}

/// With another exponent: mostly the next.
fn resized(random: &mut Random, number: f32, [least, greatest]: [i32; 2]) -> f32 {
    let bits = number.to_bits();
    let by = [1, 1, 1, 2, 3, 1 + random.below(24) as i32][random.below(6) as usize];
    let by = if random.below(2) == 0 { by } else { -by };
    let exponent = (bits >> 23 & 0xff) as i32 - 127 + by;
    if (least..=greatest).contains(&exponent) {
        return f32::from_bits(bits & 0x807f_ffff | ((exponent + 127) as u32) << 23);
    }
    number
}
