//! The nearest of many: `t_max` shrinks.

use crate::lecture::canvas::{Canvas, letter};
use crate::lecture::few::{Cursor, Few};
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Entry, Source, Station, Turn, number};
use spherule_kernel::{Exact, Intersect, Ray, SphereList, roots};

pub(super) const ENTRY: Entry = Entry {
    name: "nearest",
    title: "the nearest of many",
    topic: "groups of surfaces",
    words: [
        "A group of surfaces is a surface: each is asked in turn, and whatever is hit",
        "becomes the next t_max. So the last hit is the nearest, whatever their order.",
    ],
    arrows: "arrows: another pixel",
    sources: &[
        Source { file: "kernel/src/linear.rs", symbols: &["traverse", "is_closer"] },
        Source { file: "kernel/src/intersect.rs", symbols: &["closest_hit"] },
        Source { file: "kernel/src/bvh/traverse.rs", symbols: &["wavefront"] },
    ],
    start: || Box::new(Nearest { cursor: Cursor::new(1, 2) }),
};

const SIZE: (u32, u32) = (20, 14);
/// Columns of the text.
const TEXT: i32 = 36;

struct Nearest {
    cursor: Cursor,
}

impl Station for Nearest {
    fn turn(&mut self, turn: Turn) {
        self.cursor.turn(turn);
    }

    fn draw(&self, canvas: &mut Canvas) {
        let few = Few::new(SIZE, false);
        let (hits, _) = few.image_order(few.pixels());
        let (ix, iy) = self.cursor.pixel(SIZE.0, SIZE.1);
        let columns = canvas.columns();
        let pixels = Pixels::new((0, 0), (columns - TEXT, canvas.rows()), SIZE);
        pixels.draw(canvas, |x, y| {
            Pixel::of_sphere(few.shown(hits[(y * SIZE.0 + x) as usize]), letter)
        });
        pixels.point_at(canvas, ix, iy);

        let pixel = (iy * SIZE.0 + ix) as usize;
        let mut ray = few.ray(pixel);
        let mut lines = vec![
            format!("the ray of pixel ({ix}, {iy})"),
            format!("t_min = {}  t_max = {}", number(ray.t_min), number(ray.t_max)),
            String::new(),
        ];
        for (place, sphere) in few.list.spheres().iter().enumerate() {
            let name = letter(few.name(place));
            let one = SphereList::from([sphere]);
            lines.push(match (one.closest_hit(Exact, &ray), roots(Exact, &ray, &sphere)) {
                (Some(hit), _) => {
                    // A hit at t_max itself is as near: the lower index is kept.
                    ray = Ray { t_max: hit.t.next_down(), ..ray };
                    format!("{name}  t = {:<11} t_max = t", number(hit.t))
                }
                (None, Some([t, _])) => format!("{name}  t = {:<11} beyond t_max", number(t)),
                (None, None) => format!("{name}  no hit"),
            });
        }
        let nearest = few.list.closest_hit(Exact, &few.ray(pixel));
        lines.extend([
            String::new(),
            "closest_hit of all:".to_owned(),
            match nearest {
                Some(hit) => {
                    format!("{} at t = {}", letter(few.name(hit.sphere as usize)), number(hit.t))
                }
                None => "none: the background".to_owned(),
            },
            String::new(),
            "A tree of boxes asks fewer of them,".to_owned(),
            "and answers with the same bits.".to_owned(),
        ]);
        canvas.write_lines(columns - TEXT + 1, 0, lines);
    }
}
