//! Object order: sphere by sphere.

use crate::lecture::canvas::{Canvas, Role, letter};
use crate::lecture::few::Few;
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Entry, Source, Station, Turn};
use crate::structure::object_order::Counts;

pub(super) const ENTRY: Entry = Entry {
    name: "object-order",
    title: "object order: sphere by sphere",
    topic: "object order",
    words: [
        "The outer loop is over spheres: each is tested against the pixels that it may",
        "affect, and a pixel keeps the nearer hit. What lies behind is overwritten.",
    ],
    arrows: "right, left: spheres   up, down: order",
    sources: &[
        Source { file: "tui/src/structure/object_order.rs", symbols: &["ObjectOrder", "Counts"] },
        Source { file: "kernel/src/linear/object.rs", symbols: &["object_lanes", "Writes"] },
        Source { file: "tui/src/structure/screen.rs", symbols: &["of_sphere"] },
    ],
    start: || Box::new(BySphere { done: 2, reversed: false }),
};

const SIZE: (u32, u32) = (20, 11);
/// Columns of the text.
const TEXT: i32 = 35;

struct BySphere {
    /// How many spheres have been drawn.
    done: usize,
    reversed: bool,
}

impl Station for BySphere {
    fn turn(&mut self, turn: Turn) {
        let few = Few::new(SIZE, self.reversed);
        match turn {
            Turn::Left => self.done = self.done.saturating_sub(1),
            Turn::Right => self.done = (self.done + 1).min(few.count()),
            Turn::Up | Turn::Down => self.reversed = !self.reversed,
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        let few = Few::new(SIZE, self.reversed);
        let (hits, counts) = few.object_order(self.done);
        let (before, _) = few.object_order(self.done.saturating_sub(1));
        let columns = canvas.columns();
        let pixels = Pixels::new((0, 0), (columns - TEXT, canvas.rows()), SIZE);
        // What the last sphere wrote is in capitals.
        pixels.draw(canvas, |x, y| {
            let pixel = (y * SIZE.0 + x) as usize;
            let is_new = hits[pixel] != before[pixel];
            Pixel::of_sphere(few.shown(hits[pixel]), |index| {
                if is_new { letter(index) } else { letter(index).to_ascii_lowercase() }
            })
        });
        canvas.write(0, pixels.rows(), "capitals: written by the last sphere", Role::Faint);

        let mut lines =
            vec!["for each sphere:".to_owned(), "        tests  writes  overwritten".to_owned()];
        let mut last = Counts::default();
        for place in 0..few.count() {
            let name = letter(few.name(place));
            let sphere = few.list.spheres().get(place).map_or(0.0, |sphere| sphere.center.z);
            lines.push(if place < self.done {
                let (_, all) = few.object_order(place + 1);
                let line = row(
                    &format!("{name}"),
                    [
                        all.tests - last.tests,
                        all.writes.stored - last.writes.stored,
                        all.writes.overwritten - last.writes.overwritten,
                    ],
                );
                last = all;
                line
            } else {
                format!("{name}       waits, at z = {sphere}")
            });
        }
        let Counts { tests, writes } = counts;
        lines.extend([
            row("all", [tests, writes.stored, writes.overwritten]),
            String::new(),
            "Tested: blocks of 4 x 4 pixels, all".to_owned(),
            "that the sphere's bounds touch.".to_owned(),
            String::new(),
            if self.reversed {
                "From near to far: little is".to_owned()
            } else {
                "From far to near: much is".to_owned()
            },
            if self.reversed { "written twice.".to_owned() } else { "overwritten.".to_owned() },
            "The picture is the same.".to_owned(),
        ]);
        canvas.write_lines(columns - TEXT + 1, 0, lines);
    }
}

fn row(name: &str, [tests, writes, overwritten]: [u64; 3]) -> String {
    format!("{name:<4}{tests:>9}{writes:>8}{overwritten:>13}")
}
