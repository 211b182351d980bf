//! FNV-1a, of 64 bits.

use spherule_kernel::Hit;

/// A digest of words.
pub(super) struct Fnv(pub(super) u64);

impl Fnv {
    pub(super) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(super) fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds the bits of `t`. Of a NaN, which the roots of `Fast` and `Geometric` may be, adds only that it is one.
    pub(super) fn t(&mut self, t: f32) {
        self.word(if t.is_nan() { u32::MAX } else { t.to_bits() });
    }

    pub(super) fn hit(&mut self, hit: Option<Hit>) {
        match hit {
            Some(hit) => {
                self.t(hit.t);
                self.word(hit.sphere);
            }
            None => self.word(u32::MAX - 1),
        }
    }
}
