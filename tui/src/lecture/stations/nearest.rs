//! The nearest of many: `t_max` shrinks.

use crate::lecture::canvas::{Canvas, letter};
use crate::lecture::few::Few;
use crate::lecture::pixels::Pixels;
use crate::lecture::station::{Knob, Numbers, Source, Station, number};
use spherule_kernel::{Exact, Intersect, Ray, SphereList, roots};

pub(super) const STATION: Station = Station {
    name: "nearest",
    title: "the nearest of many",
    topic: "groups of surfaces",
    words: [
        "A group of surfaces is a surface: each is asked in turn, and whatever is hit",
        "becomes the next t_max. So the last hit is the nearest, whatever their order.",
    ],
    arrows: "arrows: another pixel",
    sources: &[
        Source { file: "kernel/src/linear.rs", symbols: &["traverse"] },
        Source { file: "kernel/src/accuracy/tier.rs", symbols: &["is_closer"] },
        Source { file: "kernel/src/intersect.rs", symbols: &["closest_hit"] },
        Source { file: "kernel/src/bvh/traverse.rs", symbols: &["wavefront"] },
    ],
    knobs: [Knob::within(1, [1, 0], [-10, 9]), Knob::within(2, [0, -1], [-7, 6])],
    text: 36,
    draw,
};

const SIZE: (u32, u32) = (20, 14);

fn draw([right, down]: Numbers, canvas: &mut Canvas) -> String {
    let few = Few::new(SIZE, false);
    let (hits, _) = few.image_order(few.pixels());
    let (ix, iy) = (SIZE.0 / 2)
        .checked_add_signed(right)
        .zip((SIZE.1 / 2).checked_add_signed(down))
        .unwrap_or_default();
    let pixels = Pixels::beside(canvas, STATION.text, SIZE);
    pixels.draw(canvas, |x, y| few.seen(&hits, x, y));
    pixels.point_at(canvas, ix, iy);

    let pixel = few.pixel(ix, iy);
    let mut ray = few.ray(pixel);
    let mut text = format!(
        "the ray of pixel ({ix}, {iy})\nt_min = {}  t_max = {}\n\n",
        number(ray.t_min),
        number(ray.t_max)
    );
    for (place, sphere) in few.list.spheres().iter().enumerate() {
        let one = SphereList::from([sphere]);
        let answer = match (one.closest_hit(Exact, &ray), roots(Exact, &ray, &sphere)) {
            (Some(hit), _) => {
                // A hit at t_max itself is as near: the lower index is kept.
                ray = Ray { t_max: hit.t.next_down(), ..ray };
                format!("t = {:<11} t_max = t", number(hit.t))
            }
            (None, Some([t, _])) => format!("t = {:<11} beyond t_max", number(t)),
            (None, None) => "no hit".to_owned(),
        };
        text += &format!("{}  {answer}\n", letter(few.name(place)));
    }
    let nearest = few.list.closest_hit(Exact, &few.ray(pixel)).map_or_else(
        || "none: the background".to_owned(),
        |hit| format!("{} at t = {}", letter(few.name(hit.sphere as usize)), number(hit.t)),
    );
    text + &format!(
        "
closest_hit of all:
{nearest}

A tree of boxes asks fewer of them,
and answers with the same bits."
    )
}
