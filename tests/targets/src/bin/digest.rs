//! Prints the digests of this target, and fails if rays hit nothing in a question. An argument, on targets that have arguments, changes one
//! bit of an answer of `Exact` to each question.

#![cfg_attr(target_os = "none", no_std, no_main)]

use spherule_targets::{digest, start};

#[cfg(not(any(target_os = "none", target_arch = "wasm32")))]
fn run() -> bool {
    digest::print_all(std::env::args().len() > 1)
}

#[cfg(any(target_os = "none", target_arch = "wasm32"))]
fn run() -> bool {
    digest::print_all(false)
}

start!(run);
