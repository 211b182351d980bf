//! What the benchmarks share: workloads, the check before the clock, probes of the machine, and
//! the way in which times are taken.
//!
//! | target | prints |
//! |---|---|
//! | `nearest` | criterion: tier x lane width x spheres x kind of rays |
//! | `peers` | criterion: the same rays through other people's code |
//! | `limit` | a table: the share of the machine's arithmetic that brute force reaches |
//! | `report` | tables and a plot: speed against error for every tier; see [`report`] |
//!
//! Nothing is timed before its answers are checked: [`check`].

#![forbid(unsafe_code)]

pub mod check;
pub mod probe;
pub mod random;
pub mod report;
pub mod rounds;
pub mod settings;
pub mod workload;
