//! Sorting spheres by depth.
//!
//! A radix sort moves indices from one column of the memory to another. The keys lie where the depths will be, in
//! the order of the spheres. Then the columns are filled. All columns hold `f32`; of keys and indices they hold
//! the bits.

use super::listed::{column_length, columns};
use super::view::View;
use crate::count::count;
use crate::geometry::sphere::{Sphere, Spheres};
use crate::numeric::axes::axes;
use crate::numeric::radix_sort::radix_sort;
use crate::scale::scene::SceneScale;

/// The key of a sphere that nothing hits, above all others.
const NOTHING: u32 = u32::MAX;
/// The key of a sphere that the bounds do not cover.
const OUTSIDE: u32 = u32::MAX - 1;

/// What a sort leaves in the memory of a list.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sorted {
    /// How many spheres are listed, and how many follow that the bounds do not cover.
    pub(super) listed: usize,
    pub(super) outside: usize,
    /// No listed sphere has a larger |x_i| + r.
    pub(super) extent: f32,
}

/// Sorts in memory as large as `DepthList::needed` says.
pub(super) fn sort(
    spheres: &Spheres<'_>,
    scale: SceneScale,
    view: &View,
    memory: &mut [f32],
) -> Sorted {
    let count = spheres.len();
    count!(SphereSorted, count);
    let mut columns = columns(memory, column_length(count));

    let [spare, _, _, _, keys, indices] = &mut columns;
    for (key, sphere) in keys.iter_mut().zip(spheres.iter()) {
        *key = f32::from_bits(key_of(scale, view, &sphere));
    }
    for (index, number) in indices.iter_mut().zip(0..) {
        *index = f32::from_bits(number);
    }
    let keys = keys.get(..count).unwrap_or_default();
    if let (Some(spare), Some(indices)) = (spare.get_mut(..count), indices.get_mut(..count)) {
        // After four rounds all indices are in their own column again.
        radix_sort(indices, spare, 4, |index: &f32| {
            keys.get(index.to_bits() as usize).map_or(0, |key| key.to_bits())
        });
    }
    let listed = keys.iter().filter(|key| key.to_bits() < OUTSIDE).count();
    let outside = keys.iter().filter(|key| key.to_bits() == OUTSIDE).count();

    let [x, y, z, radius, depth, index] = columns;
    let center = x.iter_mut().zip(y.iter_mut()).zip(z.iter_mut());
    let but_index = center.zip(radius.iter_mut()).zip(depth.iter_mut());
    let mut extent = 0.0_f32;
    for (place, ((((x, y), z), radius), depth)) in but_index.enumerate() {
        let sphere = index.get(place).and_then(|index| spheres.get(index.to_bits() as usize));
        let sphere = sphere.and_then(|sphere| scale.scaled(&sphere));
        match sphere {
            Some(sphere) if place < listed => {
                let (center, least) = view.see(&sphere);
                ([*x, *y, *z], *radius, *depth) = (center, sphere.radius, least);
                let [a, b, c] = axes!(i => center[i].abs() + sphere.radius);
                extent = extent.max(a).max(b).max(c);
            }
            _ => ([*x, *y, *z], *radius, *depth) = ([0.0; 3], f32::NAN, f32::INFINITY),
        }
    }
    Sorted { listed, outside, extent }
}

/// Returns an integer in the order of the depths.
fn key_of(scale: SceneScale, view: &View, sphere: &Sphere) -> u32 {
    if !sphere.is_valid() {
        return NOTHING;
    }
    let Some(scaled) = scale.scaled(sphere) else { return OUTSIDE };
    let (_, depth) = view.see(&scaled);
    let bits = depth.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}
