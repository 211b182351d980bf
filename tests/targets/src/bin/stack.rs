//! Prints the stack that `Exact`'s fallbacks use on x86-64, and fails if that is more than their documentation says.

#[cfg(target_arch = "x86_64")]
#[path = "stack/fallback.rs"]
mod fallback;
#[cfg(target_arch = "x86_64")]
#[path = "stack/painted.rs"]
mod painted;

fn main() {
    #[cfg(target_arch = "x86_64")]
    fallback::measure();
}
