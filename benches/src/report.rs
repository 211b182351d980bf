//! Speed against error: what the benchmark `report` measures, judges and prints.
//!
//! | room | holds |
//! |---|---|
//! | [`contender`] | the one list of what is compared: every tier in every lane width |
//! | [`mod@reference`] | two forms that are no tier: the lecture's with unit directions, and plain `f64` |
//! | [`error`] | wrong decisions and ulp of t, regime by regime, against the integer oracle |
//! | [`speed`] | nanoseconds a ray-sphere test, workload by workload |
//! | [`target`] | the ratios that were asked for, met or missed |
//! | [`dominance`] | which tier nobody needs |
//! | [`machine`] | CPU, compiler, flags, commit and date |
//! | [`page`] | all that as Markdown |
//! | [`plot`] | all that as a picture |

pub mod contender;
pub mod dominance;
pub mod error;
pub mod machine;
pub mod page;
pub mod plot;
pub mod reference;
pub mod speed;
pub mod target;
