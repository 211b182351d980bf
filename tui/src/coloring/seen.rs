//! What has been seen in the frames of a file, so that a colour means the same in all of them.

use super::scale::Range;
use crate::scene::attributes::{Naming, NumberColumn};
use std::collections::HashMap;

/// The names and numbers of the frames that have been coloured.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The names of each kind, with their places in the order in which they first occurred.
    names: [HashMap<Box<str>, usize>; Naming::ALL.len()],
    /// From the least to the largest number of each column, which is called by its name in small letters.
    ranges: HashMap<String, Range>,
}

impl Seen {
    /// The place of a name among those of its kind: it keeps that in all frames.
    pub(super) fn place(&mut self, naming: Naming, name: &str) -> usize {
        let names = &mut self.names[naming as usize];
        if let Some(&place) = names.get(name) {
            return place;
        }
        let place = names.len();
        names.insert(name.into(), place);
        place
    }

    /// From the least to the largest number of a column in this frame and all before it; from 0 to 1 if there are none.
    pub(super) fn range(&mut self, column: &NumberColumn) -> Range {
        let name = column.name.to_ascii_lowercase();
        let before = self.ranges.get(&name).copied();
        let range = match (before, Range::of(&column.values)) {
            (Some(before), Some(now)) => Some(before.widened(now)),
            (before, now) => before.or(now),
        };
        if let Some(range) = range {
            self.ranges.insert(name, range);
        }
        range.unwrap_or(Range { low: 0.0, high: 1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_places_among_those_of_their_kind() {
        let mut seen = Seen::default();
        let mut places = |naming, names: [&str; 3]| names.map(|name| seen.place(naming, name));
        assert_eq!(places(Naming::Type, ["1", "2", "3"]), [0, 1, 2]);
        assert_eq!(places(Naming::Type, ["3", "4", "2"]), [2, 3, 1]);
        assert_eq!(places(Naming::Molecule, ["7", "2", "7"]), [0, 1, 0]);
    }

    #[test]
    fn ranges_only_widen() {
        let mut seen = Seen::default();
        let mut range = |name: &str, values: &[f32]| {
            let Range { low, high } =
                seen.range(&NumberColumn { name: name.into(), values: values.to_vec() });
            [low, high]
        };
        // What no number says is no part of it.
        assert_eq!(range("q", &[f32::NAN]), [0.0, 1.0]);
        assert_eq!(range("q", &[3.0, 5.0]), [3.0, 5.0]);
        assert_eq!(range("Q", &[4.0]), [3.0, 5.0]);
        assert_eq!(range("q", &[-2.0, 4.0, f32::INFINITY]), [-2.0, 5.0]);
        assert_eq!(range("q", &[f32::NAN]), [-2.0, 5.0]);
        assert_eq!(range("mass", &[12.0]), [12.0, 12.0]);
    }
}
