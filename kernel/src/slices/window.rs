//! Some rays of many: as many as are packed, traced and unpacked at a time.

use crate::Accuracy;
use crate::geometry::many::ManyRays;
#[cfg(not(feature = "std"))]
use crate::geometry::many_answers::ManyAnswers;
use crate::geometry::ray_packet::RayPacket;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;

/// How many packets are traced at a time: enough that preparing 128 spheres of a list for them is a hundredth of the work; for firmware as
/// many as its stack holds.
pub(super) const PACKETS: usize = if cfg!(feature = "std") { 64 } else { 4 };

/// Answers rays `from` to `to`, which fill at most `packets`.
#[inline(always)]
pub(super) fn answer_part<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from, to): (&ManyRays<'_>, usize, usize),
    packets: &mut [RayPacket],
    (answered, answers): (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) {
    structure.many_in_packets::<Q>(tier, trace, &rays.part(from, to), packets, answered);
    #[cfg(feature = "std")]
    Q::write_at(trace.level, answers, answered, from, to);
    #[cfg(not(feature = "std"))]
    answers.write(answered, from, to);
}
