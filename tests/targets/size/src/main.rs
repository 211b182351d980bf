//! Draws the lecture's picture in one way, and prints its cost: bytes of stack, and instructions a ray.
//!
//! The program's name, `size-<tier>-<way>`, says the way, so that nothing else is linked.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod many;
#[cfg(all(target_arch = "arm", target_os = "none"))]
mod painted_stack;
#[cfg(target_os = "none")]
mod ways;

#[cfg(target_os = "none")]
fn run() -> bool {
    use spherule_targets::{numbers, platform, scene};

    let measured = painted_stack::measure(ways::draw);
    numbers::print_decimal(measured.stack);
    platform::print(b" ");
    // A tick is 40 instructions: the timer runs at 25 MHz, and an instruction takes a nanosecond.
    numbers::print_decimal(measured.ticks * 40 / (scene::WIDTH * scene::HEIGHT));
    platform::print(b" ");
    numbers::print_decimal(ways::drawn());
    platform::print(b"\n");
    true
}

#[cfg(not(target_os = "none"))]
fn run() -> bool {
    false
}

spherule_targets::start!(run);
