//! What the tests of Spherule are made of: a library, so that tests, benches and fuzz targets
//! judge by the same answers.
//!
//! | room | holds |
//! |---|---|
//! | [`oracle`] | the exact answers, from big integers |
//! | [`case`] | one ray and one sphere, printed so that no bit is hidden |
//! | [`vectors`] | the 100,000 hard cases that lie beside the workspace, where they do |

pub mod case;
pub mod oracle;
pub mod vectors;
