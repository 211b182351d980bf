//! Which root counts: the interval from `t_min` to `t_max`.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::chart::Chart;
use crate::lecture::station::{Knob, Numbers, Source, Station, flat, number};
use spherule_kernel::{Exact, Intersect, Ray, Sphere, SphereList, Vec3, roots};

pub(super) const STATION: Station = Station {
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
    knobs: [Knob::within(0, [1, 0], [-8, 32]), Knob::within(28, [0, 1], [-8, 32])],
    text: 34,
    draw,
};

/// The chart and the number line show t from here to there: a little more than the knobs reach.
const SHOWN: [f32; 2] = [-2.5, 8.5];
const SPHERE: [f32; 4] = [3.0, 0.6, 0.0, 2.0];

/// t_min and t_max, in quarters.
fn draw(ends: Numbers, canvas: &mut Canvas) -> String {
    let [t_min, t_max] = ends.map(|quarters| quarters as f32 / 4.0);
    let ray = Ray { t_min, t_max, ..Ray::new(Vec3::ZERO, Vec3::X) };
    let sphere = Sphere::from(SPHERE);
    let list = SphereList::from([SPHERE]);
    let hit = list.closest_hit(Exact, &ray);

    let (columns, rows) = (canvas.columns(), canvas.rows());
    let chart = Chart::new((0, 0), (columns - STATION.text, rows - 6), SHOWN, [-1.9, 3.0]);
    // The number line, below, in the same scale.
    let axis = Chart::new((0, rows - 6), (columns - STATION.text, 6), SHOWN, [-1.0, 1.0]);
    chart.circle(canvas, &sphere, Role::Sphere);
    let end = |t: f32| ray.at(t.clamp(SHOWN[0], SHOWN[1]));
    for chart in [chart, axis] {
        chart.dots(canvas, [end(SHOWN[0]), end(SHOWN[1])], Role::Faint);
        if t_min <= t_max {
            chart.line(canvas, [end(t_min), end(t_max)], Role::Ray);
        }
    }
    chart.mark(canvas, ray.origin, "o p", Role::Ray);
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
    for whole in [-2_i8, 0, 2, 4, 6, 8] {
        axis.mark(canvas, end(whole.into()) + 0.6 * Vec3::Y, &whole.to_string(), Role::Faint);
    }

    let roots = both.map_or(String::new(), |[near, far]| {
        format!("t1 = {}\nt2 = {}\n", number(near), number(far))
    });
    let answer = hit.map_or("no hit".to_owned(), |hit| format!("a hit at t = {}", number(hit.t)));
    let [near, far] = both.unwrap_or([f32::NAN; 2]);
    let why = match hit {
        None if t_min > t_max => "The interval is empty.\n\n",
        None => "Neither root lies in the\ninterval.\n",
        Some(hit) if hit.t == near => {
            "t1 lies in the interval, and is\nthe smaller. A shadow ray would\nbe done: something is in the way."
        }
        Some(hit) if hit.t == far => {
            "t1 < t_min, so t2 is the answer:\nthe far side, as seen by a ray\nthat starts inside."
        }
        Some(_) => "\n\n",
    };
    let any = if list.any_hit(Exact, &ray) { "yes" } else { "no" };
    let [t_min, t_max, radius] = [t_min, t_max, sphere.radius].map(number);
    let [p, d, c] = [ray.origin, ray.direction, sphere.center].map(flat);
    format!(
        "\
t_min = {t_min}
t_max = {t_max}
p = {p}  d = {d}
c = {c}  r = {radius}
{roots}
intersect(ray, t_min, t_max)
= {answer}
does it hit at all? {any}

{why}

t_max is how the nearest of many
is found: it shrinks to the hit."
    )
}
