//! Searches for how much of the pads of boxes a ray's answer uses, in the slab of a box around one sphere.

use super::{Numbers, lane, line, numbers, or_none, square};
use crate::accuracy::{Squares, TierFormula};
use crate::bvh::build::bounds::padded;
use crate::bvh::traverse::prepared_packet::PreparedPacket;
use crate::proofs::climb::{Random, assert_published, climb_twice};
use crate::{Exact, Stable};

/// The part that an answer uses of what both pads widen a slab by, at either end: how far its s is outside of the slab
/// that is computed without pads.
fn used<A: TierFormula>(numbers: &Numbers) -> f64 {
    let (line, sphere) = line(numbers);
    let Some([near, far]) = A::line_roots(&line, &sphere) else { return -1.0 };
    let rays = lane(&line);
    let mut packet = PreparedPacket::<[f32; 1]>::NONE;
    packet.prepare(&rays, 1.0, 1e12, (0.0, Squares::None));
    if packet.covered == 0 {
        return -1.0;
    }
    let length = square(line.direction.to_array().map(f64::from)).sqrt();
    let [entered, left] = [near, far].map(|t| f64::from(t) * length);

    let (center, r) = (sphere.center.to_array(), sphere.radius);
    // As the build makes a box of one sphere.
    let low = center.map(|c| (c - r).next_down());
    let high = center.map(|c| (c + r).next_up());
    let corners = padded(low, high);
    let mut worst = -1.0_f64;
    for i in 0..3 {
        let (origin, inverse) = (packet.origin[i][0], packet.inverse[i][0]);
        // A slab that a ray runs along is as good as infinite.
        if packet.direction[i][0].abs() < 1e-9 {
            continue;
        }
        let padded = corners.map(|corner| corner[i]);
        let ([near, far], [first, last]) = if inverse < 0.0 {
            ([center[i] + r, center[i] - r], [padded[1], padded[0]])
        } else {
            ([center[i] - r, center[i] + r], padded)
        };
        let bare = [near, far].map(|plane| f64::from(plane * inverse - origin * inverse));
        let with = [
            f64::from(first * inverse + packet.minus_near[i][0]),
            f64::from(last * inverse - packet.far[i][0]),
        ];
        worst = worst.max((bare[0] - entered) / (bare[0] - with[0]));
        worst = worst.max((left - bare[1]) / (with[1] - bare[1]));
    }
    or_none(worst)
}

/// Towards a pole of the sphere, or nearly.
fn start(random: &mut Random) -> Numbers {
    let sizes = [random.below(9) as i32 - 4, random.below(9) as i32 - 4];
    let [o, c] = sizes.map(|size| random.point(size));
    let r = random.wide(-12, 4).abs();
    let mut pole = c;
    pole[random.below(3) as usize] += if random.below(2) == 0 { r } else { -r };
    let by = random.wide(-8, 8).abs();
    let jitter = random.wide(-24, -2);
    let d = [0, 1, 2].map(|i| (pole[i] - o[i]) * by * (1.0 + jitter * random.about(0)));
    numbers(o, d, c, r)
}

#[test]
fn what_is_used_of_the_pads_of_boxes() {
    let found = |seed, score: fn(&Numbers) -> f64| {
        climb_twice(seed, [3000, 300], [-24, 24], start, score).0
    };
    assert_published("pads, Exact", found(71, used::<Exact>), 0.238);
    assert_published("pads, Stable", found(72, used::<Stable>), 0.258);
}
