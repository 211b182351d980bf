//! In what order rays go down the tree: those together that start near each other.
//!
//! Where the tree is in the core's cache, sorting costs more than it gains. Where it is not, rays of one place read one
//! part of it. Places are cells of a grid over where the rays start, in the order of a Z curve (Morton 1966). (By
//! octant before place u1m runs at 0.65; bits of both by turns gain 1.03, not worth a longer key.)

use crate::geometry::ray::RayPacket;
use crate::lanes::LaneArray;
use crate::numeric::axes::axes;
use crate::numeric::radix_sort::radix_sort;
use crate::numeric::z_curve::one_in_three;

/// Bits of a cell's number along each axis.
const BITS: u32 = 8;

/// Writes the numbers of the live rays of some packets into the low halves of `order`, those together that start near
/// each other; returns how many they are. `others` is as long. No start counts as farther away than `most`.
#[inline(always)]
pub(super) fn by_start<A: LaneArray>(
    packets: &[RayPacket<A>],
    most: f32,
    others: &mut [u64],
    order: &mut [u64],
) -> usize {
    let (mut low, mut high) = ([most; 3], [-most; 3]);
    for packet in packets {
        for axis in 0..3 {
            for lane in 0..A::COUNT {
                let start = packet.origin[axis].get(lane);
                low[axis] = if start < low[axis] { start } else { low[axis] };
                high[axis] = if start > high[axis] { start } else { high[axis] };
            }
            (low[axis], high[axis]) = (low[axis].max(-most), high[axis].min(most));
        }
    }
    // Not a number where all start in a plane: a cell of zero.
    let per_length = axes!(i => (1_u32 << BITS) as f32 / (high[i] - low[i]));

    let mut count = 0;
    for (number, packet) in packets.iter().enumerate() {
        let live = packet.live();
        for lane in 0..A::COUNT {
            let cell = axes!(i => {
                let along = (packet.origin[i].get(lane) - low[i]) * per_length[i];
                (along as u32).min((1 << BITS) - 1)
            });
            let cell =
                one_in_three(cell[0]) | one_in_three(cell[1]) << 1 | one_in_three(cell[2]) << 2;
            if let Some(place) = others.get_mut(count) {
                *place = u64::from(cell) << 32 | (number * A::COUNT + lane) as u64;
                count += (live >> lane & 1) as usize;
            }
        }
    }
    if let (Some(others), Some(order)) = (others.get_mut(..count), order.get_mut(..count)) {
        radix_sort(others, order, 3, |ray| (ray >> 32) as u32);
    }
    count
}
