//! In which order rays meet the children of a node: one order for each octant of directions.
//!
//! Rays of an octant run up or down along each axis alike. Children are sorted by how far their
//! boxes' centres lie along the diagonal of the octant, so one ray may find two of them in
//! the other order; that costs time, never an answer. A ray then needs no sorting of its own: the
//! children that it meets are put onto its stack in the order of its octant, and the nearest is on
//! top.

use crate::bvh::node::{BvhNode, WIDTH};

/// Writes the orders of a node whose boxes are made.
pub(super) fn order_children(node: &mut BvhNode) {
    for octant in 0..4 {
        let mut keys = [0_u64; WIDTH];
        for (slot, key) in keys.iter_mut().enumerate() {
            let mut along = 0.0;
            for axis in 0..3 {
                let center = node.low[axis][slot] + node.high[axis][slot];
                along += if octant >> axis & 1 == 1 { -center } else { center };
            }
            // As an integer in the order of the numbers, the farthest first; its slot in the last bits.
            let bits = along.to_bits();
            let rising = if bits >> 31 == 1 { !bits } else { bits | 1 << 31 };
            let there = node.low[0][slot] <= node.high[0][slot];
            let falling = if there { !rising } else { u32::MAX };
            *key = u64::from(falling) << 4 | slot as u64;
        }
        keys.sort_unstable();
        // The opposite octant meets them the other way round.
        let (mut order, mut opposite) = (0, 0);
        for (place, key) in keys.iter().enumerate() {
            let slot = key & 15;
            order |= slot << (4 * place);
            opposite |= slot << (60 - 4 * place);
        }
        node.order[octant] = order;
        node.order[7 - octant] = opposite;
    }
}

#[cfg(test)]
mod tests {
    use super::order_children;
    use crate::bvh::node::{BvhNode, WIDTH, octant_of};

    /// Sixteen boxes along a diagonal line, and an order that names each slot once.
    #[test]
    fn every_slot_once_and_the_nearest_last() {
        for count in 0..=WIDTH {
            let mut node = BvhNode::EMPTY;
            for slot in 0..count {
                // Not in the order of the slots.
                let center = (slot * 7 % 16) as f32;
                for axis in 0..3 {
                    node.low[axis][slot] = center - 0.25;
                    node.high[axis][slot] = center + 0.25;
                }
            }
            order_children(&mut node);
            for octant in 0..8_u32 {
                let order = node.order[octant as usize];
                let mut seen = 0;
                let mut before = f32::INFINITY;
                for place in 0..WIDTH {
                    let slot = (order >> (4 * place) & 15) as usize;
                    seen |= 1 << slot;
                    if slot < count && (octant == 0 || octant == 7) {
                        let center = node.low[0][slot];
                        let along = if octant == 0 { center } else { -center };
                        assert!(along < before, "{octant}: {order:x}");
                        before = along;
                    }
                }
                assert_eq!(seen, 0xffff_u32, "{octant}: {order:x}");
            }
        }
        assert_eq!(octant_of([true, false, true]), 5);
    }
}
