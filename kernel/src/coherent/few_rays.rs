//! Few rays that have little in common: recognised by some of them, before they are packed.
//!
//! # Method
//!
//! Packing rays, and laying planes around them, takes as long as some of them take by themselves; and all rays traverse what the
//! planes hold. So if rays are few, the kernel looks at four of them first. All go one by one if the directions of these four differ
//! by more than planes may be apart (`fit.rs`), or if planes around them would hold more leaves than pays. The number of leaves
//! is estimated as if those of each child of the root were spread evenly over its box. The answers are the same either way.
//!
//! (When the leaves were taken to be spread over the box of the root, a ground hid everything: nine parallel rays through 2,000 spheres
//! on a ground took twice the time that they take one by one. When rays from one point were packed however far apart they go, nine
//! pixels of a shuffled picture took 1.5 times the time.)

use super::fit::heading;
use super::frustum::across;
use crate::bvh::node::WIDTH;
use crate::bvh::traverse::small_tree;
use crate::bvh::tree::Bvh;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::numeric::axes::axes;
use crate::numeric::rounding::least;
use core::ops::Range;

/// Some rays of a packet, evenly spaced.
pub(crate) type Asked = [Ray; 4];
const APART: usize = 5;
/// 1 + 1/4: |d|^2 |e|^2 is at most so many times (d.e)^2 where the tangent of the angle between d and e is at most a half.
const NARROW: f32 = 1.25;
/// The same for a tangent of 1/32: such rays from one point are taken for neighbours in a camera's picture.
const BESIDE: f32 = 1.0 + 1.0 / 1024.0;
/// Four of many rays that are spread evenly span three fifths of what all span: so much of their span lies beyond, on either side.
const BEYOND_ASKED: f32 = 1.0 / 3.0;
/// How many leaves the planes may hold for each ray, and for all together. (Four scenes, parallel rays and cones of nine widths,
/// AVX-512: nine rays begin to be slower as packets at 1 to 9 leaves, sixteen rays at 2 to 8, 64 rays at 5 to 12. Going one by one in
/// vain costs more than being packed in vain: up to three times the time, against twice.)
const LEAVES_OF_RAY: f32 = 1.0 / 3.0;
const LEAVES_OF_ALL: f32 = 7.0;
/// The same in a small tree, where a ray takes little by itself: nine rays begin to be slower at 0.1 leaves, sixteen at 0.3.
const LEAVES_OF_RAY_IN_SMALL_TREE: f32 = 1.0 / 40.0;

/// Calls of at most so many packets are looked at. (Packed, calls of 12 to 48 rays that have nothing in common, among 300, 20,000 and
/// 300,000 spheres, took 1.1 to 2.4 times as long as one by one on a Zen 3: few rays make little use of stacks that are laid out for
/// many. In a small tree there is less to lay out: with 4, 64 diffuse rays among ten spheres took 1.3 to 2.5 times as long on a Zen 5,
/// and 128 parallel rays, some of which go together, 1.3 to 1.5 times. With 8, rays that go together ran at 0.93 of the speed,
/// diffuse rays through a city at 0.76 to 0.88.)
const FEW: usize = 4;
pub(crate) const FEW_IN_SMALL_TREE: usize = 2;

/// How many packets are few in a tree.
#[inline(always)]
pub(crate) fn few(bvh: &Bvh<'_>) -> usize {
    if small_tree::leaves(bvh).is_some() { FEW_IN_SMALL_TREE } else { FEW }
}

/// Returns whether rays have little in common, judged by the rays of the first packet and by those of the last;
/// `leaves_held` is [`leaves_held`].
#[inline(always)]
pub(crate) fn differ(
    bvh: &Bvh<'_>,
    rays: &ManyRays<'_>,
    range: Range<usize>,
    leaves_held: impl Fn(&Asked) -> f32,
) -> bool {
    let Range { start, end } = range;
    let count = end.saturating_sub(start);
    let most = if small_tree::leaves(bvh).is_some() {
        LEAVES_OF_RAY_IN_SMALL_TREE * count as f32
    } else {
        least(LEAVES_OF_RAY * count as f32, LEAVES_OF_ALL)
    };
    // The first packet may be wide only because a row of a picture ends in it.
    packet_differs(rays, start..end.min(start + RayPacket::COUNT), most, &leaves_held)
        && (count <= RayPacket::COUNT
            || packet_differs(rays, end - RayPacket::COUNT..end, most, &leaves_held))
}

/// Returns whether rays of a packet have little in common, if planes may hold `most` leaves.
#[inline(always)]
fn packet_differs(
    rays: &ManyRays<'_>,
    packet: Range<usize>,
    most: f32,
    leaves_held: &impl Fn(&Asked) -> f32,
) -> bool {
    let ray =
        |number: usize| rays.ray((packet.start + APART * number).min(packet.end.saturating_sub(1)));
    let [Some(first), Some(second), Some(third), Some(fourth)] = [ray(0), ray(1), ray(2), ray(3)]
    else {
        return false;
    };
    let asked = [first, second, third, fourth];
    let square = first.direction.length_squared();
    let mut are_beside = true;
    for ray in &asked[1..] {
        let (along, other) = (first.direction.dot(ray.direction), ray.direction.length_squared());
        if !(along > 0.0 && square * other <= NARROW * along * along) {
            return true;
        }
        are_beside &= ray.origin == first.origin && square * other <= BESIDE * along * along;
    }
    !are_beside && leaves_held(&asked) > most
}

/// Returns about how many leaves lie between planes around the rays that `asked` are some of. Each child of the root counts by the
/// part of its box between the planes, across the axis that the rays run along, as if all children had as many leaves.
#[inline(always)]
pub(crate) fn leaves_held<L: Lanes>(token: L::Token, bvh: &Bvh<'_>, asked: &Asked) -> f32 {
    let Some(root) = bvh.nodes.get(bvh.root as usize) else { return 0.0 };
    let (along, sign) = heading(asked[0].direction.to_array());
    let (k, across) = (along % 3, across(along));
    let number = |value| L::splat(token, value);
    let (factor, zero) = (bvh.scale.factor, number(0.0));
    let (mut held, mut children) = (0.0, 0);
    for part in 0..WIDTH / L::COUNT {
        let low = axes!(i => L::load_part(token, &root.low[i], part));
        let high = axes!(i => L::load_part(token, &root.high[i], part));

        // A child is looked at half way through its box, or where the rays begin if that is farther; a child behind them holds none.
        let start = number(factor * asked[0].origin.to_array()[k]);
        let middle = number(0.5) * (low[k] + high[k]);
        let depth = L::select(zero.lt(number(sign) * (middle - start)), middle, start);
        let end = if sign > 0.0 { high[k] } else { low[k] };
        let is_there = low[k].le(high[k]);
        let mut share =
            L::select(is_there & zero.le(number(sign) * (end - start)), number(1.0), zero);

        // (One division for both sides, slopes computed before, or four sums instead of one are not faster.)
        for axis in across {
            let i = axis % 3;
            let (mut left, mut right) = (number(f32::INFINITY), number(f32::NEG_INFINITY));
            for ray in asked {
                let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
                let slope = d[i] / d[k];
                let at = depth * number(slope) + number(factor * (o[i] - slope * o[k]));
                left = L::select(at.lt(left), at, left);
                right = L::select(right.lt(at), at, right);
            }
            let beyond = number(BEYOND_ASKED) * (right - left);
            let (left, right) = (left - beyond, right + beyond);
            let within = L::select(right.lt(high[i]), right, high[i])
                - L::select(low[i].lt(left), left, low[i]);
            share = L::select(zero.lt(within), share * within / (high[i] - low[i]), zero);
        }
        let share = share.store();
        for lane in 0..L::COUNT {
            held += share.get(lane);
        }
        children += is_there.bits().count_ones();
    }
    held / children as f32 * (bvh.indices.len() / WIDTH) as f32
}

#[cfg(all(test, proofs))]
mod tests;
