//! Where the samples of a picture are, and what they are traced against.

use crate::samples::CellSamples;
use crate::scene::Scene;
use crate::structure::picture_search::PictureSearch;
use crate::structure::search::Tracing;
use crate::style::Style;
use crate::threads::Threads;
use crate::view::View;
use spherule_kernel::Camera;

/// What is traced, and how.
#[derive(Clone, Copy, Debug)]
pub(super) struct Traced<'a> {
    pub(super) tracing: Tracing,
    pub(super) scene: &'a Scene,
    pub(super) search: &'a PictureSearch<'a>,
    /// Whoever stops them no longer waits for the picture.
    pub(super) threads: &'a Threads,
}

/// A grid of samples over the whole picture: sample `(x, y)` is the ray `camera.get_ray(x, y)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampleGrid {
    pub(super) camera: Camera,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl SampleGrid {
    /// The grid of so many samples in every cell of a picture of `columns` x `rows`.
    pub(super) fn new(
        view: &View,
        style: &Style,
        samples: CellSamples,
        columns: u16,
        rows: u16,
    ) -> Self {
        let (width, height) = (u32::from(columns) * samples.across, u32::from(rows) * samples.down);
        let camera = view.camera(width, height, style.picture_aspect(columns, rows));
        Self { camera, width, height }
    }
}
