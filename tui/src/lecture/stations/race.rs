//! Both orders at once, by the number of tests that they have taken.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::few::{COUNT, Few};
use crate::lecture::pixels::Pixels;
use crate::lecture::station::{Knob, Numbers, Source, Station};
use crate::structure::object_order::Counts;
use spherule_kernel::{Hit, Writes};

pub(super) const STATION: Station = Station {
    name: "race",
    title: "both orders, side by side",
    topic: "image order and object order",
    words: [
        "Both make one test after the other, of a ray against a sphere. Image order is",
        "done with a pixel at once; object order tests less, and writes some twice.",
    ],
    arrows: "right, left: tests   up, down: all, none",
    sources: &[
        Source { file: "tui/src/structure/object_order.rs", symbols: &["ObjectOrder", "Counts"] },
        Source { file: "kernel/src/linear/object.rs", symbols: &["object_lanes", "Writes"] },
        Source { file: "tui/src/tradeoff/orders.rs", symbols: &["Orders"] },
    ],
    knobs: [Knob::within(6, [1, STEPS], [0, STEPS]), Knob::within(0, [0, 0], [0, 0])],
    text: 0,
    draw,
};

const SIZE: (u32, u32) = (18, 10);
/// Steps of an arrow from no test to all tests that image order takes.
const STEPS: i32 = 30;

/// One of the two.
struct Racer {
    title: &'static str,
    /// The pixels so far; those past the end are not computed yet.
    hits: Vec<Option<Hit>>,
    counts: Counts,
    is_done: bool,
}

fn image_order(few: &Few, budget: u64) -> Racer {
    let pixels = (budget as usize / COUNT).min(few.pixels());
    let (hits, tests) = few.image_order(pixels);
    // As in object order, a write is a hit.
    let writes = Writes { stored: hits.iter().flatten().count() as u64, overwritten: 0 };
    let is_done = pixels == few.pixels();
    Racer { title: "image order", hits, counts: Counts { tests, writes }, is_done }
}

/// Object order, with as many spheres as there are tests for.
fn object_order(few: &Few, budget: u64) -> Racer {
    let drawn = (0..=COUNT).map(|spheres| few.object_order(spheres));
    let affordable = drawn.take_while(|(_, counts)| counts.tests <= budget);
    let (spheres, (hits, counts)) = affordable.enumerate().last().unwrap_or_default();
    Racer { title: "object order", hits, counts, is_done: spheres == COUNT }
}

fn draw([steps, _]: Numbers, canvas: &mut Canvas) -> String {
    let few = Few::new(SIZE, false);
    let all = (few.pixels() * COUNT) as u64;
    let budget = all * u64::from(steps.unsigned_abs()) / u64::from(STEPS.unsigned_abs());
    let columns = canvas.columns();
    canvas.write(0, 0, &format!("{budget} tests each, of at most {all}"), Role::Ray);
    let room = (columns / 2, canvas.rows() - 5);
    let below = 1 + Pixels::new((0, 1), room, SIZE).rows();
    for (left, racer) in [(0, image_order(&few, budget)), (columns / 2, object_order(&few, budget))]
    {
        let Racer { title, hits, counts, is_done } = racer;
        Pixels::new((left, 1), room, SIZE).draw(canvas, |ix, iy| few.seen(&hits, ix, iy));
        let end = if is_done { "done" } else { "not done" };
        canvas.write(left + 1, below, &format!("{title}: {end}"), Role::Hit);
        let Counts { tests, writes } = counts;
        let lines = [
            format!("tests {tests}"),
            format!("writes {}, of these overwrite {}", writes.stored, writes.overwritten),
        ];
        canvas.write_lines(left + 1, below + 1, lines);
    }
    let words = "spherule tradeoff counts both for any scene.";
    canvas.write(1, below + 3, words, Role::Faint);
    String::new()
}
