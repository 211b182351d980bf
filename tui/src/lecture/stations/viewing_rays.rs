//! Viewing rays of a perspective and a parallel projection, from the side.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Entry, Source, Station, Turn, number, vector};
use crate::view::{Lens, LensKind, View, with_projection};
use spherule_kernel::{Exact, Hit, Intersect, Projection, Ray, Sphere, SphereList, Vec3};

pub(super) const ENTRY: Entry = Entry {
    name: "viewing-rays",
    title: "viewing rays",
    topic: "camera and projections",
    words: [
        "A picture is a grid of rays, here seen from the side. In perspective all start",
        "at the eye. In parallel all have one direction: far things are not smaller.",
    ],
    arrows: "left, right: projection   up, down: iy",
    sources: &[
        Source {
            file: "kernel/src/geometry/camera.rs",
            symbols: &["get_ray", "Projection", "Perspective", "Parallel"],
        },
        Source { file: "tui/src/view.rs", symbols: &["camera", "with_projection"] },
    ],
    start: || Box::new(ViewingRays { kind: LensKind::Perspective, row: 2 }),
};

/// Rows of pixels.
const ROWS: u32 = 7;
/// The eye is at the left, and looks to the right.
const VIEW: View = View {
    eye: Vec3::new(-4.0, 0.0, 0.0),
    target: Vec3::new(2.0, 0.0, 0.0),
    up: Vec3::Y,
    lens: Lens::Perspective { fov: 46.0 },
};
const SPHERE: [f32; 4] = [2.0, 0.5, 0.0, 1.6];

struct ViewingRays {
    kind: LensKind,
    row: u32,
}

impl ViewingRays {
    fn rays(&self) -> Vec<Ray> {
        let camera = with_projection(&VIEW, self.kind).camera(1, ROWS, 1.0 / f64::from(ROWS));
        (0..ROWS).map(|iy| camera.get_ray(0, iy)).collect()
    }
}

impl Station for ViewingRays {
    fn turn(&mut self, turn: Turn) {
        match turn {
            Turn::Left => self.kind = LensKind::Perspective,
            Turn::Right => self.kind = LensKind::Parallel,
            Turn::Up => self.row = self.row.saturating_sub(1),
            Turn::Down => self.row = (self.row + 1).min(ROWS - 1),
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        let list = SphereList::from([SPHERE]);
        let sphere = Sphere::from(SPHERE);
        let rays = self.rays();
        let (columns, rows) = (canvas.columns(), canvas.rows());
        let chart = Chart::new((0, 0), (columns - 32, rows), [-4.5, 5.0], [-3.4, 3.4]);
        chart.circle(canvas, &sphere, Role::Sphere);
        let mut white = Vec::new();
        for (iy, ray) in (0..).zip(&rays) {
            let hit = list.closest_hit(Exact, ray);
            white.push(hit.is_some());
            let role = if iy == self.row { Role::Ray } else { Role::Faint };
            match hit {
                Some(Hit { t, .. }) => chart.line(canvas, [ray.origin, ray.at(t)], role),
                None => chart.half_line(canvas, ray.origin, ray.direction, role),
            }
        }
        for (iy, ray) in (0_u32..).zip(&rays) {
            if let Some(hit) = list.closest_hit(Exact, ray) {
                chart.mark(canvas, ray.at(hit.t), "*", Role::Hit);
            }
            // A plane before the eye, or that of the origins.
            let on_plane = match self.kind {
                LensKind::Perspective => ray.at(3.0),
                LensKind::Parallel => ray.origin,
            };
            chart.mark(canvas, on_plane, &iy.to_string(), Role::Plain);
        }
        if self.kind == LensKind::Perspective {
            chart.mark(canvas, VIEW.eye, "eye", Role::Plain);
        }

        let ray = rays[self.row as usize];
        let camera = with_projection(&VIEW, self.kind).camera(1, ROWS, 1.0 / f64::from(ROWS));
        let name = match camera.projection {
            Projection::Perspective { .. } => "perspective",
            Projection::Parallel { .. } => "parallel",
        };
        let mut lines = vec![
            format!("projection: {name}"),
            String::new(),
            format!("camera.get_ray(0, {})", self.row),
            "p =".to_owned(),
            format!(" {}", vector(ray.origin)),
            "d =".to_owned(),
            format!(" {}", vector(ray.direction)),
            String::new(),
        ];
        lines.push(match list.closest_hit(Exact, &ray) {
            Some(hit) => format!("it hits at t = {}", number(hit.t)),
            None => "it hits nothing".to_owned(),
        });
        lines.extend([String::new(), "the pixels, from the top:".to_owned()]);
        let next = lines.len() as i32;
        canvas.write_lines(columns - 31, 0, lines);
        for (iy, is_white) in (0..).zip(white) {
            let text = format!("{iy} {}", if is_white { "white ##" } else { "black" });
            let role = if iy == self.row as i32 { Role::Ray } else { Role::Plain };
            canvas.write(columns - 31, next + iy, &text, role);
        }
    }
}
