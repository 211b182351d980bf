//! A painted stack of our own, which shows afterwards how much of it was used.

// Unsafe code: Rust cannot set the stack pointer.
#![allow(unsafe_code)]

const SIZE: usize = 256 * 1024;
const PAINT: u8 = 0xa5;

#[repr(C, align(64))]
struct Stack([u8; SIZE]);

/// How many bytes of stack `work` writes to, its return address included.
///
/// Bytes that a function reserves but never writes do not count, below the last byte that it
/// writes.
pub(crate) fn used(work: extern "C" fn()) -> usize {
    let mut stack = Box::new(Stack([PAINT; SIZE]));
    let top = stack.0.as_mut_ptr_range().end;
    // SAFETY: the new stack is memory of ours that nothing else refers to meanwhile. It is aligned
    // as the ABI asks, and far larger than `work` needs, which the caller checks by the result.
    // `work` returns to the old stack, whose pointer is kept in a register that callees preserve,
    // and does not unwind (extern "C").
    unsafe {
        core::arch::asm!(
            "xchg rsp, r12",
            "call {work}",
            "mov rsp, r12",
            work = in(reg) work,
            inout("r12") top => _,
            clobber_abi("C"),
        );
    }
    let untouched = stack.0.iter().take_while(|&&byte| byte == PAINT).count();
    assert!(untouched > 0, "the stack was too small");
    SIZE - untouched
}
