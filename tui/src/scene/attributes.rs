//! What a file says of its spheres besides place and size: element, chain, residue, molecule, type, name, columns of
//! numbers. Colours and labels are made of it.
//!
//! An attribute that no sphere has takes no memory. One that is there takes a number a sphere: an atomic number, a
//! number of the file's, or an index into a table of the names that occur. Spheres have no texts of their own.

mod names;

pub use names::{Names, NamesBuilder};

use super::elements::of_number;

/// The attributes whose values are names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Naming {
    /// The chain of a macromolecule.
    Chain,
    /// What the residue is called: `ALA`, `HOH`. Its number is in [`Attributes::residue_numbers`].
    Residue,
    /// The molecule: a number in a file of LAMMPS, a segment, an entity.
    Molecule,
    /// The type: what the file says a particle is. In XYZ the first column, in LAMMPS its `type`.
    Type,
    /// The name of the atom in its residue: `CA`.
    Name,
}

impl Naming {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Chain, Self::Residue, Self::Molecule, Self::Type, Self::Name];
}

/// A column of numbers that the file has a name for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NumberColumn {
    /// The name in the file: charge, b_factor, a magnitude.
    pub name: Box<str>,
    /// One a sphere; NaN where there is none.
    pub values: Vec<f32>,
}

/// The attributes of all spheres of a scene. Every column that is there has a value a sphere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// Atomic numbers; 0 where none is known.
    pub elements: Option<Vec<u8>>,
    /// The numbers of residues in their chains.
    pub residue_numbers: Option<Vec<i32>>,
    /// Names, in the order of [`Naming::ALL`].
    pub(super) names: [Option<Names>; Naming::ALL.len()],
    /// Other numbers.
    pub columns: Vec<NumberColumn>,
    /// Whether the file names a colour for every sphere, or a radius.
    pub own: Own,
}

/// What a file itself states, which is otherwise chosen by attributes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Own {
    /// Colours.
    pub colors: bool,
    /// Radii.
    pub radii: bool,
}

impl NumberColumn {
    /// A column without numbers yet.
    pub(crate) fn named(name: impl Into<Box<str>>) -> Self {
        Self { name: name.into(), values: Vec::new() }
    }
}

impl Attributes {
    /// The names of one kind; `None` if the file has none.
    #[must_use]
    pub fn names(&self, naming: Naming) -> Option<&Names> {
        self.names[naming as usize].as_ref()
    }

    /// Sets the names of one kind.
    pub fn set_names(&mut self, naming: Naming, names: Option<Names>) {
        self.names[naming as usize] = names;
    }

    /// The column of numbers that the file calls `name`, in any case.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&NumberColumn> {
        self.columns.iter().find(|column| column.name.eq_ignore_ascii_case(name))
    }

    /// The atomic number of sphere `index`; `None` where none is known.
    #[must_use]
    pub fn element(&self, index: usize) -> Option<u8> {
        let number = *self.elements.as_ref()?.get(index)?;
        (number > 0).then_some(number)
    }

    /// What a sphere is called by its attributes: `CA ALA 12 A` in a chain, else `C 7`, where 7 is its place, from 1.
    /// `None` if the file says nothing of what it is.
    #[must_use]
    pub fn label(&self, index: usize) -> Option<String> {
        let name = |naming| self.names(naming).and_then(|names| names.get(index));
        let symbol = self.element(index).map(|number| of_number(number.into()));
        let symbol = symbol.flatten().map(|element| element.symbol);
        let what = name(Naming::Name).or(symbol).or_else(|| name(Naming::Type))?;
        let Some(residue) = name(Naming::Residue) else {
            return Some(format!("{what} {}", index + 1));
        };
        let mut label = format!("{what} {residue}");
        if let Some(number) = self.residue_numbers.as_ref().and_then(|numbers| numbers.get(index)) {
            label += &format!(" {number}");
        }
        if let Some(chain) = name(Naming::Chain) {
            label += &format!(" {chain}");
        }
        Some(label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(of: &[&str]) -> Option<Names> {
        let mut builder = NamesBuilder::default();
        for name in of {
            builder.push(name.as_bytes());
        }
        builder.finish()
    }

    #[test]
    fn labels_say_what_a_sphere_is() {
        let mut attributes = Attributes::default();
        assert_eq!(attributes.label(0), None);
        attributes.set_names(Naming::Type, names(&["Xx", "C"]));
        attributes.elements = Some(vec![0, 6]);
        let labels = [attributes.label(0), attributes.label(1), attributes.label(2)];
        assert_eq!(labels, [Some("Xx 1".to_owned()), Some("C 2".to_owned()), None]);
        attributes.set_names(Naming::Name, names(&["", "CA"]));
        attributes.set_names(Naming::Residue, names(&["", "ALA"]));
        attributes.set_names(Naming::Chain, names(&["", "B"]));
        attributes.residue_numbers = Some(vec![0, -3]);
        assert_eq!(attributes.label(0), Some("Xx 1".to_owned()));
        assert_eq!(attributes.label(1), Some("CA ALA -3 B".to_owned()));
    }

    #[test]
    fn columns_are_found_in_any_case() {
        let column = NumberColumn { name: "Charge".into(), values: vec![1.0] };
        let attributes = Attributes { columns: vec![column.clone()], ..Attributes::default() };
        assert_eq!(attributes.column("charge"), Some(&column));
        assert_eq!(attributes.column("mass"), None);
    }
}
