//! What the kernel costs, and what it gets wrong: beside plain code, Embree, and other crates.
//!
//! | command | does |
//! |---|---|
//! | `cargo bench --bench closest_hit` | criterion: the small scenes by brute force, every tier and lane width |
//! | `cargo bench --bench report` | prints tables: `-- tiers` speed against error, `-- structures` the large scenes, `-- cameras` the rays that a camera makes there, `-- surfaces` what is seen there, `-- orders` rays in every order, `-- calls` what a call costs, `-- scales` other units; or all |
//! | `cargo bench -p spherule-benches --features peers ...` | with other crates |
//! | `... --features embree ... -- --write` | with other crates and Embree (Debian: `libembree3-3`); and writes `docs/benchmarks`, where all else is committed |
//!
//! The tiers' speed is written for one build at a time: run once more `RUSTFLAGS="-C target-cpu=native" cargo bench -p spherule-benches
//! --bench report -- tiers --write`. The other pages are a plain build's, which has every level. `--scene NAME` runs one large scene
//! alone; with `orders`, `--order NAME` one order of rays, and `--rays N` calls of N rays. `--quick` takes a part of the rays; with
//! `--scene` it takes less than a minute. `--test` runs everything once. The variable `SPHERULE_EMBREE` names the libraries of Embree to open: paths with
//! colons between them.
//!
//! Data flows one way: [scenes](spherule_tests::scenes), [engines](engine), [the check before the clock](agreement),
//! [times](measure), [pages](page). Nothing is timed before its answers are checked.

#![cfg(feature = "measured")]
// Not forbidden, since the feature `embree` needs one foreign interface.
#![deny(unsafe_code)]
// Published nowhere: links may lead to what is private.
#![allow(rustdoc::private_intra_doc_links)]

mod agreement;
mod arguments;
mod builds;
mod calls;
mod cameras;
mod criterion_groups;
mod engine;
mod errors;
mod forms;
mod left_out;
mod lists;
mod measure;
mod orders;
mod page;
mod plot;
mod report;
mod rounds;
mod scales;
mod structures;
mod surfaces;

pub use criterion_groups::closest_hit;
pub use report::report;
