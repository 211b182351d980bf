//! What is decided about a picture before its first ray.

use super::finish::Finish;
use super::sample_grid::{SampleGrid, Traced};
use super::spending::Spending;
use crate::cells::eye::Eye;
use crate::cells::fit::Fitter;
use crate::samples::CellSamples;
use crate::style::Style;
use crate::view::View;
use std::ops::Range;

/// Samples of every cell, and what is made of them.
#[derive(Debug)]
pub(super) struct Sampling {
    pub(super) samples: CellSamples,
    pub(super) grid: SampleGrid,
    pub(super) fitter: Fitter,
}

/// What a picture is of, and how it is made.
#[derive(Debug)]
pub(super) struct Plan<'a> {
    pub(super) traced: Traced<'a>,
    pub(super) style: &'a Style,
    /// The first column of cells that is drawn, and how many are.
    pub(super) left: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The samples of every cell.
    pub(super) few: Sampling,
    /// The samples of cells where the few are not enough, from the finest grid to the coarsest that will do; empty if
    /// there are only the few.
    pub(super) many: Vec<Sampling>,
    pub(super) spending: Spending,
    /// Whether it is drawn as well as can be, and not as one of many that pass.
    pub(super) is_steady: bool,
    pub(super) eye: Eye,
    /// What is done to samples when depths are known, if anything is.
    pub(super) finish: Option<Finish<'a>>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(
        traced: Traced<'a>,
        view: &View,
        style: &'a Style,
        (columns, rows): (u16, u16),
        spending: Spending,
    ) -> Self {
        let is_steady = spending == Spending::ByNeed;
        let eye = if is_steady { Eye::at(style.distance) } else { Eye::MOVING };
        let sampling = |samples| Sampling {
            samples,
            grid: SampleGrid::new(view, style, samples, columns, rows),
            fitter: Fitter::new(style, eye, samples),
        };
        let few = sampling(CellSamples::new(style));
        let finish = Finish::new(&traced, view, style, (few.samples, &few.grid));
        let many = CellSamples::many(style);
        let with_coarser = |finest: CellSamples| {
            let finer = finest.finer(style.charset).filter(|_| !is_steady);
            let coarser = finest.coarser().filter(move |_| !is_steady);
            finer.into_iter().chain([finest]).chain(coarser)
        };
        Self {
            traced,
            style,
            left: 0,
            columns: columns.into(),
            rows: rows.into(),
            few,
            many: many.into_iter().flat_map(with_coarser).map(sampling).collect(),
            spending,
            is_steady,
            eye,
            finish,
        }
    }

    /// How many columns and rows of cells away there may be what darkens a cell.
    pub(super) fn edges_reach(&self) -> [usize; 2] {
        self.finish.as_ref().map_or([0; 2], Finish::reach)
    }

    /// The same picture, but only these columns are drawn, as if it ended with them.
    pub(super) fn only(mut self, columns: Range<u16>) -> Self {
        (self.left, self.columns) = (columns.start.into(), columns.len());
        for sampling in self.many.iter_mut().chain([&mut self.few]) {
            sampling.grid.width = u32::from(columns.end) * sampling.samples.across;
        }
        self
    }
}
