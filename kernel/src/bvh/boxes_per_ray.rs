//! How many boxes of a tree a ray is expected to enter: a number for how good its boxes are.
//!
//! A line that meets a convex body meets a box in it with a chance that is the ratio of their surfaces (MacDonald and Booth
//! 1990). The body here is no box of the tree, since one sphere far away, or a ground, would make it large, and all chances
//! small. It is the box that spheres would fill if they lay uniformly as far from their middle as half of them do: four
//! times the median distance from the median along each axis, and the median diameter. The medians are those of up to 32
//! spheres, the same ones of a list wherever they lie, which takes a microsecond. No box is entered more than once.

use super::node::{BvhNode, LEAF, NO_CHILD, SMALL_TREE, WIDTH};
use crate::geometry::sphere::Spheres;
use crate::numeric::axes::axes;
use crate::scale::scene::SceneScale;
use core::ops::Add;

/// How many spheres are looked at, at most and at least.
const SAMPLE: usize = 32;
const LEAST: usize = 8;
/// One sphere in so many is looked at.
const ONE_IN: usize = 64;
/// 2^32 over the golden ratio: its multiples fill 0 to 2^32 evenly, however many they are.
const GOLDEN: u32 = 0x9E37_79B9;

/// How many boxes a ray is expected to enter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BoxesPerRay {
    /// Those of nodes, without the root.
    pub(crate) nodes: f32,
    /// Those of leaves.
    pub(crate) leaves: f32,
}

impl BoxesPerRay {
    /// The same with the root, where that is a leaf.
    pub(crate) fn of_root(self, root: u32) -> Self {
        let is_leaf = root != NO_CHILD && root & LEAF != 0;
        Self { leaves: if is_leaf { 1.0 } else { self.leaves }, ..self }
    }

    /// What a ray is expected to cost: the root, the boxes, and a leaf that every ray enters for every sixteen spheres that
    /// no box holds. At least 1.
    pub(crate) fn cost(self, outside: usize) -> f32 {
        1.0 + self.nodes + self.leaves + outside as f32 / WIDTH as f32
    }
}

impl Add for BoxesPerRay {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { nodes: self.nodes + other.nodes, leaves: self.leaves + other.leaves }
    }
}

/// 1 over half the surface of the body that rays meet, in the units of the tree: half a box's surface times this is the
/// chance to enter the box. `+inf` where every box counts as entered, since nothing can be said, or since the spheres are
/// so few that no ray looks at a box.
pub(crate) fn inverse_of_body(spheres: &Spheres<'_>, scale: &SceneScale) -> f32 {
    let count = spheres.len();
    if count <= SMALL_TREE {
        return f32::INFINITY;
    }
    let mut columns = [[0.0; SAMPLE]; 4];
    let mut held = 0;
    for number in 0..(count / ONE_IN).clamp(LEAST, SAMPLE) {
        let part = u64::from((number as u32).wrapping_mul(GOLDEN));
        let at = (part * count as u64) >> u32::BITS;
        if let Some(sphere) = spheres.get(at as usize).and_then(|sphere| scale.scaled(&sphere)) {
            let [x, y, z] = sphere.center();
            for (column, number) in columns.iter_mut().zip([x, y, z, sphere.radius]) {
                column[held % SAMPLE] = number;
            }
            held += 1;
        }
    }
    let [xs, ys, zs, radii] = &mut columns;
    let radius = median(radii, held);
    let width = |column: &mut [f32; SAMPLE]| {
        let middle = median(column, held);
        for number in column.iter_mut() {
            *number = (*number - middle).abs();
        }
        4.0 * median(column, held) + 2.0 * radius
    };
    let [x, y, z] = [width(xs), width(ys), width(zs)];
    1.0 / (x * y + y * z + z * x)
}

/// The middle one of the first `held`, by rank: a sort of the standard library may panic.
fn median(column: &[f32; SAMPLE], held: usize) -> f32 {
    let held = held.min(SAMPLE);
    for one in 0..held {
        let mut below = 0;
        for other in 0..held {
            let is_below = column[other] < column[one];
            below += usize::from(is_below | (column[other] == column[one] && other < one));
        }
        if below == held / 2 {
            return column[one];
        }
    }
    0.0
}

/// How many of a node's boxes a ray is expected to enter, given what [`inverse_of_body`] says.
#[inline(always)]
pub(crate) fn boxes_of(BvhNode { low, high, child, .. }: &BvhNode, inverse: f32) -> BoxesPerRay {
    let (mut nodes, mut all) = (0.0, 0.0);
    for slot in 0..WIDTH {
        let [x, y, z] = axes!(i => high[i][slot] - low[i][slot]);
        let chance = (x * y + y * z + z * x) * inverse;
        // NaN where nothing can be said.
        let chance = if chance < 1.0 { chance } else { 1.0 };
        let chance = if low[0][slot] <= high[0][slot] { chance } else { 0.0 };
        all += chance;
        nodes += if child[slot] & LEAF == 0 { chance } else { 0.0 };
    }
    BoxesPerRay { nodes, leaves: all - nodes }
}

#[cfg(all(test, proofs))]
mod tests {
    extern crate std;

    use super::*;
    use crate::{SphereList, Vec3};

    /// Half the surface of the body that rays meet.
    fn surface(spheres: impl Iterator<Item = (Vec3, f32)>) -> f32 {
        let list: SphereList = spheres.collect();
        let scale = SceneScale::of(&list.spheres());
        let unit = scale.factor * scale.factor;
        1.0 / (inverse_of_body(&list.spheres(), &scale) * unit)
    }

    /// Of equal spheres a cube around one; of a row a box as long as the row.
    #[test]
    fn the_body_is_what_uniform_spheres_fill() {
        let cube = surface((0..4000).map(|_| (Vec3::new(3.0, -7.0, 2.0), 0.5)));
        assert!((2.99..3.01).contains(&cube), "{cube}");
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            let row = (0..4000).map(|number| (number as f32 * axis, 0.5));
            let surface = surface(row);
            // 4,000 by 1 by 1, and a sample of 32.
            assert!((7000.0..9000.0).contains(&surface), "{surface}");
        }
        let few = surface((0..SMALL_TREE).map(|number| (number as f32 * Vec3::X, 0.5)));
        assert_eq!(few, 0.0, "all boxes count as entered");
    }

    #[test]
    fn a_ray_enters_the_root_and_what_no_box_holds() {
        let boxes = BoxesPerRay { nodes: 2.0, leaves: 3.0 };
        assert_eq!((boxes.cost(0), boxes.cost(160)), (6.0, 16.0));
        assert_eq!((boxes + boxes).cost(0), 11.0);
        assert_eq!([0, LEAF, NO_CHILD].map(|root| boxes.of_root(root).leaves), [3.0, 1.0, 3.0]);
    }
}
