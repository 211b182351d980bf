//! What `Properties` in the comment of an extended XYZ file say: names, types, and how many columns each has.

use super::super::words::excerpt;
use crate::scene::attributes::Naming;
use crate::scene::input::Line;
use crate::scene::read_error::ReadError;

/// What a column is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Species,
    Position,
    Radius,
    Color,
    Name(Naming),
    Number,
    /// Forces, velocities and whatever a picture of spheres does not need.
    Other,
}

/// A name, and what its columns are.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) columns: usize,
    /// Whether colours are integers from 0 to 255.
    bytes: bool,
}

impl Property {
    /// Whether a picture leaves it out.
    pub(super) fn is_ignored(&self) -> bool {
        self.kind == Kind::Other
    }

    /// A channel of a colour: reals from 0 to 1, integers to 255.
    pub(super) fn channel(&self, value: f32) -> u8 {
        let value = if self.bytes { value } else { 255.0 * value };
        value.round().clamp(0.0, 255.0) as u8
    }
}

/// The properties, if the comment states any.
///
/// # Errors
/// [`ReadError`] if they are not valid: not in threes, of an unknown type, without three columns for positions, or the
/// same twice.
pub(super) fn properties(comment: &Line<'_>) -> Result<Option<Vec<Property>>, ReadError> {
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
        let name = String::from_utf8_lossy(triple[0]).into_owned();
        let columns = super::count(triple[2]).filter(|&columns| columns > 0 && columns <= 1 << 24);
        let (Some(columns), [b'S' | b'R' | b'I' | b'L']) = (columns, triple[1]) else {
            return wrong(format!(
                "Properties: {} is no name:type:columns",
                excerpt(&triple.join(&b':'))
            ));
        };
        let kind = kind(&name.to_ascii_lowercase(), triple[1][0], columns);
        if kind == Kind::Position && columns != 3 {
            return wrong(format!("Properties: {name} has {columns} columns; positions have 3"));
        }
        if matches!(
            kind,
            Kind::Species | Kind::Position | Kind::Radius | Kind::Color | Kind::Name(_)
        ) {
            if found.contains(&kind) {
                return wrong(format!("Properties: {name:?} names a second column for the same"));
            }
            found.push(kind);
        }
        let bytes = triple[1] == b"I";
        all.push(Property { name, kind, columns, bytes });
    }
    if !found.contains(&Kind::Position) {
        return wrong(format!("Properties={}: no pos:R:3 among them", excerpt(value)));
    }
    Ok(Some(all))
}

fn kind(name: &str, kind: u8, columns: usize) -> Kind {
    let number = matches!(kind, b'R' | b'I');
    match (name, columns) {
        ("species" | "element" | "type" | "atom_types" | "symbols", 1) if kind == b'S' => {
            Kind::Species
        }
        ("z" | "numbers" | "atomic_numbers", 1) if kind == b'I' => Kind::Number,
        ("pos" | "position" | "positions", _) if number => Kind::Position,
        ("radius" | "radii", 1) if number => Kind::Radius,
        ("color" | "colour" | "rgb" | "vertex_color", 3) if number => Kind::Color,
        ("molecule" | "mol" | "molecule_identifier", 1) => Kind::Name(Naming::Molecule),
        ("residuenames" | "resname" | "residue", 1) if kind == b'S' => Kind::Name(Naming::Residue),
        ("atomtypes" | "name" | "atom_name", 1) if kind == b'S' => Kind::Name(Naming::Name),
        ("chain" | "chainid", 1) => Kind::Name(Naming::Chain),
        (_, 1) if kind != b'S' => Kind::Number,
        _ => Kind::Other,
    }
}
