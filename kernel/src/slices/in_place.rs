//! A caller's packets: they are traced where they lie, except those whose rays gain by another order.

#[cfg(feature = "std")]
use super::by_depth::{self, Looks, MANY};
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
    #[cfg(feature = "std")]
    let mut looks = Looks::NONE;
    while from < count {
        #[cfg(feature = "std")]
        let is_counted = {
            let [from, left] = [from, count - from].map(|packets| packets * RayPacket::COUNT);
            looks.begin(structure, trace, [from, left, MANY])
        };
        #[cfg(feature = "std")]
        if is_counted {
            packets = FIRST;
        }
        let to = count.min(from + packets);
        if let (Some(rays), Some(answers)) = (rays.get(from..to), answers.get_mut(from..to)) {
            structure.in_packets::<Q>(tier, trace, rays, answers);
        }
        from = to;
        #[cfg(feature = "std")]
        if is_counted {
            from = nearest_first::<S, Q>(structure, tier, trace, (rays, to), answers);
            if looks.end([to, from].map(|packets| packets * RayPacket::COUNT)) {
                continue;
            }
        }
        if let (Some(rest), Some(left)) = (rays.get(from..count), answers.get_mut(from..count))
            && let Some(gain) = structure.gain_by_order::<Q>(trace)
            && gain.is_for(rest.len() * RayPacket::COUNT)
        {
            from += sorted::<S, Q>(structure, tier, trace, (gain, rest), left);
        }
        packets = AT_ONCE;
    }
}

/// Answers packets from `from` on, after some whose work is counted, by the spheres in the order of their depth, as long as that pays. Returns
/// the number of the first that is not answered. (A function of its own, as below.)
#[cfg(feature = "std")]
#[inline(never)]
fn nearest_first<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from): (&[RayPacket], usize),
    answers: &mut [Q::Packet<[f32; 16]>],
) -> usize {
    let (mut packets, mut answered) = ([RayPacket::BLANK; PACKETS], [Q::none(); PACKETS]);
    let counted = answers.get(from.saturating_sub(FIRST)..from).unwrap_or_default();
    for (to, answer) in answered.iter_mut().zip(counted) {
        *to = *answer;
    }
    let [counted, from] = [counted.len(), from].map(|packets| packets * RayPacket::COUNT);
    let count = rays.len().min(answers.len()) * RayPacket::COUNT;
    let work = (counted, trace.learnt.counted_work() / counted.max(1) as f32);
    let (rays, mut answers) = ((&ManyRays::Packets(rays), from, count), Q::of_packets(answers));
    let all = (&mut answered[..], &mut answers);
    let next = by_depth::answer::<S, Q>(structure, tier, trace, rays, work, &mut packets, all);
    next / RayPacket::COUNT
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
