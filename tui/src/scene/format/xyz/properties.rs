//! What `Properties` in the comment of an extended XYZ file say: names, types, and how many columns each has.

use super::super::words::{count, excerpt};
use crate::scene::attributes::Naming;
use crate::scene::input::Line;
use crate::scene::read_error::ReadError;
use std::borrow::Cow;

/// How many columns of numbers are kept at most, and how many others have their names: they take memory.
const MOST_KEPT: usize = 64;

/// What a column is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Species,
    Position,
    Radius,
    Diameter,
    Color,
    Name(Naming),
    Number,
    /// Forces, velocities and whatever a picture of spheres does not need.
    Other,
    /// Columns beyond those that are kept.
    Further,
}

/// Columns of names that are elements where no other column tells them.
const TYPES: [&str; 2] = ["type", "atom_types"];

/// Columns of atomic numbers.
const NUMBERS: [&str; 3] = ["z", "numbers", "atomic_numbers"];

/// A name, and what its columns are.
#[derive(Clone, Debug)]
pub(super) struct Property<'a> {
    pub(super) name: Cow<'a, str>,
    pub(super) kind: Kind,
    pub(super) columns: usize,
    /// How many properties it stands for.
    pub(super) properties: usize,
    /// Whether they are integers: then colours go to 255.
    is_integer: bool,
}

impl Property<'_> {
    /// A channel of a colour: reals from 0 to 1, integers to 255.
    pub(super) fn channel(&self, value: f32) -> u8 {
        let value = if self.is_integer { value } else { 255.0 * value };
        value.round().clamp(0.0, 255.0) as u8
    }
}

/// The properties, if the comment states any.
///
/// # Errors
/// [`ReadError`] if they are not valid: not in threes, of an unknown type, without three columns for positions, or with
/// positions twice.
pub(super) fn properties(comment: &Line<'_>) -> Result<Option<Vec<Property<'static>>>, ReadError> {
    let text = comment.bytes;
    let lower = text.to_ascii_lowercase();
    let Some(start) = memchr::memmem::find_iter(&lower, b"properties=")
        .find(|&at| at == 0 || text[at - 1].is_ascii_whitespace())
    else {
        return Ok(None);
    };
    let start = start + b"properties=".len();
    let value = &text[start..];
    let value = match value.strip_prefix(b"\"") {
        Some(quoted) => quoted.split(|&byte| byte == b'"').next().unwrap_or_default(),
        None => value.split(u8::is_ascii_whitespace).next().unwrap_or_default(),
    };
    let wrong = |what: String| Err(comment.error(start, what));
    let words: Vec<&[u8]> = value.split(|&byte| byte == b':').collect();
    if !words.len().is_multiple_of(3) {
        return wrong(format!("Properties={}: not name:type:columns, ...", excerpt(value)));
    }
    let (mut found, mut all) = (Vec::new(), Vec::with_capacity(words.len() / 3));
    for triple in words.chunks_exact(3) {
        let name = String::from_utf8_lossy(triple[0]);
        let columns = count(triple[2]).filter(|&columns| columns > 0 && columns <= 1 << 24);
        let (Some(columns), [b'S' | b'R' | b'I' | b'L']) = (columns, triple[1]) else {
            return wrong(format!(
                "Properties: {} is not name:type:columns",
                excerpt(&triple.join(&b':'))
            ));
        };
        let mut kind = kind(&name.to_ascii_lowercase(), triple[1][0], columns);
        if kind == Kind::Position && columns != 3 {
            return wrong(format!("Properties: {name} has {columns} columns; positions have 3"));
        }
        if !matches!(kind, Kind::Species | Kind::Number | Kind::Other) {
            match (found.contains(&kind), kind) {
                (false, _) => found.push(kind),
                (true, Kind::Position) => {
                    return wrong(format!("Properties: {name:?} names a second position"));
                }
                (true, _) => kind = Kind::Other,
            }
        }
        let is_integer = triple[1] == b"I";
        all.push(Property { name, kind, columns, properties: 1, is_integer });
    }
    if !found.contains(&Kind::Position) {
        return wrong(format!("Properties={}: no pos:R:3 among them", excerpt(value)));
    }
    choose_species(&mut all);
    if found.contains(&Kind::Radius) {
        for property in all.iter_mut().filter(|property| property.kind == Kind::Diameter) {
            property.kind = Kind::Number;
        }
    }
    Ok(Some(kept(all)))
}

/// All properties, except that those beyond [`MOST_KEPT`] are passed over, neighbours as one.
fn kept(all: Vec<Property<'_>>) -> Vec<Property<'static>> {
    let (mut numbers, mut others) = (0, 0);
    let mut kept: Vec<Property<'static>> = Vec::new();
    for Property { name, kind, columns, properties, is_integer } in all {
        let before = match kind {
            Kind::Number => numbers,
            Kind::Other => others,
            _ => 0,
        };
        numbers += usize::from(kind == Kind::Number);
        others += usize::from(kind == Kind::Other);
        if before < MOST_KEPT {
            let name = Cow::Owned(name.into_owned());
            kept.push(Property { name, kind, columns, properties, is_integer });
            continue;
        }
        match kept.last_mut() {
            Some(last) if last.kind == Kind::Further => {
                last.columns = last.columns.saturating_add(columns);
                last.properties += properties;
            }
            _ => {
                let (name, kind) = (Cow::Borrowed("a further column"), Kind::Further);
                kept.push(Property { name, kind, columns, properties, is_integer });
            }
        }
    }
    kept
}

/// Leaves one column to tell elements: their symbols, else their numbers, else types. Others are names.
fn choose_species<'a>(all: &mut [Property<'a>]) {
    let is_species = |property: &Property<'a>| property.kind == Kind::Species;
    let has_name = |property: &Property<'a>, names: &[&str]| {
        names.iter().any(|name| property.name.eq_ignore_ascii_case(name))
    };
    let is_symbol = |property: &Property<'a>| is_species(property) && !has_name(property, &TYPES);
    let is_number = |property: &Property<'a>| {
        property.is_integer && property.columns == 1 && has_name(property, &NUMBERS)
    };
    let find = |is_it: &dyn Fn(&Property<'a>) -> bool| all.iter().position(is_it);
    let chosen = find(&is_symbol).or_else(|| find(&is_number)).or_else(|| find(&is_species));
    let mut is_named = false;
    for (index, property) in all.iter_mut().enumerate() {
        if Some(index) == chosen {
            property.kind = Kind::Species;
        } else if property.kind == Kind::Species {
            property.kind = if is_named { Kind::Other } else { Kind::Name(Naming::Type) };
            is_named = true;
        }
    }
}

fn kind(name: &str, kind: u8, columns: usize) -> Kind {
    let number = matches!(kind, b'R' | b'I');
    match (name, columns) {
        ("species" | "element" | "type" | "atom_types" | "symbols", 1) if kind == b'S' => {
            Kind::Species
        }
        ("pos" | "position" | "positions", _) if number => Kind::Position,
        ("radius" | "radii", 1) if number => Kind::Radius,
        ("diameter" | "diameters", 1) if number => Kind::Diameter,
        ("color" | "colour" | "rgb" | "vertex_color", 3) if number => Kind::Color,
        ("molecule" | "mol" | "molecule_identifier", 1) => Kind::Name(Naming::Molecule),
        ("residuenames" | "resname" | "residue", 1) if kind == b'S' => Kind::Name(Naming::Residue),
        ("atomtypes" | "name" | "atom_name", 1) if kind == b'S' => Kind::Name(Naming::Name),
        ("chain" | "chainid", 1) => Kind::Name(Naming::Chain),
        (_, 1) if kind != b'S' => Kind::Number,
        _ => Kind::Other,
    }
}
