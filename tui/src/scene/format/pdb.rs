//! PDB: columns of fixed width; a frame is a `MODEL`, or all that comes before `END`.
//!
//! Of alternate locations the first is drawn. Serial numbers are not read, so it does not matter that there are none for
//! more than 99,999 atoms; the numbers of residues may be in hybrid-36. Format: wwPDB, "Atomic Coordinate Entry Format
//! Description", version 3.3 (2012); hybrid-36: R. W. Grosse-Kunstleve, <https://cci.lbl.gov/hybrid_36/>.

use super::Context;
use super::words::coordinate;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::elements::element;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::{Symbols, of_ion};
use glam::DVec3;
use std::collections::HashSet;

/// The records that say what a picture of spheres does not show.
const IGNORED: [&str; 6] = ["ANISOU", "CONECT", "HELIX", "SHEET", "SSBOND", "SIGATM"];

/// Reads the next model.
///
/// # Errors
/// [`ReadError`] at the first atom without coordinates, and if there is no atom in the file.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let is_first = input.place() == Default::default();
    let mut atoms = Atoms::new(context.origin);
    let mut has_ended = false;
    while let Some(line) = input.line()? {
        let record = line.bytes;
        if record.starts_with(b"ATOM") || record.starts_with(b"HETATM") {
            atoms.add(line)?;
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
}

impl Atoms {
    fn new(origin: Option<DVec3>) -> Self {
        let column = |name: &str| NumberColumn { name: name.into(), values: Vec::new() };
        let columns = vec![column("occupancy"), column("b_factor")];
        let particles = Particles { columns, ..Particles::from(origin) };
        Self { particles, residue: [0; 6], located: HashSet::new(), left_out: 0 }
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
        let particles = &mut self.particles;
        particles.center(center);
        let symbol = bytes.get(76..bytes.len().min(78)).unwrap_or_default().trim_ascii();
        let residue_name = fixed[17..21].trim_ascii();
        if symbol.first().is_some_and(u8::is_ascii_alphabetic) {
            particles.kind(symbol, line.number);
        } else {
            particles.kind(symbol_of(&name, residue_name), line.number);
        }
        particles.naming(Naming::Name).push(name.trim_ascii());
        particles.naming(Naming::Residue).push(residue_name);
        let chain = match fixed[21] {
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

/// The element in the name of an atom: it is right-justified in the first two columns. An atom with the name of its
/// residue is an ion, or a metal, wherever the name stands.
fn symbol_of<'a>(name: &'a [u8; 4], residue: &[u8]) -> &'a [u8] {
    if name.trim_ascii() == residue
        && let Some(ion) = std::str::from_utf8(residue).ok().and_then(of_ion)
    {
        return ion.symbol.as_bytes();
    }
    let two = &name[..2];
    if two[0].is_ascii_alphabetic() {
        let is_element = std::str::from_utf8(two).ok().and_then(element).is_some();
        // Four letters begin a hydrogen's name in the first column.
        return if name[0] == b'H' && !name.contains(&b' ') || !is_element {
            &name[..1]
        } else {
            two
        };
    }
    let first = name.iter().position(u8::is_ascii_alphabetic);
    first.map_or(b"", |first| &name[first..=first])
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
