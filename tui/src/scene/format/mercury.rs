//! MercuryDPM's `.data`: a line with the number of particles, the time and the box, and a line a particle; frame after frame.
//!
//! The box has its least coordinates and its largest, so its values tell whether there are two dimensions or three. A particle has its
//! position, velocity, radius, orientation, angular velocity, and a number that the simulation chooses, such as that of its species.
//! (MercuryDPM's documentation, "Understanding the output files", and its own reader.)

use super::Context;
use super::words::{Words, coordinate, count, excerpt, single};
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::Input;
use crate::scene::number::number;
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
    let Some(head) = head(input)? else { return Ok(None) };
    if head.particles == 0 {
        let what = "a frame without particles";
        return Err(ReadError::at(input.source(), head.line, 1, what).of_empty_frame());
    }
    let dimensions = head.dimensions;
    let names = if dimensions == 2 { PLANE } else { SPACE };
    // Behind the position and the velocity.
    let radius = 2 * dimensions;
    let is_number = |place: usize| place >= dimensions && place != radius;
    let mut particles = Particles::from(context.fixed);
    let numbers = names.iter().enumerate().filter(|(place, _)| is_number(*place));
    particles.columns = numbers
        .map(|(_, name)| NumberColumn { name: (*name).into(), values: Vec::new() })
        .collect();
    let mut further = false;
    for particle in 0..head.particles {
        let Some(line) = input.line()? else { return Err(input.ends(head.ends(particle))) };
        let (mut words, mut center, mut column) = (Words::of(line), DVec3::ZERO, 0);
        for (place, name) in names.iter().enumerate() {
            let (byte, word) = words.expect(name)?;
            if place < dimensions {
                center[place] = coordinate(&line, byte, word, name)?;
            } else if place == radius {
                let radius = single(&line, byte, word, "the radius", 1.0)?;
                if radius < 0.0 {
                    return Err(line.error(byte, format!("the radius is {radius}: negative")));
                }
                particles.radii.push(radius);
            } else {
                let value = number(word).map_or(f32::NAN, |value| value as f32);
                particles.columns[column].values.push(value);
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
    let Some(head) = head(input)? else { return Ok(false) };
    for particle in 0..head.particles {
        if input.line()?.is_none() {
            return Err(input.ends(head.ends(particle)));
        }
    }
    Ok(true)
}

/// What the first line of a frame says.
struct Head {
    particles: usize,
    dimensions: usize,
    line: usize,
}

impl Head {
    /// That the file ends after so many of the particles.
    fn ends(&self, after: usize) -> String {
        let Self { particles, line, .. } = self;
        format!("the file ends after {after} of the {particles} particles that line {line} says")
    }
}

/// Reads the first line of a frame; `None` after the last frame.
fn head(input: &mut Input) -> Result<Option<Head>, ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(None);
    }
    let line = input.expect("the number of particles")?;
    let mut words = Words::of(line);
    let (byte, word) = words.expect("the number of particles")?;
    let Some(particles) = count(word) else {
        return Err(line.error(byte, format!("{} is no number of particles", excerpt(word))));
    };
    let mut values = 1;
    while words.next().is_some() {
        values += 1;
    }
    let dimensions = match values {
        6 => 2,
        8 => 3,
        _ => {
            let what = "a number of particles, a time and a box are 6 or 8";
            return Err(line.error(0, format!("{values} values; {what}")));
        }
    };
    Ok(Some(Head { particles, dimensions, line: line.number }))
}
