//! Tables: a line a particle, columns between commas, tabs, semicolons or spaces, with a header or without.
//!
//! A header names `x`, `y`, `z`, and perhaps `radius`, `r`, `g`, `b` or `red`, `green`, `blue`, and `element` or `type`;
//! other columns of numbers can be chosen for colours. A unit in brackets may follow a name, as in `x (mm)`. Without a header the first three are positions and a fourth the
//! radius. `--columns` says otherwise, by names or by numbers from 1. Lines that begin with `#` are passed over, except
//! that the first may be the header.

use super::Context;
use super::words::{coordinate, excerpt};
use crate::color::Srgb;
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::{Input, Line};
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;
use std::ops::Range;

/// So many other columns are kept: they take memory.
const MOST_KEPT: usize = 8;

/// What separates columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Byte(u8),
    Space,
}

impl Separator {
    /// The one that is in a line.
    pub(super) fn of(line: &[u8]) -> Self {
        let has = |byte: &u8| line.contains(byte);
        [b'\t', b',', b';'].into_iter().find(has).map_or(Self::Space, Self::Byte)
    }

    /// The first `most` fields of a line, without quotes and white space around them.
    pub(super) fn split(self, line: &[u8], most: usize, fields: &mut Vec<Range<usize>>) {
        fields.clear();
        let mut at = 0;
        while fields.len() < most {
            if self == Self::Space {
                while line.get(at).is_some_and(|&byte| byte <= b' ') {
                    at += 1;
                }
                if at >= line.len() {
                    return;
                }
            }
            let start = at;
            let mut quoted = false;
            while let Some(&byte) = line.get(at) {
                quoted ^= byte == b'"';
                let ends = match self {
                    Self::Byte(separator) => byte == separator,
                    Self::Space => byte <= b' ',
                };
                if ends && !quoted {
                    break;
                }
                at += 1;
            }
            fields.push(trimmed(line, start..at));
            if at >= line.len() {
                return;
            }
            at += 1;
        }
    }
}

fn trimmed(line: &[u8], range: Range<usize>) -> Range<usize> {
    let Range { mut start, mut end } = range;
    while start < end && line[start] <= b' ' {
        start += 1;
    }
    while start < end && line[end - 1] <= b' ' {
        end -= 1;
    }
    if end - start >= 2 && line[start] == b'"' && line[end - 1] == b'"' {
        start + 1..end - 1
    } else {
        start..end
    }
}

/// Which column is what.
#[derive(Debug, Default)]
struct Columns {
    position: [usize; 3],
    radius: Option<usize>,
    color: Option<[usize; 3]>,
    kind: Option<usize>,
    kept: Vec<(usize, Box<str>)>,
    /// How many more there are, which are ignored.
    further: usize,
    /// As many fields of a line are looked at.
    most: usize,
}

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
        let is_header = !names.iter().take(3).all(|name| number(name).is_some());
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

/// Colours are from 0 to 1 unless one is larger: then they are to 255.
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

/// Whether a header names positions.
pub(super) fn has_axes(names: &[&[u8]]) -> bool {
    ["x", "y", "z"].iter().all(|axis| find(names, &[axis]).is_some())
}

fn find(names: &[&[u8]], wanted: &[&str]) -> Option<usize> {
    let find_by = |wanted: &str, part: fn(&[u8]) -> &[u8]| {
        names.iter().position(|name| part(name).eq_ignore_ascii_case(wanted.as_bytes()))
    };
    wanted.iter().find_map(|wanted| {
        find_by(wanted, |name| name).or_else(|| find_by(wanted, |name| with_unit(name).0))
    })
}

fn unit_or_none(unit: &[u8]) -> String {
    if unit.is_empty() { "no unit".to_owned() } else { excerpt(unit) }
}

/// The name of a column, and the unit in brackets behind it: none is empty.
fn with_unit(name: &[u8]) -> (&[u8], &[u8]) {
    let at = name.iter().position(|byte| matches!(byte, b'(' | b'[')).unwrap_or(name.len());
    let (name, unit) = name.split_at(at);
    (name.trim_ascii_end(), unit.trim_ascii())
}

impl Columns {
    fn new(
        line: &Line<'_>,
        names: &[&[u8]],
        is_header: bool,
        chosen: Option<&str>,
    ) -> Result<Self, ReadError> {
        let mut columns = Self::default();
        let named = |wanted: &[&str]| if is_header { find(names, wanted) } else { None };
        match chosen {
            Some(chosen) => {
                let numbers: Result<Vec<usize>, ReadError> = chosen
                    .split(',')
                    .map(|word| column_of(line, names, is_header, word.trim()))
                    .collect();
                let numbers = numbers?;
                let (&[x, y, z] | &[x, y, z, _]) = numbers.as_slice() else {
                    let what = "--columns: three for x, y and z, and perhaps one for the radius";
                    return Err(line.error(0, what));
                };
                columns.position = [x, y, z];
                columns.radius = numbers.get(3).copied();
            }
            None if is_header => {
                let axis = |axis: &str| {
                    named(&[
                        axis,
                        &format!("pos_{axis}"),
                        &format!("p{axis}"),
                        &format!("coord_{axis}"),
                    ])
                };
                let (Some(x), Some(y), Some(z)) = (axis("x"), axis("y"), axis("z")) else {
                    let names: Vec<String> = names
                        .iter()
                        .take(12)
                        .map(|name| String::from_utf8_lossy(name).into_owned())
                        .collect();
                    let what = format!(
                        "no columns x, y, z in {}; --columns names others",
                        excerpt(names.join(",").as_bytes())
                    );
                    return Err(line.error(0, what));
                };
                columns.position = [x, y, z];
                columns.radius = named(&["radius", "rad"]);
                let lengths = columns.position.into_iter().chain(columns.radius);
                let mut units = lengths.map(|column| with_unit(names[column]).1);
                let first = units.next().unwrap_or_default();
                if let Some(other) = units.find(|unit| *unit != first) {
                    let what = format!(
                        "lengths in {} and in {}; nothing is converted, --columns takes them as they are",
                        unit_or_none(first),
                        unit_or_none(other)
                    );
                    return Err(line.error(0, what));
                }
            }
            None if names.len() < 3 => {
                return Err(line.error(0, format!("{} columns; positions are three", names.len())));
            }
            None => {
                columns.position = [0, 1, 2];
                columns.radius = (names.len() == 4).then_some(3);
            }
        }
        let channels = |set: [&str; 3]| {
            let found = set.map(|name| named(&[name]));
            found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
        };
        columns.color = channels(["red", "green", "blue"]).or_else(|| channels(["r", "g", "b"]));
        columns.kind = named(&["element", "symbol", "species", "type", "kind"]);
        let taken = |column: usize| {
            columns.position.contains(&column)
                || [columns.radius, columns.kind].contains(&Some(column))
                || columns.color.is_some_and(|color| color.contains(&column))
        };
        let others = (0..names.len()).filter(|&column| !taken(column));
        columns.further = others.clone().count().saturating_sub(MOST_KEPT);
        let kept: Vec<(usize, Box<str>)> = others
            .take(MOST_KEPT)
            .map(|column| {
                let name = if is_header {
                    String::from_utf8_lossy(names[column]).into()
                } else {
                    format!("{}", column + 1).into()
                };
                (column, name)
            })
            .collect();
        columns.kept = kept;
        let color = columns.color.into_iter().flatten();
        let all =
            columns.position.into_iter().chain(columns.radius).chain(columns.kind).chain(color);
        let all = all.chain(columns.kept.iter().map(|(column, _)| *column));
        columns.most = all.max().unwrap_or(0) + 1;
        Ok(columns)
    }
}

fn column_of(
    line: &Line<'_>,
    names: &[&[u8]],
    is_header: bool,
    word: &str,
) -> Result<usize, ReadError> {
    if is_header && let Some(column) = find(names, &[word]) {
        return Ok(column);
    }
    match word.parse::<usize>() {
        Ok(column) if (1..=names.len()).contains(&column) => Ok(column - 1),
        _ => Err(line.error(0, format!("--columns: no column {word:?} among {}", names.len()))),
    }
}
