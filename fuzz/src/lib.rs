//! What the fuzz target does, as a library, so that tests can run it without a fuzzer.
//!
//! | room | holds |
//! |---|---|
//! | [`agreement`] | every variant against one lane, and the rules of the contract on a tier's own answers |
//! | [`pairs`], [`objects`] | rays and spheres two by two; sphere after sphere |
//! | [`promise`] | a tier's roots against the exact ones, within what the tier promises |
//! | [`surfaces`], [`tiles`] | surfaces of hits, and rays spawned there; a camera made of the rays |

#![forbid(unsafe_code)]

pub mod agreement;
pub mod objects;
pub mod pairs;
pub mod promise;
pub mod surfaces;
pub mod tiles;
