//! FNV-1a, of 64 bits.

use spherule_kernel::Hit;

/// A digest of words.
#[derive(Debug)]
pub struct Fnv {
    /// The digest of what was added so far.
    pub digest: u64,
    /// How many finite numbers it has: t, and coordinates of surfaces.
    pub hits: u32,
    /// Whether it changes the last bit of the first of these, which must be noticed.
    control: bool,
}

impl Fnv {
    /// Returns the digest of nothing.
    #[must_use]
    pub const fn new(control: bool) -> Self {
        Self { digest: 0xcbf2_9ce4_8422_2325, hits: 0, control }
    }

    /// Adds a word.
    pub fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.digest = (self.digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds the bits of a t or a coordinate of a surface. Of a NaN, which the roots of `Fast` and `Geometric` may be, adds only that it is
    /// one.
    pub fn number(&mut self, number: f32) {
        let is_changed = self.control && self.hits == 0 && number.is_finite();
        self.hits += u32::from(number.is_finite());
        let bits = if number.is_nan() { u32::MAX } else { number.to_bits() };
        self.word(bits ^ u32::from(is_changed));
    }

    /// Adds the bits of a hit, or that there is none.
    pub fn hit(&mut self, hit: Option<Hit>) {
        match hit {
            Some(hit) => {
                self.number(hit.t);
                self.word(hit.sphere);
            }
            None => self.word(u32::MAX - 1),
        }
    }
}
