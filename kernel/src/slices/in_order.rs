//! Rays of a long call that gain by another order: they are sorted, and answered in that order, some packets at a time.

use super::window::PACKETS;
use crate::Accuracy;
use crate::coherent::learnt::Learnt;
use crate::coherent::ray_order::{
    GainByOrder, MOST, RAYS_OF_A_GROUP, RayKeys, gather_some, number_of, sort,
};
use crate::dispatch::Level;
use crate::geometry::many::ManyRays;
use crate::geometry::many_answers::ManyAnswers;
use crate::geometry::ray::Ray;
use crate::geometry::ray_packet::RayPacket;
use crate::memory::lengthen;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
use glam::Vec3;

/// How many groups are tried; and of two cameras by turns, where a group may meet much, or nothing. (Eight of those told too little: two
/// cameras over chains, a shell or a million spheres ran sorted, at 0.56 to 0.8 of the speed.)
const GROUPS_TRIED: usize = 8;
const GROUPS_OF_TURNS: usize = 32;
/// How many packets of the groups on trial may go by themselves: an eighth, and a quarter where the groups do little.
const MOST_APART: usize = GROUPS_TRIED * RAYS_OF_A_GROUP / RayPacket::COUNT / 8;
const MOST_APART_OF_LITTLE: usize = 2 * MOST_APART;
/// The groups may do at most so much of what their rays would have done apart: five quarters. (Without this rule a beam of 45,000 rays
/// through a sheet of 40,000 spheres, or along a tube of 50,000, ran at 0.71 to 0.83 of the speed by AVX2 and at the baseline, instead
/// of 0.95.)
const MOST_EFFORT: [u64; 2] = [5, 4];
/// Groups do little if that, with the effort of sorting their rays, is at most nine tenths of what these would have done apart.
/// (Without this rule one more group in vain left a beam unsorted: 50,000 rays among nested spheres ran at 0.42 of the speed of
/// 49,000.)
const LITTLE_EFFORT: [u64; 2] = [9, 10];
const EFFORT_OF_SORTING: u64 = 8;
/// Groups of two cameras by turns may do at most three tenths, with so much for sorting a ray: unsorted, rays go as a stream, at 1.2 to
/// 1.4 of the speed of ray by ray. But rays that meet many spheres each take longer by themselves than is counted: of these groups may do
/// as much. (65,536 rays by turns, three levels, fourteen scenes: sorted, 1.3 to 2.4 of a stream's speed where this holds, elsewhere 0.6
/// to 1.05.)
const MOST_OF_TURNS: [u64; 2] = [3, 10];
const SORTING_OF_TURNS: u64 = 4;
const MEETS_MANY: u64 = 256;

/// Answers rays from `from` on, as long as they gain by an order, and there is memory to sort them. Returns the number of the first
/// that is not answered. Takes 8 bytes a ray, half a megabyte at most. (Streams in that order ran at 0.8 to 1.0 of the speed.)
#[inline(never)]
pub(super) fn answer<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (gain, rays, mut from, count): (GainByOrder, &ManyRays<'_>, usize, usize),
    packets: &mut [RayPacket],
    (answered, answers): (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) -> usize {
    let mut gathered = [[Ray::new(Vec3::ZERO, Vec3::ZERO); RayPacket::COUNT]; PACKETS];
    let gathered = gathered.as_flattened_mut();
    let mut memory = trace.kept.take_numbers();
    while gain.is_for(count - from) {
        // Parts have equal length, since a few rays left over would gain nothing; and they are whole packets.
        let left = count - from;
        let part = left.div_ceil(left.div_ceil(MOST).max(1)).next_multiple_of(RayPacket::COUNT);
        let to = (from + part).min(count);
        let part = rays.part(from, to);
        let Some(keys) = RayKeys::of(&part, gain) else { break };
        if lengthen(&mut memory, 0, 2 * part.count()).is_err() {
            break;
        }
        let Some((numbers, others)) = memory.split_at_mut_checked(part.count()) else { break };
        #[cfg(feature = "std")]
        crate::dispatch::compiled::write_keys(trace.level, &keys, &part, numbers);
        #[cfg(not(feature = "std"))]
        keys.write_keys::<wide::f32x16>((), &part, numbers);
        if keys.needs_a_trial(gain) {
            let tried = (&part, &*numbers, keys.are_by_turns());
            if !groups_pay::<S, Q>(structure, tier, trace.level, tried, (packets, answered)) {
                break;
            }
        }
        sort(numbers, others);

        let mut at = 0;
        while let Some(rest) = numbers.get(at..)
            && !rest.is_empty()
        {
            let numbers = rest.get(..gathered.len()).unwrap_or(rest);
            at += numbers.len();
            part.gather(numbers.iter().map(|place| number_of(*place)), gathered);
            let these = ManyRays::Slice(gathered.get(..numbers.len()).unwrap_or_default());
            structure.many_in_packets::<Q>(tier, trace, &these, packets, answered);
            answers.scatter(answered, numbers.iter().map(|place| from + number_of(*place)));
        }
        from = to;
    }
    trace.kept.put_numbers(memory);
    from
}

/// Whether most of a few groups go through together. Each is of rays that would come one after the other.
#[inline(never)]
fn groups_pay<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    level: Level,
    (rays, numbers, are_by_turns): (&ManyRays<'_>, &[u32], bool),
    (packets, answered): (&mut [RayPacket], &mut [Q::Packet<[f32; 16]>]),
) -> bool {
    let mut groups = [[0; RAYS_OF_A_GROUP]; GROUPS_OF_TURNS];
    let tried = if are_by_turns { GROUPS_OF_TURNS } else { GROUPS_TRIED };
    let groups = groups.get_mut(..tried).unwrap_or_default();
    let counts = gather_some::<GROUPS_OF_TURNS>(numbers, groups, are_by_turns);
    let (mut apart, mut efforts, mut of_group) =
        (0, Efforts::default(), [Ray::new(Vec3::ZERO, Vec3::ZERO); RAYS_OF_A_GROUP]);
    for number in 0..tried {
        // From all of the call in turn: its first rays are one part of a picture.
        let place = number * 13 % tried;
        let (Some(group), Some(&count)) = (groups.get(place), counts.get(place)) else { break };
        let group = group.get(..count).unwrap_or(group);
        rays.gather(group.iter().map(|place| number_of(*place)), &mut of_group);
        let rays = ManyRays::Slice(of_group.get(..count).unwrap_or(&of_group));
        // Each group is a call of its own, since after one in vain others would be passed over.
        let mut trial = Trace { learnt: Learnt::ON_TRIAL, ..Trace::new().at(level) };
        structure.many_in_packets::<Q>(tier, &mut trial, &rays, packets, answered);
        apart += trial.learnt.apart[0];
        efforts.add(trial.learnt.efforts.unwrap_or_default(), count);
        // A group in vain takes several times as long as its rays by themselves: no more than two or three are tried. By turns, where
        // groups may meet nothing, more are.
        let is_in_vain = if are_by_turns {
            number >= GROUPS_TRIED && !efforts.are_few_of_turns(number + 1)
        } else {
            apart > MOST_APART_OF_LITTLE
        };
        if is_in_vain {
            return false;
        }
    }
    if are_by_turns { efforts.are_few_of_turns(tried) } else { efforts.are_few(apart) }
}

/// What groups on trial did, what their rays would have done apart, and how many rays these are.
#[derive(Clone, Copy, Debug, Default)]
struct Efforts {
    of_groups: u64,
    by_rays: u64,
    rays: u64,
}

impl Efforts {
    fn add(&mut self, [of_group, by_rays]: [u64; 2], rays: usize) {
        self.of_groups += of_group;
        self.by_rays += by_rays;
        self.rays += rays as u64;
    }

    /// Whether groups did little, or no more than their rays, while few packets went by themselves.
    fn are_few(&self, packets_apart: usize) -> bool {
        let sorted = self.of_groups + EFFORT_OF_SORTING * self.rays;
        is_within(LITTLE_EFFORT, [sorted, self.by_rays])
            || (packets_apart <= MOST_APART
                && is_within(MOST_EFFORT, [self.of_groups, self.by_rays]))
    }

    /// The same for rays of two cameras by turns. After the first of the groups they may do half as much again: the next may do less.
    fn are_few_of_turns(&self, tried: usize) -> bool {
        let left = GROUPS_OF_TURNS.saturating_sub(tried) as u64;
        let by_rays = self.by_rays + self.by_rays * left / (3 * GROUPS_OF_TURNS as u64 / 2);
        let [of, parts] = MOST_OF_TURNS;
        let sorted = self.of_groups + SORTING_OF_TURNS * self.rays * of / parts;
        is_within(MOST_OF_TURNS, [sorted, by_rays])
            || (by_rays >= MEETS_MANY * self.rays && is_within([1, 1], [self.of_groups, by_rays]))
    }
}

/// Whether what groups did is at most `of` / `parts` of what their rays would have done apart.
fn is_within([of, parts]: [u64; 2], [did, by_rays]: [u64; 2]) -> bool {
    parts * did <= of * by_rays
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests;
