//! An error map as cells: its marks, and over the last rows what they mean.

use super::error_map::ErrorMap;
use super::grouped;
use super::marks::{BANDS, Marks, band};
use super::verdict::{Class, Counts, Worst};
use crate::cells::{Cell, CellGrid, Color};
use crate::style::Style;
use spherule_kernel::Tier;
use std::ops::Range;

/// A map of fewer rows has no legend. Other maps have a legend of two rows or, if it needs them, of up to half of all.
const FEWEST_ROWS: u16 = 4;

/// A word of the legend, behind the mark that it explains.
struct Word {
    mark: Option<Class>,
    text: String,
}

/// Draws maps as a style has them.
#[derive(Debug)]
pub struct MapPainter {
    marks: Marks,
}

impl MapPainter {
    /// Chooses colours and letters.
    #[must_use]
    pub fn new(style: &Style) -> Self {
        Self { marks: Marks::new(style) }
    }

    /// The cells of some `rows` of `map`.
    #[must_use]
    pub fn cells(&self, map: &ErrorMap, rows: Range<u16>) -> CellGrid {
        let (columns, all) = map.size();
        let mut cells = CellGrid::new(columns, rows.end - rows.start);
        let classes = rows.clone().flat_map(|row| map.row(row));
        for (cell, &class) in cells.cells_mut().iter_mut().zip(classes) {
            *cell = self.marks.cell(class);
        }
        if all >= FEWEST_ROWS {
            let mut legend = self.legend(map);
            legend.truncate(usize::from(all / 2));
            for (words, row) in legend.iter().zip(all - legend.len() as u16..) {
                if rows.contains(&row) {
                    self.write(words, &mut cells, row - rows.start);
                }
            }
        }
        cells
    }

    /// What is wrong, in words as long as there is room for in a row; from the next row on, how far off t is.
    fn legend(&self, map: &ErrorMap) -> Vec<Vec<Word>> {
        let columns = usize::from(map.size().0);
        let long = decisions(map, ["another sphere", "false hit", "lost hit", "other root"]);
        let mut legend = wrapped(long, columns);
        if legend.len() > 1 {
            legend = wrapped(decisions(map, ["sphere", "false", "lost", "root"]), columns);
        }
        legend.extend(wrapped(self.rounding(&map.counts), columns));
        legend
    }

    fn rounding(&self, counts: &Counts) -> Vec<Word> {
        let mut sums = [0; BANDS.len()];
        for (count, log) in counts.off.iter().zip(0..) {
            sums[band(log)] += count;
        }
        let right = format!("right {}", grouped(counts.right));
        let mut words = vec![Word { mark: Some(Class::Right), text: right }];
        if counts.off.iter().any(|&count| count > 0) {
            let unit = if self.marks.has_letters { "0-9: 2^n ulp" } else { "ulp:" };
            words.push(Word { mark: None, text: unit.to_owned() });
        }
        for (&count, from) in sums.iter().zip(BANDS).filter(|(count, _)| **count > 0) {
            let grey = Some(Class::Off(from.ilog2() as u8)).filter(|_| !self.marks.has_letters);
            words.push(Word { mark: grey, text: format!("{from}+ {}", grouped(count)) });
        }
        words
    }

    fn write(&self, words: &[Word], cells: &mut CellGrid, row: u16) {
        let blank = " ".repeat(cells.columns().into());
        cells.write(0, row, &blank, Color::Default, Color::Default);
        let mut column = 1_u16;
        for word in words {
            if let Some(class) = word.mark {
                let Cell { glyph, foreground, background } = self.marks.cell(class);
                cells.write(column, row, glyph.encode_utf8(&mut [0; 4]), foreground, background);
                column = column.saturating_add(2);
            }
            cells.write(column, row, &word.text, Color::Default, Color::Default);
            column = column.saturating_add(word.text.len() as u16 + 2);
        }
    }
}

impl Word {
    /// The width with its mark, and a gap beside it.
    fn width(&self) -> usize {
        self.text.len() + 2 + if self.mark.is_some() { 2 } else { 0 }
    }
}

/// As many words in a row as there is room for, at least one.
fn wrapped(words: Vec<Word>, columns: usize) -> Vec<Vec<Word>> {
    let (mut rows, mut room): (Vec<Vec<Word>>, usize) = (Vec::new(), 0);
    for word in words {
        match rows.last_mut().filter(|_| word.width() <= room) {
            Some(row) => {
                room -= word.width();
                row.push(word);
            }
            None => {
                // There is a blank before it, and none behind the last.
                room = (columns + 1).saturating_sub(word.width());
                rows.push(vec![word]);
            }
        }
    }
    rows
}

/// The tier, its wrong decisions by these `names`, if there are any, and the worst ray.
fn decisions(map: &ErrorMap, names: [&str; 4]) -> Vec<Word> {
    let counts = &map.counts;
    let all = [
        (Class::OtherSphere, counts.other_spheres),
        (Class::FalseHit, counts.false_hits),
        (Class::LostHit, counts.lost_hits),
        (Class::OtherRoot, counts.other_root),
    ];
    let tier = map.tier.as_str();
    let head = match (counts.worst, counts.wrong_decisions()) {
        (None, _) if map.tier == Tier::Exact => {
            format!("{tier}: all right, it is the truth")
        }
        (None, _) => format!("{tier}: all right"),
        (_, 0) => format!("{tier}: no wrong decision"),
        _ => format!("{tier}:"),
    };
    let found = all.into_iter().zip(names).filter(|((_, count), _)| *count > 0);
    let found = found.map(|((class, count), name)| Word {
        mark: Some(class),
        text: format!("{name} {}", grouped(count)),
    });
    let worst = counts.worst.map(|worst| worst_word(&worst, map.samples));
    [Word { mark: None, text: head }].into_iter().chain(found).chain(worst).collect()
}

fn worst_word(worst: &Worst, (across, down): (u32, u32)) -> Word {
    let Worst { verdict, sphere, sample: (x, y) } = worst;
    let mut text = format!("worst: sphere {sphere} at {},{}", x / across, y / down);
    if verdict.ulp > 0 {
        text += &format!(": {} ulp", grouped(verdict.ulp));
    }
    Word { mark: Some(verdict.class), text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::error_map::ErrorMapper;
    use crate::draw::brute_force;
    use crate::scene::builtin::builtin;
    use crate::style::{Charset, ColorDepth};
    use crate::threads::Threads;
    use spherule_kernel::Level;

    fn map(scene: &str, style: &Style, size: (u16, u16), threads: u16) -> ErrorMap {
        let scene = builtin(scene).expect("a scene");
        let view = scene.first_view(style.picture_aspect(size.0, size.1) as f32);
        let search = brute_force(&scene, &view);
        let threads = Threads::new(Some(threads)).expect("threads");
        let machine = (Level::best(), &threads);
        ErrorMapper::default().map((&scene, &search), &view, style, size, machine, |_| {})
    }

    fn fast(depth: ColorDepth, charset: Charset) -> Style {
        Style { accuracy: Tier::Fast, depth, charset, ..Style::PLAIN }
    }

    #[test]
    fn every_number_of_threads_finds_the_same() {
        let style = fast(ColorDepth::Never, Charset::Ascii);
        let [one, two, seven] = [1, 2, 7].map(|threads| map("edge", &style, (61, 23), threads));
        for other in [two, seven] {
            assert_eq!((one.counts, one.size()), (other.counts, other.size()));
            assert!((0..23).all(|row| one.row(row) == other.row(row)));
        }
        assert!(one.counts.worst.is_some_and(|worst| worst.verdict.class > Class::OtherRoot));
    }

    /// Cells have no letters where colours tell them apart, and strips are parts of the whole.
    #[test]
    fn strips_are_the_whole_in_colours_and_in_letters() {
        for depth in
            [ColorDepth::Never, ColorDepth::Ansi16, ColorDepth::Ansi256, ColorDepth::Truecolor]
        {
            for charset in [Charset::Ascii, Charset::Half] {
                let style = fast(depth, charset);
                let (map, painter) = (map("edge", &style, (60, 9), 1), MapPainter::new(&style));
                let whole = painter.cells(&map, 0..9);
                let strips = [0..3, 3..8, 8..9].map(|rows| painter.cells(&map, rows));
                let joined: Vec<_> = strips.iter().flat_map(CellGrid::cells).copied().collect();
                assert_eq!(joined, whole.cells());
                // Above the largest legend.
                let picture = &whole.cells()[..60 * 5];
                let letters = picture.iter().filter(|cell| cell.glyph != ' ').count();
                assert_eq!(letters > 20, painter.marks.has_letters, "{depth:?} {charset:?}");
                let colored = picture.iter().any(|cell| cell.background != Color::Default);
                assert_eq!(colored, depth != ColorDepth::Never);
            }
        }
    }

    /// Every kind of error occurs, and every count can be read where there is room for a word.
    #[test]
    fn a_legend_takes_the_rows_that_it_needs() {
        for (columns, rows) in [(200, 2), (120, 2), (80, 4), (44, 5)] {
            let style = Style { samples: Some(64), ..fast(ColorDepth::Never, Charset::Ascii) };
            let map = map("edge", &style, (columns, 24), 2);
            let cells = MapPainter::new(&style).cells(&map, 0..24);
            let lines = cells.lines();
            let legend = &lines[24 - rows..];
            assert!(legend[0].starts_with(" fast:  "), "{columns}: {lines:#?}");
            let Counts { other_spheres, false_hits, lost_hits, other_root, right, .. } = map.counts;
            let worst = map.counts.worst.expect("there are errors");
            let ulp = map.counts.off.iter().sum::<u64>();
            let text = legend.join("") + " ";
            for (name, count) in
                [("S", other_spheres), ("F", false_hits), ("L", lost_hits), ("R", other_root)]
            {
                let is_told = |name: &str| {
                    let rest = text.split_once(&format!(" {name} ")).map_or("", |(_, rest)| rest);
                    let words = rest.split("  ").next().unwrap_or_default();
                    words.ends_with(&format!(" {}", grouped(count)))
                };
                assert!(count > 0 && is_told(name), "{columns} {name} {count}: {legend:#?}");
            }
            assert!(text.contains(&format!("sphere {} at ", worst.sphere)), "{legend:#?}");
            assert!(text.contains(&format!(". right {} ", grouped(right))), "{legend:#?}");
            let told = text.split_once("2^n ulp").expect("how far t is off").1;
            let told = told.split_whitespace().filter(|word| !word.ends_with('+'));
            let told: u64 = told.map(|n| n.replace(',', "").parse::<u64>().expect("a count")).sum();
            assert_eq!(told, ulp, "{legend:#?}");
        }
    }

    #[test]
    fn forty_columns_have_room_for_the_truth() {
        let style = Style { accuracy: Tier::Exact, ..fast(ColorDepth::Never, Charset::Ascii) };
        let map = map("unit", &style, (40, 12), 1);
        let cells = MapPainter::new(&style).cells(&map, 0..12);
        assert_eq!(cells.lines()[10].trim(), "exact: all right, it is the truth");
    }

    #[test]
    fn a_small_map_has_no_legend_and_a_narrow_one_is_cut() {
        for size in [(1, 1), (7, 3), (1, 4), (9, 5), (200, 60)] {
            let style = fast(ColorDepth::Never, Charset::Ascii);
            let map = map("edge", &style, size, 2);
            let cells = MapPainter::new(&style).cells(&map, 0..size.1);
            let text = cells.lines().concat();
            assert_eq!(cells.cells().len(), usize::from(size.0) * usize::from(size.1));
            assert_eq!(text.contains("fast"), size.0 > 5 && size.1 >= FEWEST_ROWS, "{text}");
        }
    }
}
