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
use super::words::{Words, count, excerpt, half_diameter, single};
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
    let (count, first) = count_line(input)?;
    let comment = input.expect("its comment")?;
    if count == 0 {
        let what = "a molecule without atoms";
        return Err(ReadError::at(input.source(), first, 1, what).of_empty_frame());
    }
    let properties = properties(&comment)?;
    let mut particles = Particles::from(context.fixed);
    let ends = |input: &Input, atoms| {
        input.ends(format!(
            "the file ends after {atoms} of the {count} atoms that line {first} says"
        ))
    };
    match properties {
        Some(properties) => {
            particles.columns = columns(&properties);
            let ignored = properties.iter().filter(|property| property.is_ignored());
            let ignored: Vec<&str> = ignored.map(|property| &*property.name).collect();
            context.notes.ignored_columns(&ignored);
            let further = properties.iter().filter(|property| property.kind == Kind::Further);
            context.notes.further_columns(further.map(|property| property.properties).sum());
            for atoms in 0..count {
                let Some(line) = input.line()? else { return Err(ends(input, atoms)) };
                atom_of_properties(line, &properties, &mut particles)?;
            }
        }
        None => {
            let mut further = false;
            for atoms in 0..count {
                let Some(line) = input.line()? else { return Err(ends(input, atoms)) };
                further |= plain_atom(line, &mut particles)?;
            }
            if further {
                context
                    .notes
                    .note("columns behind x, y and z are ignored: no Properties say what they are");
            }
        }
    }
    if particles.kinds.known() == 0 {
        particles.symbols = Symbols::Numbers;
    }
    // Where a file grows, or in a pipe, this is left to whoever reads on: the next line may be long in coming, unless it has been read.
    if !context.follows && (input.can_be_read_again() || input.has_line()) {
        check_next(input, count, first)?;
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
    let (count, first) = count_line(input)?;
    for line in 0..=count {
        if input.line()?.is_none() {
            let atoms = line.saturating_sub(1);
            return Err(input.ends(format!(
                "the file ends after {atoms} of the {count} atoms that line {first} says"
            )));
        }
    }
    Ok(true)
}

/// What follows may be another frame, but not another atom.
fn check_next(input: &mut Input, count: usize, first: usize) -> Result<(), ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(());
    }
    let Some(line) = input.line()? else { return Ok(()) };
    if plain_atom(line, &mut Particles::default()).is_ok() {
        return Err(line.error(0, format!("one atom more than the {count} that line {first} says")));
    }
    input.give_back();
    Ok(())
}

fn count_line(input: &mut Input) -> Result<(usize, usize), ReadError> {
    if input.is_over()? {
        return Err(ReadError::whole(input.source(), "the file is empty").of_end());
    }
    let line = input.expect("a number of atoms")?;
    let text = line.trimmed();
    match count(text) {
        Some(count) => Ok((count, line.number)),
        None => Err(line.error(0, format!("{} is no number of atoms", excerpt(text)))),
    }
}

/// Whether there is more in the line than an atom.
#[inline]
fn plain_atom(line: Line<'_>, particles: &mut Particles) -> Result<bool, ReadError> {
    let mut words = Words::of(line);
    let (_, name) = words.expect("an element")?;
    particles.center(words.point()?);
    particles.kind(name, line.number);
    Ok(words.next().is_some())
}

/// The columns of numbers that are kept.
fn columns(properties: &[Property<'_>]) -> Vec<NumberColumn> {
    let kept = properties.iter().filter(|property| property.kind == Kind::Number);
    kept.map(|property| NumberColumn { name: (&*property.name).into(), values: Vec::new() })
        .collect()
}

fn atom_of_properties(
    line: Line<'_>,
    properties: &[Property<'_>],
    particles: &mut Particles,
) -> Result<(), ReadError> {
    let mut words = Words::of(line);
    let mut column = 0;
    for property in properties {
        match property.kind {
            Kind::Species => {
                let (_, name) = words.expect("an element")?;
                particles.kind(name, line.number);
            }
            Kind::Position => {
                let point = words.point()?;
                particles.center(point);
            }
            Kind::Radius => {
                let (byte, word) = words.expect(&property.name)?;
                let radius = single(&line, byte, word, &property.name, 1.0)?;
                if radius < 0.0 {
                    let what = format!("{} is {radius}: negative", property.name);
                    return Err(line.error(byte, what));
                }
                particles.radii.push(radius);
            }
            Kind::Diameter => {
                let (byte, word) = words.expect(&property.name)?;
                particles.radii.push(half_diameter(&line, byte, word, &property.name)?);
            }
            Kind::Color => {
                let mut channels = [0; 3];
                for channel in &mut channels {
                    let (byte, word) = words.expect("a colour")?;
                    let share = single(&line, byte, word, "a colour", 1.0)?;
                    *channel = property.channel(share);
                }
                particles.colors.push(Srgb(channels));
            }
            Kind::Name(naming) => {
                let (_, name) = words.expect(&property.name)?;
                particles.naming(naming).push(name);
            }
            Kind::Number => {
                let (byte, word) = words.expect(&property.name)?;
                let value = number(word).or_else(|| truth(word));
                let Some(value) = value else {
                    return Err(line.error(
                        byte,
                        format!("{} is {}: no number", property.name, excerpt(word)),
                    ));
                };
                particles.columns[column].values.push(value as f32);
                column += 1;
            }
            Kind::Other | Kind::Further => {
                for _ in 0..property.columns {
                    words.expect(&property.name)?;
                }
            }
        }
    }
    match words.next() {
        Some((byte, _)) => Err(line.error(byte, "more columns than Properties say")),
        None => Ok(()),
    }
}

fn truth(word: &[u8]) -> Option<f64> {
    let is = |letter: &[u8], name: &[u8]| {
        word.eq_ignore_ascii_case(letter) || word.eq_ignore_ascii_case(name)
    };
    if is(b"T", b"true") {
        Some(1.0)
    } else if is(b"F", b"false") {
        Some(0.0)
    } else {
        None
    }
}
