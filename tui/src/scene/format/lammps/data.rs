//! The input of LAMMPS: counts, a box, and sections, of which `Atoms` is read.
//!
//! The style, which is written behind `Atoms` as a comment, `Atoms # full`, says what its columns are. Without a style
//! their number tells: five are atomic, seven are full, six are charge or molecular, by whether the third is an
//! integer. Three more are images.

use super::super::words::{Words, coordinate, count, single};
use super::dump::id;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use glam::DVec3;

/// Which column is what; the first is the id.
#[derive(Clone, Copy, Debug)]
struct Style {
    kind: usize,
    molecule: Option<usize>,
    charge: Option<usize>,
    diameter: Option<usize>,
    position: usize,
}

impl Style {
    const ATOMIC: Self =
        Self { kind: 1, molecule: None, charge: None, diameter: None, position: 2 };
    const CHARGE: Self = Self { charge: Some(2), position: 3, ..Self::ATOMIC };
    const MOLECULAR: Self = Self { kind: 2, molecule: Some(1), position: 3, ..Self::ATOMIC };
    const FULL: Self = Self { charge: Some(3), position: 4, ..Self::MOLECULAR };
    const SPHERE: Self = Self { diameter: Some(2), position: 4, ..Self::ATOMIC };

    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"atomic" => Self::ATOMIC,
            b"charge" => Self::CHARGE,
            b"angle" | b"bond" | b"molecular" => Self::MOLECULAR,
            b"full" => Self::FULL,
            b"sphere" => Self::SPHERE,
            _ => return None,
        })
    }

    fn of_columns(line: &Line<'_>) -> Option<Self> {
        let text = line.bytes.split(|&byte| byte == b'#').next().unwrap_or_default();
        let words: Vec<&[u8]> =
            text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
        let is_integer =
            |word: &[u8]| std::str::from_utf8(word).is_ok_and(|text| text.parse::<i64>().is_ok());
        let images =
            words.len() >= 8 && words[words.len() - 3..].iter().all(|word| is_integer(word));
        match words.len() - if images { 3 } else { 0 } {
            5 => Some(Self::ATOMIC),
            6 if is_integer(words[2]) => Some(Self::MOLECULAR),
            6 => Some(Self::CHARGE),
            7 => Some(Self::FULL),
            _ => None,
        }
    }
}

/// Reads the atoms.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be, and if there is no section of atoms.
pub(in super::super) fn read(input: &mut Input, notes: &mut Notes) -> Result<Scene, ReadError> {
    let mut announced = None;
    let style = loop {
        let Some(line) = input.line()? else {
            return Err(ReadError::whole(input.source(), "no section Atoms"));
        };
        let mut parts = line.bytes.splitn(2, |&byte| byte == b'#');
        let text = parts.next().unwrap_or_default().trim_ascii();
        if text == b"Atoms" {
            let hint = parts.next().unwrap_or_default().trim_ascii();
            let style = Style::named(hint);
            if style.is_none() && !hint.is_empty() {
                let hint = String::from_utf8_lossy(hint).into_owned();
                notes.note(format!(
                    "the atom style {hint:?} is not known: columns are told by their number"
                ));
            }
            break style;
        }
        if let Some(number) = text.strip_suffix(b"atoms") {
            announced = count(number.trim_ascii()).map(|count| (count, line.number));
        }
        for record in ["bonds", "angles", "dihedrals", "impropers"] {
            let number = text.strip_suffix(record.as_bytes()).map(<[u8]>::trim_ascii);
            if number.and_then(count).is_some_and(|count| count > 0) {
                notes.ignore(record);
            }
        }
    };
    let Some((atoms, first)) = announced.filter(|&(atoms, _)| atoms > 0) else {
        return Err(ReadError::whole(
            input.source(),
            "no number of atoms before the section Atoms",
        ));
    };
    input.is_over_but_blanks()?;
    let mut particles = Particles { symbols: Symbols::Numbers, ..Particles::default() };
    let (mut ids, mut columns) = (Vec::new(), None);
    let mut charges = NumberColumn { name: "charge".into(), values: Vec::new() };
    for atom in 0..atoms {
        let ends =
            || format!("the file ends after {atom} of the {atoms} atoms that line {first} says");
        let Some(line) = input.line()? else { return Err(input.ends(ends())) };
        let style = match columns {
            Some(style) => style,
            None => {
                let found = style.or_else(|| Style::of_columns(&line));
                let unknown = || {
                    line.error(
                        0,
                        "columns of no known atom style: write it behind Atoms, as in Atoms # full",
                    )
                };
                *columns.insert(found.ok_or_else(unknown)?)
            }
        };
        add(line, &style, &mut particles, &mut ids, &mut charges.values)?;
    }
    check_next(input, atoms, first)?;
    particles.columns.push(charges);
    particles.sort_by(&ids);
    particles.finish(notes, input.source())
}

/// What follows may be a section, but not another atom.
fn check_next(input: &mut Input, atoms: usize, first: usize) -> Result<(), ReadError> {
    while let Some(line) = input.line()? {
        match line.trimmed().first() {
            None | Some(b'#') => {}
            Some(byte) if byte.is_ascii_digit() => {
                let what = format!("one atom more than the {atoms} that line {first} says");
                return Err(line.error(0, what));
            }
            Some(_) => break,
        }
    }
    Ok(())
}

fn add(
    line: Line<'_>,
    style: &Style,
    particles: &mut Particles,
    ids: &mut Vec<i64>,
    charges: &mut Vec<f32>,
) -> Result<(), ReadError> {
    let mut words = Words::of(line);
    let mut position = [0.0; 3];
    for column in 0..style.position + 3 {
        let (byte, word) = words.expect("a column")?;
        if column == 0 {
            ids.push(id(&line, byte, word)?);
        } else if column >= style.position {
            let axis = column - style.position;
            position[axis] = coordinate(&line, byte, word, ["x", "y", "z"][axis])?;
        } else if column == style.kind {
            particles.kind(word, line.number);
        } else if Some(column) == style.molecule {
            particles.naming(Naming::Molecule).push(word);
        } else if Some(column) == style.charge {
            charges.push(number(word).map_or(f32::NAN, |value| value as f32));
        } else if Some(column) == style.diameter {
            particles.radii.push(single(&line, byte, word, "diameter", 0.5)?.abs());
        }
    }
    particles.center(DVec3::from_array(position));
    Ok(())
}
