//! Colours as SGR parameters.

use super::cursor::printable;
use super::tolerance::look_same;
use crate::cells::masks::opposite;
use crate::cells::{Cell, Color};

/// Before the parameters, and without any.
const START: &[u8] = b"\x1b[";
pub(super) const RESET: &[u8] = b"\x1b[m";

/// The colours that the terminal will draw the next glyph with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pen {
    pub(super) foreground: Color,
    pub(super) background: Color,
}

impl Pen {
    /// After a reset.
    pub(super) const RESET: Self = Self { foreground: Color::Default, background: Color::Default };

    /// The cell that `glyph` makes.
    pub(super) fn painted(self, glyph: char) -> Cell {
        Cell { glyph, foreground: self.foreground, background: self.background }
    }

    /// The cells that can be sent for `cell`, each with what is then seen, in the glyph of `cell` where that looks the same. They are the
    /// cell itself and the cell with ink and paper exchanged, each also with the pen's own colours; and blanks of one colour. Mostly the
    /// shorter come before the longer.
    pub(super) fn forms(self, cell: &Cell) -> impl Iterator<Item = (Cell, Cell)> {
        let Cell { glyph, foreground, background } = *cell;
        // The terminal's own ink is not its own paper, and of the 16 colours some terminals have only eight for paper.
        let is_free = |color| matches!(color, Color::Ansi256(_) | Color::Rgb(_));
        let other = opposite(glyph).filter(|_| is_free(foreground) && is_free(background));
        let colored = move |ink, paper| Cell { glyph, foreground: ink, background: paper };
        let [ink, paper] = [self.foreground, self.background];
        let own = [
            colored(ink, paper),
            colored(ink, background),
            colored(foreground, paper),
            colored(foreground, background),
        ];
        let own = own.into_iter().map(|cell| (cell, cell));
        let exchanged = [
            colored(paper, ink),
            colored(paper, background),
            colored(foreground, ink),
            colored(foreground, background),
        ];
        let exchanged = exchanged.into_iter().filter_map(move |seen| {
            let [foreground, background] = [seen.background, seen.foreground];
            Some((Cell { glyph: other?, foreground, background }, seen))
        });
        let blanks = [paper, background, foreground, middle(foreground, background)];
        let blanks = blanks.into_iter().filter(move |_| glyph != ' ');
        let blanks = blanks.map(|color| Cell { glyph: ' ', foreground: color, background: color });
        own.chain(exchanged).chain(blanks.map(|blank| (blank, blank)))
    }

    /// How many bytes it takes to draw `cell`, with its glyph.
    pub(super) fn bytes(self, cell: &Cell) -> usize {
        let glyph = printable(cell.glyph).len_utf8();
        if look_same(&self.painted(cell.glyph), cell) {
            return glyph;
        }
        let inkless = cell.glyph == ' ';
        if cell.background == Color::Default && (inkless || cell.foreground == Color::Default) {
            return RESET.len() + glyph;
        }
        let ink = !inkless && self.foreground != cell.foreground;
        let paper = self.background != cell.background;
        let ink = if ink { color_length(cell.foreground, &FOREGROUND) } else { 0 };
        let paper = if paper { color_length(cell.background, &BACKGROUND) } else { 0 };
        START.len() + ink + paper + glyph
    }

    /// Appends the shortest change of the pen that suits `cell`; returns whether there was one.
    pub(super) fn take_up(&mut self, cell: &Cell, out: &mut Vec<u8>) -> bool {
        if look_same(&self.painted(cell.glyph), cell) {
            return false;
        }
        let inkless = cell.glyph == ' ';
        if cell.background == Color::Default && (inkless || cell.foreground == Color::Default) {
            self.put_down(out);
            return true;
        }
        out.extend_from_slice(START);
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
            out.extend_from_slice(RESET);
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

/// How many bytes [`push_color`] appends.
fn color_length(color: Color, layer: &Layer) -> usize {
    let number = |value: u8| 2 + usize::from(value > 9) + usize::from(value > 99);
    match color {
        Color::Default => layer.default.len(),
        Color::Ansi16(index @ 0..8) => number(layer.dark + index),
        Color::Ansi16(index) => number(layer.bright + index % 8),
        Color::Ansi256(index) => layer.palette.len() + number(index),
        Color::Rgb(channels) => layer.rgb.len() + channels.map(number).into_iter().sum::<usize>(),
    }
}

/// The mean of two `Rgb` colours; else the second.
fn middle(a: Color, b: Color) -> Color {
    let (Color::Rgb(a), Color::Rgb(b)) = (a, b) else { return b };
    Color::Rgb(std::array::from_fn(|channel| a[channel].midpoint(b[channel])))
}

fn push_number(value: u8, out: &mut Vec<u8>) {
    out.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
    out.push(b';');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encode::cursor::push_glyph;

    #[test]
    fn as_many_bytes_as_are_appended() {
        let colors = [
            Color::Default,
            Color::Ansi16(3),
            Color::Ansi16(12),
            Color::Ansi256(7),
            Color::Ansi256(77),
            Color::Ansi256(177),
            Color::Rgb([0, 10, 100]),
            Color::Rgb([9, 99, 255]),
        ];
        let all = || colors.into_iter().flat_map(|ink| colors.map(|paper| (ink, paper)));
        for (foreground, background) in all() {
            let pen = Pen { foreground, background };
            for (foreground, background) in all() {
                for glyph in [' ', 'x', '\u{2580}', '\u{7}'] {
                    let cell = Cell { glyph, foreground, background };
                    let mut bytes = Vec::new();
                    pen.clone().take_up(&cell, &mut bytes);
                    push_glyph(glyph, &mut bytes);
                    assert_eq!(pen.bytes(&cell), bytes.len(), "{pen:?}, {cell:?}");
                }
            }
        }
    }
}
