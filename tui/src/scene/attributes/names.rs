//! Names that many spheres share: a table, and an index a sphere.

use std::collections::HashMap;

/// A name a sphere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    table: Vec<Box<str>>,
    indices: Vec<u32>,
}

impl Names {
    /// The names that occur, in the order of their first occurrence; the empty name stands for
    /// none.
    #[must_use]
    pub fn table(&self) -> &[Box<str>] {
        &self.table
    }

    /// An index into the table for every sphere.
    #[must_use]
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The name of sphere `index`; `None` if it has none, or there is no such sphere.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&str> {
        let name = self.table.get(*self.indices.get(index)? as usize)?;
        (!name.is_empty()).then_some(name)
    }
}

/// Names, as a file is read.
#[derive(Clone, Debug)]
pub struct NamesBuilder {
    names: Names,
    known: HashMap<Box<[u8]>, u32>,
    /// Recent short names, and their indices: most names are short, and few.
    recent: [(u64, u32); RECENT],
}

/// How many short names are kept at hand.
const RECENT: usize = 64;

impl Default for NamesBuilder {
    fn default() -> Self {
        let (names, known) = (Names::default(), HashMap::new());
        Self { names, known, recent: [(u64::MAX, 0); RECENT] }
    }
}

/// The bytes of a name and its length in a word, if it is short.
fn word(name: &[u8]) -> Option<u64> {
    let mut bytes = [0; 8];
    bytes.get_mut(..name.len())?.copy_from_slice(name);
    bytes[7] = if name.len() < 8 { name.len() as u8 } else { return None };
    Some(u64::from_le_bytes(bytes))
}

impl NamesBuilder {
    /// Adds the name of the next sphere; bytes that are no UTF-8 are replaced. An empty name means
    /// that the sphere has none.
    pub fn push(&mut self, name: &[u8]) {
        let index = match word(name) {
            None => self.index_of(name),
            Some(word) => {
                // The high bits of a product depend on all bits of the factor.
                let place = (word.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 58) as usize;
                match self.recent[place] {
                    (recent, index) if recent == word => index,
                    _ => {
                        let index = self.index_of(name);
                        self.recent[place] = (word, index);
                        index
                    }
                }
            }
        };
        self.names.indices.push(index);
    }

    /// Gives sphere `index`, which has been added, another name.
    pub(in super::super) fn rename(&mut self, index: usize, name: &[u8]) {
        let name = self.index_of(name);
        self.names.indices[index] = name;
    }

    /// How many names there are, the empty one among them.
    #[must_use]
    pub fn known(&self) -> usize {
        self.names.table.len()
    }

    /// Brings the spheres into another order, and the table into that of its names' first occurrence then. Returns where
    /// the names stood in the table before.
    pub(in super::super) fn permute(&mut self, permute: impl FnOnce(&mut Vec<u32>)) -> Vec<u32> {
        let Names { table, indices } = &mut self.names;
        permute(indices);
        let (mut places, mut former) = (vec![None; table.len()], Vec::new());
        for index in indices {
            let before = *index;
            *index = *places[before as usize].get_or_insert_with(|| {
                former.push(before);
                former.len() as u32 - 1
            });
        }
        *table = former.iter().map(|&before| std::mem::take(&mut table[before as usize])).collect();
        for place in self.known.values_mut() {
            *place = places[*place as usize].unwrap_or_default();
        }
        self.recent = [(u64::MAX, 0); RECENT];
        former
    }

    fn index_of(&mut self, name: &[u8]) -> u32 {
        if let Some(&index) = self.known.get(name) {
            return index;
        }
        // There are no more names than spheres, and no more spheres than an index can number.
        let index = self.names.table.len() as u32;
        self.names.table.push(String::from_utf8_lossy(name).into());
        self.known.insert(name.into(), index);
        index
    }

    /// The names; `None` if no sphere has one.
    #[must_use]
    pub fn finish(self) -> Option<Names> {
        self.names.table.iter().any(|name| !name.is_empty()).then_some(self.names)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stands_once() {
        let mut builder = NamesBuilder::default();
        for name in ["A", "B", "B", "A", "", "\u{e9}"] {
            builder.push(name.as_bytes());
        }
        builder.push(b"\xff");
        let names = builder.finish().expect("names");
        assert_eq!(names.indices(), [0, 1, 1, 0, 2, 3, 4]);
        assert_eq!(names.table().len(), 5);
        assert_eq!((names.get(3), names.get(4), names.get(7)), (Some("A"), None, None));
        assert_eq!(names.get(6), Some("\u{fffd}"));
    }

    #[test]
    fn long_and_short_names_are_told_apart() {
        let mut builder = NamesBuilder::default();
        let all: Vec<String> =
            (0..1000).map(|index| "x".repeat(index % 20) + &index.to_string()).collect();
        for name in all.iter().chain(&all) {
            builder.push(name.as_bytes());
        }
        let names = builder.finish().expect("names");
        assert_eq!(names.table().len(), 1000);
        assert!(
            all.iter().chain(&all).enumerate().all(|(index, name)| names.get(index) == Some(name))
        );
    }

    #[test]
    fn the_table_follows_the_order_of_the_spheres() {
        let mut builder = NamesBuilder::default();
        for name in ["B", "", "A", "a long name", "B"] {
            builder.push(name.as_bytes());
        }
        assert_eq!(builder.permute(|indices| indices.swap(0, 2)), [2, 1, 0, 3]);
        for name in ["", "B", "a long name", "C"] {
            builder.push(name.as_bytes());
        }
        let names = builder.finish().expect("names");
        assert_eq!(names.indices(), [0, 1, 2, 3, 2, 1, 2, 3, 4]);
        let table: Vec<&str> = names.table().iter().map(|name| &**name).collect();
        assert_eq!(table, ["A", "", "B", "a long name", "C"]);
    }

    #[test]
    fn nothing_but_empty_names_is_none() {
        let mut builder = NamesBuilder::default();
        builder.push(b"");
        assert_eq!(builder.finish(), None);
    }
}
