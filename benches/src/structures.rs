//! Scene structures against each other and against other programs: what the benchmark `structures`
//! measures, judges and prints.
//!
//! | room | holds |
//! |---|---|
//! | [`contender`] | who takes part: ways through a scene, tiers, levels, peers |
//! | [`ours`] | the kernel's brute force and walks, by tier and level |
//! | [`peer`] | what another tree must offer, and the one sphere test of all of them |
//! | [`agreement`] | the checks before the clock |
//! | [`measure`] | a scene's times |

pub mod agreement;
pub mod contender;
pub mod measure;
pub mod ours;
pub mod peer;
