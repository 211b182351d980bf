//! Colours as SGR parameters.

use super::tolerance::{Tolerance, look_same};
use crate::cells::masks::opposite;
use crate::cells::{Cell, Color};

/// The colours that the terminal will draw the next glyph with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pen {
    foreground: Color,
    background: Color,
}

impl Pen {
    /// After a reset.
    pub(super) const RESET: Self = Self { foreground: Color::Default, background: Color::Default };

    /// Whether `cell` can be drawn without a word about colour, or what looks alike. A space has no ink.
    pub(super) fn suits(self, cell: &Cell, tolerance: &Tolerance) -> bool {
        tolerance.allows(self.background, cell.background)
            && (cell.glyph == ' ' || tolerance.allows(self.foreground, cell.foreground))
    }

    /// The cell that `glyph` makes.
    pub(super) fn painted(self, glyph: char) -> Cell {
        Cell { glyph, foreground: self.foreground, background: self.background }
    }

    /// `cell`, or what looks the same with ink and paper exchanged, if that takes fewer colours; and in place of colours
    /// the pen's own, if they look alike.
    pub(super) fn nearest_form(self, cell: &Cell, tolerance: &Tolerance) -> Cell {
        let Cell { glyph, foreground, background } = *cell;
        let kept = |ink, paper| {
            u8::from(tolerance.allows(self.foreground, ink))
                + u8::from(tolerance.allows(self.background, paper))
        };
        // The terminal's own ink is not its own paper, and of the 16 some have only eight for paper.
        let is_free = |color| matches!(color, Color::Ansi256(_) | Color::Rgb(_));
        let other = opposite(glyph).filter(|_| is_free(foreground) && is_free(background));
        let form = match other {
            Some(glyph) if kept(background, foreground) > kept(foreground, background) => {
                Cell { glyph, foreground: background, background: foreground }
            }
            _ => *cell,
        };
        let nearest = |own, color| if tolerance.allows(own, color) { own } else { color };
        Cell {
            glyph: form.glyph,
            foreground: nearest(self.foreground, form.foreground),
            background: nearest(self.background, form.background),
        }
    }

    /// Appends the shortest change that suits `cell`; whether there was one.
    pub(super) fn take_up(&mut self, cell: &Cell, out: &mut Vec<u8>) -> bool {
        if look_same(&self.painted(cell.glyph), cell) {
            return false;
        }
        let inkless = cell.glyph == ' ';
        if cell.background == Color::Default && (inkless || cell.foreground == Color::Default) {
            self.put_down(out);
            return true;
        }
        out.extend_from_slice(b"\x1b[");
        if !inkless && self.foreground != cell.foreground {
            self.foreground = cell.foreground;
            push_color(cell.foreground, &FOREGROUND, out);
        }
        if self.background != cell.background {
            self.background = cell.background;
            push_color(cell.background, &BACKGROUND, out);
        }
        // Every parameter was pushed with a semicolon behind it.
        if let Some(last) = out.last_mut() {
            *last = b'm';
        }
        true
    }

    /// Resets, if there is anything to reset.
    pub(super) fn put_down(&mut self, out: &mut Vec<u8>) {
        if *self != Self::RESET {
            *self = Self::RESET;
            out.extend_from_slice(b"\x1b[m");
        }
    }
}

/// The parameters of one of the two layers, each with a semicolon behind it.
struct Layer {
    default: &'static [u8],
    /// Codes of the eight dark colours start here, ...
    dark: u8,
    /// ... of the eight bright ones here.
    bright: u8,
    palette: &'static [u8],
    rgb: &'static [u8],
}

const FOREGROUND: Layer =
    Layer { default: b"39;", dark: 30, bright: 90, palette: b"38;5;", rgb: b"38;2;" };
const BACKGROUND: Layer =
    Layer { default: b"49;", dark: 40, bright: 100, palette: b"48;5;", rgb: b"48;2;" };

fn push_color(color: Color, layer: &Layer, out: &mut Vec<u8>) {
    match color {
        Color::Default => out.extend_from_slice(layer.default),
        Color::Ansi16(index @ 0..8) => push_number(layer.dark + index, out),
        Color::Ansi16(index) => push_number(layer.bright + index % 8, out),
        Color::Ansi256(index) => {
            out.extend_from_slice(layer.palette);
            push_number(index, out);
        }
        Color::Rgb([red, green, blue]) => {
            out.extend_from_slice(layer.rgb);
            push_number(red, out);
            push_number(green, out);
            push_number(blue, out);
        }
    }
}

fn push_number(value: u8, out: &mut Vec<u8>) {
    out.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
    out.push(b';');
}
