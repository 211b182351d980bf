//! What a picture is to be: its tier, characters, colours and samples.

use crate::choice::Auto;
pub use crate::palette::ColorDepth;
use crate::palette::Theme;
use crate::scene::Scene;
use crate::scene::attributes::Naming;
use clap::ValueEnum;
use spherule_kernel::Tier;

/// Which characters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Charset {
    /// Printable ASCII; in every font
    Ascii,
    /// Halves of a cell; in every font
    Half,
    /// Quarters; in most fonts
    Quadrant,
    /// Sixths; in fonts with Unicode 13
    Sextant,
    /// Eighths of two columns; in fonts with Unicode 16
    Octant,
    /// Dots, as plots have them; in most fonts
    Braille,
    /// All of these that are blocks, and bars; in fonts with Unicode 16
    Block,
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Which tier decides hits.
    pub accuracy: Tier,
    /// Which characters may be used.
    pub charset: Charset,
    /// How many colours there are.
    pub depth: ColorDepth,
    /// What the 16 colours are, if there are so many.
    pub theme: Theme,
    /// Rays a cell, at least one; `None` if as many as the cell needs.
    pub samples: Auto<u32>,
    /// Width of a cell over its height.
    pub cell_aspect: f32,
    /// How far away the eye is, in widths of a cell.
    pub distance: f32,
    /// What tells spheres of a crowd apart.
    pub aids: Aids,
}

/// What tells spheres of a crowd apart, beside their colours. An aid that is not asked for costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Aids {
    /// Spheres get little light where others are in the way.
    pub occlusion: bool,
    /// Dark edges where something lies far behind what is beside it, or is part of something else.
    pub edges: bool,
    /// What is far away fades into the background.
    pub depth_cue: bool,
}

impl Aids {
    /// None.
    pub const NONE: Self = Self { occlusion: false, edges: false, depth_cue: false };
    /// All.
    pub const ALL: Self = Self { occlusion: true, edges: true, depth_cue: true };

    /// All aids for a scene with chains, which is a heap of atoms without them; none for other scenes.
    #[must_use]
    pub fn usual(scene: &Scene) -> Self {
        let chains = scene.attributes().names(Naming::Chain);
        let has_chains =
            chains.is_some_and(|names| names.table().iter().any(|name| !name.is_empty()));
        if has_chains { Self::ALL } else { Self::NONE }
    }
}

/// The usual distance of the eye, in widths of a cell: 60 cm over 2.2 mm.
pub const CHAIR: f32 = 273.0;

/// The size of a picture in a pipe.
pub const PIPE_SIZE: (u16, u16) = (80, 24);

impl Style {
    /// A picture for a pipe: exact, in ASCII, without colour, in cells of the usual shape.
    pub const PLAIN: Self = Self {
        accuracy: Tier::Exact,
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        theme: Theme::XTERM,
        samples: None,
        cell_aspect: 0.5,
        distance: CHAIR,
        aids: Aids::NONE,
    };

    /// Width over height of a picture of `columns` x `rows` cells; 1 if it has no area.
    #[must_use]
    pub fn picture_aspect(&self, columns: u16, rows: u16) -> f64 {
        if columns == 0 || rows == 0 {
            return 1.0;
        }
        f64::from(columns) * f64::from(self.cell_aspect) / f64::from(rows)
    }
}
