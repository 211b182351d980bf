//! One ray at one sphere, in a plane: what the stations of the intersection share.

use super::canvas::{Canvas, Role};
use super::chart::Chart;
use super::station::{Knob, Numbers, at_degrees};
use spherule_kernel::{Ray, Sphere, Vec3};

/// The knobs: how far the origin is moved, in halves, and by how many degrees the ray is turned.
pub(super) const KNOBS: [Knob; 2] =
    [Knob::within(0, [1, 0], [-2, 16]), Knob::around(20, [0, 4], 360)];

/// The sphere; its centre is in the plane of the chart.
const SPHERE: Sphere = Sphere { center: Vec3::new(1.5, 0.5, 0.0), radius: 2.0 };

/// A ray at the sphere, and the chart in which both are drawn.
pub(super) struct Shot {
    /// The ray, with t in [0, +inf]. Its direction does not have unit length, nor need it.
    pub(super) ray: Ray,
    pub(super) sphere: Sphere,
    pub(super) chart: Chart,
}

impl Shot {
    /// Draws sphere and ray, left of so many columns of text: the half-line as a line, what is behind it as dots.
    pub(super) fn new([halves, degrees]: Numbers, canvas: &mut Canvas, text: i32) -> Self {
        let origin = Vec3::new(-3.0 + 0.5 * halves as f32, 0.0, 0.0);
        let direction = 2.0 * at_degrees(degrees);
        let chart = Chart::beside(canvas, text, [-4.2, 5.8], [-2.6, 3.4]);
        chart.circle(canvas, &SPHERE, Role::Sphere);
        chart.behind(canvas, origin, direction);
        chart.half_line(canvas, origin, direction, Role::Ray);
        chart.mark(canvas, SPHERE.center, "+ c", Role::Sphere);
        chart.mark(canvas, origin + direction, "> d", Role::Ray);
        chart.mark(canvas, origin, "o p", Role::Ray);
        Self { ray: Ray::new(origin, direction), sphere: SPHERE, chart }
    }
}
