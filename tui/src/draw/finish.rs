//! What is done to the light of samples when it is known how far away they are: it fades, and edges get dark.

use super::sample_grid::{SampleGrid, Traced};
use crate::samples::CellSamples;
use crate::scene::attributes::Naming;
use crate::shade::depth_cue::DepthCue;
use crate::shade::silhouettes::{Pitch, Seen, SeenGrid, darkened, reach};
use crate::style::Style;
use crate::view::View;
use spherule_kernel::{Hit, Spheres, Vec3};

/// How the samples of a picture are finished.
#[derive(Clone, Copy, Debug)]
pub(super) struct Finish<'a> {
    cue: Option<DepthCue>,
    /// Whether edges get dark.
    pub(super) edges: bool,
    spheres: Spheres<'a>,
    /// Which part each sphere is of, if the scene has parts.
    parts: &'a [u32],
    background: Vec3,
    few: CellSamples,
    cell_aspect: f32,
    pitch: Pitch,
}

impl<'a> Finish<'a> {
    /// The finish of a picture with so few samples in every cell; `None` if they are left as they are.
    pub(super) fn new(
        traced: &Traced<'a>,
        view: &View,
        style: &Style,
        (few, grid): (CellSamples, &SampleGrid),
    ) -> Option<Self> {
        let aids = style.aids;
        let subject = traced.search.setting.subject.filter(|_| aids.depth_cue);
        let attributes = traced.scene.attributes();
        let parts = [Naming::Chain, Naming::Molecule]
            .into_iter()
            .find_map(|naming| attributes.names(naming));
        (subject.is_some() || aids.edges).then(|| Self {
            cue: subject.map(|subject| DepthCue::new(view, subject)),
            edges: aids.edges,
            spheres: traced.scene.spheres(),
            parts: parts.map_or(&[], |names| names.indices()),
            background: traced.scene.background.to_linear(),
            few,
            cell_aspect: style.cell_aspect,
            pitch: Pitch::new(&grid.camera),
        })
    }

    /// What a hit shows. Its depth is t, since the part of every camera ray's direction along the line of sight is one.
    #[inline]
    pub(super) fn seen(&self, hit: Hit) -> Seen {
        let index = hit.sphere as usize;
        let radius = self.spheres.get(index).map_or(0.0, |sphere| sphere.radius);
        Seen { depth: hit.t, radius, part: self.parts.get(index).copied().unwrap_or(0) }
    }

    /// How many columns and rows of cells away there may be what darkens a cell.
    pub(super) fn reach(&self) -> [usize; 2] {
        let samples = (self.few.across as usize, self.few.down as usize);
        if self.edges { reach(samples, self.cell_aspect) } else { [0; 2] }
    }

    /// What the few samples show of rows of so many cells.
    pub(super) fn grid<'b>(&self, seen: &'b [Seen], columns: usize) -> SeenGrid<'b> {
        let samples = (self.few.across as usize, self.few.down as usize);
        SeenGrid { seen, columns, samples, cell_aspect: self.cell_aspect, pitch: self.pitch }
    }

    /// Lets a sample fade.
    #[inline]
    pub(super) fn fade(&self, light: &mut Vec3, seen: &Seen) {
        if let Some(cue) = self.cue.filter(|_| seen.depth.is_finite()) {
            *light = cue.seen(*light, seen.depth, self.background);
        }
    }

    /// Darkens a sample that has faded, at this place of the grid.
    #[inline]
    pub(super) fn darken(
        &self,
        light: &mut Vec3,
        seen: &Seen,
        grid: &SeenGrid<'_>,
        place: (f32, f32),
    ) {
        let darkness = grid.darkness(place, seen);
        if darkness > 0.0 {
            let veil = self.cue.map_or(0.0, |cue| cue.veil(seen.depth));
            *light = darkened(*light, veil * self.background, darkness);
        }
    }
}
