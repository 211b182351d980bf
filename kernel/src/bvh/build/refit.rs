//! The boxes of a tree whose spheres have moved.
//!
//! Every lane takes the sphere of its index from where it is now, and boxes are made anew from the leaves up, as the
//! build makes them; every sphere stays in its leaf. A lane whose sphere is not seen by bounds any more has NaN for a
//! radius, and so has one whose sphere is the same as that of a lower index in its leaf. A sphere that has no lane
//! (`unplaced.rs`) is tested by itself, if it is valid and no longer equal to the
//! sphere in the tree whose copy it was.

mod leaves;

use self::leaves::Leaves;
use super::child_order::order_children;
use super::join::InTurn;
use super::top_down::extent_of;
use crate::bvh::boxes_per_ray::inverse_of_body;
use crate::bvh::built::Built;
use crate::bvh::node::BvhNode;
use crate::bvh::unplaced::Unplaced;
use crate::geometry::sphere::Spheres;
use crate::memory::TooSmall;
use crate::numeric::heap_sort::heap_sort;
use crate::numeric::radix_sort::radix_sort;
use crate::scale::scene::SceneScale;
use wide::f32x4;

/// Moves the spheres of a tree to where they are now in `spheres`, which has as many; nothing changes if `indices` has
/// no room for those that no box holds then.
pub(crate) fn refit(
    built: &mut Built,
    spheres: &Spheres<'_>,
    nodes: &mut [BvhNode],
    places: &mut [[f32; 4]],
    indices: &mut [u32],
) -> Result<(), TooSmall> {
    // Where there is room for all, they need not be counted before anything changes.
    if indices.len() < built.places + spheres.len() {
        let numbers = places.as_flattened().get(built.shift + built.leaves()..);
        let table = numbers.unwrap_or_default().as_chunks().0.get(..built.unplaced);
        let outside = outside(spheres, &built.scale, table.unwrap_or_default());
        TooSmall::check("indices", built.places + outside, indices.len())?;
    }
    let needed = refit_anyway(built, spheres, nodes, places, indices);
    TooSmall::check("indices", needed, indices.len())
}

/// The same, whatever the room: returns how many indices are needed. If these are more than there are, the tree is not
/// valid until it is refitted again.
pub(crate) fn refit_anyway(
    built: &mut Built,
    spheres: &Spheres<'_>,
    nodes: &mut [BvhNode],
    places: &mut [[f32; 4]],
    indices: &mut [u32],
) -> usize {
    let numbers = places.as_flattened_mut().get_mut(built.shift..).unwrap_or_default();
    let (numbers, table) = numbers.split_at_mut(built.leaves().min(numbers.len()));
    let table = table.as_chunks().0.get(..built.unplaced).unwrap_or_default();

    let nodes = nodes.get_mut(..built.nodes).unwrap_or_default();
    let (lanes, outside) = indices.split_at_mut(built.places.min(indices.len()));
    let scale = built.scale;
    let mut leaves = Leaves { spheres, scale, numbers, lanes, outside, count: 0 };
    let all = leaves.refit(nodes, built.root);
    for bits in table {
        let unplaced = Unplaced::from_bits(*bits);
        if unplaced.is_met(spheres) {
            leaves.leave_out(unplaced.index);
        }
    }
    built.outside = leaves.count;
    // Where `Stable` and other tiers find equal t, the first sphere is the answer.
    if let Some((outside, spare)) = outside.split_at_mut_checked(built.outside) {
        sort(outside, spare, spheres.len());
    }

    built.extent = if all.is_empty() { 0.0 } else { extent_of(all.outward()) };
    let inverse = inverse_of_body(spheres, &scale);
    let boxes = order_children::<false>(&InTurn, nodes, numbers, inverse);
    built.boxes_per_ray = boxes.of_root(built.root);
    built.places + built.outside
}

/// Sorts indices below `below`, by digits where there is as much memory to spare. (Then the whole refit takes half the
/// time where a thousand spheres part into 10,000.) Not inlined, so that its counts need no room while the tree is
/// walked.
#[inline(never)]
fn sort(indices: &mut [u32], spare: &mut [u32], below: usize) {
    // (Not `is_sorted`, whose chunks may panic, as compilers see it.)
    if indices.iter().zip(indices.iter().skip(1)).all(|(one, next)| one <= next) {
        return;
    }
    // As many, and no more: every second round reads what the one before wrote, and nothing else.
    let Some(spare) = spare.get_mut(..indices.len()) else {
        heap_sort(indices, |one, next| one < next);
        return;
    };
    // After an even number of rounds the indices are where they were.
    let bits = usize::BITS - below.leading_zeros();
    radix_sort(indices, spare, bits.div_ceil(8).next_multiple_of(2), |index| *index);
}

/// How many spheres no box will hold.
fn outside(spheres: &Spheres<'_>, scale: &SceneScale, table: &[[f32; 2]]) -> usize {
    if table.is_empty() && all_are_inside(spheres, scale) {
        return 0;
    }
    let mut outside = 0;
    for sphere in spheres.iter() {
        outside += usize::from(scale.scaled(&sphere).is_none() && sphere.is_valid());
    }
    for bits in table {
        let unplaced = Unplaced::from_bits(*bits);
        outside += usize::from(unplaced.is_met(spheres));
        outside -= usize::from(unplaced.is_beyond(spheres, scale)).min(outside);
    }
    outside
}

/// Whether bounds see every sphere.
fn all_are_inside(spheres: &Spheres<'_>, scale: &SceneScale) -> bool {
    let [x, y, z, radii] = spheres.columns().map(|column| column.as_chunks::<4>().0);
    let mut inside = 0b1111;
    for ((x, y), (z, radius)) in x.iter().zip(y).zip(z.iter().zip(radii)) {
        inside &= scale.scale_four([*x, *y, *z, *radius].map(f32x4::new)).1;
    }
    let rest = spheres.iter().skip(4 * x.len());
    inside == 0b1111 && rest.into_iter().all(|sphere| scale.scaled(&sphere).is_some())
}
