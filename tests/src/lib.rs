//! What the tests of Spherule are made of: a library, so that tests, benches and fuzz targets
//! judge by the same answers.
//!
//! | room | holds |
//! |---|---|
//! | [`oracle`] | the exact answers, from big integers |
//! | [`variants`] | the one table of tiers, structures and layers of the door |
//! | [`ulp`] | steps between neighbouring numbers |
//! | [`tally`] | what a tier's answers come to |
//! | [`case`] | one ray and one sphere, printed so that no bit is hidden |
//! | [`random`] | random numbers that never change |
//! | [`aim`] | rays aimed at spheres |
//! | [`regimes`] | cases of the 22 hard regimes |
//! | [`scenes`] | scenes that are measured |
//! | [`orders`] | orders in which rays come |
//! | [`inputs`] | what proptest draws |
//! | [`kept`] | some of the regimes' cases with their answers, in a file |
//! | [`measured`] | cases of the regimes in which error is measured |
//! | [`campaign`] | runs of many minutes |
//! | [`budget`] | the one table of what each tier gets wrong, and where |
//! | [`art`] | how near a picture in a terminal comes to the truth |
//! | [`binary`] | the program itself |
//! | [`vectors`] | the 100,000 hard cases that lie beside the workspace, if they do |
//!
//! `PROPTEST_CASES=100000 cargo test -p spherule-tests` looks longer for counterexamples;
//! `SPHERULE_VECTORS=<folder>` says where the vectors are, and makes their absence a failure.
//! After a change of a tier the budget is pinned anew as [`budget`] says; after a change of a
//! generator the kept cases are written anew as the head of their file says.

pub mod aim;
#[cfg(feature = "art")]
pub mod art;
pub mod binary;
#[cfg(feature = "tally")]
pub mod budget;
pub mod campaign;
pub mod case;
#[cfg(feature = "inputs")]
pub mod inputs;
pub mod kept;
pub mod measured;
pub mod oracle;
pub mod orders;
pub mod random;
pub mod regimes;
pub mod scenes;
#[cfg(feature = "tally")]
pub mod tally;
pub mod ulp;
pub mod variants;
#[cfg(feature = "tally")]
pub mod vectors;

/// The README's Rust, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}
