//! A chemical component: the molecule of a block of data that has no other atoms, as in the wwPDB's dictionary of components and in
//! libraries of monomers.

use super::row::Row;
use super::rows::read_rows;
use crate::scene::Scene;
use crate::scene::attributes::Naming;
use crate::scene::fixed::Fixed;
use crate::scene::format::words::excerpt;
use crate::scene::input::{Input, Line};
use crate::scene::notes::Notes;
use crate::scene::number::number;
use crate::scene::particles::Particles;
use crate::scene::read_error::ReadError;
use glam::DVec3;

/// What names of columns begin with.
pub(super) const CATEGORY: &[u8] = b"_chem_comp_atom.";

/// The names of positions: as they were seen, as they were computed, and as libraries have them.
const POSITIONS: [[&str; 3]; 3] = [
    ["model_Cartn_x", "model_Cartn_y", "model_Cartn_z"],
    ["pdbx_model_Cartn_x_ideal", "pdbx_model_Cartn_y_ideal", "pdbx_model_Cartn_z_ideal"],
    ["x", "y", "z"],
];

/// The names of columns; of an atom alone, which is no loop, its values, too.
#[derive(Default)]
pub(super) struct Heading {
    names: Vec<String>,
    row: Row,
    line: usize,
}

impl Heading {
    pub(super) fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Adds a line that begins with the name of a column.
    ///
    /// # Errors
    /// As [`Row::add`].
    pub(super) fn add(&mut self, line: &Line<'_>) -> Result<(), ReadError> {
        let first = self.row.words.len();
        self.row.add(line)?;
        let name = self.row.word(first).get(CATEGORY.len()..).unwrap_or_default();
        self.names.push(String::from_utf8_lossy(name).into_owned());
        self.row.words.remove(first);
        self.line = line.number;
        Ok(())
    }
}

/// The atoms of a component.
pub(super) struct Component {
    particles: Particles,
    /// How many have no position.
    left_out: usize,
}

impl Component {
    /// Reads the table below `heading`; `None` if no atom has a position. Of several positions, those are taken that most atoms have.
    ///
    /// # Errors
    /// [`ReadError`] at the first position that is no finite number.
    pub(super) fn read(
        heading: &Heading,
        input: &mut Input,
        fixed: Fixed,
    ) -> Result<Option<Self>, ReadError> {
        let mut table = Table::of(&heading.names, fixed);
        if table.places.is_empty() {
            return Ok(None);
        }
        let (count, row) = (heading.names.len(), &heading.row);
        if row.is_begun() {
            let wrong = |what: String| ReadError::at(input.source(), heading.line, 1, what);
            if row.words.len() != count {
                let what = format!("{} values of an atom that has {count}", row.words.len());
                return Err(wrong(what));
            }
            table.add(row, heading.line).map_err(wrong)?;
        } else {
            read_rows(input, count, |line, row| {
                table.add(row, line.number).map_err(|what| line.error(0, what))?;
                Ok(true)
            })?;
        }
        let most = table.components.into_iter().min_by_key(|component| component.left_out);
        Ok(most.filter(|component| !component.particles.is_empty()))
    }

    /// The scene.
    ///
    /// # Errors
    /// As [`Particles::finish`].
    pub(super) fn finish(self, notes: &mut Notes, source: &str) -> Result<Scene, ReadError> {
        match self.left_out {
            0 => {}
            1 => notes.note("1 atom without a position is left out"),
            count => notes.note(format!("{count} atoms without a position are left out")),
        }
        self.particles.finish(notes, source)
    }
}

/// The columns that are read, and what they have told.
struct Table {
    symbol: Option<usize>,
    name: Option<usize>,
    residue: Option<usize>,
    /// Those of x, y, z, and the atoms there.
    places: Vec<[usize; 3]>,
    components: Vec<Component>,
}

impl Table {
    fn of(names: &[String], fixed: Fixed) -> Self {
        let find = |name: &str| names.iter().position(|other| other.eq_ignore_ascii_case(name));
        let place = |axes: &[&str; 3]| -> Option<[usize; 3]> {
            Some([find(axes[0])?, find(axes[1])?, find(axes[2])?])
        };
        let places: Vec<[usize; 3]> = POSITIONS.iter().filter_map(place).collect();
        let component = || Component { particles: Particles::from(fixed), left_out: 0 };
        Self {
            symbol: find("type_symbol"),
            name: find("atom_id"),
            residue: find("comp_id"),
            components: places.iter().map(|_| component()).collect(),
            places,
        }
    }

    /// Adds the atom of a row, which is in `line`.
    ///
    /// # Errors
    /// What is wrong with it.
    fn add(&mut self, row: &Row, line: usize) -> Result<(), String> {
        for (place, component) in self.places.iter().zip(&mut self.components) {
            let words = place.map(|column| row.value(Some(column)));
            if words.iter().any(|word| word.is_empty()) {
                component.left_out += 1;
                continue;
            }
            let mut center = DVec3::ZERO;
            for (axis, word) in words.into_iter().enumerate() {
                let value = number(word).filter(|value| (*value as f32).is_finite());
                center[axis] =
                    value.ok_or_else(|| format!("{} is not a finite coordinate", excerpt(word)))?;
            }
            let particles = &mut component.particles;
            particles.center(center);
            particles.kind(row.value(self.symbol), line);
            particles.naming(Naming::Name).push(row.value(self.name));
            particles.naming(Naming::Residue).push(row.value(self.residue));
        }
        Ok(())
    }
}
