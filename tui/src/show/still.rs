//! Pictures of frames, one after another, from where the first is seen.

use super::once::Once;
use super::reading::while_reading;
use crate::choice::Auto;
use crate::coloring::legend::Legend;
use crate::draw::{Renderer, picture_workload};
use crate::error::Error;
use crate::scene::Scene;
use crate::scene::frames::Frames;
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::style::Style;
use crate::view::View;
use std::ops::Range;

/// What the frames have in common.
pub(super) struct Still {
    pub(super) view: View,
    pub(super) style: Style,
    pub(super) structure: Auto<Structure>,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    pub(super) is_terminal: bool,
}

impl Still {
    /// Writes the pictures of a range of frames.
    pub(super) fn pictures(
        &self,
        renderer: &mut Renderer<'_>,
        mut structures: SceneStructures<'_>,
        frames: Frames,
        range: Range<usize>,
        mut prepared: impl FnMut(usize, Scene) -> (Scene, Option<Legend>),
    ) -> Result<(), Error> {
        let Self { view, style, structure, size: (columns, rows), is_terminal } = *self;
        let end = range.end;
        while_reading(frames, range, |index, scene| {
            let (scene, legend) = prepared(index, scene);
            structures.go_on(scene.list());
            let workload = picture_workload(scene.spheres().len(), &style, columns, rows, 1.0)
                .with_moves((end - index - 1) as f64);
            let search = structures.picture(structure, &workload, &view, &scene)?;
            let once = Once { scene: &scene, view, style, size: self.size, is_terminal };
            once.picture(renderer, &search, legend)
        })
    }
}
