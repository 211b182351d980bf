//! The sphere, solved geometrically: through the closest point.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::shot::Solved;
use crate::lecture::station::{Entry, Source, flat, number};
use spherule_kernel::{Geometric, Ray, Sphere, roots};

pub(super) const ENTRY: Entry = Entry {
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
    start: || Box::new(Solved::new(form)),
};

fn form(ray: &Ray, sphere: &Sphere, chart: &Chart, canvas: &mut Canvas) -> Vec<String> {
    let found = roots(Geometric, ray, sphere);

    // The formula's parts, in the order in which the kernel computes them.
    let (p, d) = (ray.origin - sphere.center, ray.direction);
    let length = d.dot(d).sqrt();
    let unit = d * (1.0 / length);
    let middle = -p.dot(unit);
    let ll = p.dot(p) - middle * middle;
    let half = sphere.radius * sphere.radius - ll;

    let closest = ray.origin + middle * unit;
    chart.dots(canvas, [sphere.center, closest], Role::Hit);
    chart.mark(canvas, closest, "m", Role::Hit);
    chart.mark(canvas, (sphere.center + closest) / 2.0, "l", Role::Hit);
    if let Some([near, far]) = found {
        chart.mark(canvas, ray.at(near), "* t1", Role::Hit);
        chart.mark(canvas, ray.at(far), "* t2", Role::Hit);
        chart.mark(canvas, (closest + ray.at(near)) / 2.0, "dt", Role::Hit);
        chart.mark(canvas, (closest + ray.at(far)) / 2.0, "dt", Role::Hit);
    }

    let mut lines = vec![
        format!("p - c = {}", flat(p)),
        format!("d = {}", flat(d)),
        format!("|d| = {}   r = {}", number(length), number(sphere.radius)),
        format!("v = d/|d| = {}", flat(unit)),
        String::new(),
        format!("t_m = -p.v = {}", number(middle)),
        format!("l^2 = p.p - t_m^2 = {}", number(ll)),
        format!("r^2 - l^2 = {}", number(half)),
    ];
    match found {
        Some([near, far]) => lines.extend([
            format!("dt = sqrt(r^2 - l^2) = {}", number(half.sqrt())),
            String::new(),
            "t = (t_m -+ dt) / |d|".to_owned(),
            format!("t1 = {}", number(near)),
            format!("t2 = {}", number(far)),
            String::new(),
            "With |d| = 1 it is t_m -+ dt: the".to_owned(),
            "kernel makes v, and scales back.".to_owned(),
        ]),
        None => lines.extend([
            "l > r: the line passes the sphere".to_owned(),
            String::new(),
            "no root, no hit".to_owned(),
        ]),
    }
    lines
}
