//! Frames in pixels, with text over them.

use super::session::Viewer;
use super::shown::Outcome;
use crate::cells::{Cell, CellGrid, Color};
use crate::choice::Auto;
use crate::color::Srgb;
use crate::draw::pixels::PixelGrid;
use crate::picture::Image;
use crate::pixels::{Output, Protocol};
use crate::terminal::{ASKED_IMAGE, Reply, pixels_of_cell};

/// A cell where the picture is seen, and no text: its glyph is in no font.
pub(super) const NO_TEXT: Cell = Cell { glyph: '\u{10FFFF}', ..Cell::BLANK };
/// The most pixels of a picture, which the terminal then enlarges: more take longer than they are seen.
const MOST_PIXELS: u32 = 2_500_000;
/// The most pixels of a picture that is not enlarged: no screen has more, whatever a terminal says of its cells.
const LARGEST_SCREEN: u32 = 1 << 26;
/// Colours of text over pixels, where the terminal has not told the colour behind it.
const INK: Color = Color::Rgb([229; 3]);
const PAPER: Color = Color::Rgb([0; 3]);

impl Viewer {
    /// The protocol for what is shown now; what tiers get wrong is shown in cells, and what is too large.
    pub(super) fn protocol(&self) -> Auto<Protocol> {
        let protocol = self.pixels.protocol.filter(|_| self.state.shown.comparison.is_none());
        protocol.filter(|&protocol| self.exceeded(protocol).is_none())
    }

    /// How many pixels the terminal shows, if the picture has more by this protocol: sixels are not enlarged.
    fn exceeded(&self, protocol: Protocol) -> Option<(u32, u32)> {
        let most = self.terminal.abilities().sixel_pixels?;
        let size = self.state.size();
        let cell = self.pixels_of_cell(protocol, size);
        let is_more = cell.0 * u32::from(size.0) > most.0 || cell.1 * u32::from(size.1) > most.1;
        (is_more && matches!(protocol, Protocol::Sixel { .. })).then_some(most)
    }

    /// Tells the user if the picture is too large for sixels, which were asked for by name.
    pub(super) fn say_too_large(&mut self) {
        let exceeded = self.pixels.protocol.and_then(|protocol| self.exceeded(protocol));
        if let Some((width, height)) = exceeded.filter(|_| self.pixels.output == Output::Sixel) {
            self.notice =
                Some(format!("--output sixel: the terminal shows {width}x{height} pixels at most"));
        }
    }

    /// Falls back to cells where the terminal has told that it knows no such images, or has said nothing of the first.
    /// Goes on to pixels where one behind tmux says late that it has them.
    pub(super) fn heed_image_reply(&mut self, reply: Reply) -> Outcome {
        let has_failed = self.pixels.are_denied_by(reply);
        let protocol = self.pixels.output.protocol(self.terminal.abilities());
        if self.pixels.protocol.is_some() && (has_failed || protocol.is_none()) {
            self.remove_images();
            self.pixels.protocol = None;
            self.say_no_pixels();
            return Outcome::Changed;
        }
        let is_named = self.pixels.output == Output::Kitty;
        if self.pixels.protocol.is_none() && is_named && reply == Reply::Image(ASKED_IMAGE, true) {
            self.pixels.protocol = protocol;
            let denial = self.denial();
            self.notice.take_if(|notice| *notice == denial);
            return Outcome::Changed;
        }
        Outcome::Unchanged
    }

    /// Tells the user if pixels were asked for by name and cannot be had.
    pub(super) fn say_no_pixels(&mut self) {
        if self.pixels.protocol.is_none()
            && !matches!(self.pixels.output, Output::Auto | Output::Cells)
        {
            self.notice = Some(self.denial());
        }
    }

    fn denial(&self) -> String {
        let name = crate::choice::name(&self.pixels.output);
        format!("--output {name}: the terminal cannot show these pixels")
    }

    /// How many pixels a cell of the picture has, in width and height.
    pub(super) fn pixels_of_cell(&self, protocol: Protocol, size: (u16, u16)) -> (u32, u32) {
        let told = self.terminal.abilities().cell_pixels;
        let usual = || PixelGrid::usual_cell(&self.state.shown.style);
        drawn_cell(protocol, pixels_of_cell(told).unwrap_or_else(usual), area(size))
    }

    /// Appends the image if it is new or must be shown again, then the text that is over it: all of `cells` but their last
    /// row, if that is not one of the `rows` of the picture.
    pub(super) fn write_image(
        &mut self,
        protocol: Protocol,
        (image, is_new): (&Image, bool),
        cells: &mut CellGrid,
        rows: u16,
    ) {
        let (ink, paper) = match self.terminal.abilities().background {
            Some(Srgb(background)) => (Color::Default, Color::Rgb(background)),
            None => (INK, PAPER),
        };
        let count = usize::from(rows) * usize::from(cells.columns());
        for cell in cells.cells_mut().iter_mut().take(count) {
            if *cell == NO_TEXT {
                *cell = Cell::BLANK;
                continue;
            }
            let or = |color, own| if color == Color::Default { own } else { color };
            (cell.foreground, cell.background) =
                (or(cell.foreground, ink), or(cell.background, paper));
        }
        let is_cleared = self.encoder.clear(cells.columns(), cells.rows(), &mut self.bytes);
        // Where text was on the same layer, the image has a hole.
        let has_hole = !protocol.has_layers()
            && self.encoder.shown().is_some_and(|shown| {
                let pairs = shown.cells().iter().zip(cells.cells()).take(count);
                pairs.into_iter().any(|(shown, wanted)| *wanted == Cell::BLANK && shown != wanted)
            });
        if is_new || is_cleared || has_hole || !self.pixels.is_shown {
            self.terminal.remove_when_leaving(protocol.removal());
            protocol.write(image, (cells.columns(), rows), self.pixels.sent, &mut self.bytes);
            // A terminal that tells how far it has come has said a word about the image before that.
            if self.pixels.sent == 0 && protocol.has_layers() && self.asks_for_status() {
                self.pixels.awaits_first = Some(self.terminal.open_questions());
            }
            self.pixels.sent += 1;
            self.pixels.is_shown = true;
            if !protocol.has_layers() {
                self.encoder.covered(rows, cells);
            }
        }
    }

    /// Appends what removes the image, if there is one, so that cells can be shown.
    pub(super) fn remove_images(&mut self) {
        if let Some(protocol) = self.pixels.protocol.filter(|_| self.pixels.is_shown) {
            self.pending_removal.extend(protocol.removal());
            self.pixels.is_shown = false;
            self.encoder.forget();
        }
    }
}

fn area((columns, rows): (u16, u16)) -> u32 {
    u32::from(columns) * u32::from(rows)
}

/// The pixels that are drawn for each of so many cells of this size.
fn drawn_cell(protocol: Protocol, cell: (u32, u32), cells: u32) -> (u32, u32) {
    // Sixels are not enlarged.
    let is_sixel = matches!(protocol, Protocol::Sixel { .. });
    let most = if is_sixel { LARGEST_SCREEN } else { MOST_PIXELS };
    let mut drawn = cell;
    while drawn.0.min(drawn.1) > 1 && cells.saturating_mul(drawn.0 * drawn.1) > most {
        drawn = (drawn.0 / 2, drawn.1 / 2);
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_no_more_pixels_than_a_screen() {
        let sixel = Protocol::Sixel { colors: 256 };
        assert_eq!(drawn_cell(sixel, (20, 40), 200 * 60), (20, 40));
        assert_eq!(drawn_cell(Protocol::Iterm2, (20, 40), 200 * 60), (10, 20));
        let (width, height) = drawn_cell(sixel, (512, 512), 200 * 60);
        assert!(width == height && (32..=64).contains(&width), "{width}x{height}");
    }
}
