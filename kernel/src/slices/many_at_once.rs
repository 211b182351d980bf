//! Rays of a long call that have nothing in common: many are answered at once, so that a tree can trace them as a stream,
//! in memory that the call allocates.

use super::window::answer_part;
use crate::Accuracy;
use crate::geometry::many::ManyRays;
use crate::geometry::ray_packet::RayPacket;
use crate::memory::lengthen;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
use alloc::vec::Vec;

/// Answers rays from `from` on, as long as the structure gains by many at once, and there is memory. Returns the number
/// of the first that is not answered. Takes 40 bytes a ray, two thirds of a megabyte at most.
#[inline(never)]
pub(super) fn answer<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, mut from, count): (&ManyRays<'_>, usize, usize),
    answers: &mut Q::Many<'_>,
) -> usize {
    if structure.many_at_once::<Q>(trace, count.saturating_sub(from)).is_none() {
        return from;
    }
    let (mut packets, mut answered) = (trace.kept.take_packets(), Vec::new());
    while from < count
        && let Some(at_once) = structure.many_at_once::<Q>(trace, count - from)
    {
        let needed = at_once.div_ceil(RayPacket::COUNT);
        if lengthen(&mut packets, RayPacket::inactive(), needed).is_err()
            || lengthen(&mut answered, Q::none::<[f32; 16]>(), needed).is_err()
        {
            break;
        }
        let to = (from + at_once).min(count);
        let part = (rays, from, to);
        let answers = (&mut answered[..], &mut *answers);
        answer_part::<S, Q>(structure, tier, trace, part, &mut packets, answers);
        from = to;
    }
    trace.kept.put_packets(packets);
    from
}
