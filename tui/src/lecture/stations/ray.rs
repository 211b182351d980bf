//! The ray, a half-line.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Knob, Numbers, Source, Station, at_degrees, flat, number};
use spherule_kernel::{Ray, Vec3};

pub(super) const STATION: Station = Station {
    name: "ray",
    title: "the ray, a half-line",
    topic: "rays",
    words: [
        "A ray starts at the point p and goes where the vector d goes: r(t) = p + t d.",
        "Every t >= 0 is one of its points. At t < 0 the line goes on, but not the ray.",
    ],
    arrows: "left, right: t   up, down: turn d",
    sources: &[Source { file: "kernel/src/geometry/ray.rs", symbols: &["Ray", "at"] }],
    knobs: [Knob::within(10, [1, 0], [-12, 16]), Knob::around(20, [0, 5], 360)],
    text: 36,
    draw,
};

const ORIGIN: Vec3 = Vec3::new(1.0, 0.5, 0.0);
/// So short that every point that has a name is seen, wherever d points.
const LENGTH: f32 = 0.8;

/// t in quarters, and degrees from x to d.
fn draw([quarters, degrees]: Numbers, canvas: &mut Canvas) -> String {
    let ray = Ray::new(ORIGIN, LENGTH * at_degrees(degrees));
    let t = quarters as f32 / 4.0;
    let point = ray.at(t);
    // There is more room at the right, for names.
    let chart = Chart::beside(canvas, STATION.text, [-2.6, 5.8], [-3.1, 4.1]);
    chart.behind(canvas, ray.origin, ray.direction);
    chart.half_line(canvas, ray.origin, ray.direction, Role::Ray);
    for whole in 1..5_u8 {
        chart.mark(canvas, ray.at(f32::from(whole)), &whole.to_string(), Role::Ray);
    }
    chart.mark(canvas, ray.origin, "o p", Role::Ray);
    chart.mark(canvas, point, "*", Role::Hit);
    // The name stands where neither line nor numbers go on.
    let d = ray.direction;
    let side = if d.x.abs() <= d.y.abs() {
        Vec3::X
    } else if d.x * d.y < 0.0 {
        Vec3::Y
    } else {
        -Vec3::Y
    };
    chart.mark_beside(canvas, (point, side), "r(t)", Role::Hit);

    let (verdict, role) = if ray.t_min <= t && t <= ray.t_max {
        ("r(t) is on the ray", Role::Hit)
    } else {
        ("r(t) is behind p: not on the ray", Role::Wrong)
    };
    canvas.write(canvas.columns() - STATION.text + 1, 13, verdict, role);
    let [length, t, t_min, t_max] = [ray.direction.length(), t, ray.t_min, ray.t_max].map(number);
    let [p, d, point] = [ray.origin, ray.direction, point].map(flat);
    format!(
        "\
p = {p}
d = {d}
|d| = {length}

t = {t}
r(t) = p + t d
     = {point}

the ray: t from {t_min} to {t_max}

1, 2, 3, 4 on the ray are r(1) to
r(4): t counts in lengths of d."
    )
}
