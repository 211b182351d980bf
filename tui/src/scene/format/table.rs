//! Tables: a line a particle, columns between commas, tabs, semicolons or spaces, with a header or without.
//!
//! A header names `x`, `y`, `z`, and perhaps `radius`, `r`, `g`, `b` or `red`, `green`, `blue`, and `element` or
//! `type`; other columns of numbers can be chosen for colours. A unit in brackets may follow a name, as in `x (mm)`.
//! Without a header the first three columns are positions, and a fourth is the radius. `--columns` chooses others, by
//! names or by numbers from 1. Lines that begin with `#` are passed over, except that the first may be the header.

mod columns;
mod separator;

use super::Context;
use super::words::coordinate;
use crate::color::Srgb;
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::{Input, Line};
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;
use std::ops::Range;

pub(super) use columns::has_axes;
use columns::{Columns, is_header};
pub(super) use separator::Separator;

/// Reads the table.
///
/// # Errors
/// [`ReadError`] at the first line without a number where one should be, and if there is no line.
pub(super) fn read(input: &mut Input, context: &mut Context) -> Result<Scene, ReadError> {
    let chosen = context.columns.clone();
    let (separator, columns, is_header) = loop {
        let Some(line) = input.line()? else {
            return Err(ReadError::whole(input.source(), "no line with numbers"));
        };
        let text = line.trimmed();
        if text.is_empty() {
            continue;
        }
        let is_comment = text[0] == b'#';
        let names = if is_comment { text[1..].trim_ascii() } else { line.bytes };
        let separator = Separator::of(names);
        let mut fields = Vec::new();
        separator.split(names, usize::MAX, &mut fields);
        let names: Vec<&[u8]> = fields.iter().map(|field| &names[field.clone()]).collect();
        let is_header = is_header(&names, chosen.as_deref());
        if is_comment && !(is_header && has_axes(&names)) {
            continue;
        }
        let columns = Columns::new(&line, &names, is_header, chosen.as_deref())?;
        break (separator, columns, is_header);
    };
    if !is_header {
        input.give_back();
    }
    context.notes.further_columns(columns.further);
    let kept = columns.kept.iter();
    let kept = kept.map(|(_, name)| NumberColumn { name: name.clone(), values: Vec::new() });
    let mut particles = Particles { columns: kept.collect(), ..Particles::default() };
    let (mut fields, mut scale) = (Vec::new(), ColorScale::default());
    let mut raw = Vec::new();
    while let Some(line) = input.line()? {
        if line.trimmed().first().is_none_or(|&first| first == b'#') {
            continue;
        }
        separator.split(line.bytes, columns.most, &mut fields);
        add(&line, &fields, &columns, &mut particles, &mut raw, &mut scale)?;
    }
    if particles.is_empty() {
        return Err(ReadError::whole(input.source(), "no line with numbers"));
    }
    particles.colors = raw.iter().map(|channels| scale.color(*channels)).collect();
    particles.finish(&mut context.notes, input.source())
}

/// Colours go from 0 to 1, unless one is larger: then they go to 255.
#[derive(Clone, Copy, Debug, Default)]
struct ColorScale {
    most: f32,
}

impl ColorScale {
    fn color(self, channels: [f32; 3]) -> Srgb {
        let scale = if self.most > 1.0 { 1.0 } else { 255.0 };
        Srgb(channels.map(|channel| (scale * channel).round().clamp(0.0, 255.0) as u8))
    }
}

fn add(
    line: &Line<'_>,
    fields: &[Range<usize>],
    columns: &Columns,
    particles: &mut Particles,
    raw: &mut Vec<[f32; 3]>,
    scale: &mut ColorScale,
) -> Result<(), ReadError> {
    let number_in = |column: usize, name: &str| {
        let Some(field) = fields.get(column) else {
            let what = format!("{name} is missing: {} columns, not {}", fields.len(), column + 1);
            return Err(line.error(line.bytes.len(), what));
        };
        coordinate(line, field.start, &line.bytes[field.clone()], name)
    };
    let value = |column, name| number_in(column, name).map(|value| value as f32);
    let [x, y, z] = columns.position;
    particles.center(DVec3::new(number_in(x, "x")?, number_in(y, "y")?, number_in(z, "z")?));
    if let Some(column) = columns.radius {
        let radius = value(column, "the radius")?;
        if radius < 0.0 {
            return Err(line.error(fields[column].start, format!("radius is {radius}: negative")));
        }
        particles.radii.push(radius);
    }
    if let Some([red, green, blue]) = columns.color {
        let channels = [value(red, "red")?, value(green, "green")?, value(blue, "blue")?];
        scale.most = channels.iter().copied().fold(scale.most, f32::max);
        raw.push(channels);
    }
    let text =
        |column: usize| fields.get(column).map_or(&b""[..], |field| &line.bytes[field.clone()]);
    if let Some(column) = columns.kind {
        particles.kind(text(column), line.number);
    }
    for ((column, _), kept) in columns.kept.iter().zip(&mut particles.columns) {
        kept.values.push(number(text(*column)).map_or(f32::NAN, |value| value as f32));
    }
    Ok(())
}
