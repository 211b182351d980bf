//! The symbol of an atom for which no symbol is written, by its name.
//!
//! A name has its element right-justified in its first two columns: ` CA ` is carbon, `CA  ` calcium. CHARMM and others
//! begin most names in the first column: there `CA  ` may be carbon. Their files are told by a letter alone in the first
//! column. In the residues of proteins and nucleic acids there is no metal, so the first letter tells.

use crate::scene::elements::element;
use crate::scene::symbols::{of_atom_name, of_ion};

/// The residues of proteins, of other protonations too, and of nucleic acids: all of H, C, N, O, P and S.
pub(super) const OF_POLYMERS: [&[u8]; 47] = [
    b"ALA", b"ARG", b"ASN", b"ASP", b"CYS", b"GLN", b"GLU", b"GLY", b"HIS", b"ILE", b"LEU", b"LYS",
    b"MET", b"PHE", b"PRO", b"SER", b"THR", b"TRP", b"TYR", b"VAL", b"ASH", b"CYM", b"CYX", b"GLH",
    b"HID", b"HIE", b"HIP", b"HSD", b"HSE", b"HSP", b"LYN", b"A", b"C", b"G", b"I", b"U", b"DA",
    b"DC", b"DG", b"DI", b"DT", b"DU", b"ADE", b"CYT", b"GUA", b"THY", b"URA",
];

/// The residues whose sulfur is replaced by an atom `SE` of selenium.
const OF_SELENIUM: [&[u8]; 2] = [b"MSE", b"SEC"];

/// Whether a name stands where it would not if its element were right-justified.
pub(super) fn begins_left(name: &[u8; 4], residue: &[u8]) -> bool {
    matches!(name, b"C   " | b"N   " | b"O   " | b"P   ") && name.trim_ascii() != residue
}

/// The element in the name of an atom; `are_left`: names begin in the first column, whatever their elements. An atom with
/// the name of its residue is an ion, or a metal, wherever the name stands.
pub(super) fn symbol_of<'a>(name: &'a [u8; 4], residue: &[u8], are_left: bool) -> &'a [u8] {
    if name.trim_ascii() == residue
        && let Some(ion) = std::str::from_utf8(residue).ok().and_then(of_ion)
    {
        return ion.symbol.as_bytes();
    }
    if name.trim_ascii() == b"SE" && OF_SELENIUM.contains(&residue) {
        return b"SE";
    }
    let Some(first) = name.iter().position(u8::is_ascii_alphabetic) else { return b"" };
    let letter = &name[first..=first];
    if first > 0 || OF_POLYMERS.contains(&residue) {
        return letter;
    }
    if are_left {
        let found = std::str::from_utf8(name.trim_ascii()).ok().and_then(of_atom_name);
        return found.map_or(letter, |element| element.symbol.as_bytes());
    }
    let two = &name[..2];
    let is_element = std::str::from_utf8(two).ok().and_then(element).is_some();
    // Four letters begin a hydrogen's name in the first column.
    if name[0] == b'H' && !name.contains(&b' ') || !is_element { letter } else { two }
}
