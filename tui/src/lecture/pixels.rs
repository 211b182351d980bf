//! A picture of pixels so large that each can be seen.

use super::canvas::{Canvas, Role};

/// One pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pixel {
    glyph: char,
    role: Role,
    filled: bool,
}

impl Pixel {
    /// Not computed yet.
    pub(super) const WAITING: Self = Self { glyph: '.', role: Role::Faint, filled: false };
    /// There is nothing.
    pub(super) const NOTHING: Self = Self { glyph: ' ', role: Role::Plain, filled: false };
    /// The ray hits nothing.
    pub(super) const BLACK: Self = Self { glyph: ' ', role: Role::Black, filled: true };
    /// The ray hits.
    pub(super) const WHITE: Self = Self { glyph: '#', role: Role::White, filled: true };

    /// A character.
    pub(super) fn sign(glyph: char, role: Role) -> Self {
        Self { glyph, role, filled: false }
    }

    /// The ray hits a sphere first: its letter.
    pub(super) fn of_sphere(index: Option<usize>, glyph: impl Fn(usize) -> char) -> Self {
        index.map_or(Self::NOTHING, |index| Self::sign(glyph(index), Role::Nth(index)))
    }
}

/// A picture and where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixels {
    left: i32,
    top: i32,
    /// The rows of a pixel; it has twice as many columns.
    side: i32,
    width: i32,
    height: i32,
}

impl Pixels {
    /// `width` x `height` pixels, as large as the room lets them be, from `(left, top)` on.
    pub(super) fn new(
        (left, top): (i32, i32),
        (columns, rows): (i32, i32),
        (width, height): (u32, u32),
    ) -> Self {
        let (width, height) = (width as i32, height as i32);
        let side = ((columns - 2) / (2 * width)).min((rows - 2) / height).max(1);
        Self { left, top, side, width, height }
    }

    /// Pixels of this `size`, to the left of `text` columns of text.
    pub(super) fn beside(canvas: &Canvas, text: i32, size: (u32, u32)) -> Self {
        Self::new((0, 0), (canvas.columns() - text, canvas.rows()), size)
    }

    /// How many rows it takes, with its frame.
    pub(super) fn rows(&self) -> i32 {
        self.side * self.height + 2
    }

    /// How many columns, with its frame.
    pub(super) fn columns(&self) -> i32 {
        2 * self.side * self.width + 2
    }

    /// Draws a frame, and in it every pixel.
    pub(super) fn draw(&self, canvas: &mut Canvas, pixel: impl Fn(u32, u32) -> Pixel) {
        let (right, bottom) = (self.left + self.columns() - 1, self.top + self.rows() - 1);
        for column in self.left..=right {
            for row in [self.top, bottom] {
                canvas.put(column, row, '-', Role::Faint);
            }
        }
        for row in self.top..=bottom {
            let corner = row == self.top || row == bottom;
            for column in [self.left, right] {
                canvas.put(column, row, if corner { '+' } else { '|' }, Role::Faint);
            }
        }
        for iy in 0..self.height {
            for ix in 0..self.width {
                let Pixel { glyph, role, filled } = pixel(ix as u32, iy as u32);
                for (column, row) in self.cells(ix, iy) {
                    if filled {
                        canvas.fill(column, row, glyph, role);
                    } else {
                        canvas.put(column, row, glyph, role);
                    }
                }
            }
        }
    }

    /// Puts brackets into one pixel.
    pub(super) fn point_at(&self, canvas: &mut Canvas, ix: u32, iy: u32) {
        let (column, row) = (self.left + 1 + 2 * self.side * ix as i32, self.top + 1);
        let row = row + self.side * iy as i32 + self.side / 2;
        canvas.put(column, row, '[', Role::Plain);
        canvas.put(column + 2 * self.side - 1, row, ']', Role::Plain);
    }

    fn cells(&self, ix: i32, iy: i32) -> impl Iterator<Item = (i32, i32)> + use<> {
        let side = self.side;
        let (left, top) = (self.left + 1 + 2 * side * ix, self.top + 1 + side * iy);
        (top..top + side).flat_map(move |row| (left..left + 2 * side).map(move |c| (c, row)))
    }
}
