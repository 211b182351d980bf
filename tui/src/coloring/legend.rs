//! What colours mean, over the top right of a picture.

use super::categories::NEUTRAL;
use super::scale::{Range, color_of};
use crate::cells::{CellGrid, Color};
use crate::color::Srgb;
use crate::palette::shown;
use crate::style::Style;

/// The most columns that a name takes.
const LONGEST: usize = 16;
/// Columns of the scale of numbers.
const SCALE: usize = 16;

/// What colours mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    title: String,
    entries: Entries,
}

/// The meanings.
#[derive(Clone, Debug, PartialEq)]
pub enum Entries {
    /// A name for each colour.
    Names(Vec<(Srgb, String)>),
    /// Numbers.
    Numbers {
        /// From the darkest colour to the lightest.
        range: Range,
        /// Whether some spheres have no number.
        has_none: bool,
    },
}

/// A part of a line: in ink, or on a colour.
type Part = (String, Option<Srgb>);

impl Legend {
    /// Whether colours mean numbers.
    pub(super) fn has_numbers(&self) -> bool {
        matches!(self.entries, Entries::Numbers { .. })
    }

    /// A legend with the name of what spheres are coloured by, and its values.
    #[must_use]
    pub fn new(title: &str, entries: Entries) -> Self {
        Self { title: printable(title), entries }
    }

    /// Writes the legend over the top right of the first `rows` rows: as many names as there is room for in half of them, and how many more
    /// there are. The text is in ASCII, since a label may be two columns wide. Where there is no colour, nothing is written.
    pub fn write(&self, cells: &mut CellGrid, rows: u16, style: &Style) {
        if shown(Srgb::WHITE, style.depth, &style.theme) == Color::Default {
            return;
        }
        let lines = self.lines(usize::from(rows / 2).max(1));
        let width = |line: &[Part]| line.iter().map(|(text, _)| text.len()).sum::<usize>();
        let widest = lines.iter().map(|line| width(line)).max().unwrap_or(0);
        let left = usize::from(cells.columns()).saturating_sub(widest);
        for (row, line) in (0..rows).zip(&lines) {
            let mut column = left;
            for (text, color) in line {
                let paper =
                    color.map_or(Color::Default, |color| shown(color, style.depth, &style.theme));
                cells.write(column as u16, row, text, Color::Default, paper);
                column += text.len();
            }
            cells.write(
                column as u16,
                row,
                &" ".repeat(left + widest - column),
                Color::Default,
                Color::Default,
            );
        }
    }

    /// The title, and below it no more than so many lines.
    fn lines(&self, most: usize) -> Vec<Vec<Part>> {
        let mut lines = vec![vec![(format!(" {} ", self.title), None)]];
        match &self.entries {
            Entries::Names(names) => {
                let fits = if names.len() <= most { names.len() } else { most - 1 };
                lines.extend(names[..fits].iter().map(|(color, name)| named(*color, name)));
                if fits < names.len() {
                    lines.push(vec![(format!(" {} more ", names.len() - fits), None)]);
                }
            }
            Entries::Numbers { range, has_none } => {
                let colors = (0..SCALE).map(|place| color_of(place as f32 / (SCALE - 1) as f32));
                let mut scale = vec![(" ".to_owned(), None)];
                scale.extend(colors.map(|color| (" ".to_owned(), Some(color))));
                scale.push((" ".to_owned(), None));
                lines.push(scale);
                let [low, high] = [range.low, range.high].map(number);
                let room = SCALE.saturating_sub(low.len()).max(high.len() + 1);
                lines.push(vec![(format!(" {low}{high:>room$} "), None)]);
                if *has_none {
                    lines.push(named(NEUTRAL, "none"));
                }
            }
        }
        lines
    }
}

fn named(color: Srgb, name: &str) -> Vec<Part> {
    vec![
        (" ".to_owned(), None),
        ("  ".to_owned(), Some(color)),
        (format!(" {} ", printable(name)), None),
    ]
}

/// Makes it ASCII, and cuts it if it is long.
fn printable(text: &str) -> String {
    let text = text.escape_default().to_string();
    if text.len() <= LONGEST {
        return text;
    }
    let mut cut = &text[..LONGEST - 3];
    // An escape is kept whole, or left out.
    if let Some(start) = cut
        .rfind('\\')
        .filter(|&start| text[start..].starts_with("\\u{") && !cut[start..].contains('}'))
    {
        cut = &cut[..start];
    }
    format!("{cut}...")
}

/// Writes a number in four digits, or in as many as there are before the point.
fn number(value: f32) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.3e}");
    }
    let digits = if size >= 1000.0 {
        0
    } else if size >= 100.0 {
        1
    } else if size >= 10.0 {
        2
    } else {
        3
    };
    let text = format!("{value:.digits$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::ColorDepth;

    const STYLE: Style = Style { depth: ColorDepth::Truecolor, ..Style::PLAIN };

    fn text(legend: &Legend, columns: u16, rows: u16, style: &Style) -> Vec<String> {
        let mut cells = CellGrid::new(columns, rows);
        cells.cells_mut().iter_mut().for_each(|cell| cell.glyph = '.');
        legend.write(&mut cells, rows, style);
        (0..rows).map(|row| cells.row(row).iter().map(|cell| cell.glyph).collect()).collect()
    }

    fn names(count: u8) -> Legend {
        let names = (0..count).map(|place| (Srgb([place; 3]), format!("N{place}")));
        Legend::new("chain", Entries::Names(names.collect()))
    }

    #[test]
    fn names_stand_beside_their_colours() {
        assert_eq!(
            text(&names(2), 12, 8, &STYLE)[..4],
            ["..... chain ", ".....    N0 ", ".....    N1 ", "............"]
        );
        let mut cells = CellGrid::new(12, 8);
        names(2).write(&mut cells, 8, &STYLE);
        let papers: Vec<_> = cells.row(2)[5..].iter().map(|cell| cell.background).collect();
        let own = Color::Rgb([1; 3]);
        assert_eq!(papers[..4], [Color::Default, own, own, Color::Default]);
    }

    #[test]
    fn where_there_is_no_room_it_says_how_many_more_there_are() {
        let lines = text(&names(30), 14, 8, &STYLE);
        assert_eq!(
            lines[..6],
            [
                "..... chain   ",
                ".....    N0   ",
                ".....    N1   ",
                ".....    N2   ",
                "..... 27 more ",
                ".............."
            ]
        );
    }

    #[test]
    fn numbers_have_a_scale_and_its_ends() {
        let range = Range { low: -0.25, high: 1234.5 };
        let legend = Legend::new("b_factor", Entries::Numbers { range, has_none: true });
        let lines = text(&legend, 20, 10, &STYLE);
        assert_eq!(lines[0], ".. b_factor         ");
        assert_eq!(lines[2], ".. -0.25       1234 ");
        assert_eq!(lines[3], "..    none          ");
    }

    #[test]
    fn it_is_cut_where_there_is_no_room_at_all() {
        for (columns, rows) in [(0, 0), (1, 1), (3, 2), (5, 1)] {
            let _ = text(&names(9), columns, rows, &STYLE);
        }
        assert_eq!(text(&names(9), 6, 1, &STYLE), [" chain"]);
    }

    #[test]
    fn without_colours_there_is_nothing_to_explain() {
        assert_eq!(text(&names(2), 12, 2, &Style::PLAIN), ["............"; 2]);
    }

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 0.5, -12.3456, 1e-7, 123.45, 1e9, 99_999.0].map(number);
        assert_eq!(texts, ["0", "0.5", "-12.35", "1.000e-7", "123.4", "1.000e9", "99999"]);
        assert_eq!(printable("Ångström and more of it"), "\\u{c5}ngstr...");
    }
}
