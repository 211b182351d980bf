//! The page of a station: title, words, what it draws, what its keys do.

use super::canvas::{Canvas, Role};
use super::station::{Numbers, Station};
use super::stations::STATIONS;
use crate::cells::CellGrid;
use crate::style::Style;

/// The least size, in which every station has room.
pub(super) const LEAST: (u16, u16) = (80, 24);
/// Rows above what the station draws, and below it.
const ABOVE: u16 = 4;
const BELOW: u16 = 2;

const KEYS: &str = "n next  b back  arrows change it  r reset  ? help  q quit";

const HELP: [&str; 14] = [
    "                                                            ",
    "  n, Page Down      the next station                        ",
    "  b, Page Up        the one before                          ",
    "  arrows            change the numbers of this one          ",
    "  r                 its first numbers again                 ",
    "  ?                 this                                    ",
    "  Ctrl-Z, Ctrl-L    stop, fg goes on; draw anew             ",
    "  q, Esc, Ctrl-C    quit                                    ",
    "                                                            ",
    "  Every number is computed by the kernel when it is shown.  ",
    "  Triangles are left out: the kernel models only what a     ",
    "  scene here requires, and these are made of spheres.       ",
    "  spherule lecture --list names the source of each station. ",
    "                                                            ",
];

/// Columns and rows of what a station draws, on a page of this size.
pub(super) fn room((columns, rows): (u16, u16)) -> (u16, u16) {
    (columns.max(LEAST.0) - 2, rows.max(LEAST.1) - ABOVE - BELOW)
}

/// The page of station `index`, in so many columns and rows; if these are less than [`LEAST`], the top left of a larger
/// page.
pub(super) fn page(
    index: usize,
    numbers: Numbers,
    help: bool,
    (columns, rows): (u16, u16),
    style: Style,
) -> CellGrid {
    let (width, height) = (columns.max(LEAST.0), rows.max(LEAST.1));
    let mut page = Canvas::new(width, height, style);
    let station = &STATIONS[index];
    write_words(&mut page, index, station);
    let (inner_columns, inner_rows) = room((columns, rows));
    let mut drawn = Canvas::new(inner_columns, inner_rows, style);
    station.show(numbers, &mut drawn);
    page.copy(1, ABOVE.into(), &drawn.into_cells());
    if help {
        write_help(&mut page);
    }
    if (width, height) == (columns, rows) {
        return page.into_cells();
    }
    cut(page, columns, rows)
}

fn write_words(page: &mut Canvas, index: usize, station: &Station) {
    let (columns, rows) = (page.columns(), page.rows());
    let title = format!("{:>2}/{}  {}", index + 1, STATIONS.len(), station.title);
    page.write(1, 0, &title, Role::Hit);
    let topic = format!("lecture: {}", station.topic);
    page.write(columns - 1 - topic.len() as i32, 0, &topic, Role::Faint);
    for (row, words) in (1..).zip(station.words) {
        page.write(1, row, words, Role::Plain);
    }
    page.write(1, rows - 2, station.arrows, Role::Ray);
    let file = station.sources[0].file;
    page.write(columns - 1 - file.len() as i32, rows - 2, file, Role::Faint);
    page.write(1, rows - 1, KEYS, Role::Faint);
}

fn write_help(page: &mut Canvas) {
    let left = (page.columns() - HELP[0].len() as i32) / 2;
    let top = (page.rows() - HELP.len() as i32) / 2;
    page.write_lines(left, top, HELP);
}

/// What fits of a page; the last row says what size it needs.
fn cut(page: Canvas, columns: u16, rows: u16) -> CellGrid {
    let style = *page.style();
    let mut small = Canvas::new(columns, rows, style);
    small.copy(0, 0, &page.into_cells());
    let (width, height) = LEAST;
    let needs = format!("needs {width}x{height}, has {columns}x{rows}");
    let row = format!("{needs:width$}", width = usize::from(columns));
    small.write(0, i32::from(rows) - 1, &row, Role::Wrong);
    small.into_cells()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_fit_into_the_least_size() {
        let columns = usize::from(LEAST.0) - 2;
        for entry in &STATIONS {
            assert!(entry.words.iter().all(|words| words.len() <= columns), "{}", entry.name);
            let topic = "lecture: ".len() + entry.topic.len();
            assert!("14/14  ".len() + entry.title.len() + topic < columns, "{}", entry.name);
            let below = entry.arrows.len() + entry.sources[0].file.len();
            assert!(below < columns, "{}: {below}", entry.name);
        }
        assert!(KEYS.len() <= columns && HELP.iter().all(|line| line.len() == HELP[0].len()));
    }

    #[test]
    fn what_is_too_small_says_so() {
        let first = STATIONS[0].first();
        let text = |size| page(0, first, false, size, Style::PLAIN).lines().concat();
        assert!(!text(LEAST).contains("needs"));
        assert!(text((79, 24)).contains("needs 80x24, has 79x24"));
        assert!(text((30, 3)).ends_with("needs 80x24, has 30x3         "));
        assert_eq!(text((3, 1)), "nee");
    }
}
