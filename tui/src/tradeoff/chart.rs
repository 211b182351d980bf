//! A report as bars over a picture: of every tier nanoseconds a ray, wrong rays in a million, and ulp of t.

use super::rays::Kind;
use super::report::{Report, TierReport};
use super::watch::Step;
use crate::cells::{CellGrid, Color};
use crate::compare::grouped;
use crate::style::{Charset, ColorDepth, Style};
use spherule_kernel::Tier;
use std::iter;

/// How a measurement stands.
#[derive(Clone, Debug)]
pub enum Standing {
    /// The picture still moves.
    Waiting,
    /// What is being done, and the share of all that is done.
    Underway(Step, f64),
    /// It is done.
    Done(Report),
    /// Why there is no report.
    Failed(String),
}

/// What the columns hold.
const TITLES: [&str; 3] = ["ns a ray", "wrong in a million", "largest ulp of t"];
/// The lengths of bars: those of time grow evenly up to the slowest, the others as logarithms do.
const FOOT: &str = "bars of wrong and ulp: logarithms, full at 10^6 and 2^24";
/// The other tiers' own shadow rays start farther from the surface, so that they are less wrong.
const WHOSE_SHADOWS: &str = ", from where exact starts them";
/// The longest name of a tier.
const NAME: usize = 9;
/// The shortest bars, and the longest that are read at a glance.
const BARS: (usize, usize) = (4, 24);
/// How wide the numbers of the columns are, unless some are wider: so the size does not change with the times.
const NUMBERS: [usize; 3] = [6, 7, 9];
/// How long the bar is that tells how far a measurement is.
const WAY: usize = 30;

/// The colour of the bars of each column: one of the 16 that every terminal with colour has. They are those of the
/// user's theme, so that they are seen on light and dark. Titles say the same.
const COLORS: [Color; 3] = [Color::Ansi16(6), Color::Ansi16(9), Color::Ansi16(3)];

/// A line: texts and their colours.
type Line = Vec<(String, Color)>;

/// Writes how a measurement stands into the lower left of the first `rows` rows. Where there is no room for all of it,
/// writes what there is room for, and how much it needs.
pub fn write(cells: &mut CellGrid, rows: u16, style: &Style, standing: &Standing) {
    let columns = cells.columns();
    let (lines, width) = match standing {
        Standing::Waiting => short(" waits until the picture rests ".to_owned(), Vec::new()),
        Standing::Underway(step, share) => underway(style, *step, *share),
        Standing::Done(report) => Chart::new(report, style, columns.into()).lines(),
        Standing::Failed(why) => short(format!(" {} ", why.escape_debug()), Vec::new()),
    };
    let height = u16::try_from(lines.len()).unwrap_or(u16::MAX);
    let fits = width <= columns.into() && height <= rows;
    let room = if fits { height } else { rows.saturating_sub(1) };
    let first = rows.saturating_sub(height.max(1));
    for (row, line) in (first..).zip(lines.iter().take(room.into())) {
        cells.write(0, row, &" ".repeat(width), Color::Default, Color::Default);
        let mut column = 0_usize;
        for (text, color) in line {
            let place = u16::try_from(column).unwrap_or(u16::MAX);
            cells.write(place, row, text, *color, Color::Default);
            column += text.chars().count();
        }
    }
    if !fits && rows > 0 {
        // Only a side that is too short has to grow.
        let (wide, high) = (width.max(columns.into()), height.max(rows));
        let needs = format!(" table needs {wide}x{high}, has {columns}x{rows} ");
        cells.write(0, rows - 1, &needs, Color::Default, Color::Default);
    }
}

/// One or two lines, and how wide they are.
fn short(first: String, second: Line) -> (Vec<Line>, usize) {
    let width = |line: &Line| line.iter().map(|(text, _)| text.chars().count()).sum();
    let lines = vec![vec![(first, Color::Default)], second];
    let widest = lines.iter().map(width).max().unwrap_or(0);
    (lines.into_iter().filter(|line| !line.is_empty()).collect(), widest)
}

fn underway(style: &Style, step: Step, share: f64) -> (Vec<Line>, usize) {
    let percent = format!(" {:3.0} %  Esc stops ", 100.0 * share);
    let way = (bar(style, share, WAY), color_of(style, COLORS[0]));
    let texts = [(" ".to_owned(), Color::Default), way, (percent, Color::Default)];
    short(format!(" {}", step.doing()), texts.to_vec())
}

/// The colour, or the terminal's own if there are no colours.
fn color_of(style: &Style, color: Color) -> Color {
    if style.depth == ColorDepth::Never { Color::Default } else { color }
}

/// A bar over a share of `columns`: blank where the share is 0, and never blank where it is more.
fn bar(style: &Style, share: f64, columns: usize) -> String {
    let parts: &[char] = match style.charset {
        Charset::Ascii => &['#'],
        Charset::Block => &['▏', '▎', '▍', '▌', '▋', '▊', '▉', '█'],
        _ => &['▌', '█'],
    };
    let all = columns * parts.len();
    let least = usize::from(share > 0.0);
    let length = ((share * all as f64).round() as usize).clamp(least, all);
    let full = parts[parts.len() - 1];
    let rest = (length % parts.len()).checked_sub(1).map(|part| parts[part]);
    let bar: String = iter::repeat_n(full, length / parts.len()).chain(rest).collect();
    format!("{bar:columns$}")
}

/// The report as rows of numbers and bars.
struct Chart<'a> {
    report: &'a Report,
    style: &'a Style,
    /// The slowest of all tiers and kinds of rays.
    slowest: f64,
    /// How wide the numbers are.
    numbers: [usize; 3],
    /// How long the bars.
    bar: usize,
}

impl<'a> Chart<'a> {
    /// A chart as wide as there is room in so many columns.
    fn new(report: &'a Report, style: &'a Style, columns: usize) -> Self {
        let mut numbers = NUMBERS;
        for tier in &report.tiers {
            for (width, number) in numbers.iter_mut().zip(texts(tier)) {
                *width = number.len().max(*width);
            }
        }
        let slowest = report.tiers.iter().map(TierReport::ns_per_ray).fold(0.0, f64::max);
        let mut chart = Self { report, style, slowest, numbers, bar: BARS.0 };
        while chart.bar < BARS.1 && (Self { bar: chart.bar + 1, ..chart }).width() <= columns {
            chart.bar += 1;
        }
        chart
    }

    fn column(&self, index: usize) -> usize {
        (self.numbers[index] + 1 + self.bar).max(TITLES[index].len())
    }

    fn width(&self) -> usize {
        let columns: usize = (0..TITLES.len()).map(|index| 2 + self.column(index)).sum();
        1 + NAME + columns + 1
    }

    /// All of it, and how wide it is.
    fn lines(&self) -> (Vec<Line>, usize) {
        let plain = |text: String| vec![(text, Color::Default)];
        let titles = TITLES.iter().enumerate();
        let titles = titles.map(|(index, title)| format!("  {title:0$}", self.column(index)));
        let titles = format!(" {:NAME$}{}", "", titles.collect::<String>());
        let mut lines =
            vec![plain(format!(" {}", self.report.search_and_machine())), plain(titles)];
        for of_kind in self.report.tiers.chunks(Tier::ALL.len()) {
            lines.extend(of_kind.first().map(|tier| plain(heading(tier))));
            lines.extend(of_kind.iter().map(|tier| self.row(tier)));
        }
        lines.push(plain(format!(" {FOOT}")));
        (lines, self.width())
    }

    fn row(&self, tier: &TierReport) -> Line {
        let mut line = vec![(format!(" {:NAME$}", tier.tier.as_str()), Color::Default)];
        let columns = texts(tier).into_iter().zip(shares(tier, self.slowest)).zip(COLORS);
        for (index, ((number, share), color)) in columns.enumerate() {
            let width = self.column(index) - self.bar - 1;
            line.push((format!("  {number:>width$} "), Color::Default));
            line.push((bar(self.style, share, self.bar), color_of(self.style, color)));
        }
        line
    }
}

/// How many rays, and whose.
fn heading(tier: &TierReport) -> String {
    let whose = if tier.rays_kind == Kind::Shadow.name() { WHOSE_SHADOWS } else { "" };
    format!(" {} {} rays{whose}", grouped(tier.rays as u64), tier.rays_kind)
}

/// The numbers of a tier.
fn texts(tier: &TierReport) -> [String; 3] {
    let ulp = tier.errors.ulp.map_or_else(|| "-".to_owned(), |ulp| grouped(ulp.max));
    [format!("{:.1}", tier.ns_per_ray()), grouped(tier.wrong_in_a_million()), ulp]
}

/// How much of their bars the numbers fill.
fn shares(tier: &TierReport, slowest: f64) -> [f64; 3] {
    let ulp = tier.errors.ulp.map_or(0, |ulp| ulp.max);
    [
        if slowest > 0.0 { tier.ns_per_ray() / slowest } else { 0.0 },
        (1.0 + tier.wrong_in_a_million() as f64).log10() / 6.0,
        (1.0 + ulp as f64).log2() / 24.0,
    ]
}

#[cfg(test)]
mod tests;
