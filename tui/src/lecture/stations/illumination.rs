//! Illumination at the point that is seen.

use super::{Entry, Source, Station, Turn, number};
use crate::cells::CellGrid;
use crate::color::{Srgb, luminance};
use crate::draw::draw;
use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::few::Cursor;
use crate::scene::builtin::builtin;
use crate::scene::{Light, Scene, Source as LightSource};
use crate::style::{ColorDepth, Style};
use spherule_kernel::{Exact, Intersect, Ray, Side, Vec3, side, surface};
use std::cell::RefCell;

pub(super) const ENTRY: Entry = Entry {
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
        Source { file: "kernel/src/leave.rs", symbols: &["leave"] },
    ],
    start: || {
        let scene = builtin("marbles").unwrap_or_default();
        Box::new(Illumination { scene, cursor: Cursor::new(3, -2), drawn: RefCell::default() })
    },
};

/// Columns of the text.
const TEXT: i32 = 35;

struct Illumination {
    scene: Scene,
    cursor: Cursor,
    /// The picture that was drawn last, and with how many colours. On a large terminal it takes a tenth of a second,
    /// and no arrow changes it.
    drawn: RefCell<Option<(ColorDepth, CellGrid)>>,
}

impl Station for Illumination {
    fn turn(&mut self, turn: Turn) {
        self.cursor.turn(turn);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (columns, rows) = ((canvas.columns() - TEXT) as u16, canvas.rows() as u16);
        let style = Style { samples: Some(4), ..*canvas.style() };
        let aspect = style.picture_aspect(columns, rows);
        let view = self.scene.first_view(aspect as f32);
        let drawn = self.drawn.take().filter(|(depth, cells)| {
            (*depth, cells.columns(), cells.rows()) == (style.depth, columns, rows)
        });
        let drawn = drawn.unwrap_or_else(|| {
            (style.depth, draw(&self.scene, &view, &style, columns, rows).cells)
        });
        canvas.copy(0, 0, &drawn.1);
        self.drawn.replace(Some(drawn));
        let (ix, iy) = self.cursor.pixel(columns.into(), rows.into());
        let (column, row) = (ix as i32, iy as i32);
        for (above, frame) in [(-1, "+---+"), (1, "+---+")] {
            canvas.write(column - 2, row + above, frame, Role::Plain);
        }
        canvas.put(column - 2, row, '|', Role::Plain);
        canvas.put(column + 2, row, '|', Role::Plain);

        let ray = view.camera(columns.into(), rows.into(), aspect).get_ray(ix, iy);
        let lights = self.scene.lighting.lights(&view);
        let lines = self.at(&ray, &lights);
        canvas.write_lines(i32::from(columns) + 1, 0, lines);
    }
}

impl Illumination {
    /// What is computed for the point that `ray` sees.
    fn at(&self, ray: &Ray, lights: &[Light]) -> Vec<String> {
        let spheres = self.scene.spheres();
        let Some((hit, sphere)) = self
            .scene
            .list()
            .closest_hit(Exact, ray)
            .and_then(|hit| Some((hit, spheres.get(hit.sphere as usize)?)))
        else {
            return vec!["in the frame: the background".to_owned()];
        };
        let surface = surface(Exact, ray, hit.t, &sphere);
        let index = hit.sphere as usize;
        let label = self.scene.label(index).unwrap_or("marble".into());
        let mut lines = vec![
            format!("in the frame: sphere {index}, {label}"),
            format!("t = {}", number(hit.t)),
            format!("point ({})", coordinates(surface.position(&sphere))),
            format!("n     ({})", coordinates(surface.normal)),
            String::new(),
        ];
        let from = side(ray.origin, &sphere).unwrap_or(Side::Outside);
        let mut received = Vec3::ZERO;
        for (number, light) in (1..).zip(lights) {
            let (to_light, shadow) = match light.source {
                LightSource::Direction(way) => (way, surface.leave(Exact, &sphere, from, way)),
                LightSource::Position(place) => (
                    place - surface.position(&sphere),
                    surface.leave_to(Exact, &sphere, from, place),
                ),
            };
            let cosine = surface.normal.dot(to_light.normalize_or_zero());
            lines
                .push(format!("light {number}: l ({})", coordinates(to_light.normalize_or_zero())));
            lines.push(format!("  n.l = {cosine:.3}"));
            let is_dark = cosine <= 0.0
                || shadow.is_none_or(|shadow| self.scene.list().any_hit(Exact, &shadow));
            lines.push(match (cosine > 0.0, is_dark) {
                (false, _) => "  turned away: no light".to_owned(),
                (true, true) => "  a sphere is in the way: shadow".to_owned(),
                (true, false) => "  nothing is in the way: lit".to_owned(),
            });
            if !is_dark {
                received += cosine * light.color.to_linear();
            }
        }
        let light = luminance(received);
        let Srgb([red, green, blue]) = self.scene.colors()[index];
        lines.extend([
            String::new(),
            format!("sum of n.l times light: {light:.3}"),
            format!("times colour #{red:02x}{green:02x}{blue:02x}, and a"),
            "little light from everywhere".to_owned(),
        ]);
        lines
    }
}

fn coordinates(v: Vec3) -> String {
    format!("{:.3}, {:.3}, {:.3}", v.x + 0.0, v.y + 0.0, v.z + 0.0)
}
