//! Rays of a long call that have nothing in common, as streams, in memory that the call takes.

use crate::Accuracy;
use crate::bvh::{QueuedRay, StreamMemory, StreamRay};
use crate::geometry::many::ManyRays;
use crate::geometry::ray::RayPacket;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
use alloc::vec::Vec;
use core::iter::repeat_n;

/// How many packets go down together: 8,192 rays.
const PACKETS: usize = 512;
/// Fewer rays gain less than it takes to clear the memory.
const LEAST_RAYS: usize = 2 * PACKETS * RayPacket::COUNT;
/// Places in queues for a ray. (64: as fast, and a megabyte and a half more to clear; 4: 0.87 of the speed.)
const QUEUES: usize = 32;

/// Answers rays from `from` on, and returns up to which: all, as long as they have nothing in common; none, if streams
/// do not pay, or there is no memory. Takes 3.5 MB.
#[inline(never)]
pub(super) fn answer<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, mut from, count): (ManyRays<'_>, usize, usize),
    answers: &mut Q::Many<'_>,
) -> usize {
    if trace.stream.is_some() || !trace.learnt.streams || count - from < LEAST_RAYS {
        return from;
    }
    let at_once = PACKETS * RayPacket::COUNT;
    let (Some(mut stream), Some(mut queues), Some(mut packets), Some(mut answered)) = (
        filled(StreamRay::EMPTY, at_once),
        filled(QueuedRay::EMPTY, StreamMemory::queues_needed(at_once).max(QUEUES * at_once)),
        filled(RayPacket::inactive(), PACKETS),
        filled(Q::none::<[f32; 16]>(), PACKETS),
    ) else {
        return from;
    };
    while from < count && trace.learnt.streams {
        let to = (from + at_once).min(count);
        let Ok(memory) = StreamMemory::new(&mut stream, &mut queues) else { return from };
        let mut streamed = Trace::new().at(trace.level).with(trace.coherence).with_stream(memory);
        streamed.learnt = trace.learnt;
        let part = rays.part(from, to);
        structure.many_in_packets::<Q>(tier, &mut streamed, part, &mut packets, &mut answered);
        trace.learnt = streamed.learnt;
        #[cfg(feature = "std")]
        Q::write_at(trace.level, answers, &answered, from, to);
        #[cfg(not(feature = "std"))]
        Q::write(answers, &answered, from, to);
        from = to;
    }
    from
}

/// So many of a value; `None` if there is no memory.
fn filled<T: Clone>(value: T, count: usize) -> Option<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(count).ok()?;
    values.extend(repeat_n(value, count));
    Some(values)
}
