//! What the fuzz target does, as a library, so that tests can run it without a fuzzer.
//!
//! | room | holds |
//! |---|---|
//! | [`agreement`] | every variant against one lane, and the rules of the contract on a tier's own answers |
//! | [`promise`] | a tier's roots against the exact ones, within what the tier promises |
//! | [`surfaces`], [`tiles`] | surfaces of hits; a camera made of the rays |

#![forbid(unsafe_code)]

pub mod agreement;
pub mod promise;
pub mod surfaces;
pub mod tiles;
