//! PDB: columns of fixed width; a frame is a `MODEL`, or all that comes before `END`.
//!
//! Of alternate locations the first is drawn. Serial numbers are not read, so it does not matter that there are none for
//! more than 99,999 atoms; the numbers of residues may be in hybrid-36. AutoDock's PDBQT is read, too. Format: wwPDB,
//! "Atomic Coordinate Entry Format Description", version 3.3 (2012); hybrid-36: R. W. Grosse-Kunstleve,
//! <https://cci.lbl.gov/hybrid_36/>.

mod autodock;
mod chains;
mod symbol;

use super::Context;
use super::locations::Locations;
use super::words::{Word, split};
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::fixed::Fixed;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::{number, number_or_nan, parsed};
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::of_symbol;
use chains::Chains;
use glam::DVec3;
use symbol::{begins_left, symbol_of};

/// The records that say what a picture of spheres does not show.
const IGNORED: [&str; 6] = ["ANISOU", "CONECT", "HELIX", "SHEET", "SSBOND", "SIGATM"];

/// Reads the next model.
///
/// # Errors
/// [`ReadError`] at the first atom without coordinates, and if there is no atom in the file.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let is_first = input.place() == Default::default();
    let mut atoms = Atoms::new(context.fixed);
    let mut has_ended = false;
    while let Some(line) = input.line()? {
        let record = line.bytes;
        if record.starts_with(b"ATOM") || record.starts_with(b"HETATM") {
            atoms.add(line).map_err(|error| if is_pqr(&line) { pqr(&line) } else { error })?;
        } else if record.starts_with(b"MODEL") {
            if !atoms.particles.is_empty() {
                has_ended = true;
                input.give_back();
                break;
            }
        } else if (record.starts_with(b"ENDMDL") || record.trim_ascii_end() == b"END")
            && !atoms.particles.is_empty()
        {
            has_ended = true;
            break;
        } else if let Some(name) = IGNORED.iter().find(|name| record.starts_with(name.as_bytes())) {
            context.notes.ignore(name);
        }
    }
    // What remains may be connections and no atom: then there is no further frame.
    if atoms.particles.is_empty() {
        return if is_first {
            Err(ReadError::whole(input.source(), "no ATOM and no HETATM").of_end())
        } else {
            Ok(None)
        };
    }
    // More of the model may be on its way.
    if context.follows && !has_ended {
        return Err(input.ends("the file ends within a model"));
    }
    atoms.finish(&mut context.notes, input.source()).map(Some)
}

/// The atoms of a model.
struct Atoms {
    particles: Particles,
    locations: Locations,
    chains: Chains,
    /// The symbols that have been seen, and whether they are elements'.
    symbols: Vec<([u8; 2], bool)>,
    /// Whether names begin in the first column, whatever their elements, ...
    are_left: bool,
    /// ... and, until that is seen, the atoms whose element it would change, with their names and residues.
    undecided: Vec<(usize, [u8; 4], [u8; 4])>,
}

impl Atoms {
    fn new(fixed: Fixed) -> Self {
        let columns = ["occupancy", "b_factor"].map(NumberColumn::named).into();
        let particles = Particles { columns, ..Particles::from(fixed) };
        Self {
            particles,
            locations: Locations::default(),
            chains: Chains::default(),
            symbols: Vec::new(),
            are_left: false,
            undecided: Vec::new(),
        }
    }

    #[inline]
    fn add(&mut self, line: Line<'_>) -> Result<(), ReadError> {
        let bytes = line.bytes;
        let Some(fixed) = bytes.get(..54) else {
            return Err(line.error(bytes.len(), "the line ends before column 54: no coordinates"));
        };
        let name = [fixed[12], fixed[13], fixed[14], fixed[15]];
        // Chain, number and insertion tell a residue.
        let chain = self.chains.start(fixed);
        self.locations.enter(&fixed[chain..27]);
        if fixed[16] != b' ' && !self.locations.is_first(&name) {
            return Ok(());
        }
        let at = |byte: usize, axis| {
            Word { line, byte, bytes: fixed[byte..byte + 8].trim_ascii() }.coordinate(axis)
        };
        let center = DVec3::new(at(30, "x")?, at(38, "y")?, at(46, "z")?);
        self.particles.center(center);
        let last = if chain == 21 { fixed[20] } else { b' ' };
        let residue_field = [fixed[17], fixed[18], fixed[19], last];
        let residue_name = residue_field.trim_ascii();
        let symbol = [76, 77].map(|column: usize| bytes.get(column).copied().unwrap_or(b' '));
        let kind = autodock::type_of(bytes);
        if let Some(kind) = kind {
            self.particles.kind(autodock::symbol_of(kind), line.number);
        } else if self.is_symbol(symbol) {
            self.particles.kind(symbol.trim_ascii(), line.number);
        } else {
            self.kind_of_name(&name, &residue_field, line.number);
        }
        let particles = &mut self.particles;
        particles.naming(Naming::Name).push(name.trim_ascii());
        particles.naming(Naming::Residue).push(residue_name);
        let chain: &[u8] = match fixed[21] {
            b' ' if kind.is_some() => b"",
            b' ' => bytes.get(72..bytes.len().min(76)).unwrap_or_default().trim_ascii(),
            _ => &fixed[chain..22],
        };
        particles.naming(Naming::Chain).push(chain);
        particles.residue_numbers.push(residue_number(fixed[22..26].trim_ascii()));
        for (column, from) in particles.columns.iter_mut().zip([54, 60]) {
            let field = bytes.get(from..bytes.len().min(from + 6)).unwrap_or_default();
            column.values.push(number_or_nan(field.trim_ascii()));
        }
        Ok(())
    }

    /// Whether an element is written there, and no type of a force field.
    #[inline]
    fn is_symbol(&mut self, columns: [u8; 2]) -> bool {
        let text = columns.trim_ascii();
        // Files of old have numbers of lines there.
        if !text.first().is_some_and(u8::is_ascii_alphabetic) {
            return false;
        }
        if let Some((_, is_symbol)) = self.symbols.iter().find(|(seen, _)| *seen == columns) {
            return *is_symbol;
        }
        let is_symbol = std::str::from_utf8(text).is_ok_and(|text| of_symbol(text).is_some());
        self.symbols.push((columns, is_symbol));
        is_symbol
    }

    /// Adds what the name of the next atom tells of its element.
    fn kind_of_name(&mut self, name: &[u8; 4], residue_field: &[u8; 4], line: usize) {
        let residue = residue_field.trim_ascii();
        if !self.are_left && begins_left(name, residue) {
            self.are_left = true;
            for (atom, name, residue) in std::mem::take(&mut self.undecided) {
                let symbol = symbol_of(&name, residue.trim_ascii(), true);
                self.particles.rename_kind(atom, symbol, line);
            }
        }
        let symbol = symbol_of(name, residue, self.are_left);
        // A name that begins further on is the same to both.
        let is_undecided = !self.are_left && name[0].is_ascii_alphabetic();
        if is_undecided && !symbol.eq_ignore_ascii_case(symbol_of(name, residue, true)) {
            self.undecided.push((self.particles.residue_numbers.len(), *name, *residue_field));
        }
        self.particles.kind(symbol, line);
    }

    fn finish(self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        self.locations.note(notes);
        self.particles.finish(notes, source)
    }
}

/// Whether a line is an atom of PQR: words between spaces, of which the last five are a position, a charge and a radius.
fn is_pqr(line: &Line<'_>) -> bool {
    let words: Vec<&[u8]> = split(line.bytes).take(12).collect();
    let is_finite = |word: &&[u8]| number(word).is_some_and(f64::is_finite);
    (10..=11).contains(&words.len()) && words.iter().rev().take(5).all(is_finite)
}

fn pqr(line: &Line<'_>) -> ReadError {
    line.error(0, "values between spaces, as in PQR, which is not read; PDB has columns")
}

/// The number of a residue: four digits, or hybrid-36 from 10,000 on; 0 where it is neither.
fn residue_number(text: &[u8]) -> i32 {
    if text.len() < 4 || !text[0].is_ascii_alphabetic() {
        return parsed(text).unwrap_or(0);
    }
    let value = std::str::from_utf8(text).ok().and_then(|text| i32::from_str_radix(text, 36).ok());
    // Capitals are behind all digits, and small letters behind all capitals.
    let letters = if text[0].is_ascii_uppercase() { 0 } else { 26 };
    value.map_or(0, |value| value + (letters - 10) * 36_i32.pow(3) + 10_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_whose_element_no_other_atom_changes_are_decided() {
        let mut atoms = Atoms::new(Fixed::default());
        for (name, undecided) in [(b"AU  ", 0), (b" CA ", 0), (b"NE  ", 1)] {
            atoms.kind_of_name(name, b"LIG ", 1);
            assert_eq!(atoms.undecided.len(), undecided, "{name:?}");
        }
    }
}
