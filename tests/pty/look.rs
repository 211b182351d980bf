//! What a screen looks like, in a form to compare.

use spherule::cells::masks::opposite;
use vt100::{Color, Screen};

/// A glyph and its colours.
pub(crate) type Look = (String, Color, Color);

/// Every cell of the first `rows` rows. The ink of a space is invisible, so it does not count. Of two glyphs each of
/// which fills what the other leaves, the look has the first, whichever the program sent.
pub(crate) fn look(screen: &Screen, rows: u16) -> Vec<Vec<Look>> {
    let columns = screen.size().1.get();
    (0..rows.min(screen.size().0.get()))
        .map(|row| (0..columns).filter_map(|column| cell_look(screen, row, column)).collect())
        .collect()
}

fn cell_look(screen: &Screen, row: u16, column: u16) -> Option<Look> {
    let cell = screen.cell(row, column)?;
    Some(match cell.contents() {
        "" | " " => (" ".to_owned(), Color::Default, cell.bgcolor()),
        "▄" | "▐" => {
            let glyph = cell.contents().chars().find_map(opposite)?;
            (glyph.to_string(), cell.bgcolor(), cell.fgcolor())
        }
        glyph => (glyph.to_owned(), cell.fgcolor(), cell.bgcolor()),
    })
}

/// The cells that are shown with ink and paper exchanged: column and row of each.
pub(crate) fn inverse(screen: &Screen) -> Vec<(u16, u16)> {
    let (rows, columns) = screen.size();
    let cells = (0..rows.get()).flat_map(|row| (0..columns.get()).map(move |column| (column, row)));
    cells
        .filter(|&(column, row)| screen.cell(row, column).is_some_and(vt100::Cell::inverse))
        .collect()
}

/// The text of the last row.
pub(crate) fn last_row(screen: &Screen) -> String {
    let (rows, columns) = screen.size();
    let row = rows.get() - 1;
    screen.contents_between(row, 0, row, columns.get())
}
