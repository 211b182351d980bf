//! Packets of every width and tier against one lane, the rules and the exact oracle.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spherule_fuzz::{agreement, geometry::Scene};

fuzz_target!(|bytes: &[u8]| agreement::check(&Scene::from_bytes(bytes)));
