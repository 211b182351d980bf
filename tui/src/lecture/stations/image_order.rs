//! Image order: pixel by pixel.

use crate::lecture::canvas::{Canvas, Role, letter};
use crate::lecture::few::Few;
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Entry, Source, Station, Turn, number};
use spherule_kernel::{Exact, Hit, Ray, roots};

pub(super) const ENTRY: Entry = Entry {
    name: "image-order",
    title: "image order: pixel by pixel",
    topic: "image order",
    words: [
        "The outer loop is over pixels: its viewing ray is tested against every sphere,",
        "the nearest hit is illuminated and stored. Every pixel is written just once.",
    ],
    arrows: "right, left: a pixel on, back   up, down: a row",
    sources: &[
        Source { file: "kernel/src/linear.rs", symbols: &["traverse"] },
        Source { file: "tui/src/structure/object_order.rs", symbols: &["image order"] },
    ],
    start: || Box::new(ImageOrder { done: SIZE.0 as usize * 5 + 12 }),
};

const SIZE: (u32, u32) = (20, 11);
/// Columns of the text.
const TEXT: i32 = 35;

struct ImageOrder {
    /// How many pixels are stored; the next one is looked at.
    done: usize,
}

impl Station for ImageOrder {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        let step = right - up * SIZE.0 as i32;
        let last = (SIZE.0 * SIZE.1) as usize - 1;
        self.done = self.done.saturating_add_signed(step as isize).min(last);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let few = Few::new(SIZE, false);
        let (hits, tests) = few.image_order(self.done + 1);
        let (ix, iy) = few.place(self.done);
        let columns = canvas.columns();
        let pixels = Pixels::new((0, 0), (columns - TEXT, canvas.rows()), SIZE);
        pixels.draw(canvas, |x, y| match hits.get((y * SIZE.0 + x) as usize) {
            Some(hit) => Pixel::of_sphere(few.shown(*hit), letter),
            None => Pixel::WAITING,
        });
        pixels.point_at(canvas, ix, iy);
        canvas.write(0, pixels.rows(), "[ ] this pixel   . not computed yet", Role::Faint);

        let ray = few.ray(self.done);
        let d = ray.direction;
        let mut lines = vec![
            format!("pixel ({ix}, {iy}): get_ray({ix}, {iy})"),
            format!("d = ({:.3}, {:.3}, {:.3})", d.x, d.y, d.z),
            String::new(),
            "for each sphere: intersect".to_owned(),
        ];
        lines.extend(tests_of(&few, &ray, hits[self.done]));
        lines.extend([
            String::new(),
            "illuminate, store:".to_owned(),
            match few.shown(hits[self.done]) {
                Some(sphere) => format!("  pixel ({ix}, {iy}) = {}", letter(sphere)),
                None => format!("  pixel ({ix}, {iy}) = background"),
            },
            String::new(),
            format!("pixels so far {:>6}", self.done + 1),
            format!("tests         {tests:>6}"),
            format!("writes        {:>6}", hits.len()),
        ]);
        canvas.write_lines(columns - TEXT + 1, 0, lines);
    }
}

/// What each sphere answers.
fn tests_of(few: &Few, ray: &Ray, nearest: Option<Hit>) -> Vec<String> {
    let line = |(place, sphere)| {
        let name = letter(few.name(place));
        let is_nearest = nearest.is_some_and(|hit| hit.sphere as usize == place);
        match roots(Exact, ray, &sphere) {
            Some([near, _]) if is_nearest => format!("  {name}  t = {}  nearest", number(near)),
            Some([near, _]) => format!("  {name}  t = {}", number(near)),
            None => format!("  {name}  no hit"),
        }
    };
    few.list.spheres().iter().enumerate().map(line).collect()
}
