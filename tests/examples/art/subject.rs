//! A scene, drawn by the program's own library.

use super::modes::SIZE;
use spherule::draw::pixels::PixelGrid;
use spherule::draw::{Renderer, Spending, picture_workload};
use spherule::encode;
use spherule::scene::Scene;
use spherule::scene::builtin::builtin;
use spherule::scene::open;
use spherule::structure::scene::SceneStructures;
use spherule::style::Style;
use spherule::threads::Threads;
use spherule::view::View;
use spherule_kernel::Level;
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::Rgb;
use spherule_tests::art::scenes::KEPT;
use std::convert::Infallible;
use std::error::Error;

/// A scene with a name.
pub(crate) struct Subject {
    pub(crate) name: &'static str,
    scene: Scene,
    /// Where it is first seen from.
    pub(crate) home: View,
}

impl Subject {
    pub(crate) fn open(name: &'static str) -> Result<Self, Box<dyn Error>> {
        let kept = KEPT.iter().find(|kept| kept.name == name);
        let scene = match kept {
            Some(kept) => open::scene(&kept.path()).map_err(|error| error.to_string())?,
            None => builtin(name).ok_or("no such scene")?,
        };
        let home = scene.first_view(Style::PLAIN.picture_aspect(SIZE.0, SIZE.1) as f32);
        Ok(Self { name, scene, home })
    }

    /// The picture in the pixels that `--png` writes.
    pub(crate) fn truth(&self, view: &View) -> Result<Light, Box<dyn Error>> {
        let Self { scene, .. } = self;
        let threads = Threads::new(None).map_err(said)?;
        let mut structures = SceneStructures::new(scene.list(), &threads);
        let grid = PixelGrid::new(view, &Style::PLAIN, SIZE.0, SIZE.1);
        let workload = grid.workload(scene.spheres().len());
        let search = structures.picture(None, &workload, view, scene).map_err(said)?;
        let mut colors: Vec<Rgb> = Vec::new();
        let take = |row: &[u8]| {
            colors.extend(row.as_chunks().0);
            Ok::<_, Infallible>(())
        };
        let renderer = Renderer::new(Level::best(), &threads);
        let accuracy = Style::PLAIN.accuracy;
        let Ok(()) = renderer.draw_pixels(scene, &search, accuracy, &grid, take);
        Ok(Light::of_colors(grid.size().0 as usize, colors))
    }

    /// The pictures in cells: for one view the cells that `--once` writes; for several those of the viewer, which draws
    /// them one after the other, with time enough.
    pub(crate) fn pictures(
        &self,
        style: &Style,
        views: &[View],
    ) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
        let Self { scene, .. } = self;
        let threads = Threads::new(None).map_err(said)?;
        let mut structures = SceneStructures::new(scene.list(), &threads);
        let workload = picture_workload(scene.spheres().len(), style, SIZE.0, SIZE.1, 1.0);
        // One renderer for all views, since what it carries from frame to frame counts.
        let mut renderer = Renderer::new(Level::best(), &threads);
        let spending = match views {
            [_] => Spending::ByNeed,
            _ => Spending::AtMost(u64::MAX),
        };
        let draw = |view: &View| {
            let search = structures.picture(None, &workload, view, scene).map_err(said)?;
            let drawn = renderer.draw(scene, &search, view, style, SIZE, spending);
            let mut bytes = Vec::new();
            encode::full(&drawn.cells, &mut bytes);
            Ok(bytes)
        };
        views.iter().map(draw).collect()
    }
}

/// What the program says when it fails.
fn said(error: impl std::fmt::Debug) -> String {
    format!("{error:?}")
}
