//! Whether `float_environment_is_sound` detects flushed subnormals and other rounding modes, where a target can set them.

#![cfg_attr(target_os = "none", no_std, no_main)]
// Unsafe code: Rust cannot set the control register of a floating-point unit.
#![allow(unsafe_code)]

use spherule_kernel::float_environment_is_sound;
use spherule_targets::platform::print;

/// The bits of the control register, and their effects: flush, and round up, down and to zero.
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
        // SAFETY: the bits are set back before Rust computes anything except the question asked under them.
        unsafe { spherule_set_control(bits) }
    }
}

/// The bits of `MXCSR`, which SSE computes by.
#[cfg(target_arch = "x86_64")]
mod control {
    pub(super) const MODES: &[(u32, &str)] = &[
        (0x8000, "MXCSR.FTZ, subnormal results are flushed"),
        (0x0040, "MXCSR.DAZ, subnormal operands are flushed"),
        (0x8040, "MXCSR.FTZ and DAZ"),
        (0x4000, "MXCSR.RC, up"),
        (0x2000, "MXCSR.RC, down"),
        (0x6000, "MXCSR.RC, to zero"),
    ];
    /// Every exception is masked.
    const DEFAULT: u32 = 0x1f80;

    pub(super) fn set(bits: u32) {
        // SAFETY: the bits are set back before Rust computes anything except the question asked under them.
        unsafe { core::arch::asm!("ldmxcsr [{}]", in(reg) &(DEFAULT | bits), options(nostack)) }
    }
}

/// The rounding modes of RISC-V's `frm`: to zero, down, up, and ties away from zero. RISC-V has no flushing.
#[cfg(all(target_arch = "riscv32", target_feature = "f"))]
mod control {
    pub(super) const MODES: &[(u32, &str)] =
        &[(1, "frm, to zero"), (2, "frm, down"), (3, "frm, up"), (4, "frm, ties away from zero")];

    pub(super) fn set(bits: u32) {
        // SAFETY: the bits are set back before Rust computes anything except the question asked under them.
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
        // SAFETY: the bits are set back before Rust computes anything except the question asked under them.
        unsafe {
            core::arch::asm!("msr fpcr, {}", in(reg) u64::from(bits), options(nomem, nostack))
        }
    }
}

/// A library computes the numbers, or the target has only one environment: nothing can be set.
#[cfg(not(any(
    all(target_arch = "arm", target_abi = "eabihf"),
    all(target_arch = "riscv32", target_feature = "f"),
    target_arch = "aarch64",
    target_arch = "x86_64",
)))]
mod control {
    pub(super) const MODES: &[(u32, &str)] = &[];

    pub(super) fn set(_bits: u32) {}
}

/// Whether the kernel calls the default sound, and every other environment unsound.
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
