//! One ray at one sphere, in a plane: what the stations of the intersection share.

use super::canvas::{Canvas, Role};
use super::chart::Chart;
use super::station::{Station, Turn};
use spherule_kernel::{Ray, Sphere, Vec3};

/// The sphere; its centre is in the plane of the chart.
const SPHERE: Sphere = Sphere { center: Vec3::new(1.5, 0.5, 0.0), radius: 2.0 };
/// Degrees that an arrow turns the ray by.
const TURN: i32 = 4;
/// How far an arrow moves its origin.
const SHIFT: f32 = 0.5;
/// How many steps it may go.
const SHIFTS: std::ops::RangeInclusive<i32> = -2..=16;

/// Columns of the lines.
const NUMBERS: i32 = 38;

/// A ray that can be turned and moved.
#[derive(Clone, Copy, Debug)]
struct Shot {
    degrees: i32,
    shifts: i32,
    /// Of the direction.
    length: f32,
}

impl Shot {
    /// From the left through the sphere, by a direction of this length.
    fn new(length: f32) -> Self {
        Self { degrees: 3 * TURN, shifts: 0, length }
    }

    /// Up and down turn the ray, left and right move its origin.
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.degrees = (self.degrees + TURN * up) % 360;
        self.shifts = (self.shifts + right).clamp(*SHIFTS.start(), *SHIFTS.end());
    }

    /// The ray, with t in [0, +inf].
    fn ray(&self) -> Ray {
        let (sin, cos) = (self.degrees as f32).to_radians().sin_cos();
        let origin = Vec3::new(-3.0 + SHIFT * self.shifts as f32, 0.0, 0.0);
        Ray::new(origin, self.length * Vec3::new(cos, sin, 0.0))
    }

    /// Draws sphere and ray: the half-line as a line, what is behind it as dots.
    fn draw(&self, chart: &Chart, canvas: &mut Canvas) {
        let Ray { origin, direction, .. } = self.ray();
        chart.circle(canvas, &SPHERE, Role::Sphere);
        chart.behind(canvas, origin, direction);
        chart.half_line(canvas, origin, direction, Role::Ray);
        chart.mark(canvas, SPHERE.center, "+ c", Role::Sphere);
        chart.mark(canvas, origin + direction, "> d", Role::Ray);
        chart.mark(canvas, origin, "o p", Role::Ray);
    }
}

/// A form of the intersection: marks its parts in a chart of the shot, and tells them in lines.
type Form = fn(&Ray, &Sphere, &Chart, &mut Canvas) -> Vec<String>;

/// The station of a form.
pub(super) struct Solved {
    shot: Shot,
    form: Form,
}

impl Solved {
    /// Of a direction that does not have unit length, as it need not.
    pub(super) fn new(form: Form) -> Self {
        Self { shot: Shot::new(2.0), form }
    }
}

impl Station for Solved {
    fn turn(&mut self, turn: Turn) {
        self.shot.turn(turn);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let left = canvas.columns() - NUMBERS;
        let chart = Chart::new((0, 0), (left, canvas.rows()), [-4.2, 5.0], [-2.6, 3.4]);
        self.shot.draw(&chart, canvas);
        let lines = (self.form)(&self.shot.ray(), &SPHERE, &chart, canvas);
        canvas.write_lines(left + 1, 0, lines);
    }
}
