//! PDBQT, the PDB of AutoDock: behind a charge stands the type of an atom, by which its forces are computed.
//!
//! Most types are symbols, in any case. Others begin with a symbol, and say besides how an atom binds hydrogen: `NA` is nitrogen that
//! accepts it, and sodium is `Na` alone. (AutoDock 4.2's user guide; its `AD4_parameters.dat`; `atom_constants.h` of AutoDock Vina.)

use crate::scene::number::number;

/// The type of an atom, if the line is one of PDBQT: its charge has a point in column 73. There PDB has nothing, or the name of a
/// segment.
pub(super) fn type_of(line: &[u8]) -> Option<&[u8]> {
    let charge = line.get(70..76)?;
    let kind = line.get(77..line.len().min(80))?.trim_ascii();
    let is_type = charge[2] == b'.' && number(charge.trim_ascii()).is_some() && !kind.is_empty();
    is_type.then_some(kind)
}

/// The symbol of a type's element; the type itself if it is a symbol, or not known.
pub(super) fn symbol_of(kind: &[u8]) -> &[u8] {
    match kind {
        // Aromatic, and where rings are closed or a covalent bond is. What ring closures attract, G0 to G3, is no atom.
        b"A" | b"G" | b"GA" | b"J" | b"Q" | b"Z" | b"CG0" | b"CG1" | b"CG2" | b"CG3" => b"C",
        b"HD" | b"HS" => b"H",
        b"NA" | b"NS" => b"N",
        // Water is one atom.
        b"OA" | b"OS" | b"W" => b"O",
        b"SA" => b"S",
        _ => kind,
    }
}
