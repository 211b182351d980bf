//! The sphere, solved geometrically: through the closest point.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::shot::{self, Shot};
use crate::lecture::station::{Numbers, Source, Station, flat, number};
use spherule_kernel::{Geometric, roots};

pub(super) const STATION: Station = Station {
    name: "geometric",
    title: "ray and sphere, geometric form",
    topic: "ray-sphere intersection",
    words: [
        "The same roots by a triangle: m is the point of the line closest to c, at the",
        "distance l. If l <= r, the line is inside from dt before m to dt behind m.",
    ],
    arrows: "up, down: turn d   left, right: move p",
    sources: &[Source {
        file: "kernel/src/accuracy/geometric.rs",
        symbols: &["roots", "middle", "Geometric"],
    }],
    knobs: shot::KNOBS,
    text: 38,
    draw,
};

fn draw(numbers: Numbers, canvas: &mut Canvas) -> String {
    let Shot { ray, sphere, chart } = Shot::new(numbers, canvas, STATION.text);
    let found = roots(Geometric, &ray, &sphere);

    // The formula's parts, in the order in which the kernel computes them.
    let (p, d) = (ray.origin - sphere.center, ray.direction);
    let length = d.dot(d).sqrt();
    let unit = d * (1.0 / length);
    let middle = -p.dot(unit);
    let ll = p.dot(p) - middle * middle;
    let half = sphere.radius * sphere.radius - ll;

    let closest = ray.origin + middle * unit;
    chart.dots(canvas, [sphere.center, closest], Role::Hit);
    chart.mark(canvas, (sphere.center + closest) / 2.0, "l", Role::Hit);
    // The dots have covered it.
    chart.mark(canvas, sphere.center, "+ c", Role::Sphere);
    chart.mark(canvas, closest, "m", Role::Hit);
    for (t, name) in found.iter().flatten().zip(["* t1", "* t2"]) {
        chart.mark(canvas, ray.at(*t), name, Role::Hit);
    }
    for t in found.iter().flatten() {
        let middle = (closest + ray.at(*t)) / 2.0;
        chart.mark_beside(canvas, (middle, closest - sphere.center), "dt", Role::Hit);
    }

    let verdict = match found {
        Some([near, far]) => format!(
            "\
dt = sqrt(r^2 - l^2) = {}

t = (t_m -+ dt) / |d|
t1 = {}
t2 = {}

With |d| = 1 it is t_m -+ dt: the
kernel makes v, and scales back.",
            number(half.sqrt()),
            number(near),
            number(far)
        ),
        None => "l > r: the line passes the sphere\n\nno root, no hit".to_owned(),
    };
    let [length, r, middle, ll, half] = [length, sphere.radius, middle, ll, half].map(number);
    let [p, d, unit] = [p, d, unit].map(flat);
    format!(
        "\
p - c = {p}
d = {d}
|d| = {length}   r = {r}
v = d/|d|
  = {unit}

t_m = -p.v = {middle}
l^2 = p.p - t_m^2 = {ll}
r^2 - l^2 = {half}
{verdict}"
    )
}
