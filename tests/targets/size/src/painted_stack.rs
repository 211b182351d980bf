//! Measures how much stack a function writes to, and how many instructions it takes, on a Cortex-M.

// Unsafe code: the stack below its pointer, and a timer's registers.
#![allow(unsafe_code)]

use core::arch::asm;

/// The measured cost of a function.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// The bytes of stack that it writes to.
    pub stack: u32,
    /// Ticks of the timer, which counts up to 2^24 of them.
    pub ticks: u32,
}

const PAINT: u32 = 0xa5a5_a5a5;
const PAINTED: usize = 128 * 1024;
/// The stack of this function itself, below the pointer that it reads.
const SPARED: usize = 64;
/// Control, reload value and current value of the timer `SysTick`.
const SYSTICK: *mut u32 = 0xe000_e010 as *mut u32;
const LONGEST: u32 = 0x00ff_ffff;

/// Runs `work` over a painted stack, and finds how far down the paint is gone.
#[inline(never)]
pub fn measure(work: fn()) -> Measured {
    let top: usize;
    // SAFETY: the memory below the stack pointer belongs to no one, and the board has more of it than is painted; only
    // `work` runs between painting and looking. Nothing else uses the timer.
    unsafe {
        asm!("mov {}, sp", out(reg) top, options(nomem, nostack));
        let bottom = top - PAINTED;
        for word in (bottom..top - SPARED).step_by(4) {
            (word as *mut u32).write_volatile(PAINT);
        }
        SYSTICK.add(1).write_volatile(LONGEST);
        SYSTICK.add(2).write_volatile(0);
        SYSTICK.write_volatile(0b101);
        work();
        let ticks = LONGEST - SYSTICK.add(2).read_volatile();
        let mut lowest = bottom;
        while lowest < top && (lowest as *const u32).read_volatile() == PAINT {
            lowest += 4;
        }
        Measured { stack: (top - lowest) as u32, ticks }
    }
}
