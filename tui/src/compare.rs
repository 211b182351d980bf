//! Tiers held against each other in one picture.

pub mod error_map;
pub mod legend;
mod marks;
pub mod split;
pub mod verdict;

use spherule_kernel::{Tier, UnknownName};

/// What a picture shows in place of the scene as one tier sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// What the tier gets wrong, cell by cell.
    Errors,
    /// Two tiers side by side.
    Split([Tier; 2]),
}

impl Comparison {
    /// The comparison of this name: `error`, or `split:` and two tiers.
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        if text == "error" {
            return Some(Self::Errors);
        }
        let (left, right) = text.strip_prefix("split:")?.split_once(',')?;
        Some(Self::Split([tier(left).ok()?, tier(right).ok()?]))
    }
}

/// The lecture's name for the form that [`Tier::Fast`] computes.
pub(crate) const ALGEBRAIC: &str = "algebraic";

/// The tier of this name on the command line.
pub(crate) fn tier(name: &str) -> Result<Tier, UnknownName> {
    if name == ALGEBRAIC { Ok(Tier::Fast) } else { name.parse() }
}

/// A number with a comma before every three digits.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_in_threes() {
        for (number, text) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (65_536, "65,536"),
            (1 << 32, "4,294,967,296"),
        ] {
            assert_eq!(grouped(number), text);
        }
    }
}
