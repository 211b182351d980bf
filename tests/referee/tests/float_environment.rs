//! A thread whose floats are not what `Exact` needs is no judge.
#![cfg(target_arch = "x86_64")]
// Unsafe code: Rust cannot set the control register of SSE.
#![allow(unsafe_code)]

use core::arch::asm;
use spherule_referee::Rules;
use spherule_referee::judge::Judge;
use spherule_referee::truth::Shared;
use std::panic::catch_unwind;

const DEFAULT: u32 = 0x1f80;
/// Subnormal results become zero, and so do subnormal operands.
const FLUSHING: u32 = DEFAULT | 0x8040;

fn set(control: u32) {
    // SAFETY: the load reads four bytes where there are four. Exceptions stay masked, and the test restores the default.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const control, options(nostack, readonly)) };
}

#[test]
fn a_thread_that_flushes_judges_nothing() {
    let judges: [fn(); 2] = [
        || Judge::new(Rules::CONTRACT, false).pairs(&[], &[], &[], &[]),
        || Judge::new(Rules::CONTRACT, false).shared(&Shared::new(&[]), &[], &[], &[]),
    ];
    for judge in judges {
        for (control, is_judge) in [(DEFAULT, true), (FLUSHING, false)] {
            set(control);
            let outcome = catch_unwind(judge);
            set(DEFAULT);
            assert_eq!(outcome.is_ok(), is_judge, "{control:x}");
        }
    }
}
