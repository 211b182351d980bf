//! Vectors: sum, length, dot product, and the part of one vector along another.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Entry, Source, Station, Turn, at_degrees, flat, number};
use spherule_kernel::Vec3;

pub(super) const ENTRY: Entry = Entry {
    name: "vectors",
    title: "vectors",
    topic: "vectors and points",
    words: [
        "A vector has a direction and a length. Rays and spheres are made of vectors.",
        "The dot product a.b measures: a.a = |a|^2 a length, a.b = |a||b| cos an angle.",
    ],
    arrows: "left, right: turn b   up, down: its length",
    sources: &[
        Source { file: "kernel/src/lib.rs", symbols: &["Vec3"] },
        Source { file: "kernel/src/numeric/axes.rs", symbols: &["dot"] },
    ],
    start: || Box::new(Vectors { degrees: 60, halves: 5 }),
};

const A: Vec3 = Vec3::new(3.0, 1.0, 0.0);

struct Vectors {
    degrees: i32,
    /// The length of b, in halves.
    halves: i32,
}

impl Station for Vectors {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.degrees = (self.degrees - 10 * right) % 360;
        self.halves = (self.halves + up).clamp(1, 6);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let b = self.halves as f32 / 2.0 * at_degrees(self.degrees);
        let (sum, along) = (A + b, A.dot(b) / A.dot(A) * A);
        let (columns, rows) = (canvas.columns(), canvas.rows());
        let chart = Chart::new((0, 0), (columns - 38, rows), [-3.4, 6.4], [-3.2, 4.2]);
        let zero = Vec3::ZERO;
        chart.dots(canvas, [A, sum], Role::Faint);
        chart.dots(canvas, [b, sum], Role::Faint);
        chart.dots(canvas, [b, along], Role::Sphere);
        chart.line(canvas, [zero, A], Role::Ray);
        chart.line(canvas, [zero, b], Role::Hit);
        chart.mark(canvas, along, "*", Role::Sphere);
        chart.mark(canvas, sum, "a+b", Role::Faint);
        chart.mark(canvas, A, "> a", Role::Ray);
        chart.mark(canvas, b, "> b", Role::Hit);
        chart.mark(canvas, zero, "0", Role::Plain);

        let cosine = A.dot(b) / (A.length() * b.length());
        let meaning = match A.dot(b) {
            dot if dot.abs() < 1e-5 => "     0: at right angles",
            dot if dot > 0.0 => "     > 0: less than 90 degrees apart",
            _ => "     < 0: more than 90 degrees apart",
        };
        let lines = [
            format!("a   = {}", flat(A)),
            format!("b   = {}", flat(b)),
            format!("a+b = {}", flat(sum)),
            String::new(),
            format!("a.b = ax bx + ay by = {}", number(A.dot(b))),
            meaning.to_owned(),
            format!("|a| = sqrt(a.a) = {}", number(A.length())),
            format!("|b| = sqrt(b.b) = {}", number(b.length())),
            format!("cos = a.b / |a||b| = {}", number(cosine)),
            format!("      {:.1} degrees", cosine.clamp(-1.0, 1.0).acos().to_degrees()),
            String::new(),
            "* the part of b along a:".to_owned(),
            "(a.b / a.a) a".to_owned(),
            format!("    = {}", flat(along)),
            "So the point of a ray closest to a".to_owned(),
            "sphere's centre is found.".to_owned(),
        ];
        canvas.write_lines(columns - 37, 0, lines);
    }
}
