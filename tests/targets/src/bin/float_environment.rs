//! Whether `float_environment_is_sound` sees subnormals that are flushed, and other roundings, where a target can set them.

#![cfg_attr(target_os = "none", no_std, no_main)]
// Unsafe code: the control register of a floating-point unit is not Rust's to set.
#![allow(unsafe_code)]

use spherule_kernel::float_environment_is_sound;
use spherule_targets::platform::print;

/// The bits of the control register, and what they do: flush, and round up, down and to zero.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
mod control {
    pub(super) const MODES: &[(u32, &str)] = &[
        (1 << 24, "FPSCR.FZ, subnormals are flushed"),
        (1 << 22, "FPSCR.RMode, up"),
        (2 << 22, "FPSCR.RMode, down"),
        (3 << 22, "FPSCR.RMode, to zero"),
    ];

    core::arch::global_asm!(
        ".syntax unified",
        ".fpu fpv4-sp-d16",
        ".global spherule_set_control",
        ".type spherule_set_control, %function",
        ".thumb_func",
        "spherule_set_control:",
        "vmsr fpscr, r0",
        "bx lr",
    );

    unsafe extern "C" {
        fn spherule_set_control(bits: u32);
    }

    pub(super) fn set(bits: u32) {
        // SAFETY: set back before Rust computes anything but what is asked under these bits.
        unsafe { spherule_set_control(bits) }
    }
}

/// The rounding modes of RISC-V's `frm`: to zero, down, up, and ties away from zero. It has no flushing.
#[cfg(all(target_arch = "riscv32", target_feature = "f"))]
mod control {
    pub(super) const MODES: &[(u32, &str)] =
        &[(1, "frm, to zero"), (2, "frm, down"), (3, "frm, up"), (4, "frm, ties away from zero")];

    pub(super) fn set(bits: u32) {
        // SAFETY: set back before Rust computes anything but what is asked under these bits.
        unsafe { core::arch::asm!("fsrm {}", in(reg) bits, options(nomem, nostack)) }
    }
}

/// The bits of `FPCR`.
#[cfg(target_arch = "aarch64")]
mod control {
    pub(super) const MODES: &[(u32, &str)] = &[
        (1 << 24, "FPCR.FZ, subnormals are flushed"),
        (1 << 22, "FPCR.RMode, up"),
        (2 << 22, "FPCR.RMode, down"),
        (3 << 22, "FPCR.RMode, to zero"),
    ];

    pub(super) fn set(bits: u32) {
        // SAFETY: set back before Rust computes anything but what is asked under these bits.
        unsafe {
            core::arch::asm!("msr fpcr, {}", in(reg) u64::from(bits), options(nomem, nostack))
        }
    }
}

/// Numbers are a library's, or the target's have one environment: nothing can be set. (x86-64's are `tests/machine`'s.)
#[cfg(not(any(
    all(target_arch = "arm", target_abi = "eabihf"),
    all(target_arch = "riscv32", target_feature = "f"),
    target_arch = "aarch64",
)))]
mod control {
    pub(super) const MODES: &[(u32, &str)] = &[];

    pub(super) fn set(_bits: u32) {}
}

/// Sound by default, and in no other environment.
fn run() -> bool {
    if !float_environment_is_sound() {
        print(b"FAILED: the default is not sound\n");
        return false;
    }
    print(b"ok: the default is sound\n");
    let mut all_seen = true;
    for &(bits, name) in control::MODES {
        control::set(bits);
        let is_sound = float_environment_is_sound();
        control::set(0);
        all_seen &= !is_sound;
        print(if is_sound { "FAILED: not seen: " } else { "ok: seen: " }.as_bytes());
        print(name.as_bytes());
        print(b"\n");
    }
    all_seen && float_environment_is_sound()
}

spherule_targets::start!(run);
