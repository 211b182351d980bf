//! What the tests of Spherule are made of: a library, so that tests, benches and fuzz targets
//! judge by the same answers.
//!
//! | room | holds |
//! |---|---|
//! | [`oracle`] | the exact answers, from big integers |
//! | [`ulp`] | distance in ulp, and the tally of a tier's answers |
//! | [`case`] | one ray and one sphere, printed so that no bit is hidden |
//! | [`random`] | random numbers that never change |
//! | [`aim`] | rays aimed at spheres |
//! | [`regimes`] | cases of the 22 hard regimes |
//! | [`inputs`] | what proptest draws |
//! | [`kept`] | some of them with their answers, in a file |
//! | [`measured`] | cases of the regimes in which error is measured |
//! | [`budget`] | the one table of what each tier gets wrong, and where |
//! | [`doors`] | every tier in every lane width, as plain functions |
//! | [`vectors`] | the 100,000 hard cases that lie beside the workspace, where they do |

pub mod aim;
pub mod budget;
pub mod case;
pub mod doors;
pub mod inputs;
pub mod kept;
pub mod measured;
pub mod oracle;
pub mod random;
pub mod regimes;
pub mod ulp;
pub mod vectors;
