//! GROMACS's `.gro`: a title, the number of atoms, a line of fixed width an atom, and the box; frame after frame.
//!
//! Lengths are in nanometres there, and in angstrom in a scene, as radii are. The distance between decimal points tells
//! how wide a number is (GROMACS reference manual, "gro file format").

use super::Context;
use super::stated::Stated;
use super::words::{Word, Words, count, excerpt};
use crate::scene::Scene;
use crate::scene::attributes::Naming;
use crate::scene::input::{Input, Line};
use crate::scene::number::{number, parsed};
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use spherule_kernel::Vec3;

/// Angstrom a nanometre.
pub(super) const ANGSTROM: f32 = 10.0;

/// Where coordinates begin.
const COORDINATES: usize = 20;

/// Reads the next frame.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let before = input.place();
    if input.is_over_but_blanks()? && input.place() != Default::default() {
        // What is blank may be the title of a frame that is still being written.
        if input.can_be_read_again() {
            input.go(before)?;
        }
        return Ok(None);
    }
    let has_blanks = input.place() != before;
    let title = input.expect("a title")?;
    // Where the number of atoms follows blank lines, the last of them is the title.
    if has_blanks && count(title.trimmed()).is_some() {
        input.give_back();
    }
    let stated = Stated::atoms(&input.expect("a number of atoms")?)?;
    let mut particles = Particles { symbols: Symbols::AtomNames, ..Particles::from(context.fixed) };
    let (mut width, mut velocities) = (0, false);
    for atom in 0..stated.count {
        let line = stated.next(input, atom)?;
        if atom == 0 {
            width = width_of(&line)?;
        }
        let end = COORDINATES + 3 * width;
        let Some(fixed) = line.bytes.get(..end) else {
            return Err(line.error(line.bytes.len(), format!("the line ends before column {end}")));
        };
        let at = |axis: usize, name| {
            let byte = COORDINATES + axis * width;
            let bytes = fixed[byte..byte + width].trim_ascii();
            Word { line, byte, bytes }.single(name, ANGSTROM)
        };
        let center = Vec3::new(at(0, "x")?, at(1, "y")?, at(2, "z")?);
        particles.center(center.as_dvec3());
        let (residue, name) = (fixed[5..10].trim_ascii(), fixed[10..15].trim_ascii());
        particles.kind(name, line.number);
        particles.naming(Naming::Name).push(name);
        particles.naming(Naming::Residue).push(residue);
        particles.residue_numbers.push(parsed(fixed[..5].trim_ascii()).unwrap_or(0));
        velocities |= !line.bytes[end..].trim_ascii().is_empty();
    }
    check_box(input.expect("the box")?, stated)?;
    if stated.count == 0 {
        return Err(stated.none(input.source(), "no atoms"));
    }
    if velocities {
        context.notes.note("velocities are ignored");
    }
    particles.finish(&mut context.notes, input.source()).map(Some)
}

/// The box may be blank, wide numbers may touch, and words may follow three numbers; but it is no further atom.
fn check_box(line: Line<'_>, stated: Stated) -> Result<(), ReadError> {
    let mut words = Words::of(line);
    for _ in 0..3 {
        let Some(word) = words.next() else { break };
        if number(word.bytes).is_none() && word.bytes.iter().any(u8::is_ascii_alphabetic) {
            let Stated { count, line, .. } = stated;
            return Err(word.error(format!(
                "{} in the box is not a number; the number of atoms in line {line} is {count}",
                excerpt(word.bytes)
            )));
        }
    }
    Ok(())
}

/// The distance from decimal point to decimal point.
fn width_of(line: &Line<'_>) -> Result<usize, ReadError> {
    let rest = line.bytes.get(COORDINATES..).unwrap_or_default();
    let mut points = rest.iter().enumerate().filter(|(_, byte)| **byte == b'.').map(|(at, _)| at);
    match (points.next(), points.next(), points.next()) {
        (Some(one), Some(two), Some(three)) if three - two == two - one && two - one < 32 => {
            Ok(two - one)
        }
        _ => Err(line.error(COORDINATES, "the line does not have three coordinates of one width")),
    }
}
