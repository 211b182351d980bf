//! An empty library: `cargo test` compiles the kernel with its proofs, as the test `proofs`.
#![no_std]
