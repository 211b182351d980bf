//! Few rays that have little in common: told by some of them, before they are packed.
//!
//! # Method
//!
//! To pack rays, and to lay planes around them, takes as long as some of them do by themselves. So of few rays four are looked
//! at first. They go one by one if their slopes differ by more than planes may be apart (`fit.rs`); or if they begin so far apart
//! that planes around all would hold more leaves than there are rays, as if leaves were spread evenly. This decides the way
//! alone: answers are the same. (For 64 of a camera's rays this takes some 30 ns, 3 to 6 % where they are fastest. To look first for
//! one origin and small angles saves a third of that.)

use super::fit::heading;
use super::frustum::across;
use super::tree_group::NARROW;
use crate::bvh::node::{BvhNode, WIDTH};
use crate::bvh::tree::Bvh;
use crate::geometry::many::ManyRays;
use crate::geometry::ray::RayPacket;
use crate::numeric::rounding::{least, most};
use core::ops::Range;

/// The rays of a packet that are held against its first.
const ASKED: [usize; 3] = [5, 10, 15];
/// Four of many that are spread evenly lie within three fifths of their range: so much larger is the area of all.
const AREA_OF_ALL: f32 = 25.0 / 9.0;

/// Whether rays have little in common, as far as those tell that fill the first packet, and those that fill the last.
#[inline(always)]
pub(crate) fn differ(bvh: &Bvh<'_>, rays: &ManyRays<'_>, range: Range<usize>) -> bool {
    let Range { start, end } = range;
    let count = end.saturating_sub(start);
    if count <= RayPacket::COUNT {
        return packet_differs(bvh, rays, start..end, count);
    }
    // Where a row of a picture ends, the first may be wide, and the others are not.
    packet_differs(bvh, rays, start..start + RayPacket::COUNT, count)
        && packet_differs(bvh, rays, end - RayPacket::COUNT..end, count)
}

/// Whether rays of a packet have little in common, of so many in all.
#[inline(always)]
fn packet_differs(bvh: &Bvh<'_>, rays: &ManyRays<'_>, packet: Range<usize>, count: usize) -> bool {
    let Some(first) = rays.ray(packet.start) else { return false };
    let (o, d) = (first.origin.to_array(), first.direction.to_array());
    let (along, sign) = heading(d);
    let (k, axes) = (along % 3, across(along));

    // Offsets across that axis, times d_k, from the first ray.
    let mut offsets = [[0.0; 2]; 2];
    for number in ASKED {
        let Some(ray) = rays.ray((packet.start + number).min(packet.end - 1)) else { continue };
        let (p, e) = (ray.origin.to_array(), ray.direction.to_array());
        if e[k] * sign <= 0.0 {
            return true;
        }
        for side in 0..2 {
            let i = axes[side] % 3;
            // Without a division: |e_i / e_k - d_i / d_k| > NARROW.
            if (e[i] * d[k] - d[i] * e[k]).abs() > NARROW * (e[k] * d[k]) {
                return true;
            }
            let offset = (p[i] - o[i]) * d[k] - (p[k] - o[k]) * d[i];
            offsets[side] = [least(offsets[side][0], offset), most(offsets[side][1], offset)];
        }
    }
    let [width, height] = [offsets[0][1] - offsets[0][0], offsets[1][1] - offsets[1][0]];
    // Of a camera, and of a row of parallel rays, there is no area.
    if width * height <= 0.0 {
        return false;
    }
    let Some(root) = bvh.nodes.get(bvh.root as usize) else { return false };
    let per_offset = bvh.scale.factor / d[k];
    let area = AREA_OF_ALL * width * height * per_offset * per_offset;
    let of_tree = area_across(root, axes);
    let leaves = (bvh.indices.len() / WIDTH) as f32;
    least(area, of_tree) * leaves > of_tree * count as f32
}

/// The area of the box around a node's children across an axis.
#[inline(always)]
fn area_across(node: &BvhNode, axes: [usize; 2]) -> f32 {
    let mut area = 1.0;
    for axis in axes {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for slot in 0..WIDTH {
            low = least(low, node.low[axis % 3][slot]);
            high = most(high, node.high[axis % 3][slot]);
        }
        area *= high - low;
    }
    area
}

#[cfg(all(test, proofs))]
mod tests {
    extern crate std;

    use super::{ManyRays, WIDTH};
    use crate::proofs::climb::Random;
    use crate::proofs::work::{Kind, Work};
    use crate::{Exact, Intersect, Ray, SphereList, SphereTree, Trace, Vec3};
    use std::vec::Vec;

    /// Whether rays are packed: what goes by itself clears no stack, begins no run, and is in no group.
    fn are_packed(tree: &SphereTree, mut trace: Trace<'_>, rays: &[Ray]) -> bool {
        let mut hits = std::vec![None; rays.len()];
        let work = Work::of(|| tree.closest_hits_with(Exact, &mut trace, rays, &mut hits));
        for (ray, hit) in rays.iter().zip(&hits) {
            assert_eq!(*hit, tree.closest_hit(Exact, ray));
        }
        [Kind::RayRun, Kind::RayStacks, Kind::GroupPacket].iter().any(|&kind| work.count(kind) > 0)
    }

    /// A tree of so many spheres between -8 and 8.
    fn tree(spheres: usize) -> SphereTree {
        let mut random = Random(61);
        let mut sphere = || (point(&mut random, 8.0), 0.25);
        SphereTree::new((0..spheres).map(|_| sphere()).collect::<SphereList>())
    }

    fn point(random: &mut Random, extent: f32) -> Vec3 {
        let mut coordinate = || random.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0;
        Vec3::new(coordinate(), coordinate(), coordinate()) * extent
    }

    /// Diffuse rays; parallel ones that fill the tree; and a row of a camera's.
    fn rays(count: usize) -> [Vec<Ray>; 3] {
        let mut random = Random(67);
        let mut points = || [point(&mut random, 8.0), point(&mut random, 1.0)];
        let diffuse = (0..count).map(|_| points()).map(|[o, d]| Ray::new(o, d)).collect();
        let beam = (0..count).map(|_| points()[0]);
        let beam = beam.map(|o| Ray::new(Vec3 { z: -9.0, ..o }, Vec3::Z)).collect();
        let eye = Vec3::new(0.1, 0.2, -20.0);
        let row = (0..count).map(|x| Ray::new(eye, Vec3::new(0.004 * x as f32, 0.05, 1.0)));
        [diffuse, beam, row.collect()]
    }

    #[test]
    fn few_rays_that_differ_go_one_by_one() {
        let (large, small, listed) = (tree(4000), tree(40), tree(4));
        for (tree, count, packed) in [
            (&large, 9, [false, false, true]),
            (&large, 16, [false, false, true]),
            (&large, 17, [false, false, true]),
            (&large, 64, [false, false, true]),
            (&large, 65, [true; 3]),
            // A small tree has no boxes that a beam might fill.
            (&small, 32, [false, true, true]),
            (&small, 33, [true; 3]),
            (&listed, 8, [false; 3]),
        ] {
            let are = rays(count).map(|rays| are_packed(tree, Trace::new(), &rays));
            assert_eq!(are, packed, "{count} rays");
        }
    }

    #[test]
    fn a_tree_that_is_met_as_a_list_is_met_by_packets() {
        let tree = tree(4);
        let [diffuse, ..] = rays(16);
        let groups = |rays: &[Ray]| {
            let work = Work::of(|| tree.closest_hits(Exact, rays, &mut [None; 16]));
            work.count(Kind::ListGroup)
        };
        assert_eq!([groups(&diffuse[..8]), groups(&diffuse)], [0, 1]);
    }

    #[test]
    fn rays_differ_where_planes_around_them_hold_more_leaves_than_there_are_rays() {
        let tree = tree(4000);
        let bvh = tree.bvh();
        let leaves = (bvh.indices.len() / WIDTH) as f32;
        for (count, threshold) in [(16, 16.0), (64, 64.0)] {
            // Four rays of each packet are asked: corners of a square that three fifths of a side reach.
            let side = (16.5f32 * 16.5 * threshold / leaves).sqrt();
            let differ = |side: f32| {
                let corner = |number: usize| {
                    let (x, y) = (number / 5 % 2, number / 10 % 2);
                    0.6 * side * Vec3::new(x as f32, y as f32, 0.0)
                };
                let ray = |number| Ray::new(corner(number % 16) - 9.0 * Vec3::Z, Vec3::Z);
                let rays: Vec<Ray> = (0..count).map(ray).collect();
                super::differ(&bvh, &ManyRays::Slice(&rays), 0..count)
            };
            assert_eq!([0.85, 1.15].map(|part| differ(part * side)), [false, true], "{count} rays");
        }
    }

    #[test]
    fn few_rays_that_are_said_to_be_incoherent_go_one_by_one() {
        let tree = tree(4000);
        for (count, packed) in [(9, false), (64, false), (65, true)] {
            let are = rays(count).map(|rays| are_packed(&tree, Trace::new().incoherent(), &rays));
            assert_eq!(are, [packed; 3], "{count} rays");
        }
    }

    #[test]
    fn a_narrow_beam_and_the_end_of_a_row_are_packed() {
        let tree = tree(4000);
        let [_, mut beam, row] = rays(48);
        for ray in &mut beam {
            ray.origin *= Vec3::new(0.1, 0.1, 1.0);
        }
        assert!(are_packed(&tree, Trace::new(), &beam));
        // The first packet has the last pixels of a row and the first of the next.
        let mut rows = row.clone();
        for ray in &mut rows[..8] {
            ray.direction = Vec3::new(1.0, 0.1, 1.0);
        }
        assert!(are_packed(&tree, Trace::new(), &rows));
        assert!(!are_packed(&tree, Trace::new(), &rows[..16]));
    }

    #[test]
    fn a_few_packets_that_are_left_of_a_call_go_one_by_one() {
        let tree = tree(4000);
        let [diffuse, _, mut rays] = rays(128);
        // A packet of one ray is left, then four packets, and five.
        let ran = |rays: &[Ray]| {
            let mut hits = [None; 256];
            let work = Work::of(|| tree.closest_hits(Exact, rays, &mut hits));
            for (ray, hit) in rays.iter().zip(&hits) {
                assert_eq!(*hit, tree.closest_hit(Exact, ray));
            }
            work.count(Kind::RayRun) > 0
        };
        assert!(!ran(&rays[..65]));
        rays.extend_from_slice(&diffuse[..64]);
        assert!(!ran(&rays), "four packets are left");
        rays.extend_from_slice(&diffuse[64..80]);
        assert!(ran(&rays), "five packets are left");
    }
}
