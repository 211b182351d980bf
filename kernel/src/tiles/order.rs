//! Sorting spheres by depth.
//!
//! The least depth that a ray may meet a sphere at: for a common origin the distance of its surface,
//! which for an origin inside is r - |x|; for a common direction n, x.n - r; both lowered by the
//! margin of `tiles/pencil.rs`. Indices are sorted by a radix sort of eight bits a round, from one
//! column of the memory to another, with the keys where the depths will be, in the order of the
//! spheres; then the columns are filled.

use super::DepthOrder;
use super::list::{List, Listed, column_length, columns};
use super::view::View;
use crate::axes::axes;
use crate::bvh::LARGEST;
use crate::{Sphere, Spheres};

/// The key of a sphere that nothing hits, above all others.
const NOTHING: u32 = u32::MAX;
/// The key of a sphere that the bounds do not cover.
const OUTSIDE: u32 = u32::MAX - 1;

/// The memory is as large as [`DepthOrder::needed`] says.
pub(super) fn sort<'a, V: View>(
    spheres: Spheres<'_>,
    view: Option<V>,
    memory: &'a mut [u32],
) -> DepthOrder<'a> {
    let count = spheres.len();
    let mut columns = columns(memory, column_length(count));
    let Some(view) = view else {
        let list = List::new(columns, 0);
        return DepthOrder { seen: None, list, outside: 0, extent: 0.0, count };
    };

    let [spare, _, _, _, keys, indices] = &mut columns;
    for (key, sphere) in keys.iter_mut().zip(spheres.iter()) {
        *key = key_of(&view, &sphere);
    }
    for (index, number) in indices.iter_mut().zip(0..) {
        *index = number;
    }
    let keys = keys.get(..count).unwrap_or_default();
    if let (Some(spare), Some(indices)) = (spare.get_mut(..count), indices.get_mut(..count)) {
        sort_by_key(keys, indices, spare);
    }
    let judged = keys.iter().filter(|&&key| key < OUTSIDE).count();
    let outside = keys.iter().filter(|&&key| key == OUTSIDE).count();

    let [x, y, z, reach, depth, index] = &mut columns;
    let center = x.iter_mut().zip(y.iter_mut()).zip(z.iter_mut());
    let columns_but_index = center.zip(reach.iter_mut()).zip(depth.iter_mut());
    let mut extent = 0.0_f32;
    for (place, ((((x, y), z), reach), depth)) in columns_but_index.enumerate() {
        let sphere = index.get(place).and_then(|&index| spheres.get(index as usize));
        let listed = match sphere {
            Some(sphere) if place < judged => view.listed(&sphere),
            _ => Listed::NONE,
        };
        let center = listed.center;
        [*x, *y, *z] = axes!(i => center[i].to_bits());
        (*reach, *depth) = (listed.reach.to_bits(), listed.depth.to_bits());
        extent = extent.max(center[0].abs() + center[1].abs() + center[2].abs() + listed.reach);
    }
    let list = List::new(columns, judged);
    DepthOrder { seen: Some(view.seen_by()), list, outside, extent, count }
}

/// An integer in the order of the depths.
fn key_of<V: View>(view: &V, sphere: &Sphere) -> u32 {
    if !sphere.is_valid() {
        return NOTHING;
    }
    if sphere.center.abs().max_element().max(sphere.radius) > LARGEST {
        return OUTSIDE;
    }
    let bits = view.listed(sphere).depth.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

/// Sorts `indices` by the keys that they are the places of; equal ones stay in their order.
fn sort_by_key(keys: &[u32], indices: &mut [u32], spare: &mut [u32]) {
    let (mut from, mut to) = (indices, spare);
    for round in 0..4 {
        let digit = |index: u32| {
            keys.get(index as usize).map_or(0, |key| (key >> (8 * round)) as usize & 0xff)
        };
        let mut places = [0_u32; 256];
        for &index in from.iter() {
            let count = &mut places[digit(index)];
            *count = count.wrapping_add(1);
        }
        let mut before = 0_u32;
        for place in &mut places {
            (*place, before) = (before, before.wrapping_add(*place));
        }
        for &index in from.iter() {
            let place = &mut places[digit(index)];
            if let Some(element) = to.get_mut(*place as usize) {
                *element = index;
            }
            *place = place.wrapping_add(1);
        }
        (from, to) = (to, from);
    }
    // After four rounds all are where they came from.
}
