//! How spheres are coloured: in their own colours, or by what the scene's file says of them.
//!
//! Names get colours that everybody can tell apart, in the order in which they first occur. Numbers get a scale that becomes lighter from
//! the least to the largest. Both hold for all frames of a file. Colours of elements are the ones that chemists know.

pub mod categories;
pub mod legend;
pub mod scale;
pub mod seen;

use crate::color::Srgb;
use crate::scene::Scene;
use crate::scene::attributes::{Attributes, Naming, NumberColumn, Own};
use crate::scene::elements::of_number;
use categories::{NEUTRAL, category};
use legend::{Entries, Legend};
use scale::{Range, color_of};
use seen::Seen;
use std::str::FromStr;

/// By what spheres are coloured.
#[derive(Clone, Debug, PartialEq)]
pub enum ColorBy {
    /// The scene's own colours.
    Scene,
    /// The chemical element.
    Element,
    /// Names of one kind.
    Names(Naming),
    /// A column of numbers, by its name.
    Column(Box<str>),
}

/// The kinds of names by which spheres can be coloured.
const NAMINGS: [(&str, Naming); 4] = [
    ("chain", Naming::Chain),
    ("residue", Naming::Residue),
    ("molecule", Naming::Molecule),
    ("type", Naming::Type),
];

impl ColorBy {
    /// Its name: on the command line, and in a legend.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Scene => "scene",
            Self::Element => "element",
            Self::Names(naming) => {
                let named = NAMINGS.iter().find(|(_, other)| other == naming);
                named.map_or("name", |(name, _)| name)
            }
            Self::Column(name) => name,
        }
    }

    /// What there is in a scene to colour by, its own colours first.
    #[must_use]
    pub fn choices(attributes: &Attributes) -> Vec<Self> {
        let names = NAMINGS.iter().filter(|(name, naming)| {
            attributes.names(*naming).is_some() && column_of_numbers(attributes, name).is_none()
        });
        let names = names.map(|(_, naming)| Self::Names(*naming));
        let element = attributes.elements.as_ref().map(|_| Self::Element);
        let columns = attributes
            .columns
            .iter()
            .filter(|column| has_numbers(column) && is_meant(&column.name));
        let columns = columns.map(|column| Self::Column(column.name.clone()));
        [Self::Scene].into_iter().chain(element).chain(names).chain(columns).collect()
    }

    /// What a scene is coloured by unless somebody says otherwise: its chains, if there are several, else its own colours.
    #[must_use]
    pub fn usual(attributes: &Attributes) -> Self {
        let has_chains =
            attributes.names(Naming::Chain).is_some_and(|names| names.table().len() > 1);
        let Own { colors, .. } = attributes.own;
        if has_chains && !colors { Self::Names(Naming::Chain) } else { Self::Scene }
    }

    /// The choice after this one; the first comes after the last.
    #[must_use]
    pub fn next(&self, attributes: &Attributes) -> Self {
        let choices = Self::choices(attributes);
        let place = choices.iter().position(|choice| choice == self).map_or(0, |place| place + 1);
        choices.into_iter().cycle().nth(place).unwrap_or(Self::Scene)
    }
}

impl FromStr for ColorBy {
    type Err = String;

    /// Reads `scene`, `element` or the name of a kind of names; any other text is the name of a column.
    fn from_str(text: &str) -> Result<Self, String> {
        let naming = NAMINGS.iter().find(|(name, _)| *name == text);
        match text {
            "" => {
                Err("scene, element, chain, residue, molecule, type, or a column of numbers"
                    .to_owned())
            }
            "scene" => Ok(Self::Scene),
            "element" => Ok(Self::Element),
            _ => Ok(naming
                .map_or_else(|| Self::Column(text.into()), |(_, naming)| Self::Names(*naming))),
        }
    }
}

/// Colours, one a sphere, and what they mean; the scene's own by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coloring {
    /// `None` if they are the scene's own.
    pub colors: Option<Vec<Srgb>>,
    /// What the colours mean; `None` if that is not known.
    pub legend: Option<Legend>,
}

impl Coloring {
    /// Whether the colours mean numbers.
    #[must_use]
    pub fn has_numbers(&self) -> bool {
        self.legend.as_ref().is_some_and(Legend::has_numbers)
    }
}

/// Finds the colours of `scene` by something. Numbers are coloured from one end of `range` to the other, or of the numbers that there are.
/// Names and numbers that have been `seen` in other frames of its file count too.
///
/// # Errors
/// If `scene` does not have that: says what it has instead.
pub fn coloring(
    scene: &Scene,
    by: &ColorBy,
    range: Option<Range>,
    seen: &mut Seen,
) -> Result<Coloring, String> {
    let attributes = scene.attributes();
    let missing = || {
        let has = ColorBy::choices(attributes);
        let has = has.iter().map(ColorBy::name).collect::<Vec<_>>().join(", ");
        match attributes.column(by.name()) {
            Some(column) => {
                format!("column {} has no number to colour by; there are {has}", column.name)
            }
            None => format!("this scene has no {} to colour by; it has {has}", by.name()),
        }
    };
    let (colors, names): (Vec<_>, Vec<_>) = match by {
        ColorBy::Scene => return Ok(Coloring::default()),
        ColorBy::Element => {
            let elements = attributes.elements.as_ref().ok_or_else(missing)?;
            let color =
                |&number: &u8| of_number(number.into()).map_or(NEUTRAL, |element| element.color);
            let mut counts = [0_usize; 256];
            elements.iter().for_each(|&number| counts[usize::from(number)] += 1);
            let mut present: Vec<_> =
                (0..=255).filter(|&number| counts[usize::from(number)] > 0).collect();
            present.sort_by_key(|&number: &u8| std::cmp::Reverse(counts[usize::from(number)]));
            let name =
                |number: &u8| of_number((*number).into()).map_or("?", |element| element.symbol);
            let names = present.iter().map(|number| (color(number), name(number).to_owned()));
            (elements.iter().map(color).collect(), names.collect())
        }
        ColorBy::Names(naming) => {
            // Where the file itself has a column of numbers with that name, that is meant.
            if let Some(column) = column_of_numbers(attributes, by.name()) {
                return Ok(by_numbers(column, range, seen));
            }
            let names = attributes.names(*naming).ok_or_else(missing)?;
            // A sphere without a name takes no colour away from others.
            let mut place = |name: &str| (!name.is_empty()).then(|| seen.place(*naming, name));
            let places: Vec<_> = names.table().iter().map(|name| place(name)).collect();
            let colors = places.iter().map(|place| place.map_or(NEUTRAL, category));
            let table: Vec<_> = colors.collect();
            let color = |&index: &u32| table.get(index as usize).copied().unwrap_or(NEUTRAL);
            // They are listed in the same order in all frames, those without a name last.
            let mut order: Vec<_> = (0..table.len()).collect();
            order.sort_by_key(|&index| places[index].unwrap_or(usize::MAX));
            let shown =
                |name: &str| if name.is_empty() { "none".to_owned() } else { name.to_owned() };
            let shown = order.iter().map(|&index| (table[index], shown(&names.table()[index])));
            (names.indices().iter().map(color).collect(), shown.collect())
        }
        ColorBy::Column(name) => {
            let column = column_of_numbers(attributes, name).ok_or_else(missing)?;
            return Ok(by_numbers(column, range, seen));
        }
    };
    let legend = Legend::new(by.name(), Entries::Names(names));
    Ok(Coloring { colors: Some(colors), legend: Some(legend) })
}

/// Whether a column can be asked for by its name: that is not empty, and means no other choice, except names of a kind.
fn is_meant(name: &str) -> bool {
    let is_naming = NAMINGS.iter().any(|(naming, _)| *naming == name);
    is_naming || matches!(name.parse::<ColorBy>(), Ok(ColorBy::Column(_)))
}

/// The column of that name, unless no number is in it.
fn column_of_numbers<'a>(attributes: &'a Attributes, name: &str) -> Option<&'a NumberColumn> {
    attributes.column(name).filter(|column| has_numbers(column))
}

/// Whether there is a number in a column: in one of words there is none.
fn has_numbers(column: &NumberColumn) -> bool {
    column.values.iter().any(|value| !value.is_nan())
}

fn by_numbers(column: &NumberColumn, range: Option<Range>, seen: &mut Seen) -> Coloring {
    let range = range.unwrap_or_else(|| seen.range(column));
    let color = |&value: &f32| range.place(value).map_or(NEUTRAL, color_of);
    let has_none = column.values.iter().any(|value| value.is_nan());
    let legend = Legend::new(&column.name, Entries::Numbers { range, has_none });
    Coloring { colors: Some(column.values.iter().map(color).collect()), legend: Some(legend) }
}

#[cfg(test)]
mod tests;
