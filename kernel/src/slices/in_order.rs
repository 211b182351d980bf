//! Rays of a long call that gain by another order: sorted, and answered in it, some packets at a time.

use super::PACKETS;
use crate::Accuracy;
use crate::coherent::ray_order::{GainByOrder, MOST, RayOrder, number_of};
use crate::geometry::many::ManyRays;
use crate::geometry::ray::{Ray, RayPacket};
use crate::memory::lengthen;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
use glam::Vec3;

/// Answers rays from `from` on, and returns up to which: as long as they gain by an order, and there is memory for it. Takes 8
/// bytes a ray, half a megabyte at most. (Streams in that order: 0.8 to 1.0 of the speed.)
#[inline(never)]
pub(super) fn answer<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (gain, rays, mut from, count): (GainByOrder, ManyRays<'_>, usize, usize),
    packets: &mut [RayPacket],
    (answered, answers): (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) -> usize {
    let mut gathered = [[Ray::new(Vec3::ZERO, Vec3::ZERO); RayPacket::COUNT]; PACKETS];
    let gathered = gathered.as_flattened_mut();
    let mut memory = trace.kept.take_numbers();
    while gain.is_for(count - from) {
        // In parts of equal length: of few rays left over none would gain.
        let left = count - from;
        let to = from + left.div_ceil(left.div_ceil(MOST).max(1));
        let part = rays.part(from, to);
        let Some(order) = RayOrder::of(&part, gain) else { break };
        if lengthen(&mut memory, 0, 2 * part.count()).is_none() {
            break;
        }
        let (numbers, others) = memory.split_at_mut(part.count());
        order.sort(&part, numbers, others);

        let mut at = 0;
        while let Some(rest) = numbers.get(at..)
            && !rest.is_empty()
        {
            let numbers = rest.get(..gathered.len()).unwrap_or(rest);
            at += numbers.len();
            for (place, &number) in gathered.iter_mut().zip(numbers) {
                if let Some(ray) = part.ray(number_of(number)) {
                    *place = ray;
                }
            }
            let these = ManyRays::Slice(gathered.get(..numbers.len()).unwrap_or_default());
            structure.many_in_packets::<Q>(tier, trace, these, packets, answered);
            for (place, &number) in numbers.iter().enumerate() {
                if let Some(packet) = answered.get(place / RayPacket::COUNT) {
                    let one = Q::one(packet, place % RayPacket::COUNT);
                    Q::write_one(answers, from + number_of(number), one);
                }
            }
        }
        from = to;
    }
    trace.kept.put_numbers(memory);
    from
}
