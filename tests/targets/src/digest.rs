//! A digest of every tier's answers, which must be the same everywhere.

mod fnv;
mod questions;

use crate::numbers::print_hexadecimal;
use crate::platform::print;
use questions::Asked;
use spherule_kernel::{Level, LevelName, Tier};

/// Prints the digests at every level that the CPU has, one line each: level, tier, question, and digest.
///
/// With `control`, one bit of one answer is changed.
#[must_use]
pub fn print_all(control: bool) -> bool {
    for name in LevelName::ALL {
        if let Some(level) = Level::named(name) {
            for tier in Tier::ALL {
                print_tier(level, tier, control && tier == Tier::Exact);
            }
        }
    }
    true
}

fn print_tier(level: Level, tier: Tier, control: bool) {
    let asked = Asked { level, tier };
    let answers = [
        ("pairs", asked.pairs(control)),
        ("roots", asked.roots()),
        ("lists", asked.lists()),
        ("structures", asked.structures()),
        ("pictures", asked.pictures()),
    ];
    for (question, digest) in answers {
        for word in [level.name().as_str(), tier.as_str(), question] {
            print(word.as_bytes());
            print(b" ");
        }
        print_hexadecimal(digest);
        print(b"\n");
    }
}
