//! mmCIF: the loop over `_atom_site`, whose columns are named; a frame is a `pdbx_PDB_model_num` in a block of data, or a block's
//! component, `_chem_comp_atom`, where it has no other atoms.
//!
//! All else is passed over. Of alternate locations the first is drawn. Grammar: "CIF 1.1 syntax", IUCr.

mod component;
mod row;
mod rows;

use super::context::Context;
use super::locations::Locations;
use super::mmcif_columns::Columns;
use super::words::Word;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::fixed::Fixed;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::{number_or_nan, parsed};
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use component::{CATEGORY, Component, Heading};
use glam::DVec3;
use row::Row;
use rows::{begins, ends_loop, read_rows};

/// Reads the next model.
///
/// # Errors
/// [`ReadError`] at the first atom whose coordinates are none, and if there is no table of atoms.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let is_first = input.place() == Default::default();
    if is_first || is_past_table(input)? {
        match find_atoms(input, context, is_first)? {
            Found::Table => {}
            Found::Component(component) => {
                return component.finish(&mut context.notes, input.source()).map(Some);
            }
            Found::Nothing => return Ok(None),
        }
    }
    let Some((_, columns)) = context.mmcif.range(..=input.place()).next_back() else {
        return Ok(None);
    };
    let columns = columns.clone();
    let mut atoms = Atoms::new(&columns, context.fixed);
    let has_ended = read_rows(input, columns.count, |line, row| atoms.add(line, row))?;
    if atoms.particles.is_empty() {
        return Ok(None);
    }
    if context.follows && !has_ended {
        return Err(input.ends("the file ends within the table of atoms"));
    }
    atoms.finish(&mut context.notes, input.source()).map(Some)
}

/// Whether the table of atoms has no further row; passes over blank lines and comments.
fn is_past_table(input: &mut Input) -> Result<bool, ReadError> {
    while let Some(line) = input.line()? {
        let text = line.trimmed();
        if !text.is_empty() && text[0] != b'#' {
            let is_past = ends_loop(text);
            input.give_back();
            return Ok(is_past);
        }
    }
    Ok(false)
}

/// What there is to show next.
enum Found {
    /// A table of atoms, whose first row is next.
    Table,
    /// A component, whose block has been read.
    Component(Box<Component>),
    Nothing,
}

/// Goes to the first row of the next table of atoms, or to the end of the next block without one that has a component. There must be a
/// first of them.
fn find_atoms(
    input: &mut Input,
    context: &mut Context,
    is_first: bool,
) -> Result<Found, ReadError> {
    let (mut tags, mut heading, mut in_text) = (Vec::new(), Heading::default(), false);
    let (mut fractions, mut unplaced) = (false, false);
    // Of the block: it may begin before.
    let mut has_table = !is_first;
    // What is wrong with it does not matter in a block that has a table.
    let mut component: Result<Option<Component>, ReadError> = Ok(None);
    while let Some(line) = input.line()? {
        if line.bytes.starts_with(b";") {
            in_text = !in_text;
            continue;
        }
        if in_text {
            continue;
        }
        let text = line.trimmed();
        if begins(text, CATEGORY) {
            heading.add(&line)?;
            tags.clear();
            continue;
        }
        if !heading.is_empty() && !text.is_empty() && text[0] != b'#' {
            input.give_back();
            let heading = std::mem::take(&mut heading);
            if !has_table {
                let read = Component::read(&heading, input, context.fixed);
                component = component.and_then(|before| Ok(read?.or(before)));
                unplaced |= matches!(component, Ok(None));
            }
            continue;
        }
        if begins(text, b"data_") {
            if let Some(component) = std::mem::replace(&mut component, Ok(None))? {
                input.give_back();
                return Ok(Found::Component(Box::new(component)));
            }
            has_table = false;
        }
        let is_tag = begins(text, b"_atom_site.");
        fractions |= begins(text, b"_atom_site_fract_");
        if is_tag {
            let tag = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
            if tag.len() < text.len() && !text[tag.len()..].trim_ascii().starts_with(b"#") {
                return Err(line.error(tag.len() + 1, "_atom_site is not a loop"));
            }
            tags.push(String::from_utf8_lossy(&tag[11..]).into_owned());
        } else if !tags.is_empty() && !text.is_empty() && text[0] != b'#' {
            if ends_loop(text) {
                // A table without rows.
                tags.clear();
                continue;
            }
            let columns = Columns::of(&tags, &line)?;
            input.give_back();
            let place = input.place();
            let before = context.mmcif.range(..=place).next_back();
            if before.is_none_or(|(_, before)| *before != columns) {
                context.mmcif.insert(place, columns);
            }
            return Ok(Found::Table);
        }
    }
    let mut component = component?;
    if !has_table && !heading.is_empty() {
        component = Component::read(&heading, input, context.fixed)?.or(component);
        unplaced |= component.is_none();
    }
    // A further block may be on its way, or the end of this one.
    if context.follows && (component.is_some() || !is_first) {
        return Err(input.ends("the file ends before a further table of atoms"));
    }
    let what = match component {
        Some(component) => return Ok(Found::Component(Box::new(component))),
        None if !is_first => return Ok(Found::Nothing),
        None if fractions => {
            "atoms in fractions of a cell: only _atom_site.Cartn_x, _y, _z are read"
        }
        None if unplaced => {
            "components without positions: _chem_comp_atom has neither model_Cartn_x nor pdbx_model_Cartn_x_ideal nor x"
        }
        None => return Err(ReadError::whole(input.source(), "no loop over _atom_site").of_end()),
    };
    Err(ReadError::whole(input.source(), what))
}

struct Atoms<'a> {
    columns: &'a Columns,
    particles: Particles,
    model: Option<Vec<u8>>,
    locations: Locations,
    /// The residue of the last atom that has a location.
    residue: Vec<u8>,
}

impl<'a> Atoms<'a> {
    fn new(columns: &'a Columns, fixed: Fixed) -> Self {
        let kept = ["occupancy", "b_factor"].map(NumberColumn::named).into();
        let particles = Particles { columns: kept, ..Particles::from(fixed) };
        let (locations, residue) = (Locations::default(), Vec::new());
        Self { columns, particles, model: None, locations, residue }
    }

    /// Adds an atom; returns `false` if it is of the next model.
    fn add(&mut self, line: &Line<'_>, row: &Row) -> Result<bool, ReadError> {
        let columns = self.columns;
        let model = row.value(columns.model);
        match &self.model {
            None => self.model = Some(model.to_vec()),
            Some(of) if of != model => return Ok(false),
            Some(_) => {}
        }
        let (chain, number_text, name) =
            (row.value(columns.chain), row.value(columns.residue_number), row.value(columns.name));
        if !row.value(columns.location).is_empty() {
            self.residue.clear();
            for part in [chain, b" ", number_text, b" ", row.value(columns.insertion)] {
                self.residue.extend_from_slice(part);
            }
            self.locations.enter(&self.residue);
            if !self.locations.is_first(name) {
                return Ok(true);
            }
        }
        let at = |axis: usize, called: &str| {
            let word = row.word(columns.position[axis]);
            // A standard uncertainty may follow in brackets.
            let bytes = word.split(|&byte| byte == b'(').next().unwrap_or_default();
            Word { line: *line, byte: 0, bytes }.coordinate(called)
        };
        let center = DVec3::new(at(0, "Cartn_x")?, at(1, "Cartn_y")?, at(2, "Cartn_z")?);
        let particles = &mut self.particles;
        particles.center(center);
        particles.kind(row.value(columns.symbol), line.number);
        particles.naming(Naming::Name).push(name);
        particles.naming(Naming::Residue).push(row.value(columns.residue));
        particles.naming(Naming::Chain).push(chain);
        particles.naming(Naming::Molecule).push(row.value(columns.entity));
        particles.residue_numbers.push(parsed(number_text).unwrap_or(0));
        for (column, kept) in columns.numbers.iter().zip(&mut particles.columns) {
            kept.values.push(number_or_nan(row.value(*column)));
        }
        Ok(true)
    }

    fn finish(self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        self.locations.note(notes);
        self.particles.finish(notes, source)
    }
}
