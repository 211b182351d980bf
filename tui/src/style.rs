//! What a picture is to be: its tier, characters, colours and samples.

use clap::ValueEnum;
use spherule_kernel::Tier;

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: glyphs alone.
    Never,
    /// The 16 of the user's theme.
    Ansi16,
    /// The xterm palette.
    Ansi256,
    /// 24 bits.
    Truecolor,
}

/// Which characters may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Charset {
    /// Printable ASCII.
    Ascii,
    /// Half blocks: two pixels a cell.
    Half,
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
    /// Rays a cell, at least one.
    pub samples: u32,
    /// Width of a cell over its height.
    pub cell_aspect: f32,
}

/// The size of a picture in a pipe.
pub const PIPE_SIZE: (u16, u16) = (80, 24);

impl Style {
    /// A picture for a pipe: exact, in ASCII, without colour, 4 rays a cell of the usual shape.
    pub const PLAIN: Self = Self {
        accuracy: Tier::Exact,
        charset: Charset::Ascii,
        depth: ColorDepth::Never,
        samples: 4,
        cell_aspect: 0.5,
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
