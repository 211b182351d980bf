//! How near a picture in a terminal comes to the picture that it stands for.
//!
//! The bytes that a program writes become a [screen], the screen's cells become pixels, 8x16 a cell, and these are compared with the truth:
//! a picture of as many pixels. Nothing here comes from the program: shapes of blocks are from Unicode's [charts](geometry), letters from
//! [fonts](font), colours from [palettes](palette).
//!
//! | room | holds |
//! |---|---|
//! | [`screen`] | what a terminal shows after some bytes |
//! | [`palette`] | what the 16 colours of themes are, and xterm's 256 |
//! | [`cell`] | how much of each pixel of a cell a glyph covers |
//! | [`geometry`] | the coverage of blocks |
//! | [`font`] | the coverage of letters and dots |
//! | [`ink`] | the program's tables of ink, measured again |
//! | [`srgb`] | colours of a display, and their light |
//! | [`light`] | pictures in linear light: from a screen, from a PNG; blurred |
//! | [`flip`] | the difference that a person sees |
//! | [`ssim`] | likeness of structure |
//! | [`figures`] | the figures: what of the truth is seen from reading distance, from across the room, from near, and its shapes alone |
//! | [`motion`] | how pictures change, against how the truth does |
//! | [`scenes`] | scenes that are in no program: a dark one, one like noise |

pub mod cell;
pub mod figures;
pub mod flip;
pub mod font;
pub mod geometry;
pub mod ink;
pub mod light;
pub mod motion;
pub mod palette;
pub mod scenes;
pub mod screen;
pub mod srgb;
pub mod ssim;

use figures::{Figures, Truth};
use font::Font;
use light::Light;
use palette::Sixteen;
use screen::Screen;

/// Scores what the terminal shows after `bytes` against `truth`, in a terminal with these colours and this font.
///
/// # Errors
/// If the bytes are no picture of the truth's size, or hold what no font or terminal here knows.
pub fn score(
    bytes: &[u8],
    truth: &Truth,
    palette: &Sixteen,
    font: Font,
) -> Result<Figures, String> {
    let (columns, rows) = truth.cells();
    let screen = Screen::read(bytes, columns, rows, palette)?;
    Ok(truth.figures(&Light::of_screen(&screen, font)?))
}
