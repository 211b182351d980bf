//! What colours mean, over the top right of a picture.

use super::categories::NEUTRAL;
use super::scale::{Range, color_of};
use crate::cells::{CellGrid, Color};
use crate::color::Srgb;
use crate::palette::shown;
use crate::style::{Charset, Style};

/// The most columns that a name takes.
const LONGEST: usize = 16;
/// Columns of the scale of numbers.
const SCALE: usize = 16;
/// The digits of the scale's ends, and those by which any two `f32` differ.
const FEW_DIGITS: usize = 4;
const MOST_DIGITS: usize = 9;

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
        self.range().is_some()
    }

    /// The numbers between which colours lie, if they mean numbers.
    #[must_use]
    pub fn range(&self) -> Option<Range> {
        match self.entries {
            Entries::Numbers { range, .. } => Some(range),
            Entries::Names(_) => None,
        }
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
                match color {
                    Some(color) => swatch(cells, (column as u16, row), text.len(), *color, style),
                    None => cells.write(column as u16, row, text, Color::Default, Color::Default),
                }
                column += text.len();
            }
            let rest = " ".repeat(left + widest - column);
            cells.write(column as u16, row, &rest, Color::Default, Color::Default);
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
                let [low, high] = ends(*range);
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

/// Writes so many cells of a colour. One that cannot be paper is ink that fills them, on black, as it is in a picture.
fn swatch(
    cells: &mut CellGrid,
    (column, row): (u16, u16),
    width: usize,
    color: Srgb,
    style: &Style,
) {
    let color = shown(color, style.depth, &style.theme);
    let (glyph, ink, paper) = match style.charset {
        _ if style.theme.paper(color) == color => (" ", Color::Default, color),
        Charset::Ascii => ("#", color, Color::Ansi16(0)),
        _ => ("█", color, Color::Ansi16(0)),
    };
    cells.write(column, row, &glyph.repeat(width), ink, paper);
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

/// Writes both ends in four digits, or in so many more that they differ.
fn ends(range: Range) -> [String; 2] {
    let written = |digits| [range.low, range.high].map(|end| number(end, digits));
    let differ = |[low, high]: &[String; 2]| low != high || range.low == range.high;
    (FEW_DIGITS..MOST_DIGITS).map(written).find(differ).unwrap_or_else(|| written(MOST_DIGITS))
}

/// Writes a number in so many digits, or in as many as there are before the point.
fn number(value: f32, digits: usize) -> String {
    let behind_first = digits - 1;
    let scientific = format!("{value:.behind_first$e}");
    let exponent = scientific.split_once('e').and_then(|(_, text)| text.parse::<i32>().ok());
    let exponent = exponent.unwrap_or(0);
    if !(-3..6).contains(&exponent) {
        return scientific;
    }
    let decimals = usize::try_from(behind_first as i32 - exponent).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::palette::Theme;
    use crate::scene::elements::of_number;
    use crate::style::ColorDepth;

    const STYLE: Style = Style { depth: ColorDepth::Truecolor, ..Style::PLAIN };

    fn text(legend: &Legend, columns: u16, rows: u16, style: &Style) -> Vec<String> {
        let mut cells = CellGrid::new(columns, rows);
        cells.cells_mut().iter_mut().for_each(|cell| cell.glyph = '.');
        legend.write(&mut cells, rows, style);
        cells.lines()
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
    fn colours_that_cannot_be_paper_are_ink() {
        let theme = Theme { papers: 8, ..Theme::VGA };
        let elements = [8, 1, 6].map(|number| of_number(number).expect("known"));
        let entries = elements.map(|element| (element.color, element.symbol.to_owned()));
        let legend = Legend::new("element", Entries::Names(entries.into()));
        for (charset, glyph) in [(Charset::Half, '█'), (Charset::Ascii, '#')] {
            let style = Style { charset, depth: ColorDepth::Ansi16, theme, ..Style::PLAIN };
            let mut cells = CellGrid::new(9, 8);
            legend.write(&mut cells, 8, &style);
            let swatch = |row| {
                let cell = cells.row(row)[1];
                assert_eq!(cells.row(row)[2], cell);
                assert!(matches!(cell.background, Color::Ansi16(0..8)), "{cell:?}");
                if cell.glyph == ' ' {
                    return cell.background;
                }
                assert_eq!((cell.glyph, cell.background), (glyph, Color::Ansi16(0)));
                cell.foreground
            };
            let [oxygen, hydrogen, carbon] = [1, 2, 3].map(swatch);
            assert!(matches!(oxygen, Color::Ansi16(1 | 9)), "{oxygen:?}");
            assert!(oxygen != hydrogen && oxygen != carbon && hydrogen != carbon);
        }
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
        for (value, text) in [
            (0.0, "0"),
            (0.5, "0.5"),
            (-12.3456, "-12.35"),
            (0.0123, "0.0123"),
            (0.001_234_5, "0.001234"),
            (0.000_999_96, "0.001"),
            (9.9996, "10"),
            (1e-7, "1.000e-7"),
            (123.45, "123.4"),
            (1e9, "1.000e9"),
            (99_999.0, "99999"),
        ] {
            assert_eq!(number(value, FEW_DIGITS), text);
        }
        assert_eq!(printable("Ångström and more of it"), "\\u{c5}ngstr...");
    }

    #[test]
    fn ends_that_differ_are_written_so() {
        for (low, high, texts) in [
            (0.001_23, 0.001_9, ["0.00123", "0.0019"]),
            (0.0021, 0.0024, ["0.0021", "0.0024"]),
            (293.11, 293.14, ["293.11", "293.14"]),
            (100_000.1, 100_000.4, ["100000.1", "100000.4"]),
            (1e-9, 1.000_02e-9, ["1.00000e-9", "1.00002e-9"]),
            (1.0, 1.0_f32.next_up(), ["1", "1.0000001"]),
            (7.0, 7.0, ["7", "7"]),
        ] {
            assert_eq!(ends(Range { low, high }), texts);
        }
    }
}
