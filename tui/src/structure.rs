//! Finds the spheres that a ray may meet: all of them are searched, or a structure that is built over them first. The
//! choice changes the time, and no answer except false hits of `Fast` and `Geometric`, which a tree and a depth list
//! may lose. In object order the spheres find the rays instead.

pub mod choose;
pub mod object_order;
pub mod openness;
pub mod picture_search;
pub mod scene;
pub mod screen;
pub mod search;
mod tracing;

use clap::ValueEnum;

/// Which of the two loops over rays and spheres is the outer one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Order {
    /// For each ray the spheres, by a structure
    #[default]
    Image,
    /// For each sphere the rays that may meet it
    Object,
}

/// What is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Structure {
    /// All spheres, from end to end
    Brute,
    /// The spheres by their depth, for rays that share an origin or a direction; other rays search all
    #[value(alias = "tiles")]
    DepthList,
    /// A tree of boxes, built once
    Bvh,
}

impl Structure {
    /// The name in reports. Scripts compare it, so the depth list keeps the name that it had first.
    #[must_use]
    pub const fn in_reports(self) -> &'static str {
        match self {
            Self::Brute => "brute",
            Self::DepthList => "tiles",
            Self::Bvh => "bvh",
        }
    }
}
