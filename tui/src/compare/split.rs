//! Two tiers side by side: the columns left of a seam by one tier, those right of it by the other. Below is what each
//! takes and gets wrong.

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
use std::time::Instant;

/// The rows of the figures, and the fewest rows of a picture that has them.
const FIGURES: u16 = 2;
const FEWEST_ROWS: u16 = 4;
/// The most tests of a ray against a sphere whose stages are counted.
const MOST_TESTS: usize = 1 << 22;
/// How many of the last times the median is taken of.
const TIMES: usize = 9;

/// A picture cut in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// The tiers left and right of the seam.
    pub tiers: [Tier; 2],
    /// The column of the seam.
    pub seam: u16,
}

/// A drawn picture, and the nanoseconds a ray of each half; `None` for a half without rays.
#[derive(Clone, Debug)]
pub struct SplitPicture {
    /// Without figures.
    pub drawn: Drawn,
    /// Shadow rays count as rays.
    pub ns_a_ray: [Option<f64>; 2],
}

/// What the tier of a half gets wrong, and which stages its tests reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HalfFigures {
    /// Camera rays, a few a cell.
    pub rays: u64,
    /// Rays with another answer than that of `Exact`, beside rounding.
    pub wrong: u64,
    /// The stages of every test that there is, as if by brute force; of some rays only, if there are too many tests.
    pub stages: Stages,
}

impl Split {
    /// The columns of each half, of so many columns.
    #[must_use]
    pub fn halves(&self, columns: u16) -> [Range<u16>; 2] {
        let seam = self.seam.min(columns);
        [0..seam, seam.saturating_add(1).min(columns)..columns]
    }

    /// Draws both halves and the seam.
    #[must_use]
    pub fn draw(
        &self,
        renderer: &mut Renderer<'_>,
        scene: (&Scene, &PictureSearch<'_>),
        view: &View,
        style: &Style,
        (columns, rows): (u16, u16),
        spending: Spending,
    ) -> SplitPicture {
        let mut cells = CellGrid::new(columns, rows);
        let (mut effort, mut ns_a_ray) = (Effort::NONE, [None; 2]);
        let halves = self.halves(columns).into_iter().zip(self.tiers).zip(&mut ns_a_ray);
        for ((half, accuracy), ns_a_ray) in halves.filter(|((half, _), _)| !half.is_empty()) {
            let style = Style { accuracy, ..*style };
            let part = spending.part(half.len(), usize::from(columns));
            let start = Instant::now();
            let drawn =
                renderer.draw_columns(scene, view, &style, (columns, rows), half.clone(), part);
            let ns = start.elapsed().as_secs_f64() * 1e9;
            *ns_a_ray = (drawn.effort.rays > 0).then(|| ns / drawn.effort.rays as f64);
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
        SplitPicture { drawn: Drawn { cells, effort }, ns_a_ray }
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
            let stages = match accuracy {
                Tier::Exact => stages_of(scene, view, &style, size, &half),
                // The other tiers have only single precision.
                _ => Stages::default(),
            };
            HalfFigures { rays: map.effort().samples, wrong: map.counts.wrong_decisions(), stages }
        };
        [of_half(left, self.tiers[0]), of_half(right, self.tiers[1])]
    }

    /// Writes below each half, over the last rows, what it takes and gets wrong, as far as that is known.
    pub fn write(
        &self,
        cells: &mut CellGrid,
        rows: u16,
        ns_a_ray: [Option<f64>; 2],
        figures: Option<[HalfFigures; 2]>,
    ) {
        if rows < FEWEST_ROWS {
            return;
        }
        for (index, half) in self.halves(cells.columns()).into_iter().enumerate() {
            let width = half.len();
            let name = self.tiers[index].as_str();
            let ns = ns_a_ray[index].map(|ns| format!("  {ns:.1} ns/ray"));
            let first = format!(" {name}{}", ns.unwrap_or_default());
            let second = figures.map_or_else(|| " wrong -".to_owned(), |both| text(&both[index]));
            for (line, row) in [first, second].iter().zip(rows - FIGURES..) {
                // Cut at the seam.
                let line: String = format!("{line:width$}").chars().take(width).collect();
                cells.write(half.start, row, &line, Color::Default, Color::Default);
            }
        }
    }
}

fn text(figures: &HalfFigures) -> String {
    let HalfFigures { rays, wrong, stages } = figures;
    let share = |tests: u64| 100.0 * tests as f64 / (stages.tests as f64).max(1.0);
    let wrong = format!(" wrong {} of {}", grouped(*wrong), grouped(*rays));
    format!("{wrong} f64 {:.1}% sums {:.3}%", share(stages.double), share(stages.expansions))
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

/// The last times of both halves.
#[derive(Clone, Debug, Default)]
pub struct Times {
    of: Option<[Tier; 2]>,
    last: [Vec<f64>; 2],
}

impl Times {
    /// Takes note of a picture of these `tiers`, and returns the medians of the last times, which can be read.
    pub fn medians(&mut self, tiers: [Tier; 2], ns_a_ray: [Option<f64>; 2]) -> [Option<f64>; 2] {
        if self.of != Some(tiers) {
            *self = Self { of: Some(tiers), ..Self::default() };
        }
        for (last, ns) in self.last.iter_mut().zip(ns_a_ray) {
            last.extend(ns);
            if last.len() > TIMES {
                last.remove(0);
            }
        }
        self.last.each_ref().map(|last| {
            let mut sorted = last.clone();
            sorted.sort_by(f64::total_cmp);
            sorted.get(sorted.len() / 2).copied()
        })
    }
}
