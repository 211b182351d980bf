//! The sphere, solved algebraically: a quadratic in t.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::shot::Solved;
use crate::lecture::station::{Entry, Source, flat, number};
use spherule_kernel::{Fast, Ray, Sphere, roots};

pub(super) const ENTRY: Entry = Entry {
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
    start: || Box::new(Solved::new(form)),
};

fn form(ray: &Ray, sphere: &Sphere, chart: &Chart, canvas: &mut Canvas) -> Vec<String> {
    let found = roots(Fast, ray, sphere);
    for (t, name) in found.iter().flatten().zip(["* t1", "* t2"]) {
        let role = if *t >= 0.0 { Role::Hit } else { Role::Faint };
        chart.mark(canvas, ray.at(*t), name, role);
    }

    // The formula's parts, in the order in which the kernel computes them.
    let (p, d) = (ray.origin - sphere.center, ray.direction);
    let (dd, dp) = (d.dot(d), d.dot(p));
    let c = p.dot(p) - sphere.radius * sphere.radius;
    let discriminant = dp * dp - dd * c;
    let mut lines = vec![
        format!("p - c = {}", flat(p)),
        format!("d = {}", flat(d)),
        format!("r = {}", number(sphere.radius)),
        String::new(),
        format!("d.d = {}", number(dd)),
        format!("d.p = {}", number(dp)),
        format!("p.p - r^2 = {}", number(c)),
        "D = (d.p)^2 - (d.d)(p.p - r^2)".to_owned(),
        format!("  = {}", number(discriminant)),
        String::new(),
    ];
    match found {
        Some([near, far]) => lines.extend([
            "D >= 0: the line meets the sphere".to_owned(),
            "t = (-d.p -+ sqrt D) / (d.d)".to_owned(),
            format!("t1 = {}", number(near)),
            format!("t2 = {}", number(far)),
            String::new(),
            match (near >= 0.0, far >= 0.0) {
                (true, _) => "both on the ray: the hit is t1",
                (false, true) => "t1 < 0: p is inside, the hit is t2",
                _ => "both t < 0: behind p, no hit",
            }
            .to_owned(),
        ]),
        None => lines.extend([
            "D < 0: no real root, no hit".to_owned(),
            String::new(),
            "Turn the ray to the sphere.".to_owned(),
        ]),
    }
    lines
}
