//! The ray, a half-line.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Entry, Source, Station, Turn, at_degrees, flat, number};
use spherule_kernel::{Ray, Vec3};

pub(super) const ENTRY: Entry = Entry {
    name: "ray",
    title: "the ray, a half-line",
    topic: "rays",
    words: [
        "A ray starts at the point p and goes where the vector d goes: r(t) = p + t d.",
        "Every t >= 0 is one of its points. At t < 0 the line goes on, but not the ray.",
    ],
    arrows: "left, right: t   up, down: turn d",
    sources: &[Source { file: "kernel/src/geometry/ray.rs", symbols: &["Ray", "at"] }],
    start: || Box::new(HalfLine { quarters: 10, degrees: 20 }),
};

const ORIGIN: Vec3 = Vec3::new(-2.0, -1.0, 0.0);

struct HalfLine {
    /// t, in quarters.
    quarters: i32,
    degrees: i32,
}

impl Station for HalfLine {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.quarters = (self.quarters + right).clamp(-12, 24);
        self.degrees = (self.degrees + 5 * up) % 360;
    }

    fn draw(&self, canvas: &mut Canvas) {
        let ray = Ray::new(ORIGIN, 1.5 * at_degrees(self.degrees));
        let t = self.quarters as f32 / 4.0;
        let point = ray.at(t);
        let (columns, rows) = (canvas.columns(), canvas.rows());
        let chart = Chart::new((0, 0), (columns - 36, rows), [-5.0, 6.0], [-4.0, 4.0]);
        chart.behind(canvas, ray.origin, ray.direction);
        chart.half_line(canvas, ray.origin, ray.direction, Role::Ray);
        for whole in 1..5_u8 {
            chart.mark(canvas, ray.at(f32::from(whole)), &whole.to_string(), Role::Ray);
        }
        chart.mark(canvas, ray.origin, "o p", Role::Ray);
        chart.mark(canvas, point, "* r(t)", Role::Hit);

        let counts = ray.t_min <= t && t <= ray.t_max;
        let lines = [
            format!("p = {}", flat(ray.origin)),
            format!("d = {}", flat(ray.direction)),
            format!("|d| = {}", number(ray.direction.length())),
            String::new(),
            format!("t = {}", number(t)),
            "r(t) = p + t d".to_owned(),
            format!("     = {}", flat(point)),
            String::new(),
            format!("the ray: t from {} to {}", number(ray.t_min), number(ray.t_max)),
            String::new(),
            "1, 2, 3, 4 on the ray are r(1) to".to_owned(),
            "r(4): t counts in lengths of d.".to_owned(),
            String::new(),
        ];
        let next = lines.len() as i32;
        canvas.write_lines(columns - 35, 0, lines);
        let (verdict, role) = if counts {
            ("r(t) is on the ray", Role::Hit)
        } else {
            ("r(t) is behind p: not on the ray", Role::Wrong)
        };
        canvas.write(columns - 35, next, verdict, role);
    }
}
