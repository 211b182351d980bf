//! The sphere, solved algebraically: a quadratic in t.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::shot::{self, Shot};
use crate::lecture::station::{Numbers, Source, Station, flat, number};
use spherule_kernel::{Fast, roots};

pub(super) const STATION: Station = Station {
    name: "algebraic",
    title: "ray and sphere, algebraic form",
    topic: "ray-sphere intersection",
    words: [
        "Where is |r(t) - c| = r? Put in r(t) = p + t d, and take c for the origin: a",
        "quadratic in t. Its discriminant D says first whether there are roots at all.",
    ],
    arrows: "up, down: turn d   left, right: move p",
    sources: &[
        Source { file: "kernel/src/accuracy/fast.rs", symbols: &["roots", "discriminant", "Fast"] },
        Source { file: "kernel/src/linear/line.rs", symbols: &["roots"] },
    ],
    knobs: shot::KNOBS,
    text: 38,
    draw,
};

fn draw(numbers: Numbers, canvas: &mut Canvas) -> String {
    let Shot { ray, sphere, chart } = Shot::new(numbers, canvas, STATION.text);
    let found = roots(Fast, &ray, &sphere);
    for (t, name) in found.iter().flatten().zip(["* t1", "* t2"]) {
        let role = if *t >= 0.0 { Role::Hit } else { Role::Faint };
        chart.mark(canvas, ray.at(*t), name, role);
    }

    // The formula's parts, in the order in which the kernel computes them.
    let (p, d) = (ray.origin - sphere.center, ray.direction);
    let (dd, dp) = (d.dot(d), d.dot(p));
    let c = p.dot(p) - sphere.radius * sphere.radius;
    let verdict = match found {
        Some([near, far]) => format!(
            "\
D >= 0: the line meets the sphere
t = (-d.p -+ sqrt D) / (d.d)
t1 = {}
t2 = {}

{}",
            number(near),
            number(far),
            match (near >= 0.0, far >= 0.0) {
                (true, _) => "both on the ray: the hit is t1",
                (false, true) => "t1 < 0: p is inside, the hit is t2",
                _ => "both t < 0: behind p, no hit",
            }
        ),
        None => "D < 0: no real root, no hit\n\nTurn the ray to the sphere.".to_owned(),
    };
    let [r, dd, dp, c, discriminant] = [sphere.radius, dd, dp, c, dp * dp - dd * c].map(number);
    let [p, d] = [p, d].map(flat);
    format!(
        "\
p - c = {p}
d = {d}
r = {r}

d.d = {dd}
d.p = {dp}
p.p - r^2 = {c}
D = (d.p)^2 - (d.d)(p.p - r^2)
  = {discriminant}

{verdict}"
    )
}
