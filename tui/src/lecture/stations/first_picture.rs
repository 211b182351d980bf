//! The first picture: white where a ray hits.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Knob, Numbers, Source, Station, number, vector};
use crate::scene::builtin::builtin;
use crate::view::zoomed;
use spherule_kernel::{Exact, Intersect, Ray};

pub(super) const STATION: Station = Station {
    name: "first-picture",
    title: "the first picture, white where a ray hits",
    topic: "ray tracing",
    words: [
        "For each pixel a viewing ray; the pixel is white if it hits, else black. That",
        "is a ray tracer. The scene is unit, one sphere without a light: spherule unit.",
    ],
    arrows: "up, down: more, fewer pixels   left, right: zoom",
    sources: &[
        Source { file: "tui/scenes/unit.toml", symbols: &["sphere", "camera"] },
        Source { file: "tui/src/draw/tracer.rs", symbols: &["tile_hits"] },
    ],
    knobs: [Knob::within(12, [0, 1], [2, 200]).up_to(most), Knob::within(0, [1, 0], [-12, 12])],
    text: 33,
    draw,
};

/// The most rows of pixels that so many columns and rows of cells have room for.
fn most([columns, rows]: [i32; 2]) -> i32 {
    (rows - 2).min((columns - 2) / 3)
}

/// Rows of pixels, and steps of the zoom.
fn draw([wanted, zoom]: Numbers, canvas: &mut Canvas) -> String {
    let (wanted, scene) = (wanted.unsigned_abs(), builtin("unit").unwrap_or_default());
    let (columns, rows) = (canvas.columns(), canvas.rows());
    let room = (columns - STATION.text, rows);
    let most = most(room.into()) as u32;
    // The room may have become smaller.
    let height = wanted.min(most);
    let (width, height) = (height * 3 / 2, height);
    let aspect = f64::from(width) / f64::from(height);
    let view = zoomed(&scene.first_view(aspect as f32), 1.1_f32.powi(zoom));
    let camera = view.camera(width, height, aspect);
    let rays: Vec<Ray> =
        (0..width * height).map(|pixel| camera.get_ray(pixel % width, pixel / width)).collect();
    let mut white = vec![false; rays.len()];
    scene.list().any_hits(Exact, &rays, &mut white);
    Pixels::new((0, 0), room, (width, height)).draw(canvas, |ix, iy| {
        if white[(iy * width + ix) as usize] { Pixel::WHITE } else { Pixel::BLACK }
    });

    let hits = white.iter().filter(|&&white| white).count();
    let share = 100.0 * hits as f32 / rays.len() as f32;
    if height == most {
        canvas.write(columns - STATION.text + 1, 17, "no room for more pixels", Role::Faint);
    }
    let [x, y, z] = rays[0].direction.to_array().map(number);
    format!(
        "\
for each pixel (ix, iy):
  ray = camera.get_ray(ix, iy)
  if sphere.intersect(ray)
    white
  else
    black

pixels: {width} x {height}
rays:   {}
white:  {hits}, {share:.1} %

get_ray(0, 0):
p = {}
d =
({x},
 {y},
 {z})",
        rays.len(),
        vector(rays[0].origin)
    )
}
