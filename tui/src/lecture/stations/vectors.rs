//! Vectors: sum, length, dot product, and the part of one vector along another.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Knob, Numbers, Source, Station, at_degrees, flat, number};
use spherule_kernel::Vec3;

pub(super) const STATION: Station = Station {
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
    knobs: [Knob::around(60, [-10, 0], 360), Knob::within(5, [0, 1], [1, 6])],
    text: 38,
    draw,
};

const A: Vec3 = Vec3::new(3.0, 1.0, 0.0);

/// Degrees from x to b, and its length in halves.
fn draw([degrees, halves]: Numbers, canvas: &mut Canvas) -> String {
    let b = halves as f32 / 2.0 * at_degrees(degrees);
    let (sum, along) = (A + b, A.dot(b) / A.dot(A) * A);
    let chart = Chart::beside(canvas, STATION.text, [-3.4, 6.9], [-3.2, 4.2]);
    let zero = Vec3::ZERO;
    chart.dots(canvas, [A, sum], Role::Faint);
    chart.dots(canvas, [b, sum], Role::Faint);
    chart.dots(canvas, [b, along], Role::Sphere);
    chart.line(canvas, [zero, A], Role::Ray);
    chart.line(canvas, [zero, b], Role::Hit);
    for (point, text, role) in [
        (along, "*", Role::Sphere),
        (A, "> a", Role::Ray),
        (b, "> b", Role::Hit),
        (zero, "0", Role::Plain),
    ] {
        chart.mark(canvas, point, text, role);
    }
    // A short b leads to beside a, whose name it must not cover.
    let side = if b.y < 0.0 { -Vec3::Y } else { Vec3::Y };
    chart.mark_beside(canvas, (sum, side), "a+b", Role::Faint);

    let cosine = A.dot(b) / (A.length() * b.length());
    let degrees = cosine.clamp(-1.0, 1.0).acos().to_degrees();
    let meaning = match A.dot(b) {
        dot if dot.abs() < 1e-5 => "    0: at right angles",
        dot if dot > 0.0 => "    > 0: less than 90 degrees apart",
        _ => "    < 0: more than 90 degrees apart",
    };
    let [dot, a_length, b_length, cosine] = [A.dot(b), A.length(), b.length(), cosine].map(number);
    let [a, b, sum, along] = [A, b, sum, along].map(flat);
    format!(
        "\
a   = {a}
b   = {b}
a+b = {sum}

a.b = ax bx + ay by = {dot}
 {meaning}
|a| = sqrt(a.a) = {a_length}
|b| = sqrt(b.b) = {b_length}
cos = a.b / |a||b| = {cosine}
      {degrees:.1} degrees

* the part of b along a:
(a.b / a.a) a
    = {along}
So the point of a ray closest to a
sphere's centre is found."
    )
}
