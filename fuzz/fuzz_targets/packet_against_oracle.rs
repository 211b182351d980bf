//! Packets of every width and tier against one lane, the rules and the exact oracle.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spherule_fuzz::agreement;
use spherule_referee::bytes::AimedScene;

fuzz_target!(|scene: AimedScene| agreement::check(&scene));
