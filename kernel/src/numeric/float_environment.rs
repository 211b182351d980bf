//! Whether the machine computes as the proofs assume.

use core::hint::black_box;

/// Returns whether arithmetic rounds to nearest even and keeps subnormals, in `f32` and `f64`, on
/// this thread.
///
/// Rust assumes so, and every target starts so unless a library replaces the float routines:
/// without its feature `disable-intrinsics` rp2040-hal takes those of the boot ROM, which flush
/// subnormals. A library called from another language may have set flush-to-zero,
/// denormals-are-zero or another rounding mode; AArch32 NEON always flushes. Where this returns
/// `false`, [`Exact`](crate::Exact) promises nothing. Costs some nanoseconds: call it once in every
/// thread, and in every interrupt handler that calls the kernel (on a Cortex-M a handler's
/// environment is not that of the thread that it interrupts).
///
/// ```
/// use spherule_kernel::float_environment_is_sound;
///
/// assert!(float_environment_is_sound());
/// ```
#[must_use]
#[inline(never)]
pub fn float_environment_is_sound() -> bool {
    // Nearest even: 1 + u is a tie that falls to 1, 1 + 3u one that rises, of either sign; every
    // directed mode gets one of them wrong.
    let half_ulp = black_box(f32::EPSILON / 2.0);
    let one = black_box(1.0_f32);
    let nearest = one + half_ulp == one
        && one + 3.0 * half_ulp == one + 4.0 * half_ulp
        && -one - half_ulp == -one
        && -one - 3.0 * half_ulp == -one - 4.0 * half_ulp;
    let (half_ulp, one) = (black_box(f64::EPSILON / 2.0), black_box(1.0_f64));
    let nearest = nearest
        && one + half_ulp == one
        && one + 3.0 * half_ulp == one + 4.0 * half_ulp
        && -one - half_ulp == -one
        && -one - 3.0 * half_ulp == -one - 4.0 * half_ulp;

    // Subnormals: made from normals, and read.
    let (small, tiny) = (black_box(f32::MIN_POSITIVE), black_box(f32::from_bits(1)));
    let kept = black_box(small * black_box(0.5)).to_bits() == 0x0040_0000
        && black_box(tiny * black_box(16_777_216.0)) == f32::from_bits(2 << 23);
    let (small, tiny) = (black_box(f64::MIN_POSITIVE), black_box(f64::from_bits(1)));
    nearest
        && kept
        && black_box(small * black_box(0.5)).to_bits() == 1 << 51
        && black_box(tiny * black_box(9_007_199_254_740_992.0)) == f64::from_bits(2 << 52)
}

#[cfg(all(test, proofs))]
mod tests {
    // `false` needs another environment, which only unsafe code can set: see tests/targets.
    #[test]
    fn the_machine_that_runs_this_is_sound() {
        assert!(super::float_environment_is_sound());
    }
}
