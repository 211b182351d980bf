//! Object order: sphere by sphere.

use crate::lecture::canvas::{Canvas, Role, letter};
use crate::lecture::few::{COUNT, Few};
use crate::lecture::pixels::{Pixel, Pixels};
use crate::lecture::station::{Knob, Numbers, Source, Station, number};
use crate::structure::object_order::Counts;

pub(super) const STATION: Station = Station {
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
    knobs: [Knob::within(2, [1, 0], [0, COUNT as i32]), Knob::around(0, [0, 1], 2)],
    text: 35,
    draw,
};

const SIZE: (u32, u32) = (20, 11);

/// How many spheres have been drawn, and whether from near to far.
fn draw([done, reversed]: Numbers, canvas: &mut Canvas) -> String {
    let (done, reversed) = (done as usize, reversed == 1);
    let few = Few::new(SIZE, reversed);
    let (hits, counts) = few.object_order(done);
    let (before, _) = few.object_order(done.saturating_sub(1));
    let pixels = Pixels::beside(canvas, STATION.text, SIZE);
    // What the last sphere wrote is in capitals.
    pixels.draw(canvas, |x, y| {
        let pixel = few.pixel(x, y);
        let is_new = hits[pixel] != before[pixel];
        Pixel::of_sphere(few.shown(hits[pixel]), |index| {
            if is_new { letter(index) } else { letter(index).to_ascii_lowercase() }
        })
    });
    canvas.write(0, pixels.rows(), "capitals: written by the last sphere", Role::Faint);

    let mut rows = String::new();
    let mut last = Counts::default();
    for (place, sphere) in few.list.spheres().iter().enumerate() {
        let name = letter(few.name(place));
        if place < done {
            let (_, all) = few.object_order(place + 1);
            let new = [
                all.tests - last.tests,
                all.writes.stored - last.writes.stored,
                all.writes.overwritten - last.writes.overwritten,
            ];
            rows += &row(&name.to_string(), new);
            last = all;
        } else {
            rows += &format!("{name}       waits, at z = {}\n", number(sphere.center.z));
        }
    }
    let Counts { tests, writes } = counts;
    rows += &row("all", [tests, writes.stored, writes.overwritten]);
    let order = if reversed {
        "From near to far: little or\nnothing is written twice."
    } else {
        "From far to near: some is\noverwritten."
    };
    format!(
        "\
for each sphere:
        tests  writes  overwritten
{rows}
Tested: blocks of 4 x 4 pixels
that the sphere's bounds touch.

{order}
The picture is the same."
    )
}

fn row(name: &str, [tests, writes, overwritten]: [u64; 3]) -> String {
    format!("{name:<4}{tests:>9}{writes:>8}{overwritten:>13}\n")
}
