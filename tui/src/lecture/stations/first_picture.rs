//! The first picture: white where a ray hits.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Entry, Source, Station, Turn, number, vector};
use crate::scene::Scene;
use crate::scene::builtin::builtin;
use crate::view::zoomed;
use spherule_kernel::{Exact, Intersect, Ray};

pub(super) const ENTRY: Entry = Entry {
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
    start: || {
        Box::new(FirstPicture { height: 12, zoom: 0, scene: builtin("unit").unwrap_or_default() })
    },
};

/// Columns of the text.
const TEXT: i32 = 33;

struct FirstPicture {
    height: u32,
    zoom: i32,
    scene: Scene,
}

impl Station for FirstPicture {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.height = self.height.saturating_add_signed(up).clamp(2, 200);
        self.zoom = (self.zoom + right).clamp(-12, 12);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (columns, rows) = (canvas.columns(), canvas.rows());
        let room = (columns - TEXT, rows);
        // No more pixels than there is room for.
        let most = ((rows - 2).min((columns - TEXT - 2) / 3)) as u32;
        let height = self.height.min(most);
        let (width, height) = (height * 3 / 2, height);
        let aspect = f64::from(width) / f64::from(height);
        let view = zoomed(&self.scene.first_view(aspect as f32), 1.1_f32.powi(self.zoom));
        let camera = view.camera(width, height, aspect);
        let rays: Vec<Ray> =
            (0..width * height).map(|pixel| camera.get_ray(pixel % width, pixel / width)).collect();
        let mut white = vec![false; rays.len()];
        self.scene.list().any_hits(Exact, &rays, &mut white);
        Pixels::new((0, 0), room, (width, height)).draw(canvas, |ix, iy| {
            if white[(iy * width + ix) as usize] { Pixel::WHITE } else { Pixel::BLACK }
        });

        let hits = white.iter().filter(|&&white| white).count();
        let share = 100.0 * hits as f32 / rays.len() as f32;
        let lines = [
            "for each pixel (ix, iy):".to_owned(),
            "  ray = camera.get_ray(ix, iy)".to_owned(),
            "  if sphere.intersect(ray)".to_owned(),
            "    white".to_owned(),
            "  else".to_owned(),
            "    black".to_owned(),
            String::new(),
            format!("pixels: {width} x {height}"),
            format!("rays:   {}", rays.len()),
            format!("white:  {hits}, {share:.1} %"),
            String::new(),
            "get_ray(0, 0):".to_owned(),
            format!("p = {}", vector(rays[0].origin)),
            "d =".to_owned(),
            format!("({},", number(rays[0].direction.x)),
            format!(" {},", number(rays[0].direction.y)),
            format!(" {})", number(rays[0].direction.z)),
        ];
        canvas.write_lines(columns - TEXT + 1, 0, lines);
        if height < self.height {
            canvas.write(columns - TEXT + 1, 17, "no room for more pixels", Role::Faint);
        }
    }
}
