//! What a terminal shows after some bytes.

use super::palette::{Rgb, Sixteen, indexed};
use std::num::NonZeroU16;
use vt100::{Callbacks, Color, Parser};

/// One cell of a screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The character.
    pub glyph: char,
    /// The colour of its ink.
    pub ink: Rgb,
    /// The colour behind it.
    pub behind: Rgb,
}

/// What a terminal shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Screen {
    /// Cells side by side.
    pub columns: u16,
    /// The cells, row by row.
    pub cells: Vec<Shown>,
}

/// The terminal's own colours: light grey on black.
const INK: Rgb = [229; 3];
const BEHIND: Rgb = [0; 3];

impl Screen {
    /// The screen after lines as they are written to a file: each line ends in a newline, which a terminal shows as
    /// carriage return and line feed.
    ///
    /// # Errors
    /// If there are more or fewer lines than rows, or if anything is not understood: otherwise half a picture would be
    /// scored.
    pub fn read(bytes: &[u8], columns: u16, rows: u16, palette: &Sixteen) -> Result<Self, String> {
        let lines = bytes.iter().filter(|&&byte| byte == b'\n').count();
        if lines != usize::from(rows) {
            return Err(format!("{lines} lines for {rows} rows"));
        }
        let size = |count: u16| NonZeroU16::new(count).ok_or("no cells");
        // A row more, so that the last newline does not scroll.
        let tall = size(rows.saturating_add(1))?;
        let mut parser =
            Parser::new_with_callbacks(tall, size(columns)?, 0, NotUnderstood::default());
        for line in bytes.split_inclusive(|&byte| byte == b'\n') {
            parser.process(line);
            parser.process(b"\r");
        }
        if let Some(what) = &parser.callbacks().0 {
            return Err(what.clone());
        }
        let screen = parser.screen();
        let shown = |(row, column)| {
            let cell = screen.cell(row, column).ok_or("outside of the screen")?;
            let color = |color, own| match color {
                Color::Default => own,
                Color::Idx(index) => indexed(index, palette),
                Color::Rgb(red, green, blue) => [red, green, blue],
            };
            let mut colors = [color(cell.fgcolor(), INK), color(cell.bgcolor(), BEHIND)];
            if cell.inverse() {
                colors.reverse();
            }
            let [ink, behind] = colors;
            let mut text = cell.contents().chars();
            match (text.next(), text.next()) {
                _ if cell.is_wide() || cell.is_wide_continuation() => {
                    Err(format!("{:?} is wide", cell.contents()))
                }
                (first, None) => Ok(Shown { glyph: first.unwrap_or(' '), ink, behind }),
                _ => Err(format!("{:?} in one cell", cell.contents())),
            }
        };
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let cells = places.map(shown).collect::<Result<_, _>>();
        Ok(Self { columns, cells: cells? })
    }
}

/// The first thing that the terminal did not understand.
#[derive(Default)]
struct NotUnderstood(Option<String>);

impl NotUnderstood {
    fn note(&mut self, what: String) {
        self.0.get_or_insert(what);
    }
}

impl Callbacks for NotUnderstood {
    fn unhandled_char(&mut self, _: &mut vt100::Screen, character: char) {
        self.note(format!("the character {character:?}"));
    }

    fn unhandled_control(&mut self, _: &mut vt100::Screen, byte: u8) {
        self.note(format!("the control character {byte}"));
    }

    fn unhandled_escape(&mut self, _: &mut vt100::Screen, _: Option<u8>, _: Option<u8>, byte: u8) {
        self.note(format!("escape {}", char::from(byte)));
    }

    fn unhandled_csi(
        &mut self,
        _: &mut vt100::Screen,
        _: Option<u8>,
        _: Option<u8>,
        parameters: &[&[u16]],
        character: char,
    ) {
        self.note(format!("escape [ {parameters:?} {character}"));
    }

    fn on_scroll(&mut self, _: vt100::capture::RowContents<'_>, _: bool) {
        self.note("the screen scrolled".to_owned());
    }
}
