//! PLY: the vertices, in text or in binary of either order; `x y z`, and perhaps `radius`, `red green blue`.
//!
//! Faces and all else are passed over: only spheres are drawn. G. Turk, "The PLY Polygon File Format" (1994).

mod header;

use super::channels::srgb;
use super::words::Words;
use crate::color::Srgb;
use crate::scene::Scene;
use crate::scene::attributes::NumberColumn;
use crate::scene::input::Input;
use crate::scene::notes::Notes;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;
use header::{Element, Encoding, Property, Scalar, header};

/// How many other properties are kept at most: they take memory.
const MOST_KEPT: usize = 4;

/// Reads the vertices.
///
/// # Errors
/// [`ReadError`] if there is no valid header, or the data ends early, or a position is not finite.
pub(super) fn read(input: &mut Input, notes: &mut Notes) -> Result<Scene, ReadError> {
    let (encoding, elements) = header(input)?;
    let source = input.source().to_owned();
    let Some(at) = elements.iter().position(|element| element.is_vertex && element.count > 0)
    else {
        return Err(ReadError::whole(&source, "no vertices"));
    };
    for element in &elements[..at] {
        // So many elements as a header claims, and no bytes of them at which the file could end.
        if encoding != Encoding::Ascii && element.properties.is_empty() {
            continue;
        }
        for _ in 0..element.count {
            skip(input, encoding, element)?;
        }
    }
    let others = elements[..at].iter().chain(&elements[at + 1..]);
    if others.map(|element| element.count).any(|count| count > 0) {
        notes.note("only the vertices are drawn");
    }
    vertices(input, encoding, &elements[at], notes)
}

fn vertices(
    input: &mut Input,
    encoding: Encoding,
    element: &Element,
    notes: &mut Notes,
) -> Result<Scene, ReadError> {
    let names = &element.properties;
    let find = |wanted: &[&str]| {
        let is_it = |property: &Property| {
            property.list.is_none() && wanted.contains(&property.name.as_str())
        };
        names.iter().position(is_it)
    };
    let source = input.source().to_owned();
    let (Some(x), Some(y), Some(z)) = (find(&["x"]), find(&["y"]), find(&["z"])) else {
        return Err(ReadError::whole(&source, "vertices without x, y, z"));
    };
    let radius = find(&["radius"]);
    let color = [
        ["red", "r", "diffuse_red"],
        ["green", "g", "diffuse_green"],
        ["blue", "b", "diffuse_blue"],
    ];
    let color = color.map(|names| find(&names));
    let color = color.iter().all(Option::is_some).then(|| color.map(Option::unwrap_or_default));
    let taken = |index: usize| {
        [x, y, z].contains(&index)
            || radius == Some(index)
            || color.is_some_and(|color| color.contains(&index))
    };
    let (mut kept, lists): (Vec<usize>, Vec<usize>) = (0..names.len())
        .filter(|&index| !taken(index))
        .partition(|&index| names[index].list.is_none());
    notes.further_columns(kept.len().saturating_sub(MOST_KEPT) + lists.len());
    kept.truncate(MOST_KEPT);
    let columns = kept.iter().map(|&index| NumberColumn::named(names[index].name.as_str()));
    let mut particles = Particles { columns: columns.collect(), ..Particles::default() };
    let (mut values, mut shares) = (vec![0.0; names.len()], Vec::new());
    for vertex in 0..element.count {
        let line = row(input, encoding, element, &mut values, vertex)?;
        let center = DVec3::new(values[x], values[y], values[z]);
        particles.sphere(center, radius.map(|radius| values[radius])).map_err(|what| {
            let what = format!("vertex {vertex} {what}");
            match line {
                Some(line) => ReadError::at(&source, line, 1, what),
                None => ReadError::whole(&source, what),
            }
        })?;
        if let Some(color) = color {
            let scale = match names[color[0]].kind {
                Scalar::Float | Scalar::Double => None,
                Scalar::Uint(2) => Some(1.0 / 257.0),
                _ => Some(1.0),
            };
            match scale {
                Some(scale) => {
                    let channel =
                        |index: usize| (values[index] * scale).round().clamp(0.0, 255.0) as u8;
                    particles.colors.push(Srgb(color.map(channel)));
                }
                None => shares.push(color.map(|index| values[index] as f32)),
            }
        }
        for (column, &index) in particles.columns.iter_mut().zip(&kept) {
            column.values.push(values[index] as f32);
        }
    }
    particles.colors.extend(srgb(&shares));
    particles.finish(notes, &source)
}

/// Reads an element; returns the number of its line if it is text. A list is passed over.
fn row(
    input: &mut Input,
    encoding: Encoding,
    element: &Element,
    values: &mut [f64],
    index: usize,
) -> Result<Option<usize>, ReadError> {
    if encoding == Encoding::Ascii {
        let line = input
            .line_or(|| format!("the file ends after {index} of {} elements", element.count))?;
        let mut words = Words::of(line);
        for (property, value) in element.properties.iter().zip(values) {
            *value = words.number(&property.name)?;
            if property.list.is_some() {
                for _ in 0..*value as usize {
                    words.number(&property.name)?;
                }
            }
        }
        return Ok(Some(line.number));
    }
    for (property, value) in element.properties.iter().zip(values) {
        *value = scalar(input, encoding, property.list.unwrap_or(property.kind))?;
        if property.list.is_some() {
            for _ in 0..*value as u64 {
                scalar(input, encoding, property.kind)?;
            }
        }
    }
    Ok(None)
}

fn skip(input: &mut Input, encoding: Encoding, element: &Element) -> Result<(), ReadError> {
    let mut values = vec![0.0; element.properties.len()];
    row(input, encoding, element, &mut values, 0).map(|_| ())
}

#[inline]
fn scalar(input: &mut Input, encoding: Encoding, kind: Scalar) -> Result<f64, ReadError> {
    let mut bytes = [0; 8];
    let own = &mut bytes[..kind.size()];
    input.exactly(own)?;
    if encoding == Encoding::Big {
        own.reverse();
    }
    Ok(kind.value(bytes))
}
