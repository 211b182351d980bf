//! What the benchmarks share: workloads, the check before the clock, probes of the machine, and
//! the way in which times are taken.
//!
//! | target | prints |
//! |---|---|
//! | `nearest` | criterion: tier x lane width x spheres x kind of rays |
//! | `peers` | criterion: the same rays through other people's code |
//! | `limit` | a table: the share of the machine's arithmetic that brute force reaches |
//! | `report` | tables and a plot: speed against error for every tier; see [`report`] |
//! | `structures` | tables and a plot: scene structures and other programs, scene by scene; see [`mod@structures`] |
//!
//! Nothing is timed before its answers are checked: [`check`].

// Not forbidden, for one file: a foreign interface behind the feature `embree`.
#![deny(unsafe_code)]

pub mod check;
#[cfg(feature = "embree")]
pub mod embree;
pub mod probe;
pub mod random;
pub mod report;
pub mod rounds;
pub mod scenes;
pub mod settings;
pub mod structures;
pub mod workload;
