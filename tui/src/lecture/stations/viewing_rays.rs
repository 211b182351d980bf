//! Viewing rays of a perspective and a parallel projection, from the side.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Knob, Numbers, Source, Station, number, vector};
use crate::view::{Lens, LensKind, View, with_projection};
use spherule_kernel::{Exact, Intersect, Projection, Ray, Sphere, SphereList, Vec3};

pub(super) const STATION: Station = Station {
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
    knobs: [Knob::within(0, [1, 0], [0, 1]), Knob::within(2, [0, -1], [0, ROWS as i32 - 1])],
    text: 32,
    draw,
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

/// The projection, and a row of pixels.
fn draw([kind, row]: Numbers, canvas: &mut Canvas) -> String {
    let kind = if kind == 0 { LensKind::Perspective } else { LensKind::Parallel };
    let camera = with_projection(&VIEW, kind).camera(1, ROWS, 1.0 / f64::from(ROWS));
    let list = SphereList::from([SPHERE]);
    let sphere = Sphere::from(SPHERE);
    let rays = (0..ROWS).map(|iy| camera.get_ray(0, iy)).collect::<Vec<Ray>>();
    let chart = Chart::beside(canvas, STATION.text, [-4.5, 5.0], [-3.4, 3.4]);
    chart.circle(canvas, &sphere, Role::Sphere);
    let hits: Vec<_> = rays.iter().map(|ray| list.closest_hit(Exact, ray)).collect();
    for (iy, (ray, hit)) in (0..).zip(rays.iter().zip(&hits)) {
        let role = if iy == row { Role::Ray } else { Role::Faint };
        match hit {
            Some(hit) => chart.line(canvas, [ray.origin, ray.at(hit.t)], role),
            None => chart.half_line(canvas, ray.origin, ray.direction, role),
        }
    }
    for (iy, (ray, hit)) in (0_u32..).zip(rays.iter().zip(&hits)) {
        if let Some(hit) = hit {
            chart.mark(canvas, ray.at(hit.t), "*", Role::Hit);
        }
        // A plane before the eye, or that of the origins.
        let on_plane = match kind {
            LensKind::Perspective => ray.at(3.0),
            LensKind::Parallel => ray.origin,
        };
        chart.mark(canvas, on_plane, &iy.to_string(), Role::Plain);
    }
    if kind == LensKind::Perspective {
        chart.mark(canvas, VIEW.eye, "eye", Role::Plain);
    }

    let left = canvas.columns() - STATION.text + 1;
    for (iy, hit) in (0..).zip(&hits) {
        let text = format!("{iy} {}", if hit.is_some() { "white ##" } else { "black" });
        let role = if iy == row { Role::Ray } else { Role::Plain };
        canvas.write(left, 11 + iy, &text, role);
    }
    let name = match camera.projection {
        Projection::Perspective { .. } => "perspective",
        Projection::Parallel { .. } => "parallel",
    };
    let ray = rays[row as usize];
    let answer =
        hits[row as usize].map_or("nothing".to_owned(), |hit| format!("at t = {}", number(hit.t)));
    format!(
        "\
projection: {name}

camera.get_ray(0, {row})
p =
 {}
d =
 {}

it hits {answer}

the pixels, from the top:",
        vector(ray.origin),
        vector(ray.direction)
    )
}
