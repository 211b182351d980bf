//! Scaling d does not change the ray, nor the picture.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::few::Few;
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Knob, Numbers, Source, Station, number, vector};
use spherule_kernel::{Exact, Hit, Intersect, Ray, Vec3, surface};

pub(super) const STATION: Station = Station {
    name: "scaling",
    title: "d has any length",
    topic: "rays",
    words: [
        "With a d for d, a > 0, the half-line is the same; t counts otherwise, t/a.",
        "So both pictures are the same one. Both are rendered now, and compared.",
    ],
    arrows: "left, right: a/2, 2a   up, down: 10a, a/10",
    sources: &[
        Source { file: "kernel/src/geometry/ray.rs", symbols: &["Ray", "direction"] },
        Source { file: "docs/contract.md", symbols: &["any length"] },
    ],
    knobs: [Knob::within(3, [1, 0], [-20, 20]), Knob::within(0, [0, 1], [-6, 6])],
    text: 0,
    draw,
};

const SIZE: (u32, u32) = (18, 9);
/// Towards the light.
const LIGHT: Vec3 = Vec3::new(-0.48, 0.6, 0.64);
/// From dark to light.
const RAMP: &[u8] = b".:-=+*#%@";

/// A picture of bytes: bright where a surface faces the light.
struct Rendered {
    hits: Vec<Option<Hit>>,
    bytes: Vec<u8>,
}

fn render(few: &Few, factor: f32) -> Rendered {
    let scaled = |ray: Ray| Ray { direction: factor * ray.direction, ..ray };
    let rays: Vec<_> = (0..few.pixels()).map(|pixel| scaled(few.ray(pixel))).collect();
    let mut hits = vec![None; rays.len()];
    few.list.closest_hits(Exact, &rays, &mut hits);
    let byte = |(ray, hit): (&Ray, &Option<Hit>)| {
        let met = hit.and_then(|hit| Some((hit.t, few.list.spheres().get(hit.sphere as usize)?)));
        let Some((t, sphere)) = met else { return 0 };
        let cosine = surface(Exact, ray, t, &sphere).normal.dot(LIGHT);
        (30.0 + 225.0 * cosine.max(0.0)) as u8
    };
    let bytes = rays.iter().zip(&hits).map(byte).collect();
    Rendered { hits, bytes }
}

/// a = 2^twos 10^tens.
fn draw([twos, tens]: Numbers, canvas: &mut Canvas) -> String {
    let few = Few::new(SIZE, false);
    let factor = 2_f32.powi(twos) * 10_f32.powi(tens);
    let [plain, scaled] = [1.0, factor].map(|factor| render(&few, factor));
    let columns = canvas.columns();
    let room = (columns / 2, canvas.rows() - 6);
    for (left, picture, title) in [
        (0, &plain, "by d".to_owned()),
        (columns / 2, &scaled, format!("by a d, a = {}", number(factor))),
    ] {
        canvas.write(left + 1, 0, &title, Role::Ray);
        Pixels::new((left, 1), room, SIZE).draw(canvas, |ix, iy| {
            let pixel = few.pixel(ix, iy);
            let glyph = RAMP[usize::from(picture.bytes[pixel]) * RAMP.len() / 256];
            match few.shown(picture.hits[pixel]) {
                Some(sphere) => Pixel::sign(char::from(glyph), Role::Nth(sphere)),
                None => Pixel::NOTHING,
            }
        });
    }
    let pairs = || plain.bytes.iter().zip(&scaled.bytes);
    let differ = pairs().filter(|(a, b)| a != b).count();
    let sphere = |hit: &Option<Hit>| hit.map(|hit| hit.sphere);
    let others =
        plain.hits.iter().zip(&scaled.hits).filter(|(a, b)| sphere(a) != sphere(b)).count();
    // The first pixel that is white.
    let seen = plain.hits.iter().position(Option::is_some).unwrap_or(0);
    let (ix, iy) = few.place(seen);
    let t = |picture: &Rendered| picture.hits[seen].map_or(f32::INFINITY, |hit| hit.t);
    let (t, u) = (t(&plain), t(&scaled));
    let row = 1 + Pixels::new((0, 1), room, SIZE).rows();
    let lines = [
        format!("d of pixel ({ix}, {iy}) = {}", vector(few.ray(seen).direction)),
        format!(
            "t by d = {}   t by a d = {}   times a = {}",
            number(t),
            number(u),
            number(factor * u)
        ),
    ];
    canvas.write_lines(0, row, lines);
    let total = plain.bytes.len();
    let verdict =
        format!("{differ} of {total} bytes differ, {others} of {total} pixels show another sphere");
    let role = if differ + others == 0 { Role::Hit } else { Role::Wrong };
    canvas.write(0, row + 2, &verdict, role);
    let why = if tens == 0 {
        "a is a power of two: a d is not rounded, and every bit is the same."
    } else {
        "a is no power of two: a d is rounded, and may be a ray beside, by 2^-24 of d."
    };
    canvas.write(0, row + 3, why, Role::Faint);
    String::new()
}
