//! `float_environment_is_sound` in unsound environments.

// Unsafe code: Rust cannot set the control register of SSE.
#![allow(unsafe_code)]

use spherule_kernel::float_environment_is_sound;

const DEFAULT: u32 = 0x1f80;

/// What the kernel says under the given control register.
fn sound_under(control: u32) -> bool {
    // SAFETY: exceptions stay masked, and the default is restored before Rust's own arithmetic
    // continues. Between the two there is one call of a function that is not inlined.
    unsafe {
        core::arch::asm!("ldmxcsr [{}]", in(reg) &control, options(nostack));
        let sound = float_environment_is_sound();
        core::arch::asm!("ldmxcsr [{}]", in(reg) &DEFAULT, options(nostack));
        sound
    }
}

/// Asserts that the default environment is sound, and no other.
///
/// # Panics
/// If the kernel says otherwise.
pub(crate) fn prove() {
    assert!(sound_under(DEFAULT), "the control: the default is sound");
    for (name, bits) in [
        ("flush to zero", 0x8000),
        ("denormals are zero", 0x0040),
        ("both", 0x8040),
        ("rounding down", 0x2000),
        ("rounding up", 0x4000),
        ("rounding to zero", 0x6000),
    ] {
        assert!(!sound_under(DEFAULT | bits), "{name} was not seen");
        println!("machine: ok: {name} is seen");
    }
    assert!(sound_under(DEFAULT), "the default again");
}
