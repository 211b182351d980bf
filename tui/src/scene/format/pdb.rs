//! PDB: columns of fixed width; a frame is a `MODEL`, or all that comes before `END`.
//!
//! Of alternate locations the first is drawn. Serial numbers are not read, so it does not matter that there are none for
//! more than 99,999 atoms; the numbers of residues may be in hybrid-36. AutoDock's PDBQT is read, too. Format: wwPDB,
//! "Atomic Coordinate Entry Format Description", version 3.3 (2012); hybrid-36: R. W. Grosse-Kunstleve,
//! <https://cci.lbl.gov/hybrid_36/>.

mod autodock;
mod symbol;

use super::Context;
use super::words::coordinate;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::fixed::Fixed;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::{Symbols, of_symbol};
use glam::DVec3;
use std::collections::HashSet;
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
            if !atoms.is_empty() {
                has_ended = true;
                input.give_back();
                break;
            }
        } else if (record.starts_with(b"ENDMDL") || record.trim_ascii_end() == b"END")
            && !atoms.is_empty()
        {
            has_ended = true;
            break;
        } else if let Some(name) = IGNORED.iter().find(|name| record.starts_with(name.as_bytes())) {
            context.notes.ignore(name);
        }
    }
    // What remains may be connections and no atom: then there is no further frame.
    if atoms.is_empty() {
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
    /// Chain, number and insertion of the residue of the last atom, ...
    residue: [u8; 6],
    /// ... and the names of those of its atoms that have locations.
    located: HashSet<[u8; 4]>,
    left_out: usize,
    /// The symbols that have been seen, and whether they are elements'.
    symbols: Vec<([u8; 2], bool)>,
    /// Whether names begin in the first column, whatever their elements, ...
    are_left: bool,
    /// ... and, until that is seen, the atoms whose element it would change, with their names and residues.
    undecided: Vec<(usize, [u8; 4], [u8; 4])>,
}

impl Atoms {
    fn new(fixed: Fixed) -> Self {
        let column = |name: &str| NumberColumn { name: name.into(), values: Vec::new() };
        let columns = vec![column("occupancy"), column("b_factor")];
        let particles = Particles { columns, ..Particles::from(fixed) };
        Self {
            particles,
            residue: [0; 6],
            located: HashSet::new(),
            left_out: 0,
            symbols: Vec::new(),
            are_left: false,
            undecided: Vec::new(),
        }
    }

    fn is_empty(&self) -> bool {
        self.particles.is_empty()
    }

    #[inline]
    fn add(&mut self, line: Line<'_>) -> Result<(), ReadError> {
        let bytes = line.bytes;
        let Some(fixed) = bytes.get(..54) else {
            return Err(line.error(bytes.len(), "the line ends before column 54: no coordinates"));
        };
        let residue = [fixed[21], fixed[22], fixed[23], fixed[24], fixed[25], fixed[26]];
        let name = [fixed[12], fixed[13], fixed[14], fixed[15]];
        if residue != self.residue {
            // A large set would take long to clear, however few names are in it.
            (self.residue, self.located) = (residue, HashSet::new());
        }
        if fixed[16] != b' ' && !self.located.insert(name) {
            self.left_out += 1;
            return Ok(());
        }
        let at = |from: usize, axis| {
            let word = fixed[from..from + 8].trim_ascii();
            coordinate(&line, from, word, axis)
        };
        let center = DVec3::new(at(30, "x")?, at(38, "y")?, at(46, "z")?);
        self.particles.center(center);
        let residue_field = [fixed[17], fixed[18], fixed[19], fixed[20]];
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
            _ => &fixed[21..22],
        };
        particles.naming(Naming::Chain).push(chain);
        particles
            .residue_numbers
            .push(residue_number([fixed[22], fixed[23], fixed[24], fixed[25]]));
        let field = |from: usize| {
            let word = bytes.get(from..bytes.len().min(from + 6)).unwrap_or_default().trim_ascii();
            number(word).map_or(f32::NAN, |value| value as f32)
        };
        particles.columns[0].values.push(field(54));
        particles.columns[1].values.push(field(60));
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

    fn finish(mut self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        if self.left_out > 0 {
            let atoms = if self.left_out == 1 { "atom is" } else { "atoms are" };
            notes.note(format!(
                "{} {atoms} left out: alternate locations after the first",
                self.left_out
            ));
        }
        self.particles.symbols = Symbols::Elements;
        self.particles.finish(notes, source)
    }
}

/// Whether a line is an atom of PQR: words between spaces, of which the last five are a position, a charge and a radius.
fn is_pqr(line: &Line<'_>) -> bool {
    let words = line.bytes.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let words: Vec<&[u8]> = words.take(12).collect();
    let is_finite = |word: &&[u8]| number(word).is_some_and(f64::is_finite);
    (10..=11).contains(&words.len()) && words.iter().rev().take(5).all(is_finite)
}

fn pqr(line: &Line<'_>) -> ReadError {
    line.error(0, "values between spaces, as in PQR, which is not read; PDB has columns")
}

/// The number of a residue: four digits, or hybrid-36 from 10,000 on; 0 where it is neither.
fn residue_number(field: [u8; 4]) -> i32 {
    let text = field.trim_ascii();
    if text.first().is_some_and(u8::is_ascii_alphabetic) && text.len() == 4 {
        let value =
            std::str::from_utf8(text).ok().and_then(|text| i32::from_str_radix(text, 36).ok());
        let Some(value) = value else { return 0 };
        let (digits, letters) = (10 * 36_i32.pow(3), 26 * 36_i32.pow(3));
        return if text[0].is_ascii_uppercase() {
            value - digits + 10_000
        } else {
            value - digits + letters + 10_000
        };
    }
    std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()).unwrap_or(0)
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
