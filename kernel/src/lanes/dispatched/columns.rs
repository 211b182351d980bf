//! Sixteen rows of eight numbers, transposed in registers: by shuffles that stay within blocks of 128 bits, which
//! `fearless_simd` has no name for in wider vectors. (By the shuffles that it names, or by a loop over each column,
//! this ran at the rate of SSE2 or a third of it.)

#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use fearless_simd::{Simd, SimdBase, f32x4};
#[cfg(target_arch = "x86_64")]
use fearless_simd::{SimdInto, f32x8};

/// Eight rows. (Vectors of 512 bits need as many loads, and more shuffles for each.)
#[cfg(target_arch = "x86_64")]
macro_rules! eight_rows {
    ($name:ident, $level:ident) => {
        fearless_simd::kernel!(
            #[inline(always)]
            fn $name(token: $level, rows: [[f32; 8]; 8]) -> [[f32; 8]; 8] {
                let a: __m256 = f32x8::load_array(token, rows[0]).into();
                let b: __m256 = f32x8::load_array(token, rows[1]).into();
                let c: __m256 = f32x8::load_array(token, rows[2]).into();
                let d: __m256 = f32x8::load_array(token, rows[3]).into();
                let e: __m256 = f32x8::load_array(token, rows[4]).into();
                let f: __m256 = f32x8::load_array(token, rows[5]).into();
                let g: __m256 = f32x8::load_array(token, rows[6]).into();
                let h: __m256 = f32x8::load_array(token, rows[7]).into();
                // The first halves of rows 0 and 4, 1 and 5, ..; then the last.
                let low = [
                    _mm256_permute2f128_ps::<0x20>(a, e),
                    _mm256_permute2f128_ps::<0x20>(b, f),
                    _mm256_permute2f128_ps::<0x20>(c, g),
                    _mm256_permute2f128_ps::<0x20>(d, h),
                ];
                let high = [
                    _mm256_permute2f128_ps::<0x31>(a, e),
                    _mm256_permute2f128_ps::<0x31>(b, f),
                    _mm256_permute2f128_ps::<0x31>(c, g),
                    _mm256_permute2f128_ps::<0x31>(d, h),
                ];
                let mut columns = [[0.0; 8]; 8];
                let mut half = 0;
                while half < 2 {
                    let [a, b, c, d] = if half == 0 { low } else { high };
                    let (even, odd) = (_mm256_unpacklo_ps(a, c), _mm256_unpacklo_ps(b, d));
                    let first: f32x8<_> = _mm256_unpacklo_ps(even, odd).simd_into(token);
                    let second: f32x8<_> = _mm256_unpackhi_ps(even, odd).simd_into(token);
                    let (even, odd) = (_mm256_unpackhi_ps(a, c), _mm256_unpackhi_ps(b, d));
                    let third: f32x8<_> = _mm256_unpacklo_ps(even, odd).simd_into(token);
                    let fourth: f32x8<_> = _mm256_unpackhi_ps(even, odd).simd_into(token);
                    columns[4 * half] = first.to_array();
                    columns[4 * half + 1] = second.to_array();
                    columns[4 * half + 2] = third.to_array();
                    columns[4 * half + 3] = fourth.to_array();
                    half += 1;
                }
                columns
            }
        );
    };
}

#[cfg(target_arch = "x86_64")]
eight_rows!(eight_by_avx2, Avx2);
#[cfg(target_arch = "x86_64")]
eight_rows!(eight_by_avx512, Avx512);

/// Four rows of half as many numbers.
#[inline(always)]
fn four_halves<S: Simd>(token: S, [a, b, c, d]: [[f32; 4]; 4]) -> [[f32; 4]; 4] {
    let (a, b) = (f32x4::load_array(token, a), f32x4::load_array(token, b));
    let (c, d) = (f32x4::load_array(token, c), f32x4::load_array(token, d));
    let (even, odd) = (a.zip_low(c), b.zip_low(d));
    let (more_even, more_odd) = (a.zip_high(c), b.zip_high(d));
    [
        even.zip_low(odd).to_array(),
        even.zip_high(odd).to_array(),
        more_even.zip_low(more_odd).to_array(),
        more_even.zip_high(more_odd).to_array(),
    ]
}

/// Puts a column of `N` rows at its place among all rows.
#[inline(always)]
fn put<const N: usize>(all: &mut [f32; 16], first: usize, column: &[f32; N]) {
    // Not `copy_from_slice`, which is a call in a build without link-time optimisation.
    let mut row = 0;
    while row < N {
        all[(first + row) % 16] = column[row];
        row += 1;
    }
}

/// [`Lanes::columns`](crate::Lanes::columns).
#[inline(always)]
pub(super) fn of_rows<S: Simd>(token: S, row: impl Fn(usize) -> [f32; 8]) -> [[f32; 16]; 8] {
    let mut all = [[0.0; 16]; 8];
    #[cfg(target_arch = "x86_64")]
    if let fearless_simd::Level::Avx512(_) | fearless_simd::Level::Avx2(_) = token.level() {
        let mut first = 0;
        while first < 16 {
            let rows = [
                row(first),
                row(first + 1),
                row(first + 2),
                row(first + 3),
                row(first + 4),
                row(first + 5),
                row(first + 6),
                row(first + 7),
            ];
            let columns = match token.level() {
                fearless_simd::Level::Avx512(avx512) => eight_by_avx512(avx512, rows),
                fearless_simd::Level::Avx2(avx2) => eight_by_avx2(avx2, rows),
                _ => rows,
            };
            for column in 0..8 {
                put(&mut all[column], first, &columns[column]);
            }
            first += 8;
        }
        return all;
    }
    let mut first = 0;
    while first < 16 {
        let [a, b, c, d] = [row(first), row(first + 1), row(first + 2), row(first + 3)];
        let low = [
            [a[0], a[1], a[2], a[3]],
            [b[0], b[1], b[2], b[3]],
            [c[0], c[1], c[2], c[3]],
            [d[0], d[1], d[2], d[3]],
        ];
        let high = [
            [a[4], a[5], a[6], a[7]],
            [b[4], b[5], b[6], b[7]],
            [c[4], c[5], c[6], c[7]],
            [d[4], d[5], d[6], d[7]],
        ];
        let (low, high) = (four_halves(token, low), four_halves(token, high));
        for column in 0..4 {
            put(&mut all[column], first, &low[column]);
            put(&mut all[column + 4], first, &high[column]);
        }
        first += 4;
    }
    all
}
