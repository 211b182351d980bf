//! XYZ and extended XYZ: the number of atoms, a comment, and a line an atom; frame after frame.
//!
//! ```text
//! 3
//! water
//! O  0.000  0.000  0.119
//! H  0.000  0.763 -0.477
//! 1  0.000 -0.763 -0.477   further columns are ignored
//! ```
//!
//! A comment with `Properties=species:S:1:pos:R:3:radius:R:1` says what the columns are, as ASE, OVITO and QUIP write
//! it: then positions are taken from `pos` alone, radii from `radius` or `diameter`, colours from `color`, numbers from the
//! first 64 other columns of one number. Memory grows with the atoms that are there, not with the number that the first line claims.
//! The format names no lights, so they go with the eye.

mod properties;

use super::Context;
use super::stated::Stated;
use super::words::{Words, excerpt};
use crate::color::Srgb;
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::{Input, Line};
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use properties::{Kind, Property, properties};

/// Reads the next frame.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be: no number of atoms, none or
/// fewer atoms than it says, a coordinate that is missing, no number, or not a finite `f32`.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    if input.place() != Default::default() && input.is_over_but_blanks()? {
        return Ok(None);
    }
    let stated = count_line(input)?;
    let comment = input.expect("its comment")?;
    if stated.count == 0 {
        return Err(stated.none(input.source(), "a molecule without atoms"));
    }
    let properties = properties(&comment)?;
    let mut particles = Particles::from(context.fixed);
    match properties {
        Some(properties) => {
            let kept = properties.iter().filter(|property| property.kind == Kind::Number);
            particles.columns = kept.map(|property| NumberColumn::named(&*property.name)).collect();
            let ignored = properties.iter().filter(|property| property.kind == Kind::Other);
            let ignored: Vec<&str> = ignored.map(|property| &*property.name).collect();
            context.notes.ignored_columns(&ignored);
            let further = properties.iter().filter(|property| property.kind == Kind::Further);
            context.notes.further_columns(further.map(|property| property.properties).sum());
            for atom in 0..stated.count {
                let line = stated.next(input, atom)?;
                atom_of_properties(line, &properties, &mut particles)?;
            }
        }
        None => {
            let mut further = false;
            for atom in 0..stated.count {
                further |= plain_atom(stated.next(input, atom)?, &mut particles)?;
            }
            if further {
                let what = "columns behind x, y and z are ignored: no Properties say what they are";
                context.notes.note(what);
            }
        }
    }
    if particles.kinds.known() == 0 {
        particles.symbols = Symbols::Numbers;
    }
    // Where a file grows, or in a pipe, this is left to whoever reads on: the next line may be long in coming, unless it has been read.
    if !context.follows && (input.can_be_read_again() || input.has_line()) {
        check_next(input, stated)?;
    }
    particles.finish(&mut context.notes, input.source()).map(Some)
}

/// Leaves out a frame.
///
/// # Errors
/// [`ReadError`] if it is no valid frame.
pub(super) fn skip(input: &mut Input) -> Result<bool, ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(false);
    }
    let stated = count_line(input)?;
    // The comment is a line, too.
    stated.next(input, 0)?;
    stated.skip(input)?;
    Ok(true)
}

/// What follows may be another frame, but not another atom.
fn check_next(input: &mut Input, stated: Stated) -> Result<(), ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(());
    }
    let Some(line) = input.line()? else { return Ok(()) };
    if plain_atom(line, &mut Particles::default()).is_ok() {
        return Err(stated.one_more(&line));
    }
    input.give_back();
    Ok(())
}

fn count_line(input: &mut Input) -> Result<Stated, ReadError> {
    if input.is_over()? {
        return Err(ReadError::whole(input.source(), "the file is empty").of_end());
    }
    Stated::atoms(&input.expect("a number of atoms")?)
}

/// Whether there is more in the line than an atom.
#[inline]
fn plain_atom(line: Line<'_>, particles: &mut Particles) -> Result<bool, ReadError> {
    let mut words = Words::of(line);
    let name = words.expect("an element")?;
    particles.center(words.point()?);
    particles.kind(name.bytes, line.number);
    Ok(words.next().is_some())
}

fn atom_of_properties(
    line: Line<'_>,
    properties: &[Property<'_>],
    particles: &mut Particles,
) -> Result<(), ReadError> {
    let mut words = Words::of(line);
    let mut column = 0;
    for property in properties {
        let name = &*property.name;
        match property.kind {
            Kind::Species => {
                particles.kind(words.expect("an element")?.bytes, line.number);
            }
            Kind::Position => particles.center(words.point()?),
            Kind::Radius => particles.radii.push(words.expect(name)?.radius(name)?),
            Kind::Diameter => particles.radii.push(words.expect(name)?.half_diameter(name)?),
            Kind::Color => {
                let mut channels = [0; 3];
                for channel in &mut channels {
                    let share = words.expect("a colour")?.single("a colour", 1.0)?;
                    *channel = property.channel(share);
                }
                particles.colors.push(Srgb(channels));
            }
            Kind::Name(naming) => particles.naming(naming).push(words.expect(name)?.bytes),
            Kind::Number => {
                let word = words.expect(name)?;
                let value = truth(word.bytes).or_else(|| number(word.bytes)).ok_or_else(|| {
                    let value = excerpt(word.bytes);
                    word.error(format!("{name} is {value}, which is neither a number nor T or F"))
                })?;
                particles.columns[column].values.push(value as f32);
                column += 1;
            }
            Kind::Other | Kind::Further => {
                for _ in 0..property.columns {
                    words.expect(name)?;
                }
            }
        }
    }
    match words.next() {
        Some(word) => Err(word.error("more columns than Properties say")),
        None => Ok(()),
    }
}

fn truth(word: &[u8]) -> Option<f64> {
    let is = |names: [&str; 2]| names.iter().any(|name| word.eq_ignore_ascii_case(name.as_bytes()));
    if is(["t", "true"]) { Some(1.0) } else { is(["f", "false"]).then_some(0.0) }
}
