//! Image order: pixel by pixel.

use crate::lecture::canvas::{Canvas, Role, letter};
use crate::lecture::few::Few;
use crate::lecture::pixels::Pixels;
use crate::lecture::station::{Knob, Numbers, Source, Station, decimals, number};
use spherule_kernel::{Exact, Hit, Ray, roots};

pub(super) const STATION: Station = Station {
    name: "image-order",
    title: "image order: pixel by pixel",
    topic: "image order",
    words: [
        "The outer loop is over pixels: its viewing ray is tested against every sphere,",
        "the nearest hit is illuminated and stored. No pixel is written twice.",
    ],
    arrows: "right, left: a pixel on, back   up, down: a row",
    sources: &[
        Source { file: "kernel/src/linear.rs", symbols: &["traverse"] },
        Source { file: "tui/src/structure/object_order.rs", symbols: &["image order"] },
    ],
    knobs: [
        Knob::pixel(112, SIZE.0 as i32, (SIZE.0 * SIZE.1) as i32),
        Knob::within(0, [0, 0], [0, 0]),
    ],
    text: 35,
    draw,
};

const SIZE: (u32, u32) = (20, 11);

/// How many pixels are stored; the next one is looked at.
fn draw([done, _]: Numbers, canvas: &mut Canvas) -> String {
    let (done, few) = (done as usize, Few::new(SIZE, false));
    let (hits, tests) = few.image_order(done + 1);
    let (ix, iy) = few.place(done);
    let pixels = Pixels::beside(canvas, STATION.text, SIZE);
    pixels.draw(canvas, |x, y| few.seen(&hits, x, y));
    pixels.point_at(canvas, ix, iy);
    canvas.write(0, pixels.rows(), "[ ] this pixel   . not computed yet", Role::Faint);

    let ray = few.ray(done);
    let [x, y, z] = ray.direction.to_array().map(decimals);
    let answers = tests_of(&few, &ray, hits[done]);
    let stored =
        few.shown(hits[done]).map_or("background".to_owned(), |sphere| letter(sphere).to_string());
    format!(
        "\
pixel ({ix}, {iy}): get_ray({ix}, {iy})
d = ({x}, {y}, {z})

for each sphere: intersect
{answers}
illuminate, store:
  pixel ({ix}, {iy}) = {stored}

pixels so far {:>6}
tests         {tests:>6}
writes (hits) {:>6}",
        done + 1,
        hits.iter().flatten().count()
    )
}

/// What each sphere answers.
fn tests_of(few: &Few, ray: &Ray, nearest: Option<Hit>) -> String {
    let line = |(place, sphere)| {
        let name = letter(few.name(place));
        let is_nearest = nearest.is_some_and(|hit| hit.sphere as usize == place);
        match roots(Exact, ray, &sphere) {
            Some([near, _]) if is_nearest => format!("  {name}  t = {}  nearest\n", number(near)),
            Some([near, _]) => format!("  {name}  t = {}\n", number(near)),
            None => format!("  {name}  no hit\n"),
        }
    };
    few.list.spheres().iter().enumerate().map(line).collect()
}
