//! Sixteen lanes in another order: one instruction where the CPU has it (AVX-512), which
//! `fearless_simd` has no portable name for.

use fearless_simd::{Simd, SimdBase, f32x16};

/// [`Lanes::in_order`](crate::Lanes::in_order) for sixteen lanes.
#[inline(always)]
pub(super) fn sixteen<S: Simd>(lanes: f32x16<S>, order: u64) -> f32x16<S> {
    let token = fearless_simd::ExtractToken::token(&lanes);
    #[cfg(target_arch = "x86_64")]
    if let fearless_simd::Level::Avx512(avx512) = token.level() {
        let lanes = f32x16::load_array(avx512, lanes.to_array());
        return f32x16::load_array(token, permuted(avx512, lanes, order).to_array());
    }
    let array = lanes.to_array();
    let mut ordered = array;
    for (lane, element) in ordered.iter_mut().enumerate() {
        *element = array[(order >> (4 * lane)) as usize % 16];
    }
    f32x16::load_array(token, ordered)
}

#[cfg(target_arch = "x86_64")]
use {core::arch::x86_64::*, fearless_simd::x86::Avx512};

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    #[inline(always)]
    fn permuted(token: Avx512, lanes: f32x16<Avx512>, order: u64) -> f32x16<Avx512> {
        use fearless_simd::SimdInto;
        // Four bits for each lane, and four more behind them, of which the permutation reads none.
        let places = _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60);
        let indices = _mm512_multishift_epi64_epi8(places, _mm512_set1_epi64(order as i64));
        _mm512_permutexvar_ps(indices, lanes.into()).simd_into(token)
    }
);
