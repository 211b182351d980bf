//! The screen model is vt100's: what it shows after our bytes is what we meant.

mod bytes;

use super::tolerance::{Tolerance, look_same};
use super::{Economy, Encoder, LONGEST_CELL, full};
use crate::cells::masks::opposite;
use crate::cells::{Cell, CellGrid, Color};
use proptest::prelude::*;
use std::num::NonZeroU16;

fn grid_of(columns: u16, rows: u16, cells: &[Cell]) -> CellGrid {
    let mut grid = CellGrid::new(columns, rows);
    grid.cells_mut().copy_from_slice(cells);
    grid
}

fn terminal(columns: u16, rows: u16) -> vt100::Parser {
    let size = |count| NonZeroU16::new(count).expect("a terminal has cells");
    vt100::Parser::new(size(rows), size(columns), 100)
}

fn color(color: vt100::Color) -> Color {
    match color {
        vt100::Color::Default => Color::Default,
        vt100::Color::Idx(index) => Color::Ansi256(index),
        vt100::Color::Rgb(red, green, blue) => Color::Rgb([red, green, blue]),
    }
}

/// The model does not tell the 16 from the first of the 256.
fn as_the_model_names_it(color: Color) -> Color {
    if let Color::Ansi16(index) = color { Color::Ansi256(index % 16) } else { color }
}

fn assert_shows(terminal: &vt100::Parser, grid: &CellGrid) {
    for row in 0..grid.rows() {
        for (column, expected) in (0..grid.columns()).zip(grid.row(row)) {
            let shown = terminal.screen().cell(row, column).expect("inside the screen");
            assert_eq!(shown.inverse(), grid.marked() == Some((column, row)), "{row},{column}");
            let shown = Cell {
                glyph: shown.contents().chars().next().unwrap_or(' '),
                foreground: color(shown.fgcolor()),
                background: color(shown.bgcolor()),
            };
            let expected = Cell {
                glyph: super::cursor::printable(expected.glyph),
                foreground: as_the_model_names_it(expected.foreground),
                background: as_the_model_names_it(expected.background),
            };
            assert!(
                look_same(&shown, &expected) || look_same(&exchanged(&shown), &expected),
                "{row},{column}: {shown:?}, not {expected:?}"
            );
        }
    }
}

/// The same picture, drawn by the complement of the glyph.
fn exchanged(cell: &Cell) -> Cell {
    let named = [cell.foreground, cell.background].map(|color| color != Color::Default);
    let Some(glyph) = opposite(cell.glyph).filter(|_| named == [true, true]) else { return *cell };
    Cell { glyph, foreground: cell.background, background: cell.foreground }
}

fn any_color() -> impl Strategy<Value = Color> + Clone {
    prop_oneof![
        Just(Color::Default),
        (0..16_u8).prop_map(Color::Ansi16),
        any::<u8>().prop_map(Color::Ansi256),
        prop::array::uniform3(prop_oneof![Just(0), Just(9), Just(99), any::<u8>()])
            .prop_map(Color::Rgb),
    ]
}

fn any_cell(
    glyphs: &'static [char],
    color: impl Strategy<Value = Color> + Clone,
) -> impl Strategy<Value = Cell> + Clone {
    let glyph = prop::sample::select(glyphs);
    (glyph, color.clone(), color).prop_map(|(glyph, foreground, background)| Cell {
        glyph,
        foreground,
        background,
    })
}

/// Frames of colours that are nearly the same.
fn frames_alike() -> impl Strategy<Value = Vec<CellGrid>> {
    let color =
        (0..12_u8, 0..3_u8).prop_map(|(level, hue)| Color::Rgb([128 + level, 128, 128 + hue]));
    let color = prop_oneof![9 => color, 1 => any_color()];
    let cell = any_cell(&[' ', '▀', '▄', '▌', '▚', '█', 'x'], color);
    (1..20_u16, 1..6_u16).prop_flat_map(move |(columns, rows)| {
        let count = usize::from(columns) * usize::from(rows);
        let cells = prop::collection::vec(cell.clone(), count);
        let grid = cells.prop_map(move |cells| grid_of(columns, rows, &cells));
        prop::collection::vec(grid, 1..5)
    })
}

/// Few different cells, so that neighbours share colours and frames share cells.
fn any_frames() -> impl Strategy<Value = Vec<CellGrid>> {
    let cell = any_cell(&[' ', 'a', '@', '\u{2580}', '\u{2584}', '\x1b', '\n'], any_color());
    let palette = prop::collection::vec(cell, 1..5);
    (1..40_u16, 1..12_u16, palette).prop_flat_map(|(columns, rows, palette)| {
        let count = usize::from(columns) * usize::from(rows);
        let picks = prop::collection::vec(any::<prop::sample::Index>(), count);
        // Which cells a frame keeps from the one before, in percent.
        let kept = prop::collection::vec(0..100_u8, count);
        // Half of the frames keep the mark.
        let mark = prop::option::of(prop::option::of((0..columns, 0..rows)));
        prop::collection::vec((picks, kept, 0..100_u8, mark), 1..4).prop_map(move |frames| {
            let mut grid = CellGrid::new(columns, rows);
            let mut grids = Vec::new();
            for (picks, kept, keep, mark) in frames {
                let mut next = grid_of(columns, rows, grid.cells());
                next.set_mark(mark.unwrap_or(grid.marked()));
                grid = next;
                for ((cell, pick), chance) in grid.cells_mut().iter_mut().zip(picks).zip(kept) {
                    if chance >= keep {
                        *cell = *pick.get(&palette);
                    }
                }
                grids.push(grid.clone());
            }
            grids
        })
    })
}

proptest! {
    #[test]
    fn the_terminal_shows_each_frame(frames in any_frames()) {
        let mut terminal = terminal(frames[0].columns(), frames[0].rows());
        // Whatever was there before is cleared, and its pen does not bleed.
        terminal.process(b"\x1b[41mleft over\x1b[5;5Hanywhere\x1b[m");
        let mut encoder = Encoder::new();
        for frame in frames {
            let mut bytes = Vec::new();
            encoder.encode(&frame, &mut bytes);
            terminal.process(&bytes);
            assert_shows(&terminal, &frame);
            let mut again = Vec::new();
            encoder.encode(&frame, &mut again);
            prop_assert!(again.is_empty());
        }
    }

    /// What is shown is known, each cell is as near as it should be, and nothing adds up.
    #[test]
    fn what_looks_alike_is_as_near_as_asked_for(frames in frames_alike(), most_bytes in 0..400_usize) {
        let economy = Economy { tolerance: 0.02, most_bytes: usize::MAX };
        let mut near = Tolerance::default();
        near.set(0.02);
        let mut terminal = terminal(frames[0].columns(), frames[0].rows());
        let mut encoder = Encoder::new();
        for frame in &frames {
            let mut bytes = Vec::new();
            encoder.encode_part(frame, economy, &mut bytes);
            terminal.process(&bytes);
            let shown = encoder.shown().expect("something");
            assert_shows(&terminal, shown);
            for (shown, wanted) in shown.cells().iter().zip(frame.cells()) {
                prop_assert!(
                    near.error(shown, wanted).is_finite(),
                    "{shown:?} for {wanted:?}"
                );
            }
            prop_assert_eq!(encoder.is_exact(), shown.cells().iter().zip(frame.cells()).all(|(a, b)| look_same(a, b)));
        }
        // Then all of it, a part at a time.
        let last = frames.last().expect("a frame");
        let mut parts = 0;
        while !encoder.is_exact() {
            let mut bytes = Vec::new();
            encoder.encode_part(last, Economy { tolerance: 0.0, most_bytes: most_bytes.max(1) }, &mut bytes);
            prop_assert!(bytes.len() <= most_bytes + 2 * LONGEST_CELL);
            terminal.process(&bytes);
            parts += 1;
            prop_assert!(parts <= last.cells().len());
        }
        assert_shows(&terminal, last);
    }

    #[test]
    fn lines_show_the_grid(frames in any_frames()) {
        // There is no mark in a file.
        let grid = &grid_of(frames[0].columns(), frames[0].rows(), frames[0].cells());
        let mut bytes = Vec::new();
        full(grid, &mut bytes);
        prop_assert_eq!(bytes.iter().filter(|byte| **byte == b'\n').count(), usize::from(grid.rows()));
        let mut terminal = terminal(grid.columns(), grid.rows() + 1);
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            // What a terminal in cooked mode makes of a newline.
            terminal.process(line);
            terminal.process(b"\r");
        }
        assert_shows(&terminal, grid);
    }
}
