//! What the tests of Spherule are made of. It is a library, so that tests, benches and fuzz targets judge by the same
//! answers. Cases, random numbers and proptest's strategies are those of `spherule-referee`.
//!
//! | room | holds |
//! |---|---|
//! | [`oracle`] | the exact answers, from big integers |
//! | [`variants`] | the one table of tiers, structures and layers of the door |
//! | [`tally`] | counts and errors of a tier's answers |
//! | [`scenes`] | scenes that are measured |
//! | [`orders`] | orders in which rays come |
//! | [`point`] | points in double precision |
//! | [`campaign`] | runs of many minutes |
//! | [`budget`] | the one table of what each tier gets wrong, and where |
//! | [`art`] | how near a picture in a terminal comes to the truth |
//! | [`binary`] | the program itself |
//! | [`vectors`] | the 100,000 hard cases that lie beside the workspace, if they do |
//!
//! `PROPTEST_CASES=100000 cargo test -p spherule-tests` searches longer for counterexamples.
//! `SPHERULE_VECTORS=<folder>` says where the vectors are, and makes their absence a failure. After a change of a tier,
//! pin the budget anew as [`budget`] says; after a change of a generator, write the kept cases anew as the head of
//! their file says.

#[cfg(feature = "art")]
pub mod art;
pub mod binary;
#[cfg(feature = "tally")]
pub mod budget;
pub mod campaign;
pub mod oracle;
pub mod orders;
pub mod point;
pub mod scenes;
#[cfg(feature = "tally")]
pub mod tally;
#[cfg(feature = "variants")]
pub mod variants;
#[cfg(feature = "tally")]
pub mod vectors;

pub use spherule_referee::random;

/// The README's Rust, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}
