//! Pictures as the program draws them in pixels.

use spherule::draw::pixels::PixelGrid;
use spherule::draw::{self, Renderer};
use spherule::scene::Scene;
use spherule::style::Style;
use spherule::threads::Threads;
use spherule::view::View;
use spherule_kernel::{Level, Tier};
use spherule_tests::art::light::Light;
use spherule_tests::art::palette::Rgb;
use std::convert::Infallible;

/// The truth: the pixels that `--png` writes.
pub(crate) fn truth(scene: &Scene, view: &View, columns: u16, rows: u16) -> Light {
    let threads = Threads::default();
    let grid = PixelGrid::new(view, &Style::PLAIN, columns, rows);
    let search = draw::brute_force(scene, view);
    let mut pixels: Vec<Rgb> = Vec::new();
    let take = |row: &[u8]| {
        pixels.extend(row.as_chunks().0);
        Ok::<_, Infallible>(())
    };
    let renderer = Renderer::new(Level::best(), &threads);
    let Ok(()) = renderer.draw_pixels(scene, &search, Tier::Exact, &grid, take);
    Light::of_colors(grid.size().0 as usize, pixels)
}
