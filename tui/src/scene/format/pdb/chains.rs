//! Where in a record the name of a residue ends and that of its chain begins.
//!
//! A residue has columns 18 to 20, a chain column 22. What is between them is taken by names of either that are longer: of
//! residues in GROMACS and CHARMM, of chains where there are more than 62.

use super::symbol::OF_POLYMERS;

/// Four letters that begin as a shorter name.
const LONGER: [&[u8]; 15] = [
    b"ALAD", b"ARGN", b"ASPH", b"CYS1", b"CYS2", b"CYSH", b"GLUH", b"HIS1", b"HIS2", b"HISA",
    b"HISB", b"HISD", b"HISE", b"HISH", b"LYSH",
];

/// How long the names of chains are.
#[derive(Debug, Default)]
pub(super) struct Chains {
    /// Whether one of two letters has been seen behind a residue that is known: then one may stand behind any.
    are_long: bool,
}

impl Chains {
    /// The byte of a record at which the name of the chain begins.
    #[inline]
    pub(super) fn start(&mut self, record: &[u8]) -> usize {
        if record[20] == b' ' || record[21] == b' ' {
            return 21;
        }
        let residue = &record[17..20];
        let is_known = residue == b"HOH"
            || residue[2] != b' ' && OF_POLYMERS.contains(&residue.trim_ascii_start());
        self.are_long |= is_known && !LONGER.contains(&&record[17..21]);
        if self.are_long { 20 } else { 21 }
    }
}
