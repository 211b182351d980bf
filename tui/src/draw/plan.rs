//! What is decided about a picture before its first ray.

use super::tracer::{SampleGrid, Traced};
use crate::cells::fit::Fitter;
use crate::samples::CellSamples;
use crate::style::Style;
use crate::view::View;

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
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Of every cell.
    pub(super) few: Sampling,
    /// Of those where the few are not enough.
    pub(super) many: Option<Sampling>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(
        traced: Traced<'a>,
        view: &View,
        style: &'a Style,
        columns: u16,
        rows: u16,
    ) -> Self {
        let sampling = |samples| Sampling {
            samples,
            grid: SampleGrid::new(view, style, samples, columns, rows),
            fitter: Fitter::new(style, samples),
        };
        Self {
            traced,
            style,
            columns: columns.into(),
            rows: rows.into(),
            few: sampling(CellSamples::new(style)),
            many: CellSamples::many(style).map(sampling),
        }
    }
}
