//! What a station draws on: cells, and what each of them is a picture of.

use crate::cells::{Cell, CellGrid, Color};
use crate::style::{ColorDepth, Style};

/// What a text or a line is. Without colour all look alike, so letters and marks say it too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Text.
    Plain,
    /// What is shown and does not count. Its colour is that of text: themes have papers of every grey.
    Faint,
    /// A ray.
    Ray,
    /// A sphere.
    Sphere,
    /// Where a ray hits, and what the answer is.
    Hit,
    /// A wrong decision.
    Wrong,
    /// White where a ray hits.
    White,
    /// Black where it does not.
    Black,
    /// One of several spheres, by its index.
    Nth(usize),
}

impl Role {
    /// One of the 16 colours that every terminal with colour has. They are those of the user's theme, so that they are
    /// seen on light and dark.
    fn color(self) -> Color {
        match self {
            Self::Plain | Self::Faint => Color::Default,
            Self::Ray => Color::Ansi16(6),
            Self::Sphere => Color::Ansi16(5),
            Self::Hit => Color::Ansi16(2),
            Self::Wrong => Color::Ansi16(9),
            Self::White => Color::Ansi16(15),
            Self::Black => Color::Ansi16(0),
            Self::Nth(index) => Color::Ansi16([9, 12, 11, 10, 13, 14][index % 6]),
        }
    }
}

/// The letter of a sphere by its index.
pub(super) fn letter(index: usize) -> char {
    char::from(b'A' + (index % 26) as u8)
}

/// Cells to draw on; what lies beside them is left out.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    cells: CellGrid,
    style: Style,
}

impl Canvas {
    /// A blank canvas; `style` says how many colours there are.
    pub(super) fn new(columns: u16, rows: u16, style: Style) -> Self {
        Self { cells: CellGrid::new(columns, rows), style }
    }

    pub(super) fn columns(&self) -> i32 {
        self.cells.columns().into()
    }

    pub(super) fn rows(&self) -> i32 {
        self.cells.rows().into()
    }

    /// How the program's own pictures are drawn here.
    pub(super) fn style(&self) -> &Style {
        &self.style
    }

    pub(super) fn into_cells(self) -> CellGrid {
        self.cells
    }

    /// Writes from `(column, row)` on.
    pub(super) fn write(&mut self, column: i32, row: i32, text: &str, role: Role) {
        for (column, glyph) in (column..).zip(text.chars()) {
            self.put(column, row, glyph, role);
        }
    }

    /// Writes lines below each other.
    pub(super) fn write_lines<S: AsRef<str>>(
        &mut self,
        column: i32,
        row: i32,
        lines: impl IntoIterator<Item = S>,
    ) {
        for (row, line) in (row..).zip(lines) {
            self.write(column, row, line.as_ref(), Role::Plain);
        }
    }

    /// Sets one cell.
    pub(super) fn put(&mut self, column: i32, row: i32, glyph: char, role: Role) {
        let foreground = self.color(role);
        self.set(column, row, Cell { glyph, foreground, background: Color::Default });
    }

    /// Fills one cell: with colour all of it, else with the glyph.
    pub(super) fn fill(&mut self, column: i32, row: i32, glyph: char, role: Role) {
        let color = self.style.theme.paper(self.color(role));
        self.set(column, row, Cell { glyph, foreground: color, background: color });
    }

    /// Copies cells, the top left one to `(column, row)`.
    pub(super) fn copy(&mut self, column: i32, row: i32, cells: &CellGrid) {
        for (row, y) in (row..).zip(0..cells.rows()) {
            for (column, cell) in (column..).zip(cells.row(y)) {
                self.set(column, row, *cell);
            }
        }
    }

    fn color(&self, role: Role) -> Color {
        if self.style.depth == ColorDepth::Never { Color::Default } else { role.color() }
    }

    fn set(&mut self, column: i32, row: i32, cell: Cell) {
        if (0..self.columns()).contains(&column) && (0..self.rows()).contains(&row) {
            let index = row * self.columns() + column;
            self.cells.cells_mut()[index as usize] = cell;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::palette::THEMES;

    /// Papers are among a theme's blacks and whites; what is filled in these is no text.
    #[test]
    fn text_is_seen_on_the_paper_of_every_theme() {
        let roles = [Role::Plain, Role::Faint, Role::Ray, Role::Sphere, Role::Hit, Role::Wrong];
        let roles = roles.into_iter().chain((0..6).map(Role::Nth));
        for (role, (name, theme)) in roles.flat_map(|role| THEMES.map(|theme| (role, theme))) {
            let Color::Ansi16(ink) = role.color() else { continue };
            let papers = [0, 7, 8, 15].map(|paper| theme.colors[paper]);
            assert!(!papers.contains(&theme.colors[usize::from(ink)]), "{role:?} in {name}");
        }
    }
}
