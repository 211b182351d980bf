//! Rays of a long call that gain by another order: they are sorted, and answered in that order, some packets at a time.

use super::window::PACKETS;
use crate::Accuracy;
use crate::coherent::learnt::Learnt;
use crate::coherent::ray_order::{
    GROUPS_TRIED, GainByOrder, MOST, RAYS_OF_A_GROUP, RayKeys, SecondGrid, gather_some,
    gather_turns, number_of, sort,
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
/// Groups of cameras that take turns, and their sorting, may do at most three quarters: unsorted, their rays go as a stream, at 1.2 to 1.4 of the speed of ray by ray. The
/// groups on trial are of lines; those of cells do some three fifths as much. A third is added of what rays do that then go by themselves.
/// (65,536 rays by turns, AVX2, seven scenes, four pairs of cameras: 1.1 to 3.6 of the speed where they are sorted, 0.93 to 1.06 where
/// they are not. Without a trial 0.63 to 0.9 in chains, clusters and sheets, where a stream takes 60 ns a ray, and sorting 45.)
const MOST_OF_TURNS: [u64; 2] = [3, 4];
const OF_A_CELL: [u64; 2] = [3, 5];
const PART_OF_APART: u64 = 3 * (GROUPS_TRIED * RAYS_OF_A_GROUP / RayPacket::COUNT) as u64;

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
        let by_turns = keys.second.as_ref().filter(|_| keys.are_by_turns);
        if let Some(second) = by_turns {
            let tried = (&part, Tried::Turns(second));
            if !groups_pay::<S, Q>(structure, tier, trace.level, tried, (packets, answered)) {
                break;
            }
        }
        #[cfg(feature = "std")]
        crate::dispatch::compiled::write_keys(trace.level, &keys, &part, numbers);
        #[cfg(not(feature = "std"))]
        keys.write_keys::<wide::f32x16>((), &part, numbers);
        if by_turns.is_none() && keys.needs_a_trial(gain) {
            let tried = (&part, Tried::Cells(numbers));
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

/// The rays of which groups are tried.
enum Tried<'a> {
    /// By their keys, rays of some cells.
    Cells(&'a [u32]),
    /// Rays of two viewpoints by turns.
    Turns(&'a SecondGrid),
}

/// Whether most of a few groups go through together. Each is of rays that would come one after the other.
#[inline(never)]
fn groups_pay<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    level: Level,
    (rays, tried): (&ManyRays<'_>, Tried<'_>),
    (packets, answered): (&mut [RayPacket], &mut [Q::Packet<[f32; 16]>]),
) -> bool {
    let mut groups = [[Ray::new(Vec3::ZERO, Vec3::ZERO); RAYS_OF_A_GROUP]; GROUPS_TRIED];
    let (counts, most_apart) = match tried {
        Tried::Cells(numbers) => (gather_some(rays, numbers, &mut groups), MOST_APART_OF_LITTLE),
        Tried::Turns(second) => (gather_turns(rays, second, &mut groups), usize::MAX),
    };
    let (mut apart, mut efforts, mut sorting) = (0, [0; 2], 0);
    for (group, count) in groups.iter().zip(counts) {
        let rays = group.get(..count).unwrap_or(group);
        // Each group is a call of its own, since after one in vain others would be passed over.
        let mut trial = Trace { learnt: Learnt::ON_TRIAL, ..Trace::new().at(level) };
        let rays = ManyRays::Slice(rays);
        structure.many_in_packets::<Q>(tier, &mut trial, &rays, packets, answered);
        let [of_group, _] = trial.learnt.apart;
        apart += of_group;
        let [did, by_rays] = trial.learnt.efforts.unwrap_or_default();
        efforts = [efforts[0] + did, efforts[1] + by_rays];
        sorting += EFFORT_OF_SORTING * count as u64;
        // A group in vain takes several times as long as its rays by themselves: no more than two or three are tried. Of rays by turns all
        // are, since more may go apart. (Any hits between 100,000 spheres: 10 packets of 32, and sorted they are 1.7 times as fast.)
        if apart > most_apart {
            return false;
        }
    }
    match tried {
        Tried::Turns(_) => turns_pay(apart, efforts, sorting),
        Tried::Cells(_) => {
            is_within(LITTLE_EFFORT, [efforts[0] + sorting, efforts[1]])
                || (apart <= MOST_APART && is_within(MOST_EFFORT, efforts))
        }
    }
}

/// Whether rays of cameras by turns gain by being sorted, as groups of lines tell.
fn turns_pay(packets_apart: usize, [did, by_rays]: [u64; 2], sorting: u64) -> bool {
    let of_cells = OF_A_CELL[0] * did / OF_A_CELL[1];
    let of_apart = by_rays * packets_apart as u64 / PART_OF_APART;
    by_rays > 0 && is_within(MOST_OF_TURNS, [of_cells + sorting + of_apart, by_rays])
}

/// Whether what groups did is at most `of` / `parts` of what their rays would have done apart.
fn is_within([of, parts]: [u64; 2], [did, by_rays]: [u64; 2]) -> bool {
    parts * did <= of * by_rays
}

#[cfg(all(test, proofs))]
#[cfg(feature = "std")]
mod tests;
