//! All tests that cross crates, in one binary, so that their shared code is compiled and linked
//! once.
#![forbid(unsafe_code)]

mod accuracy;
mod agreement;
mod art;
mod degenerate;
mod door;
mod exact;
mod generators;
mod golden;
mod kept;
mod lists;
mod metamorphic;
mod numbers;
mod objects;
mod oracle;
mod order;
mod orders;
mod own_lanes;
mod packets;
#[cfg(target_os = "linux")]
mod pty;
mod scenes;
mod spawn_ray;
mod structures;
mod surface;
mod truth;
