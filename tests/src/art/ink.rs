//! The program's tables of ink, measured again.

use super::cell::{HEIGHT, WIDTH};
use super::font::Font;
use std::fmt::Write;

/// The lines between the brackets of a table of `tui/src/ink.rs`, one for each character.
///
/// # Panics
/// If the font has no ASCII.
#[must_use]
pub fn lines(font: Font) -> String {
    let mut lines = String::new();
    for character in ' '..='~' {
        let parts = parts(font, character).map(|part| format!("{part:x}")).concat();
        let groups = [0, 4, 8, 12, 16, 20, 24, 28].map(|start| &parts[start..start + 4]).join("_");
        let name = if character == ' ' { "space".to_owned() } else { character.to_string() };
        let _ = writeln!(lines, "    0x{groups}, // {name}");
    }
    lines
}

/// The covered share of 4x8 equal parts of the cell, in fifteenths, row by row from the top left.
///
/// # Panics
/// If the font has no such character.
#[must_use]
pub fn parts(font: Font, character: char) -> [u8; 32] {
    let coverage = font.coverage(character).expect("a glyph");
    let (width, height) = (WIDTH / 4, HEIGHT / 8);
    std::array::from_fn(|part| {
        let corner = part / 4 * height * WIDTH + part % 4 * width;
        let pixels = (0..width * height).map(|i| coverage[corner + i / width * WIDTH + i % width]);
        (pixels.sum::<f32>() / (width * height) as f32 * 15.0).round() as u8
    })
}
