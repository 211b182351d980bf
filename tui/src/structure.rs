//! How the spheres that a ray may meet are found: by asking all of them, or by a structure that
//! is built over them first. No answer depends on it, but for false hits of `Fast` that structures
//! lose; only the time does.

mod choose;
mod scene;
mod search;

pub use choose::{Workload, choose, picture_kind};
pub use scene::{PictureSearch, SceneStructures, TreeMemory};
pub use search::{Search, TileLists};

/// What is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// The list of spheres, from end to end.
    Brute,
    /// The spheres in the order of their depth, sorted for every picture and culled by tiles of
    /// it: for rays that share an origin or a direction; the others ask the list.
    Tiles,
    /// A tree of boxes, built once.
    Bvh,
}

impl Structure {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Brute, Self::Tiles, Self::Bvh];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Brute => "brute",
            Self::Tiles => "tiles",
            Self::Bvh => "bvh",
        }
    }
}

/// What `--structure` says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StructureChoice {
    /// Whatever is likely the fastest: see [`choose`].
    #[default]
    Auto,
    /// This one.
    Only(Structure),
}

impl StructureChoice {
    /// The name on the command line.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Only(structure) => structure.as_str(),
        }
    }

    /// The one after this, around in a circle.
    #[must_use]
    pub fn next(self) -> Self {
        let next = match self {
            Self::Auto => Structure::ALL.first(),
            Self::Only(this) => Structure::ALL.iter().skip_while(|&&one| one != this).nth(1),
        };
        next.map_or(Self::Auto, |&structure| Self::Only(structure))
    }
}

/// What rays that come one after the other have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaysKind {
    /// An origin or a direction, or nearly so, and they lie close together: camera rays, shadow rays
    /// to one light.
    Coherent,
    /// Nothing.
    Incoherent,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_choices_form_a_circle() {
        let mut choice = StructureChoice::Auto;
        let mut names = Vec::new();
        for _ in 0..=Structure::ALL.len() {
            names.push(choice.as_str());
            choice = choice.next();
        }
        assert_eq!(names, ["auto", "brute", "tiles", "bvh"]);
        assert_eq!(choice, StructureChoice::Auto);
    }
}
