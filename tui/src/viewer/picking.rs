//! The cursor that picks a cell, and what is written over the picture of what is there.

use crate::cells::{CellGrid, Color};

/// The glyph of the cell that is picked, inverse: over any picture, with or without colour, one of its two parts is
/// seen.
const CROSS: &str = "+";

/// The cell that is picked: its column and its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cursor {
    pub(super) column: u16,
    pub(super) row: u16,
}

impl Cursor {
    /// The cell in the middle of a picture of `columns` x `rows`.
    pub(super) fn middle((columns, rows): (u16, u16)) -> Self {
        Self { column: columns / 2, row: rows / 2 }.within((columns, rows))
    }

    /// The cell so many columns to the right and rows up, or the nearest that the picture has.
    pub(super) fn moved(self, right: i8, up: i8, size: (u16, u16)) -> Self {
        let column = self.column.saturating_add_signed(right.into());
        let row = self.row.saturating_add_signed(-i16::from(up));
        Self { column, row }.within(size)
    }

    /// The cell itself, or the nearest that the picture has.
    pub(super) fn within(self, (columns, rows): (u16, u16)) -> Self {
        Self {
            column: self.column.min(columns.saturating_sub(1)),
            row: self.row.min(rows.saturating_sub(1)),
        }
    }
}

/// Marks the cell, and writes `lines` into a corner of the first `rows` rows: below the cell, or above it if there is
/// more room, and never over its row. Cut if there is no room.
pub(super) fn write(cells: &mut CellGrid, rows: u16, cursor: Cursor, lines: &[String]) {
    let Cursor { column, row } = cursor.within((cells.columns(), rows));
    cells.write(column, row, CROSS, Color::Default, Color::Default);
    cells.set_mark(Some((column, row)));

    let (above, below) = (row, rows.saturating_sub(row + 1));
    let wanted = u16::try_from(lines.len()).unwrap_or(u16::MAX);
    let (first, count) = if below >= wanted.min(above) {
        let count = below.min(wanted);
        (rows - count, count)
    } else {
        (0, above)
    };
    // A blank on either side.
    let width = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
    for (row, line) in (first..).zip(lines.iter().take(count.into())) {
        cells.write(0, row, &format!(" {line:width$} "), Color::Default, Color::Default);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cursor_stays_in_the_picture() {
        let size = (5, 3);
        let middle = Cursor::middle(size);
        assert_eq!((middle.column, middle.row), (2, 1));
        let corner = (0..9).fold(middle, |cursor, _| cursor.moved(-1, 1, size));
        assert_eq!((corner.column, corner.row), (0, 0));
        let corner = (0..9).fold(middle, |cursor, _| cursor.moved(1, -1, size));
        assert_eq!((corner.column, corner.row), (4, 2));
        let one = corner.within((1, 1));
        assert_eq!((one, Cursor::middle((1, 1))), (Cursor { column: 0, row: 0 }, one));
    }

    fn lines(count: usize) -> Vec<String> {
        (0..count).map(|line| format!("line {line}")).collect()
    }

    fn text(cells: &CellGrid, row: u16) -> String {
        cells.lines().remove(row.into())
    }

    #[test]
    fn the_box_is_below_the_cell_or_above_it() {
        for (row, first) in [(0, 6), (5, 6), (6, 0), (9, 0)] {
            let mut cells = CellGrid::new(12, 10);
            write(&mut cells, 10, Cursor { column: 3, row }, &lines(4));
            assert_eq!(cells.marked(), Some((3, row)));
            assert_eq!(text(&cells, row), "   +        ");
            for line in 0..4 {
                assert_eq!(text(&cells, first + line), format!(" line {line}     "), "{row}");
            }
        }
    }

    /// Whatever the size, no row but the picture's is written, and the cell stays to be seen.
    #[test]
    fn where_there_is_no_room_it_is_cut() {
        for columns in [1, 2, 7, 80] {
            for rows in 1..12 {
                for row in 0..rows {
                    let mut cells = CellGrid::new(columns, rows + 1);
                    cells.write(0, rows, "status", Color::Default, Color::Default);
                    let status = text(&cells, rows);
                    let cursor = Cursor { column: columns - 1, row };
                    write(&mut cells, rows, cursor, &lines(8));
                    assert_eq!(text(&cells, rows), status);
                    let marked = text(&cells, row);
                    assert!(marked.ends_with('+') && !marked.contains("li"), "{marked}");
                    let shown =
                        (0..rows).filter(|row| text(&cells, *row).starts_with(" l")).count();
                    let room = row.max(rows - 1 - row).min(8);
                    assert!(columns < 7 || shown == usize::from(room), "{rows} {row}: {shown}");
                }
            }
        }
    }
}
