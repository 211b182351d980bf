//! Names that many spheres share: a table, and an index a sphere.

use std::collections::HashMap;

/// A name a sphere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    table: Vec<Box<str>>,
    indices: Vec<u32>,
}

impl Names {
    /// The names that occur, in the order in which they first do; the empty one stands for none.
    #[must_use]
    pub fn table(&self) -> &[Box<str>] {
        &self.table
    }

    /// An index into the table a sphere.
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
#[derive(Clone, Debug, Default)]
pub struct NamesBuilder {
    names: Names,
    known: HashMap<Box<[u8]>, u32>,
    /// The bytes of the last name: neighbours often share theirs.
    last: Vec<u8>,
}

impl NamesBuilder {
    /// Adds the name of the next sphere; what is no UTF-8 in it is replaced. Empty: it has none.
    pub fn push(&mut self, name: &[u8]) {
        let index = match self.names.indices.last() {
            Some(&index) if self.last == name => index,
            _ => self.index_of(name),
        };
        self.names.indices.push(index);
    }

    /// How many names there are, the empty one among them.
    #[must_use]
    pub fn known(&self) -> usize {
        self.names.table.len()
    }

    /// Brings the spheres into another order.
    pub(in super::super) fn permute(&mut self, permute: impl FnOnce(&mut Vec<u32>)) {
        permute(&mut self.names.indices);
    }

    fn index_of(&mut self, name: &[u8]) -> u32 {
        self.last.clear();
        self.last.extend_from_slice(name);
        if let Some(&index) = self.known.get(name) {
            return index;
        }
        // No more names than spheres, and of those no more than an index can tell.
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
    fn nothing_but_empty_names_is_none() {
        let mut builder = NamesBuilder::default();
        builder.push(b"");
        assert_eq!(builder.finish(), None);
    }
}
