//! Which root counts: the interval from `t_min` to `t_max`.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Entry, Source, Station, Turn, flat, number};
use spherule_kernel::{Exact, Intersect, Ray, Sphere, SphereList, Vec3, roots};

pub(super) const ENTRY: Entry = Entry {
    name: "interval",
    title: "which root counts",
    topic: "surface.intersect(ray, t_min, t_max)",
    words: [
        "A surface answers intersect(ray, t_min, t_max): the first t in the interval.",
        "(So would triangles; they are left out, since scenes here need only spheres.)",
    ],
    arrows: "left, right: t_min   up, down: t_max",
    sources: &[
        Source { file: "kernel/src/intersect.rs", symbols: &["closest_hit", "any_hit"] },
        Source { file: "kernel/src/accuracy/roots.rs", symbols: &["first_accepted", "accept"] },
        Source { file: "docs/contract.md", symbols: &["The interval"] },
    ],
    start: || Box::new(Interval { least: 0, most: 28 }),
};

/// The chart and the number line show t from here to there.
const SHOWN: [f32; 2] = [-2.0, 8.0];
/// Quarters that t_min and t_max may have.
const QUARTERS: std::ops::RangeInclusive<i32> = -8..=32;
const SPHERE: [f32; 4] = [3.0, 0.6, 0.0, 2.0];
/// Columns of the numbers.
const NUMBERS: i32 = 34;

struct Interval {
    /// t_min and t_max, in quarters.
    least: i32,
    most: i32,
}

impl Station for Interval {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        let within = |quarters: i32| quarters.clamp(*QUARTERS.start(), *QUARTERS.end());
        self.least = within(self.least + right);
        self.most = within(self.most + up);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let [t_min, t_max] = [self.least, self.most].map(|quarters| quarters as f32 / 4.0);
        let ray = Ray { t_min, t_max, ..Ray::new(Vec3::ZERO, Vec3::X) };
        let sphere = Sphere::from(SPHERE);
        let list = SphereList::from([SPHERE]);
        let hit = list.closest_hit(Exact, &ray);

        let (columns, rows) = (canvas.columns(), canvas.rows());
        let chart = Chart::new((0, 0), (columns - NUMBERS, rows - 6), SHOWN, [-1.9, 3.0]);
        chart.circle(canvas, &sphere, Role::Sphere);
        let end = |t: f32| ray.at(t.clamp(SHOWN[0], SHOWN[1]));
        chart.dots(canvas, [end(SHOWN[0]), end(SHOWN[1])], Role::Faint);
        if t_min <= t_max {
            chart.line(canvas, [end(t_min), end(t_max)], Role::Ray);
        }
        chart.mark(canvas, ray.origin, "o p", Role::Ray);
        // The number line, below, in the same scale.
        let axis = Chart::new((0, rows - 6), (columns - NUMBERS, 6), SHOWN, [-1.0, 1.0]);
        axis.dots(canvas, [end(SHOWN[0]), end(SHOWN[1])], Role::Faint);
        if t_min <= t_max {
            axis.line(canvas, [end(t_min), end(t_max)], Role::Ray);
        }
        axis.mark(canvas, end(t_min), "[", Role::Ray);
        axis.mark(canvas, end(t_max), "]", Role::Ray);
        let both = roots(Exact, &ray, &sphere);
        for (t, name) in both.iter().flatten().zip(["t1", "t2"]) {
            let counts = hit.is_some_and(|hit| hit.t == *t);
            let (glyph, role) = if counts { ("*", Role::Hit) } else { ("x", Role::Faint) };
            chart.mark(canvas, end(*t), glyph, role);
            axis.mark(canvas, end(*t), glyph, role);
            axis.mark(canvas, end(*t) - 0.6 * Vec3::Y, name, role);
        }
        for whole in [-2_i8, 0, 2, 4, 6] {
            axis.mark(canvas, end(whole.into()) + 0.6 * Vec3::Y, &whole.to_string(), Role::Faint);
        }

        let mut lines = vec![
            format!("t_min = {}", number(t_min)),
            format!("t_max = {}", number(t_max)),
            format!("p = {}  d = {}", flat(ray.origin), flat(ray.direction)),
            format!("c = {}  r = {}", flat(sphere.center), number(sphere.radius)),
        ];
        if let Some([near, far]) = both {
            lines.extend([format!("t1 = {}", number(near)), format!("t2 = {}", number(far))]);
        }
        let any = if list.any_hit(Exact, &ray) { "yes" } else { "no" };
        lines.extend([
            String::new(),
            "intersect(ray, t_min, t_max)".to_owned(),
            match hit {
                Some(hit) => format!("= a hit at t = {}", number(hit.t)),
                None => "= no hit".to_owned(),
            },
            format!("does it hit at all? {any}"),
            String::new(),
        ]);
        let [near, far] = both.unwrap_or([f32::NAN; 2]);
        lines.extend(
            match hit {
                None if t_min > t_max => ["The interval is empty.", "", ""],
                None => ["Neither root lies in the", "interval.", ""],
                Some(hit) if hit.t == near => [
                    "t1 lies in the interval, and is",
                    "the smaller. A shadow ray would",
                    "be done: something is in the way.",
                ],
                Some(hit) if hit.t == far => [
                    "t1 < t_min, so t2 is the answer:",
                    "the far side, as seen by a ray",
                    "that starts inside.",
                ],
                Some(_) => [""; 3],
            }
            .map(str::to_owned),
        );
        lines.extend([
            String::new(),
            "t_max is how the nearest of many".to_owned(),
            "is found: it shrinks to the hit.".to_owned(),
        ]);
        canvas.write_lines(columns - NUMBERS + 1, 0, lines);
    }
}
