//! Tables: a line a particle, columns between commas, tabs, semicolons or spaces, with a header or without.
//!
//! A header names `x`, `y`, `z`, and perhaps `radius`, `diameter` or `r` alone, `r`, `g`, `b` or `red`, `green`, `blue`, and
//! `element` or `type`; other columns of numbers can be chosen for colours. A unit in brackets may follow a name, as in
//! `x (mm)`. Each row has as many values as the header has names, or is refused: a column that is not named would shift the
//! others. Without a header, and below one of numbers from 0, the first three columns are positions, and a fourth is the radius.
//! `--columns` chooses others, by names or by numbers from 1. Lines that begin with `#` or `%` are passed over, and with `//` unless
//! a header begins otherwise or, without one, the rows begin with labels; except that one before the rows may be the header, below
//! which the number of rows may stand. That may also stand above all rows, and Excel's `sep=;` in the first line.

mod columns;
mod first_line;
mod numbered;
mod separator;

use super::Context;
use super::channels::srgb;
use super::words::{Word, count};
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use glam::DVec3;
use std::ops::Range;

pub(super) use columns::has_axes;
use columns::{Columns, is_by_number, is_header};
use first_line::FirstLine;
pub(super) use first_line::comment;
use numbered::{has_fractions_below, is_numbered};
pub(super) use separator::{Separator, says_separator};
use separator::{comment_signs, number_before_comment};

/// Reads the table.
///
/// # Errors
/// [`ReadError`] at the first line without a number where one should be, or with more or fewer values than the header has
/// names, and if there is no line.
pub(super) fn read(input: &mut Input, context: &mut Context) -> Result<Scene, ReadError> {
    let Layout { separator, columns, header, width, has_slashes } =
        layout(input, context.columns.as_deref(), &mut context.notes)?;
    context.notes.further_columns(columns.further);
    let kept = columns.kept.iter().map(|(_, name)| NumberColumn::named(name.clone()));
    let symbols = if columns.may_number_kinds { Symbols::Numbers } else { Symbols::Elements };
    let mut particles = Particles { columns: kept.collect(), symbols, ..Particles::default() };
    let (mut fields, mut colors) = (Vec::new(), Vec::new());
    let mut other_width = None;
    let most = header.map(|header| header.names.0).or(width);
    let most = most.map_or(columns.most, |count| count + 1);
    while let Some(line) = input.line()? {
        if is_between_rows(&line, has_slashes) {
            continue;
        }
        separator.split(line.bytes, most, &mut fields);
        columns.end_at_comment(line.bytes, &mut fields);
        if let Some(header) = header
            && !separator.fits(line.bytes, &fields, header.names)
        {
            return Err(misfit(&line, separator, &columns, header));
        }
        if let Some(width) = width
            && other_width.is_none()
            && !separator.fits(line.bytes, &fields, (width, false))
        {
            other_width = Some(line.number);
        }
        add(&line, &fields, &columns, &mut particles, &mut colors)?;
    }
    if particles.is_empty() {
        return Err(no_row(input));
    }
    if let Some(line) = other_width {
        let what = "has not as many values as the first row: all rows are read as spheres";
        context.notes.note(format!("line {line} {what}"));
    }
    particles.colors = srgb(&colors);
    particles.finish(&mut context.notes, input.source())
}

/// How rows are read.
#[derive(Debug)]
struct Layout {
    separator: Separator,
    columns: Columns,
    /// The header, if its names say what the fields of rows are.
    header: Option<Header>,
    /// How many values the first row has, if nothing says what they are.
    width: Option<usize>,
    /// Whether comments between rows may begin with `//`.
    has_slashes: bool,
}

/// Where a header is, and how many names it has.
#[derive(Clone, Copy, Debug)]
struct Header {
    line: usize,
    /// And whether rows may lack values at their end.
    names: (usize, bool),
}

/// Reads up to the first row, which is next then.
fn layout(input: &mut Input, chosen: Option<&str>, notes: &mut Notes) -> Result<Layout, ReadError> {
    let (mut is_below_slashes, mut has_count) = (false, false);
    let (first, is_header) = loop {
        let Some(line) = input.line()? else { return Err(no_row(input)) };
        let text = line.trimmed();
        if text.is_empty() || line.number == 1 && says_separator(text) {
            continue;
        }
        if !has_count && count(text).is_some() {
            has_count = true;
            continue;
        }
        let first = FirstLine::of(&line);
        let names = first.names();
        let mut is_header = is_header(&names, chosen);
        let may_be_header = !is_header && !first.is_comment && is_numbered(&names);
        if may_be_header && has_fractions_below(input, &first)? {
            let what = "has the numbers of columns from 0: it is read as a header";
            notes.note(format!("line {} {what}", first.number));
            is_header = true;
        }
        if !first.is_comment || is_header && has_axes(&names) {
            break (first, is_header);
        }
        is_below_slashes |= first.has_slashes;
    };
    let is_by_number = is_by_number(chosen);
    // A row may begin with an address below a header without slashes, or if the first row begins with no number.
    let has_label = || first.names().first().is_some_and(|name| number(name).is_none());
    let has_slashes = if is_header { first.has_slashes } else { is_below_slashes || !has_label() };
    let (mut first, is_header) = match is_header {
        true => header_of_rows(input, first, chosen)?,
        false => {
            input.give_back();
            (first, false)
        }
    };
    let has_slashes = has_slashes || is_header && first.has_slashes;
    if !is_header && chosen.is_none() {
        first.end_at_comment();
        first.end_at_value();
    }
    let names = first.names();
    let columns = Columns::new(&names, is_header, chosen)
        .map_err(|what| ReadError::at(input.source(), first.number, 1, what))?;
    let header = Header { line: first.number, names: (names.len(), first.some_may_be_missing) };
    let header = (is_header && !is_by_number).then_some(header);
    let width = (!is_header && chosen.is_none()).then_some(names.len());
    Ok(Layout { separator: first.separator, columns, header, width, has_slashes })
}

/// Reads up to the first row, and finds the header that fits it: `first`, or one of the comments after it, the last of those that do; if
/// none fits, `first`. Returns the row, and `false`, if columns are chosen by number, which can be read without names.
fn header_of_rows(
    input: &mut Input,
    first: FirstLine,
    chosen: Option<&str>,
) -> Result<(FirstLine, bool), ReadError> {
    let mut candidates = vec![first];
    let mut has_count = false;
    while let Some(row) = input.line()? {
        let next = FirstLine::of(&row);
        let is_candidate = next.is_comment && candidates[0].is_comment && {
            let names = next.names();
            is_header(&names, chosen) && has_axes(&names)
        };
        if is_candidate {
            if candidates.len() < MOST_HEADERS {
                candidates.push(next);
            }
            continue;
        }
        if is_between_rows(&row, candidates.iter().any(|candidate| candidate.has_slashes)) {
            continue;
        }
        if candidates[0].is_comment && !has_count && count(row.trimmed()).is_some() {
            has_count = true;
            continue;
        }
        let fitting = candidates.iter_mut().rposition(|candidate| candidate.fit(&row));
        let without_names = (fitting.is_none() && is_by_number(chosen)).then_some(next);
        input.give_back();
        if let Some(row) = without_names {
            return Ok((row, false));
        }
        return Ok((candidates.swap_remove(fitting.unwrap_or(0)), true));
    }
    Ok((candidates.swap_remove(0), true))
}

/// So many comments are looked at.
const MOST_HEADERS: usize = 16;

/// Whether a line is blank, or a comment, which begins with `//` only if `has_slashes`.
fn is_between_rows(line: &Line<'_>, has_slashes: bool) -> bool {
    let text = line.trimmed();
    text.is_empty() || comment_signs(text) > 0 && (has_slashes || !text.starts_with(b"//"))
}

/// More rows may be on their way.
fn no_row(input: &Input) -> ReadError {
    ReadError::whole(input.source(), "no line with numbers").of_end()
}

/// The error that a row has other fields than the header names.
#[cold]
fn misfit(line: &Line<'_>, separator: Separator, columns: &Columns, header: Header) -> ReadError {
    let mut fields = Vec::new();
    separator.split(line.bytes, usize::MAX, &mut fields);
    columns.end_at_comment(line.bytes, &mut fields);
    let byte = fields.get(header.names.0).map_or(line.bytes.len(), |field| field.start);
    let what = format!(
        "{} values; the header in line {} names {}; --columns takes columns by number",
        fields.len(),
        header.line,
        header.names.0
    );
    line.error(byte, what)
}

fn add(
    line: &Line<'_>,
    fields: &[Range<usize>],
    columns: &Columns,
    particles: &mut Particles,
    colors: &mut Vec<[f32; 3]>,
) -> Result<(), ReadError> {
    let number_in = |column: usize, name: &str| {
        let Some(field) = fields.get(column) else {
            let what = format!("{name} is missing: {} columns, not {}", fields.len(), column + 1);
            return Err(line.error(line.bytes.len(), what));
        };
        let word = Word { line: *line, byte: field.start, bytes: &line.bytes[field.clone()] };
        word.coordinate(name).or_else(|error| {
            let bytes = number_before_comment(line.bytes, field).ok_or(error)?;
            Word { bytes, ..word }.coordinate(name)
        })
    };
    let value = |column, name| number_in(column, name).map(|value| value as f32);
    let [x, y, z] = columns.position;
    particles.center(DVec3::new(number_in(x, "x")?, number_in(y, "y")?, number_in(z, "z")?));
    let text =
        |column: usize| fields.get(column).map_or(&b""[..], |field| &line.bytes[field.clone()]);
    if let Some(column) = columns.diameter {
        let field = fields.get(column);
        let byte = field.map_or(line.bytes.len(), |field| field.start);
        let value = field.and_then(|field| number_before_comment(line.bytes, field));
        let word = Word { line: *line, byte, bytes: value.unwrap_or_else(|| text(column)) };
        particles.radii.push(word.half_diameter("the diameter")?);
    }
    if let Some(column) = columns.radius {
        let radius = value(column, "the radius")?;
        if radius < 0.0 {
            let what = format!("radius is {radius}, which is negative");
            return Err(line.error(fields[column].start, what));
        }
        particles.radii.push(radius);
    }
    if let Some([red, green, blue]) = columns.color {
        colors.push([value(red, "red")?, value(green, "green")?, value(blue, "blue")?]);
    }
    if let Some(column) = columns.kind {
        let (name, known) = (text(column), particles.kinds.known());
        particles.kind(name, line.number);
        // One type that is no number makes all of them symbols.
        if particles.kinds.known() > known && !is_whole(name) {
            particles.symbols = Symbols::Elements;
        }
    }
    for ((column, _), kept) in columns.kept.iter().zip(&mut particles.columns) {
        let value = number(text(*column)).or_else(|| {
            let field = fields.get(*column)?;
            number(number_before_comment(line.bytes, field)?)
        });
        kept.values.push(value.map_or(f32::NAN, |value| value as f32));
    }
    Ok(())
}

/// Whether a type is a whole number, however it is written, or missing.
fn is_whole(name: &[u8]) -> bool {
    name.is_empty() || number(name).is_some_and(|value| value.fract() == 0.0)
}
