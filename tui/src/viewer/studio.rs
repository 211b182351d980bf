//! Renderer and structures, lent to the drawing thread while the viewer reads input.

use super::picking::Cursor;
use super::pixel_frame::NO_TEXT;
use super::session::Picture;
use super::shown::Shown;
use super::table::Means;
use super::wanted::Wanted;
use crate::cells::CellGrid;
use crate::compare::Comparison;
use crate::compare::error_map::ErrorMapper;
use crate::compare::legend::MapPainter;
use crate::compare::split::Split;
use crate::draw::pixels::{PixelGrid, SAMPLES};
use crate::draw::{Drawn, Effort, Renderer, Spending, picture_workload};
use crate::error::Error;
use crate::pick::{Pick, cell_ray};
use crate::scene::Scene;
use crate::structure::scene::SceneStructures;
use crate::threads::Threads;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is kept from picture to picture to draw them.
#[derive(Debug)]
pub(super) struct Studio<'a> {
    pub(super) structures: SceneStructures<'a>,
    renderer: Renderer<'a>,
    mapper: ErrorMapper,
}

/// How a picture is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manner {
    /// The column between two tiers.
    pub(super) seam: u16,
    /// Whether it is one of a movement.
    pub(super) moving: bool,
    pub(super) spending: Spending,
}

impl<'a> Studio<'a> {
    /// A studio that has drawn nothing yet.
    pub(super) fn new(structures: SceneStructures<'a>, renderer: Renderer<'a>) -> Self {
        Self { structures, renderer, mapper: ErrorMapper::default() }
    }

    /// The threads that draw: to stop them ends the picture that is being drawn, which is then worthless.
    pub(super) fn threads(&self) -> &'a Threads {
        self.renderer.machine().1
    }

    /// What measures the table of the picture that `shown` has of `scene`.
    pub(super) fn means(&self, scene: &Arc<Scene>, shown: &Shown) -> Means {
        Means {
            scene: Arc::clone(scene),
            style: shown.style,
            tree: self.structures.tree(),
            order: self.structures.order(),
            level: self.renderer.machine().0,
        }
    }

    /// Draws the picture of `scene` that is wanted; also returns how long that took, without building a structure.
    pub(super) fn draw(
        &mut self,
        scene: &Scene,
        wanted: &Wanted,
        manner: Manner,
    ) -> Result<(Picture, Duration), Error> {
        match wanted.cell {
            Some(cell) => self.draw_pixels(scene, wanted, cell, manner.spending),
            None => self.draw_cells(scene, wanted, manner),
        }
    }

    /// Draws the picture in pixels, so many a cell.
    fn draw_pixels(
        &mut self,
        scene: &Scene,
        wanted: &Wanted,
        cell: (u32, u32),
        spending: Spending,
    ) -> Result<(Picture, Duration), Error> {
        let Shown { view, style, structure, .. } = &wanted.pictured;
        let (columns, rows) = wanted.size;
        let pixels = u64::from(columns) * u64::from(rows) * u64::from(cell.0 * cell.1);
        let across = match spending {
            Spending::AtMost(most) if most < 4 * pixels => 1,
            Spending::AtMost(_) => 2,
            Spending::ByNeed => SAMPLES,
        };
        let grid = PixelGrid::in_cells(view, style, wanted.size, cell, across);
        let workload = grid.workload(scene.spheres().len());
        let search = self.structures.picture(*structure, &workload, view, scene)?;
        let started = Instant::now();
        let image = self.renderer.draw_image(scene, &search, style.accuracy, &grid);
        let samples = pixels * u64::from(across * across);
        let effort = Effort { samples, rays: samples, is_full: across == SAMPLES };
        let mut cells = CellGrid::new(columns, rows);
        cells.cells_mut().fill(NO_TEXT);
        let (structure, drawn) = (Some(search.structure), Drawn { cells, effort });
        let picture = Picture { of: *wanted, structure, drawn, image: Some(image), legend: None };
        Ok((picture, started.elapsed()))
    }

    /// Draws the picture in cells.
    fn draw_cells(
        &mut self,
        scene: &Scene,
        wanted: &Wanted,
        Manner { seam, moving, spending }: Manner,
    ) -> Result<(Picture, Duration), Error> {
        let Wanted { pictured, size, .. } = wanted;
        let Shown { view, style, structure, comparison, .. } = pictured;
        let count = scene.spheres().len();
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let search = self.structures.picture(*structure, &workload, view, scene)?;
        let searched = (scene, &search);
        let started = Instant::now();
        let drawn = match comparison {
            None => self.renderer.draw(scene, &search, view, style, *size, spending),
            Some(Comparison::Split(tiers)) => {
                let split = Split { tiers: *tiers, seam };
                let renderer = &mut self.renderer;
                let mut drawn = split.draw(renderer, searched, view, style, *size, spending);
                // Wrong answers are counted at rest: counting takes as long as a picture.
                let (renderer, mapper) = (&self.renderer, &mut self.mapper);
                let figures = (!moving)
                    .then(|| split.figures(renderer, mapper, searched, view, style, *size));
                split.write(&mut drawn.cells, size.1, figures);
                drawn.effort.is_full &= !moving;
                drawn
            }
            Some(Comparison::Errors) => {
                let machine = self.renderer.machine();
                let map = self.mapper.map(searched, view, style, *size, machine, |_| {});
                // All of it, at every pace.
                let cells = MapPainter::new(style).cells(&map, 0..size.1);
                Drawn { cells, effort: map.effort() }
            }
        };
        let (of, structure) = (*wanted, Some(search.structure));
        let picture = Picture { of, structure, drawn, image: None, legend: None };
        Ok((picture, started.elapsed()))
    }

    /// What is picked in this picture of `scene`, if a cell is.
    pub(super) fn pick<'s>(
        &mut self,
        scene: &'s Scene,
        &Wanted { ref pictured, size, .. }: &Wanted,
        cursor: Option<Cursor>,
    ) -> Result<Option<Pick<'s>>, Error> {
        let Shown { view, style, structure, .. } = pictured;
        let Some(cursor) = cursor else { return Ok(None) };
        let count = scene.spheres().len();
        let workload = picture_workload(count, style, size.0, size.1, f64::INFINITY);
        let level = self.renderer.machine().0;
        let search = self.structures.picture(*structure, &workload, view, scene)?;
        let ray = cell_ray(view, style, size, (cursor.column, cursor.row));
        Ok(ray.map(|ray| Pick::new(scene, &search, level, ray)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::structure::Structure;
    use crate::viewer::Start;
    use crate::viewer::state::State;
    use spherule_kernel::{Level, Sphere, Vec3};

    const SIZE: (u16, u16) = (8, 4);

    /// Else it would be shown as the time of every picture, and fewer samples would be drawn in the next ones.
    #[test]
    fn the_build_of_a_tree_is_not_drawing() {
        let mut scene = Scene::new();
        for index in 0..20_000_u16 {
            let [x, y, z] = [index % 30, index / 30 % 30, index / 900].map(f32::from);
            scene.push(Sphere { center: Vec3::new(x, y, z), radius: 0.3 }, Srgb::WHITE, None);
        }
        let start = Start { structure: Some(Structure::Bvh), ..Start::FRONT };
        let pictured = State::new(start, (0, 1)).shown.pictured();
        let manner = Manner { seam: 0, moving: false, spending: Spending::ByNeed };
        for cell in [None, Some((2, 4))] {
            let threads = Threads::default();
            let structures = SceneStructures::new(scene.list(), &threads);
            let mut studio = Studio::new(structures, Renderer::new(Level::best(), &threads));
            let began = Instant::now();
            let wanted = Wanted { scene: 0, pictured, size: SIZE, cell };
            let drawn = studio.draw(&scene, &wanted, manner);
            let (all, build) = (began.elapsed(), studio.structures.build_time());
            let (_, drawing) = drawn.expect("memory for a tree");
            assert!(build > Duration::ZERO && build + drawing <= all, "{cell:?}: {drawing:?}");
        }
    }
}
