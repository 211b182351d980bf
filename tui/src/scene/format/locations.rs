//! Alternate locations of atoms, of which the first is drawn.

use crate::scene::notes::Notes;
use std::collections::HashSet;

/// The atoms of a residue that have locations.
#[derive(Debug, Default)]
pub(super) struct Locations {
    residue: Vec<u8>,
    names: HashSet<Box<[u8]>>,
    left_out: usize,
}

impl Locations {
    /// Goes to a residue, which may be the same.
    #[inline]
    pub(super) fn enter(&mut self, residue: &[u8]) {
        if self.residue != residue {
            self.residue.clear();
            self.residue.extend_from_slice(residue);
            // A large set would take long to clear, however few names are in it.
            self.names = HashSet::new();
        }
    }

    /// Whether an atom of the residue has no location before; others are left out.
    pub(super) fn is_first(&mut self, name: &[u8]) -> bool {
        let is_first = self.names.insert(name.into());
        self.left_out += usize::from(!is_first);
        is_first
    }

    /// Notes how many atoms are left out.
    pub(super) fn note(&self, notes: &mut Notes) {
        let atoms = match self.left_out {
            0 => return,
            1 => "atom is",
            _ => "atoms are",
        };
        let what = "left out: alternate locations after the first";
        notes.note(format!("{} {atoms} {what}", self.left_out));
    }
}
