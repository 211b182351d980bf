//! Illumination at the point that is seen.

use crate::cells::CellGrid;
use crate::color::{Srgb, luminance};
use crate::draw;
use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::station::{Knob, Numbers, Source, Station, decimals, number};
use crate::scene::builtin::builtin;
use crate::scene::{Light, Scene, Source as LightSource};
use crate::style::{ColorDepth, Style};
use spherule_kernel::{Exact, Intersect, Ray, Side, Vec3, side, surface};
use std::sync::{Mutex, PoisonError};

pub(super) const STATION: Station = Station {
    name: "illumination",
    title: "illumination at the point seen",
    topic: "shading and shadows",
    words: [
        "At the nearest hit stands the normal n. Lambert: a surface receives n.l of a",
        "light towards l, if no sphere is in the way: a shadow ray from the point asks.",
    ],
    arrows: "arrows: another point",
    sources: &[
        Source { file: "tui/src/shade.rs", symbols: &["Shader", "ShadowRays", "cosine"] },
        Source { file: "kernel/src/surface.rs", symbols: &["surface"] },
        Source { file: "kernel/src/spawn_ray.rs", symbols: &["spawn_ray"] },
    ],
    knobs: [Knob::column(3), Knob::row(-2)],
    text: 35,
    draw,
};

/// The picture that was drawn last, and its number of colours. On a large terminal drawing takes a tenth of a second,
/// and no arrow changes the picture.
static DRAWN: Mutex<Option<(ColorDepth, CellGrid)>> = Mutex::new(None);

/// The place of the cell that is looked at, from the middle. The knobs reach beyond any terminal; at its edge the cell
/// stays.
fn draw([right, down]: Numbers, canvas: &mut Canvas) -> String {
    let scene = builtin("marbles").unwrap_or_default();
    let (columns, rows) = ((canvas.columns() - STATION.text) as u16, canvas.rows() as u16);
    let style = Style { samples: Some(4), ..*canvas.style() };
    let aspect = style.picture_aspect(columns, rows);
    let view = scene.first_view(aspect as f32);
    let mut drawn = DRAWN.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (style.depth, columns, rows);
    drawn.take_if(|(depth, cells)| (*depth, cells.columns(), cells.rows()) != key);
    let (_, cells) = drawn.get_or_insert_with(|| {
        (style.depth, draw::draw(&scene, &view, &style, columns, rows).cells)
    });
    canvas.copy(0, 0, cells);
    let within = |off: i32, size: u16| (i32::from(size) / 2 + off).clamp(0, i32::from(size) - 1);
    let (column, row) = (within(right, columns), within(down, rows));
    for (row, frame) in (row - 1..).zip(["+---+", "|   |", "+---+"]) {
        for (column, glyph) in (column - 2..i32::from(columns)).zip(frame.chars()) {
            if glyph != ' ' {
                canvas.put(column, row, glyph, Role::Plain);
            }
        }
    }

    let camera = view.camera(columns.into(), rows.into(), aspect);
    let ray = camera.get_ray(column as u32, row as u32);
    lit(&scene, &ray, &scene.lighting.lights(&view))
}

/// What is computed for the point that `ray` sees.
fn lit(scene: &Scene, ray: &Ray, lights: &[Light]) -> String {
    let spheres = scene.spheres();
    let Some((hit, sphere)) = scene
        .list()
        .closest_hit(Exact, ray)
        .and_then(|hit| Some((hit, spheres.get(hit.sphere as usize)?)))
    else {
        return "in the frame: the background".to_owned();
    };
    let surface = surface(Exact, ray, hit.t, &sphere);
    let from = side(ray.origin, &sphere).unwrap_or(Side::Outside);
    let point = surface.position(&sphere);
    let (mut of_lights, mut received) = (String::new(), Vec3::ZERO);
    for (number, light) in (1..).zip(lights) {
        let (to_light, shadow) = match light.source {
            LightSource::Direction(way) => (way, surface.spawn_ray(Exact, &sphere, from, way)),
            LightSource::Position(place) => {
                (place - point, surface.spawn_ray_to(Exact, &sphere, from, place))
            }
        };
        let to_light = to_light.normalize_or_zero();
        let cosine = surface.normal.dot(to_light);
        let is_dark =
            cosine <= 0.0 || shadow.is_none_or(|shadow| scene.list().any_hit(Exact, &shadow));
        let verdict = match (cosine > 0.0, is_dark) {
            (false, _) => "turned away: no light",
            (true, true) => "a sphere is in the way: shadow",
            (true, false) => "nothing is in the way: lit",
        };
        let color = light.color.to_linear();
        let (way, dot, bright) =
            (coordinates(to_light), decimals(cosine), decimals(luminance(color)));
        of_lights +=
            &format!("light {number}: l ({way})\n  n.l = {dot}  light {bright}\n  {verdict}\n");
        if !is_dark {
            received += cosine * color;
        }
    }
    let index = hit.sphere as usize;
    let Srgb([red, green, blue]) = scene.colors()[index];
    format!(
        "\
in the frame: sphere {index}, {}
t = {}
point ({})
n     ({})

{of_lights}
sum of n.l times light: {:.3}
times colour #{red:02x}{green:02x}{blue:02x}, and a
little light from everywhere",
        scene.label(index).unwrap_or("marble".into()),
        number(hit.t),
        coordinates(point),
        coordinates(surface.normal),
        luminance(received)
    )
}

fn coordinates(v: Vec3) -> String {
    v.to_array().map(decimals).join(", ")
}
