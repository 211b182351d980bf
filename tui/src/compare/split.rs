//! Two tiers side by side: the columns left of a seam by one tier, those right of it by the other. Below is what each
//! gets wrong.

use super::error_map::ErrorMapper;
use super::grouped;
use crate::cells::{CellGrid, Color};
use crate::draw::{Drawn, Effort, Renderer, Spending, sample_grid};
use crate::scene::Scene;
use crate::structure::picture_search::PictureSearch;
use crate::style::{Charset, Style};
use crate::view::View;
use spherule_kernel::{Camera, ClosestHit, RayPacket, Stages, Tier, stages};
use std::ops::Range;

/// The rows of the figures, and the fewest rows of a picture that has them.
const FIGURES: u16 = 2;
const FEWEST_ROWS: u16 = 4;
/// The most tests of a ray against a sphere whose stages are counted.
const MOST_TESTS: usize = 1 << 22;

/// A picture cut in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// The tiers left and right of the seam.
    pub tiers: [Tier; 2],
    /// The column of the seam.
    pub seam: u16,
}

/// What the tier of a half gets wrong, and which stages its tests reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HalfFigures {
    /// Camera rays, a few a cell.
    pub rays: u64,
    /// Rays with another answer than that of `Exact`, beside rounding.
    pub wrong: u64,
    /// The stages of every test that there is, as if by brute force; of some rays only, if there are too many tests.
    /// `None` except for `Exact`: the other tiers have only single precision.
    pub stages: Option<Stages>,
}

impl Split {
    /// The columns of each half, of so many columns.
    #[must_use]
    pub fn halves(&self, columns: u16) -> [Range<u16>; 2] {
        let seam = self.seam.min(columns);
        [0..seam, seam.saturating_add(1).min(columns)..columns]
    }

    /// Draws both halves and the seam, without figures.
    #[must_use]
    pub fn draw(
        &self,
        renderer: &mut Renderer<'_>,
        scene: (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        spending: Spending,
    ) -> Drawn {
        let (mut cells, mut effort) = (CellGrid::new(columns, rows), Effort::NONE);
        let halves = self.halves(columns).into_iter().zip(self.tiers);
        for (half, accuracy) in halves.filter(|(half, _)| !half.is_empty()) {
            let style = Style { accuracy, ..*style };
            let part = spending.part(half.len(), usize::from(columns));
            let drawn =
                renderer.draw_columns(scene, view, &style, (columns, rows), half.clone(), part);
            let own = half.len();
            let lines = cells.cells_mut().chunks_mut(usize::from(columns));
            for (line, half_line) in lines.zip(drawn.cells.cells().chunks(own)) {
                line[usize::from(half.start)..][..own].copy_from_slice(half_line);
            }
            effort = effort.and(drawn.effort);
        }
        let seam = if style.charset == Charset::Ascii { "|" } else { "│" };
        for row in 0..rows {
            cells.write(self.seam, row, seam, Color::Default, Color::Default);
        }
        Drawn { cells, effort }
    }

    /// Compares both halves with `Exact`. This is for pictures at rest: it takes as long as a picture.
    #[must_use]
    pub fn figures(
        &self,
        renderer: &Renderer<'_>,
        mapper: &mut ErrorMapper,
        (scene, search): (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        size: (u16, u16),
    ) -> [HalfFigures; 2] {
        let [left, right] = self.halves(size.0);
        let mut of_half = |half: Range<u16>, accuracy| {
            let style = Style { accuracy, ..*style };
            let machine = renderer.machine();
            let map =
                mapper.map_columns((scene, search), view, &style, size, &half, machine, |_| {});
            let is_exact = accuracy == Tier::Exact;
            let stages = is_exact.then(|| stages_of(scene, view, &style, size, &half));
            HalfFigures { rays: map.effort().samples, wrong: map.counts.wrong_decisions(), stages }
        };
        [of_half(left, self.tiers[0]), of_half(right, self.tiers[1])]
    }

    /// Writes below each half, over the last rows, its tier and what that gets wrong, as far as it is known.
    pub fn write(&self, cells: &mut CellGrid, rows: u16, figures: Option<[HalfFigures; 2]>) {
        if rows < FEWEST_ROWS {
            return;
        }
        for (index, half) in self.halves(cells.columns()).into_iter().enumerate() {
            let width = half.len();
            let name = vec![self.tiers[index].as_str().to_owned()];
            let words = figures.map_or_else(|| vec!["wrong -".to_owned()], |of| words(&of[index]));
            for (words, row) in [name, words].iter().zip(rows - FIGURES..) {
                let line = line(words, width);
                cells.write(half.start, row, &line, Color::Default, Color::Default);
            }
        }
    }
}

/// The figures in words, the most important first.
fn words(figures: &HalfFigures) -> Vec<String> {
    let HalfFigures { rays, wrong, stages } = figures;
    let mut words = vec![format!("wrong {} of {}", grouped(*wrong), grouped(*rays))];
    if let Some(stages) = stages {
        let share = |tests: u64| 100.0 * tests as f64 / (stages.tests as f64).max(1.0);
        words.push(format!("f64 {:.1}%", share(stages.double)));
        words.push(format!("sums {:.3}%", share(stages.expansions)));
    }
    words
}

/// A line of this `width`, with as many of the `words` as it has room for: a number that is cut is another number.
fn line(words: &[String], width: usize) -> String {
    let mut line = String::new();
    for word in words {
        if line.len() + 1 + word.len() > width {
            break;
        }
        line = line + " " + word;
    }
    format!("{line:width$}")
}

/// The stages of the camera rays through some columns.
fn stages_of(
    scene: &Scene,
    view: &View,
    style: &Style,
    (columns, rows): (u16, u16),
    half: &Range<u16>,
) -> Stages {
    let (camera, width, height) = sample_grid(view, style, columns, rows);
    let across = width / u32::from(columns).max(1);
    let (left, right) = (u32::from(half.start) * across, u32::from(half.end) * across);
    let corners = Camera::tile_corners::<[f32; 16]>(right - left, height);
    let some = (MOST_TESTS / scene.spheres().len().max(1) / RayPacket::COUNT).max(1);
    let step = corners.clone().count().div_ceil(some).max(1);
    let packets: Vec<_> = corners
        .step_by(step)
        .map(|(x, y)| camera.packet::<[f32; 16]>(left + x, y, right, height))
        .collect();
    stages(ClosestHit, &packets, scene.spheres())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last row of a picture of so many columns, whose seam is in the middle.
    fn last_row(columns: u16, figures: Option<[HalfFigures; 2]>) -> String {
        let mut cells = CellGrid::new(columns, FEWEST_ROWS);
        let split = Split { tiers: [Tier::Fast, Tier::Exact], seam: columns / 2 };
        split.write(&mut cells, FEWEST_ROWS, figures);
        cells.lines().pop().unwrap_or_default()
    }

    /// Only `Exact` has more than single precision.
    #[test]
    fn figures_are_written_whole_or_not_at_all() {
        let stages = Stages { tests: 1000, double: 44, expansions: 2 };
        let fast = HalfFigures { rays: 3600, wrong: 53, stages: None };
        let exact = HalfFigures { rays: 3600, wrong: 0, stages: Some(stages) };
        let (left, right) = ("wrong 53 of 3,600", "wrong 0 of 3,600");
        for (columns, expected) in [
            (91, [left, &format!("{right} f64 4.4% sums 0.200%")]),
            (77, [left, &format!("{right} f64 4.4% sums 0.200%")]),
            (75, [left, &format!("{right} f64 4.4%")]),
            (53, [left, &format!("{right} f64 4.4%")]),
            (51, [left, right]),
            (35, ["", right]),
            (33, ["", ""]),
        ] {
            let row = last_row(columns, Some([fast, exact]));
            let halves = row.split_at(usize::from(columns / 2));
            let halves = [halves.0, &halves.1[1..]].map(str::trim);
            assert_eq!(halves, expected, "{columns}");
        }
        assert_eq!(last_row(21, None).matches(" wrong -").count(), 2);
    }
}
