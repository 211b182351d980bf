//! Rays of a long call that start in one point: if they do much in a tree, by the spheres in the order of their distance from it.
//!
//! # Method
//!
//! A ray enters all boxes in which it starts: among nested spheres those of the whole tree. Through spheres in the order of their distance it
//! goes no farther than to its first hit. Which of the two is faster depends on scene and rays. So some packets go down the tree, and
//! what they do is counted. If that is much more than to sort the spheres, others go through a [`DepthList`], and are counted, too. The rest
//! follows as long as that is less. Packets that go deep go down the tree all the same.
//!
//! (With `std` alone: else packets may be traced ray by ray, and no packet could be left to the tree.)

use super::window::{PACKETS, answer_part};
use crate::Accuracy;
use crate::coherent::depth_list::DepthList;
use crate::coherent::ray_order::{MOST, RayKeys};
use crate::coherent::view::Viewpoint;
use crate::geometry::many::ManyRays;
use crate::geometry::ray_packet::RayPacket;
use crate::geometry::sphere::Spheres;
use crate::memory::lengthen;
use crate::structures::{LevelQuery, Traverse};
use crate::trace::Trace;
use alloc::vec::Vec;
use glam::Vec3;

/// The most spheres that are sorted: they take 2.4 MB.
const MOST_SPHERES: usize = 100_000;
/// The fewest rays.
pub(super) const FEWEST: usize = 1024;
/// After so many rays of one point those that follow are looked at anew, since they may start in another. Packets of the caller's are looked
/// at if there are so many rays: shorter calls would lose their stream.
pub(super) const MANY: usize = 8192;
/// What it takes to sort a sphere, in steps of work.
const SORTING: f32 = 30.0;
/// One part in so many of the work may be lost if sorting does not pay; and if it likely does, since a ray goes past fewer spheres than it
/// does steps of work in the tree.
const PARTS: [f32; 2] = [200.0, 10.0];
/// What any ray takes besides: it is read, and its answer written.
const BESIDES: f32 = 4.0;
/// Packets pay if they do at most nine tenths of what others did in the tree; a quarter where rays that are sorted by their direction would
/// do less there. (With nine tenths for all, shuffled rays from the edge of 200 spheres apart ran at 0.3 to 0.45 of the speed.)
const PAYS: f32 = 0.9;
const PAYS_IF_SHUFFLED: f32 = 0.25;
/// How many packets are tried in the list, and counted again in the tree.
const TRIED: usize = 8;
/// Rays that do more than half of what others did in the tree may do more than rays beside them would do there. So a few of these are
/// counted. Once in so many windows they are wherever the list does an eighth.
const IN_DOUBT: f32 = 0.5;
const LOOKED_INTO: f32 = 0.125;
const WINDOWS: usize = 32;
/// How many rays are looked at; and how many hits, and spheres.
const LOOKED_AT: usize = 32;
const REACHES_LOOKED_AT: usize = 16;
const SPHERES_LOOKED_AT: usize = 128;

/// When the next rays are looked at.
pub(super) struct Looks {
    next: usize,
}

impl Looks {
    pub(super) const NONE: Self = Self { next: 0 };

    /// Returns whether ray `from` begins some whose work is counted, if `left` are left, and at least `fewest` are needed.
    pub(super) fn begin<S: Traverse + ?Sized>(
        &self,
        structure: &S,
        trace: &mut Trace<'_>,
        [from, left, fewest]: [usize; 3],
    ) -> bool {
        let begins = from >= self.next && left >= fewest && structure.may_gain_by_depth(trace);
        if begins {
            trace.learnt.count_work();
        }
        begins
    }

    /// Takes the number of the first ray after those counted, and of the first that is not answered; returns whether the next look is at
    /// once.
    pub(super) fn end(&mut self, [from, to]: [usize; 2]) -> bool {
        let is_next = to >= from + MANY;
        self.next = if is_next { to } else { to + MOST };
        is_next
    }
}

/// Whether spheres are worth sorting for so many rays of one point that are left, as some tell that do the work `in_tree` and go past so many
/// spheres.
fn is_worth_sorting(
    spheres: usize,
    left: usize,
    in_tree: f32,
    passed: impl FnOnce() -> f32,
) -> bool {
    // After so many rays there is another look, and perhaps another trial.
    let sorting = SORTING * spheres as f32 / left.min(MOST) as f32;
    let in_all = BESIDES + in_tree;
    in_all >= PARTS[0] * sorting || (in_all >= PARTS[1] * sorting && passed() <= in_tree)
}

/// Answers some rays from `from` on, by the list as long as that pays. Those just answered were so many, and each has done the work
/// `in_tree`. Returns the number of the first that is not answered.
#[inline(never)]
pub(super) fn answer<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from, count): (&ManyRays<'_>, usize, usize),
    (counted, mut in_tree): (usize, f32),
    packets: &mut [RayPacket],
    (answered, answers): (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) -> usize {
    let spheres = structure.list();
    // (Other tiers have false hits, of which a list finds others than a tree does.)
    if tier.spread() != 0.0 || spheres.len() > MOST_SPHERES {
        return from;
    }
    let Some((origin, left)) = common_origin(&rays.part(from, count)) else { return from };
    let counted = rays.part(from - counted, from);
    let passed = || passed::<Q>(origin, &counted, answered, &spheres);
    if left < FEWEST || !is_worth_sorting(spheres.len(), left, in_tree, passed) {
        return from;
    }
    let after = |from, packets| count.min(from + packets * RayPacket::COUNT);
    // If the list does not pay, the others may come in another order than these.
    let (mut to, learnt) = (from, trace.learnt);
    let mut memory = Vec::new();
    if lengthen(&mut memory, 0.0, DepthList::needed(spheres.len())).is_err() {
        return from;
    }
    let Ok(list) = DepthList::sort(spheres, Viewpoint::Origin(origin), &mut memory) else {
        return from;
    };

    let (mut at_once, mut windows, mut pays) = (TRIED, 0, PAYS);
    while to < count {
        let part = (rays, to, after(to, at_once));
        let (both, all) = ((structure, &list), (&mut *answered, &mut *answers));
        let in_list = by_list::<S, Q>(both, tier, trace, (part, in_tree), packets, all);
        (to, at_once, windows) = (part.2, PACKETS, windows + 1);
        let doubt = if windows % WINDOWS == 0 { LOOKED_INTO } else { IN_DOUBT };
        if in_list > doubt * in_tree && to < count {
            let part = (rays, to, after(to, TRIED));
            let all = (&mut *answered, &mut *answers);
            in_tree = by_tree::<S, Q>(structure, tier, trace, part, packets, all);
            to = part.2;
        }
        if windows == 1
            && in_list > PAYS_IF_SHUFFLED * in_tree
            && let Some(gain) = structure.gain_by_order::<Q>(trace)
            && gain.is_for(left)
            && RayKeys::of(&rays.part(to, count), gain).is_some()
        {
            pays = PAYS_IF_SHUFFLED;
        }
        if in_list > pays * in_tree {
            trace.learnt = learnt;
            break;
        }
    }
    to
}

/// Answers some rays by the tree; returns the work of one.
fn by_tree<S: Traverse + ?Sized, Q: LevelQuery>(
    structure: &S,
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    (rays, from, to): (&ManyRays<'_>, usize, usize),
    packets: &mut [RayPacket],
    all: (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) -> f32 {
    trace.learnt.count_work();
    answer_part::<S, Q>(structure, tier, trace, (rays, from, to), packets, all);
    trace.learnt.counted_work() / (to - from) as f32
}

/// Answers some rays by the list, and by the tree the packets that go too deep; returns the work of one ray, of which `in_tree` is done in
/// the tree.
fn by_list<S: Traverse + ?Sized, Q: LevelQuery>(
    (structure, list): (&S, &DepthList<'_>),
    tier: impl Accuracy,
    trace: &mut Trace<'_>,
    ((rays, from, to), in_tree): ((&ManyRays<'_>, usize, usize), f32),
    packets: &mut [RayPacket],
    (answered, answers): (&mut [Q::Packet<[f32; 16]>], &mut Q::Many<'_>),
) -> f32 {
    (trace.learnt.work, trace.learnt.unanswered) = (Some(0), Some(0));
    list.many_in_packets::<Q>(tier, trace, &rays.part(from, to), packets, answered);
    let mut unanswered = trace.learnt.unanswered.take().unwrap_or_default();
    let of_list = trace.learnt.work.take().unwrap_or_default() as f32;
    let of_tree = RayPacket::COUNT as f32 * unanswered.count_ones() as f32 * in_tree;
    // Those that follow each other by one call.
    while unanswered != 0 {
        let first = unanswered.trailing_zeros();
        let after = first + (unanswered >> first).trailing_ones();
        unanswered &= u64::MAX.checked_shl(after).unwrap_or_default();
        let run = first as usize..after as usize;
        if let (Some(packets), Some(answered)) = (packets.get(run.clone()), answered.get_mut(run)) {
            structure.in_packets::<Q>(tier, trace, packets, answered);
        }
    }
    Q::write_at(trace.level, answers, answered, from, to);
    (of_list + of_tree) / (to - from) as f32
}

/// Returns the point in which the first ray starts, and about how many rays from there on do so.
fn common_origin(rays: &ManyRays<'_>) -> Option<(Vec3, usize)> {
    let step = (rays.count().min(MOST) / LOOKED_AT) | 1;
    let mut some =
        (0..LOOKED_AT).filter_map(|number| Some((number * step, rays.ray(number * step)?)));
    let (_, first) = some.by_ref().find(|(_, ray)| ray.is_live())?;
    let other = some.find(|(_, ray)| ray.is_live() && ray.origin != first.origin);
    Some((first.origin, other.map_or(rays.count(), |(number, _)| number)))
}

/// Returns about how many spheres are nearer to the origin than what a ray hits, as some that were answered tell; infinitely many if hits
/// have no distance.
fn passed<Q: LevelQuery>(
    origin: Vec3,
    rays: &ManyRays<'_>,
    answered: &[Q::Packet<[f32; 16]>],
    spheres: &Spheres<'_>,
) -> f32 {
    if Q::ANY {
        return f32::INFINITY;
    }
    // One of each packet.
    let mut reaches = [0.0; REACHES_LOOKED_AT];
    for (number, (reach, answer)) in reaches.iter_mut().zip(answered).enumerate() {
        let lane = number % RayPacket::COUNT;
        if let Some(ray) = rays.ray(number * RayPacket::COUNT + lane) {
            *reach = Q::limit(answer, lane) * ray.direction.length();
        }
    }
    let step = spheres.len().div_ceil(SPHERES_LOOKED_AT).max(1);
    let (mut looked_at, mut passed) = (0, 0);
    for number in (0..spheres.len()).step_by(step) {
        let Some(sphere) = spheres.get(number) else { break };
        let depth = ((sphere.center - origin).length() - sphere.radius).abs();
        looked_at += REACHES_LOOKED_AT;
        passed += reaches.iter().filter(|reach| depth < **reach).count();
    }
    passed as f32 * spheres.len() as f32 / looked_at.max(1) as f32
}

#[cfg(all(test, proofs))]
mod tests;
