//! The boxes of nodes.

use super::order::index_in;
use super::shape::{Place, Shape, WIDTH};
use crate::bvh::build::bounds::padded;
use crate::geometry::sphere::Spheres;
use crate::numeric::axes::axes;
use crate::numeric::rounding::{least, most};
use crate::scale::scene::SceneScale;

/// Rows of a node: low x, y and z of its children, then high, as bits. A child that is not there has zeros.
pub(super) const ROWS: usize = 6;
/// Words of a node.
pub(super) const NODE: usize = ROWS * WIDTH;

/// What boxes are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxes<'a> {
    pub(super) spheres: Spheres<'a>,
    pub(super) scale: SceneScale,
    pub(super) shape: Shape,
}

impl Boxes<'_> {
    /// The rows of a node.
    pub(super) fn rows(&self, order: &[u32], place: Place) -> [[u32; WIDTH]; ROWS] {
        let mut rows = [[0; WIDTH]; ROWS];
        for slot in 0..WIDTH {
            let child = place.child(slot);
            if child.number < self.shape.of_height(child.height) {
                let [begin, end] = self.shape.run(child);
                let part = order.get(begin as usize..end as usize).unwrap_or_default();
                let [low, high] = self.of(part);
                for axis in 0..3 {
                    rows[axis][slot] = low[axis].to_bits();
                    rows[axis + 3][slot] = high[axis].to_bits();
                }
            }
        }
        rows
    }

    /// The extent: no coordinate of a box is larger.
    pub(super) fn extent(&self, order: &[u32]) -> f32 {
        if self.shape.count == 0 {
            return 0.0;
        }
        let part = order.get(..self.shape.count as usize).unwrap_or_default();
        let [low, high] = self.of(part);
        let mut extent = 0.0;
        for axis in 0..3 {
            extent = most(high[axis], most(-low[axis], extent));
        }
        extent
    }

    /// The lower and the upper corner of the box of some spheres, as bounds see them, with its margins.
    fn of(&self, part: &[u32]) -> [[f32; 3]; 2] {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for &word in part {
            let sphere = self.spheres.get(index_in(word) as usize);
            let Some(sphere) = sphere.and_then(|sphere| self.scale.scaled(&sphere)) else {
                continue;
            };
            let center = sphere.center();
            for axis in 0..3 {
                low[axis] = least(low[axis], center[axis] - sphere.radius);
                high[axis] = most(high[axis], center[axis] + sphere.radius);
            }
        }
        // Rounding to nearest is monotonic: one step covers all.
        let [low, high] = [axes!(i => low[i].next_down()), axes!(i => high[i].next_up())];
        padded(low, high)
    }
}
