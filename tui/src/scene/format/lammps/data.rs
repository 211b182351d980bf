//! The input of LAMMPS: counts, a box, and sections, of which `Atoms` is read.
//!
//! The style, which is written behind `Atoms` as a comment, `Atoms # full`, says what its columns are. Without a style
//! their number tells: five are atomic, seven are full or sphere, six are charge or molecular, by whether the third is an
//! integer. Three more are images.

use super::super::stated::Stated;
use super::super::words::{Words, count, excerpt};
use super::dump::id;
use super::style::Style;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number_or_nan;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use glam::DVec3;

/// The error where nothing tells what columns are.
const NO_STYLE: &str = "columns of no known atom style: write it behind Atoms, as in Atoms # full";

/// Reads the atoms.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be, and if there is no section of atoms.
pub(in super::super) fn read(input: &mut Input, notes: &mut Notes) -> Result<Scene, ReadError> {
    let mut announced = None;
    let (style, unknown) = loop {
        let Some(line) = input.line()? else {
            return Err(ReadError::whole(input.source(), "no section Atoms"));
        };
        let mut parts = line.bytes.splitn(2, |&byte| byte == b'#');
        let text = parts.next().unwrap_or_default().trim_ascii();
        if text == b"Atoms" {
            let hint = parts.next().unwrap_or_default().trim_ascii();
            let style = Style::named(hint);
            let unknown = (style.is_none() && !hint.is_empty())
                .then(|| format!("the atom style {} is not known", excerpt(hint)));
            if let Some(unknown) = &unknown {
                notes.note(format!("{unknown}: columns are told by their number"));
            }
            break (style, unknown);
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
    let Some((count, line)) = announced.filter(|&(count, _)| count > 0) else {
        let what = "no number of atoms before the section Atoms";
        return Err(ReadError::whole(input.source(), what));
    };
    let stated = Stated { count, line, called: "atoms" };
    input.is_over_but_blanks()?;
    let mut particles = Particles { symbols: Symbols::Numbers, ..Particles::default() };
    let (mut ids, mut columns) = (Vec::new(), None);
    let mut charges = NumberColumn::named("charge");
    let mut atom = 0;
    while atom < stated.count {
        let line = stated.next(input, atom)?;
        if line.trimmed().starts_with(b"#") {
            continue;
        }
        let style = match columns {
            Some(style) => style,
            None => {
                let found = style.or_else(|| Style::of_columns(&line));
                let wrong = || {
                    let nor = |unknown: &String| format!("{unknown}, and its columns tell none");
                    line.error(0, unknown.as_ref().map_or_else(|| NO_STYLE.to_owned(), nor))
                };
                *columns.insert(found.ok_or_else(wrong)?)
            }
        };
        add(line, &style, &mut particles, &mut ids, &mut charges.values)?;
        atom += 1;
    }
    check_next(input, stated)?;
    particles.columns.push(charges);
    particles.sort_by(&ids);
    particles.finish(notes, input.source())
}

/// What follows may be a section, but not another atom.
fn check_next(input: &mut Input, stated: Stated) -> Result<(), ReadError> {
    while let Some(line) = input.line()? {
        match line.trimmed().first() {
            None | Some(b'#') => {}
            Some(byte) if byte.is_ascii_digit() => return Err(stated.one_more(&line)),
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
        let word = words.expect("a column")?;
        if column == 0 {
            ids.push(id(&word)?);
        } else if column >= style.position {
            let axis = column - style.position;
            position[axis] = word.coordinate(["x", "y", "z"][axis])?;
        } else if column == style.kind {
            particles.kind(word.bytes, line.number);
        } else if Some(column) == style.molecule {
            particles.naming(Naming::Molecule).push(word.bytes);
        } else if Some(column) == style.charge {
            charges.push(number_or_nan(word.bytes));
        } else if Some(column) == style.diameter {
            particles.radii.push(word.single("diameter", 0.5)?.abs());
        }
    }
    particles.center(DVec3::from_array(position));
    Ok(())
}
