//! Scaling d does not change the ray, nor the picture.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::few::Few;
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Entry, Source, Station, Turn, number, vector};
use spherule_kernel::{Exact, Hit, Intersect, Ray, Vec3, surface};

pub(super) const ENTRY: Entry = Entry {
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
    start: || Box::new(Scaling { twos: 3, tens: 0 }),
};

const SIZE: (u32, u32) = (18, 9);
/// Towards the light.
const LIGHT: Vec3 = Vec3::new(-0.48, 0.6, 0.64);
/// From dark to light.
const RAMP: &[u8] = b".:-=+*#%@";

struct Scaling {
    /// a = 2^twos 10^tens.
    twos: i32,
    tens: i32,
}

impl Scaling {
    fn factor(&self) -> f32 {
        2_f32.powi(self.twos) * 10_f32.powi(self.tens)
    }
}

/// A picture of bytes: light where a surface faces it.
struct Rendered {
    hits: Vec<Option<Hit>>,
    bytes: Vec<u8>,
}

fn render(few: &Few, factor: f32) -> Rendered {
    let rays: Vec<_> = (0..few.pixels()).map(|pixel| few.ray(pixel)).collect();
    let rays: Vec<_> =
        rays.iter().map(|ray| Ray { direction: factor * ray.direction, ..*ray }).collect();
    let mut hits = vec![None; rays.len()];
    few.list.closest_hits(Exact, &rays, &mut hits);
    let byte = |(ray, hit): (&Ray, &Option<Hit>)| {
        let Some(hit) = hit else { return 0 };
        let sphere = few.list.spheres().get(hit.sphere as usize).unwrap_or(NOTHING.into());
        let cosine = surface(Exact, ray, hit.t, &sphere).normal.dot(LIGHT);
        (30.0 + 225.0 * cosine.max(0.0)) as u8
    };
    let bytes = rays.iter().zip(&hits).map(byte).collect();
    Rendered { hits, bytes }
}

/// A sphere that nothing hits.
const NOTHING: [f32; 4] = [0.0, 0.0, 0.0, -1.0];

impl Station for Scaling {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.twos = (self.twos + right).clamp(-20, 20);
        self.tens = (self.tens + up).clamp(-6, 6);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let few = Few::new(SIZE, false);
        let factor = self.factor();
        let [plain, scaled] = [1.0, factor].map(|factor| render(&few, factor));
        let columns = canvas.columns();
        let room = (columns / 2, canvas.rows() - 6);
        for (left, picture, title) in [
            (0, &plain, "by d".to_owned()),
            (columns / 2, &scaled, format!("by a d, a = {}", number(factor))),
        ] {
            canvas.write(left + 1, 0, &title, Role::Ray);
            Pixels::new((left, 1), room, SIZE).draw(canvas, |ix, iy| {
                let pixel = (iy * SIZE.0 + ix) as usize;
                let glyph = RAMP[usize::from(picture.bytes[pixel]) * RAMP.len() / 256];
                match few.shown(picture.hits[pixel]) {
                    Some(sphere) => Pixel::sign(char::from(glyph), Role::Nth(sphere)),
                    None => Pixel::NOTHING,
                }
            });
        }
        let pairs = || plain.bytes.iter().zip(&scaled.bytes);
        let differ = pairs().filter(|(a, b)| a != b).count();
        let spheres = |hits: &[Option<Hit>]| -> Vec<_> {
            hits.iter().map(|hit| hit.map(|hit| hit.sphere)).collect()
        };
        let others = spheres(&plain.hits)
            .iter()
            .zip(spheres(&scaled.hits))
            .filter(|(a, b)| **a != *b)
            .count();
        // The first that is white.
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
        let verdict = format!(
            "{differ} of {total} bytes differ, {others} of {total} pixels show another sphere"
        );
        let role = if differ + others == 0 { Role::Hit } else { Role::Wrong };
        canvas.write(0, row + 2, &verdict, role);
        let why = if self.tens == 0 {
            "a is a power of two: a d is not rounded, and every bit is the same."
        } else {
            "a is no power of two: a d is rounded to f32, so it may be a ray beside, by 2^-24 of d."
        };
        canvas.write(0, row + 3, why, Role::Faint);
    }
}
