//! A digest of every tier's answers, which must be the same everywhere.

mod fnv;
mod questions;
mod surfaces;

use crate::numbers::print_hexadecimal;
use crate::platform::print;
pub use fnv::Fnv;
use questions::Asked;
use spherule_kernel::{Level, LevelName, Tier};

/// Prints the digests at every level that the CPU has, one line each: level, tier, question, and digest. Returns whether rays hit in every
/// question, which they do not where a structure cannot be built.
///
/// With `control`, one bit of an answer of `Exact` to each question is changed.
#[must_use]
pub fn print_all(control: bool) -> bool {
    let mut all_hit = true;
    for name in LevelName::ALL {
        if let Some(level) = Level::named(name) {
            for tier in Tier::ALL {
                let control = control && tier == Tier::Exact;
                all_hit &= print_tier(&Asked { level, tier, control });
            }
        }
    }
    all_hit
}

fn print_tier(asked: &Asked) -> bool {
    let answers = [
        ("pairs", asked.pairs()),
        ("roots", asked.roots()),
        ("lists", asked.lists()),
        ("structures", asked.structures()),
        ("pictures", asked.pictures()),
        ("surfaces", asked.surfaces()),
    ];
    let mut all_hit = true;
    for (question, Fnv { digest, hits, .. }) in answers {
        all_hit &= hits > 0;
        for word in [asked.level.name().as_str(), asked.tier.as_str(), question] {
            print(word.as_bytes());
            print(b" ");
        }
        print_hexadecimal(digest);
        print(b"\n");
    }
    all_hit
}
