//! mmCIF: the loop over `_atom_site`, whose columns are named; a frame is a `pdbx_PDB_model_num` in a block of data.
//!
//! All else is passed over. Of alternate locations the first is drawn. Grammar: "CIF 1.1 syntax", IUCr.

mod row;

use super::context::Context;
use super::mmcif_columns::Columns;
use super::words::coordinate;
use crate::scene::Scene;
use crate::scene::attributes::{Naming, NumberColumn};
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;
use row::Row;
use std::collections::HashSet;

/// Reads the next model.
///
/// # Errors
/// [`ReadError`] at the first atom whose coordinates are none, and if there is no table of atoms.
pub(super) fn frame(input: &mut Input, context: &mut Context) -> Result<Option<Scene>, ReadError> {
    let is_first = input.place() == Default::default();
    if (is_first || is_past_table(input)?) && !find_atoms(input, context, is_first)? {
        return Ok(None);
    }
    let Some((_, columns)) = context.mmcif.range(..=input.place()).next_back() else {
        return Ok(None);
    };
    let columns = columns.clone();
    let mut atoms = Atoms::new(&columns, context.origin);
    let mut row = Row::default();
    // Where nothing follows yet, a comment is taken for the end of the table: writers end a table with one.
    let mut has_ended = false;
    while let Some(line) = input.line()? {
        let text = line.trimmed();
        if !row.is_begun() && (text.is_empty() || text[0] == b'#') {
            has_ended |= !text.is_empty();
            continue;
        }
        if !row.is_begun() && ends_loop(text) {
            // The next call ends here, too.
            has_ended = true;
            input.give_back();
            break;
        }
        has_ended = false;
        if row.is_begun() && line.bytes.starts_with(b";") {
            return Err(line.error(0, "a text of many lines among atoms"));
        }
        row.add(&line)?;
        if row.words.len() < columns.count {
            continue;
        }
        if row.words.len() > columns.count {
            let what =
                format!("{} values; the table has {} columns", row.words.len(), columns.count);
            return Err(line.error(0, what));
        }
        if !atoms.add(&line, &row)? {
            has_ended = true;
            input.give_back();
            break;
        }
        row.clear();
    }
    if row.is_begun() && row.words.len() < columns.count {
        return Err(input.ends(format!(
            "the file ends after {} of {} values of an atom",
            row.words.len(),
            columns.count
        )));
    }
    if atoms.particles.is_empty() {
        return Ok(None);
    }
    if context.follows && !has_ended {
        return Err(input.ends("the file ends within the table of atoms"));
    }
    atoms.finish(&mut context.notes, input.source()).map(Some)
}

/// Whether a line can no longer be a row of the table.
fn ends_loop(text: &[u8]) -> bool {
    let begins =
        |word: &[u8]| text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    begins(b"_") || begins(b"loop_") || begins(b"data_") || begins(b"save_")
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

/// Goes to the first row of the next table of atoms; `false` if there is no further one. A first one there must be.
fn find_atoms(input: &mut Input, context: &mut Context, is_first: bool) -> Result<bool, ReadError> {
    let (mut tags, mut in_text) = (Vec::new(), false);
    let (mut fractions, mut component) = (false, false);
    while let Some(line) = input.line()? {
        if line.bytes.starts_with(b";") {
            in_text = !in_text;
            continue;
        }
        if in_text {
            continue;
        }
        let text = line.trimmed();
        let is_tag = text.len() > 11 && text[..11].eq_ignore_ascii_case(b"_atom_site.");
        fractions |= text.len() > 16 && text[..17].eq_ignore_ascii_case(b"_atom_site_fract_");
        component |= text.len() > 15 && text[..16].eq_ignore_ascii_case(b"_chem_comp_atom.");
        if is_tag {
            let tag = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
            if tag.len() < text.len() && !text[tag.len()..].trim_ascii().starts_with(b"#") {
                return Err(line.error(tag.len() + 1, "_atom_site is no loop"));
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
            return Ok(true);
        }
    }
    if !is_first {
        // A further block may be on its way.
        let ends = || Err(input.ends("the file ends before a further table of atoms"));
        return if context.follows { ends() } else { Ok(false) };
    }
    if fractions {
        let what = "atoms in fractions of a cell: only _atom_site.Cartn_x, _y, _z are read";
        return Err(ReadError::whole(input.source(), what));
    }
    if component {
        let what = "a component's _chem_comp_atom, which is not read; _atom_site is";
        return Err(ReadError::whole(input.source(), what));
    }
    Err(ReadError::whole(input.source(), "no loop over _atom_site").of_end())
}

struct Atoms<'a> {
    columns: &'a Columns,
    particles: Particles,
    model: Option<Vec<u8>>,
    residue: Vec<u8>,
    /// The names of those atoms of the residue that have locations.
    located: HashSet<Box<[u8]>>,
    left_out: usize,
    scratch: Vec<u8>,
}

impl<'a> Atoms<'a> {
    fn new(columns: &'a Columns, origin: Option<DVec3>) -> Self {
        let column = |name: &str| NumberColumn { name: name.into(), values: Vec::new() };
        let kept = vec![column("occupancy"), column("b_factor")];
        let particles = Particles { columns: kept, ..Particles::from(origin) };
        Self {
            columns,
            particles,
            model: None,
            residue: Vec::new(),
            located: HashSet::new(),
            left_out: 0,
            scratch: Vec::new(),
        }
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
            self.scratch.clear();
            let insertion = row.value(columns.insertion);
            for part in [chain, b" ", number_text, b" ", insertion] {
                self.scratch.extend_from_slice(part);
            }
            if self.scratch != self.residue {
                std::mem::swap(&mut self.scratch, &mut self.residue);
                // A large set would take long to clear, however few names are in it.
                self.located = HashSet::new();
            }
            if !self.located.insert(name.into()) {
                self.left_out += 1;
                return Ok(true);
            }
        }
        let at = |axis: usize, called: &str| {
            let word = row.word(columns.position[axis]);
            // A standard uncertainty may follow in brackets.
            let word = word.split(|&byte| byte == b'(').next().unwrap_or_default();
            coordinate(line, 0, word, called)
        };
        let center = DVec3::new(at(0, "Cartn_x")?, at(1, "Cartn_y")?, at(2, "Cartn_z")?);
        let particles = &mut self.particles;
        particles.center(center);
        particles.kind(row.value(columns.symbol), line.number);
        particles.naming(Naming::Name).push(name);
        particles.naming(Naming::Residue).push(row.value(columns.residue));
        particles.naming(Naming::Chain).push(chain);
        particles.naming(Naming::Molecule).push(row.value(columns.entity));
        let residue_number =
            std::str::from_utf8(number_text).ok().and_then(|text| text.parse().ok());
        particles.residue_numbers.push(residue_number.unwrap_or(0));
        for (column, kept) in columns.numbers.iter().zip(&mut particles.columns) {
            kept.values.push(number(row.value(*column)).map_or(f32::NAN, |value| value as f32));
        }
        Ok(true)
    }

    fn finish(self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        if self.left_out > 0 {
            let atoms = if self.left_out == 1 { "atom is" } else { "atoms are" };
            notes.note(format!(
                "{} {atoms} left out: alternate locations after the first",
                self.left_out
            ));
        }
        self.particles.finish(notes, source)
    }
}
