//! What the programs share that run on every target, most of them without an operating system.

#![cfg_attr(target_os = "none", no_std)]

pub mod cases;
pub mod digest;
pub mod numbers;
pub mod platform;
pub mod scene;
