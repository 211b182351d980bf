//! MercuryDPM's `.data`: a line with the number of particles, the time and the box, and a line a particle; frame after frame.
//!
//! The box has its least coordinates and its largest, so its values tell whether there are two dimensions or three. A particle has its
//! position, velocity, radius, orientation, angular velocity, and a number that the simulation chooses, such as that of its species.
//! (MercuryDPM's documentation, "Understanding the output files", and its own reader.)

use super::Context;
use super::stated::Stated;
use super::words::{Words, count, excerpt};
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::Input;
use crate::scene::number::number_or_nan;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;

/// The values of a particle in two dimensions, as the program xballs calls them, ...
const PLANE: &[&str] = &["x", "y", "vx", "vy", "r", "phi", "omega", "xi"];
/// ... and in three.
const SPACE: &[&str] =
    &["x", "y", "z", "vx", "vy", "vz", "r", "qx", "qy", "qz", "omex", "omey", "omez", "xi"];

/// Reads the next frame.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let Some((stated, dimensions)) = head(input)? else { return Ok(None) };
    if stated.count == 0 {
        return Err(stated.none(input.source(), "a frame without particles"));
    }
    let names = if dimensions == 2 { PLANE } else { SPACE };
    // Behind the position and the velocity.
    let radius = 2 * dimensions;
    let is_number = |place: usize| place >= dimensions && place != radius;
    let mut particles = Particles::from(context.fixed);
    let numbers = names.iter().enumerate().filter(|(place, _)| is_number(*place));
    particles.columns = numbers.map(|(_, name)| NumberColumn::named(*name)).collect();
    let mut further = false;
    for particle in 0..stated.count {
        let mut words = Words::of(stated.next(input, particle)?);
        let (mut center, mut column) = (DVec3::ZERO, 0);
        for (place, name) in names.iter().enumerate() {
            let word = words.expect(name)?;
            if place < dimensions {
                center[place] = word.coordinate(name)?;
            } else if place == radius {
                particles.radii.push(word.radius("the radius")?);
            } else {
                particles.columns[column].values.push(number_or_nan(word.bytes));
                column += 1;
            }
        }
        further |= words.next().is_some();
        particles.center(center);
    }
    if further {
        context.notes.note("values behind xi are ignored");
    }
    particles.finish(&mut context.notes, input.source()).map(Some)
}

/// Leaves out a frame.
///
/// # Errors
/// [`ReadError`] if it is no valid frame.
pub(super) fn skip(input: &mut Input) -> Result<bool, ReadError> {
    let Some((stated, _)) = head(input)? else { return Ok(false) };
    stated.skip(input)?;
    Ok(true)
}

/// Reads the first line of a frame: how many particles there are, and how many dimensions. `None` after the last frame.
fn head(input: &mut Input) -> Result<Option<(Stated, usize)>, ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(None);
    }
    let line = input.expect("the number of particles")?;
    let mut words = Words::of(line);
    let word = words.expect("the number of particles")?;
    let Some(count) = count(word.bytes) else {
        return Err(word.error(format!("{} is not a number of particles", excerpt(word.bytes))));
    };
    let dimensions = match 1 + words.count() {
        6 => 2,
        8 => 3,
        values => {
            let what = "a number of particles, a time and a box are 6 or 8";
            return Err(line.error(0, format!("{values} values; {what}")));
        }
    };
    Ok(Some((Stated { count, line: line.number, called: "particles" }, dimensions)))
}
