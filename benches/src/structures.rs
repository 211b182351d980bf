//! Scene structures against each other and against other programs: what the benchmark `structures`
//! measures, judges and prints.
//!
//! | room | holds |
//! |---|---|
//! | [`contender`] | who takes part: ways through a scene, tiers, levels, peers |
//! | [`ours`] | the kernel's brute force and walks, by tier and level |
//! | [`peer`] | what another tree must offer, and the one sphere test of all of them |
//! | [`agreement`] | the checks before the clock |
//! | [`measure`] | a scene, checked and timed; [`measured`] what comes of it |
//! | [`mod@build`] | times of builds, bytes of ours |
//! | [`growth`] | the same for more and more spheres |
//! | [`threads`] | two threads against one |
//! | [`target`] | what was asked for |
//! | [`page`] | all that as Markdown |
//! | [`plot`] | the growth as a picture |
//!
//! Embree itself is in `embree.rs`, behind the feature of that name.

pub mod agreement;
pub mod build;
pub mod contender;
pub mod growth;
pub mod measure;
pub mod measured;
pub mod ours;
pub mod page;
pub mod peer;
pub mod plot;
mod race;
pub mod target;
pub mod threads;
