//! `ITEM: TIMESTEP`, number of atoms, box, and `ITEM: ATOMS` with the names of columns; frame after frame.
//!
//! Atoms are sorted by `id`, since LAMMPS writes them in any order. Positions are `x`, `xu`, or in fractions of the box
//! `xs`, `xsu`. Fractions are scaled as the documentation of `dump` says, also where the box is sheared.

use super::super::Context;
use super::super::stated::Stated;
use super::super::words::{Word, Words, excerpt, split};
use super::cell::Cell;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::input::{Input, Line};
use crate::scene::number::{number_or_nan, parsed};
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use crate::scene::symbols::Symbols;
use glam::DVec3;

/// How many columns of numbers are kept at most: they take memory.
const MOST_KEPT: usize = 64;

/// What a column is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Position(usize),
    Id,
    Type,
    Element,
    Molecule,
    Radius,
    Diameter,
    Number,
    /// So many columns that are passed over.
    Further(usize),
}

/// The columns of a frame.
#[derive(Debug, Default)]
struct Columns {
    /// What they are, and their names; neighbours that are passed over are one.
    list: Vec<(Kind, String)>,
    /// How many there are.
    count: usize,
    /// How many of them are passed over.
    further: usize,
    /// Whether positions are fractions of the box.
    are_scaled: bool,
}

/// Reads the next frame.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be.
pub(in super::super) fn frame(
    input: &mut Input,
    context: &mut Context,
) -> Result<Option<Scene>, ReadError> {
    let Some((stated, cell)) = header(input)? else { return Ok(None) };
    let heading = input.expect("ITEM: ATOMS")?;
    if stated.count == 0 {
        return Err(stated.none(input.source(), "a frame without atoms"));
    }
    let columns = columns(&heading)?;
    context.notes.further_columns(columns.further);
    let has_element = columns.list.iter().any(|(kind, _)| *kind == Kind::Element);
    let symbols = if has_element { Symbols::Elements } else { Symbols::Numbers };
    let mut particles = Particles { symbols, ..Particles::from(context.fixed) };
    let numbers = columns.list.iter().filter(|(kind, _)| *kind == Kind::Number);
    particles.columns = numbers.map(|(_, name)| NumberColumn::named(name.as_str())).collect();
    let mut ids = Vec::new();
    for atom in 0..stated.count {
        let line = stated.next(input, atom)?;
        let (mut words, mut position, mut column) = (Words::of(line), [0.0; 3], 0);
        for (kind, name) in &columns.list {
            let word = words.expect(name)?;
            match *kind {
                Kind::Position(axis) => position[axis] = word.coordinate(name)?,
                Kind::Id => ids.push(id(&word)?),
                Kind::Type => {
                    particles.naming(Naming::Type).push(word.bytes);
                    if !has_element {
                        particles.kind(word.bytes, line.number);
                    }
                }
                Kind::Element => particles.kind(word.bytes, line.number),
                Kind::Molecule => particles.naming(Naming::Molecule).push(word.bytes),
                Kind::Radius => particles.radii.push(word.single(name, 1.0)?.abs()),
                Kind::Diameter => particles.radii.push(word.single(name, 0.5)?.abs()),
                Kind::Number => {
                    particles.columns[column].values.push(number_or_nan(word.bytes));
                    column += 1;
                }
                Kind::Further(count) => {
                    for _ in 1..count {
                        words.expect(name)?;
                    }
                }
            }
        }
        let mut center = DVec3::from_array(position);
        if columns.are_scaled {
            center = cell.point(position);
            if !center.as_vec3().is_finite() {
                let what =
                    format!("an atom is at {center}, which is not finite in single precision");
                return Err(line.error(0, what));
            }
        }
        particles.center(center);
    }
    // Where a file grows, or in a pipe, this is left to whoever reads on: the next line may not be whole yet.
    if !context.follows && input.can_be_read_again() {
        check_next(input, stated, columns.count)?;
    }
    particles.sort_by(&ids);
    particles.finish(&mut context.notes, input.source()).map(Some)
}

/// What follows may be another frame, or what a run that was cut off has left of it, but not another atom of so many words.
fn check_next(input: &mut Input, stated: Stated, words: usize) -> Result<(), ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(());
    }
    let line = input.expect("ITEM:")?;
    if split(line.bytes).count() >= words && !line.bytes.starts_with(b"ITEM:") {
        let Stated { count, line: first, .. } = stated;
        let what = format!(
            "{} where an ITEM: should be; the number of atoms in line {first} is {count}",
            excerpt(line.bytes)
        );
        return Err(line.error(0, what));
    }
    input.give_back();
    Ok(())
}

/// Leaves out a frame.
///
/// # Errors
/// [`ReadError`] if it is no valid frame.
pub(in super::super) fn skip(input: &mut Input) -> Result<bool, ReadError> {
    let Some((stated, _)) = header(input)? else { return Ok(false) };
    // The names of columns are a line, too.
    stated.next(input, 0)?;
    stated.skip(input)?;
    Ok(true)
}

/// Reads up to `ITEM: ATOMS`, which is next then. Returns how many atoms there are, and the box.
fn header(input: &mut Input) -> Result<Option<(Stated, Cell)>, ReadError> {
    if input.is_over_but_blanks()? {
        return Ok(None);
    }
    let (mut stated, mut cell) = (None, Cell::default());
    loop {
        let line = input.expect("ITEM: ATOMS")?;
        let Some(item) = line.bytes.strip_prefix(b"ITEM: ") else {
            return Err(line.error(0, format!("{} where an ITEM: should be", excerpt(line.bytes))));
        };
        if item.starts_with(b"ATOMS") {
            input.give_back();
            let Some(stated) = stated else {
                return Err(input.ends("ITEM: ATOMS before ITEM: NUMBER OF ATOMS"));
            };
            return Ok(Some((stated, cell)));
        } else if item.starts_with(b"NUMBER OF ATOMS") {
            stated = Some(Stated::atoms(&input.expect("the number of atoms")?)?);
        } else if item.starts_with(b"BOX BOUNDS") {
            let is_general = item.split(u8::is_ascii_whitespace).any(|word| word == b"origin");
            cell = Cell::read(input, is_general)?;
        } else {
            // A time step, units, a time: the value is in a line of its own.
            input.expect("its value")?;
        }
    }
}

fn columns(line: &Line<'_>) -> Result<Columns, ReadError> {
    let text = line.bytes.strip_prefix(b"ITEM: ATOMS").unwrap_or_default();
    let has = |name: &str| split(text).any(|other| other == name.as_bytes());
    // Wrapped before unwrapped, plain before scaled: positions that are written twice are taken once.
    let sets = [["x", "y", "z"], ["xu", "yu", "zu"], ["xs", "ys", "zs"], ["xsu", "ysu", "zsu"]];
    let Some(set) = sets.iter().position(|set| set.iter().all(|&name| has(name))) else {
        return Err(line.error(0, "no x y z, xu yu zu, xs ys zs or xsu ysu zsu among the columns"));
    };
    let has_radius = has("radius");
    let kind = |name: &[u8]| match name {
        b"id" => Kind::Id,
        b"type" => Kind::Type,
        b"element" => Kind::Element,
        b"mol" => Kind::Molecule,
        b"radius" => Kind::Radius,
        b"diameter" if !has_radius => Kind::Diameter,
        name => match sets[set].iter().position(|axis| axis.as_bytes() == name) {
            Some(axis) => Kind::Position(axis),
            None => Kind::Number,
        },
    };
    let mut columns = Columns { are_scaled: set >= 2, ..Columns::default() };
    let (mut found, mut numbers) = (Vec::new(), 0);
    for name in split(text) {
        columns.count += 1;
        // The second column of a name is a number like any other.
        let kind = Some(kind(name)).filter(|kind| !found.contains(kind)).unwrap_or(Kind::Number);
        if kind == Kind::Number {
            numbers += 1;
        } else {
            found.push(kind);
        }
        if kind == Kind::Number && numbers > MOST_KEPT {
            columns.pass_over();
        } else {
            columns.list.push((kind, String::from_utf8_lossy(name).into_owned()));
        }
    }
    Ok(columns)
}

impl Columns {
    /// Adds a column that is passed over.
    fn pass_over(&mut self) {
        self.further += 1;
        match self.list.last_mut() {
            Some((Kind::Further(count), _)) => *count += 1,
            _ => self.list.push((Kind::Further(1), "a further column".to_owned())),
        }
    }
}

/// The number of an atom.
pub(super) fn id(word: &Word<'_>) -> Result<i64, ReadError> {
    parsed(word.bytes).ok_or_else(|| word.error(format!("{} is not an id", excerpt(word.bytes))))
}
