//! A caller's packets: they are traced where they lie, except those whose rays gain by another order.

use super::in_order;
use super::window::PACKETS;
use crate::Accuracy;
use crate::coherent::ray_order::{FEWEST_IN_GROUPS, GainByOrder, MOST};
use crate::geometry::many::ManyRays;
use crate::geometry::ray_packet::RayPacket;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;

/// How many packets go first, to see how the others should go; and at most how many go before the next look.
const FIRST: usize = 16;
const AT_ONCE: usize = MOST / RayPacket::COUNT;

/// Answers every packet for which there is room.
pub(super) fn traverse<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    rays: &[RayPacket],
    answers: &mut [Q::Packet<[f32; 16]>],
) {
    let count = rays.len().min(answers.len());
    let is_long = count * RayPacket::COUNT >= FEWEST_IN_GROUPS;
    let (mut from, mut packets) = (0, if is_long { FIRST } else { count });
    while let (Some(rest), Some(left)) = (rays.get(from..count), answers.get_mut(from..count))
        && !rest.is_empty()
    {
        let (rest, left) = (rest.split_at_checked(packets), left.split_at_mut_checked(packets));
        let (Some((rays, rest)), Some((answers, left))) = (rest, left) else { break };
        structure.in_packets::<Q>(tier, trace, rays, answers);
        from += packets;
        if let Some(gain) = structure.gain_by_order::<Q>(trace)
            && gain.is_for(rest.len() * RayPacket::COUNT)
        {
            from += sorted::<S, Q>(structure, tier, trace, (gain, rest), left);
        }
        packets = AT_ONCE.min(count - from);
    }
}

/// Answers packets whose rays gain by another order; returns how many. (A function of its own, so that other packets do not
/// pay for clearing its memory.)
#[inline(never)]
fn sorted<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (gain, rays): (GainByOrder, &[RayPacket]),
    answers: &mut [Q::Packet<[f32; 16]>],
) -> usize {
    let (mut packets, mut answered) = ([RayPacket::BLANK; PACKETS], [Q::none(); PACKETS]);
    let (many, count) = (ManyRays::Packets(rays), rays.len() * RayPacket::COUNT);
    let (rays, mut answers) = ((gain, &many, 0, count), Q::of_packets(answers));
    let all = (&mut answered[..], &mut answers);
    in_order::answer::<S, Q>(structure, tier, trace, rays, &mut packets, all) / RayPacket::COUNT
}
