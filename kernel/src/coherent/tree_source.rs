//! The packets of a call through the tree: which go down together, and which ray by ray.
//!
//! # Method
//!
//! Packets are tried in groups of four (`tree_group.rs`), since a group that looks the same way does the work of one
//! ray for all of its rays. A group that does not fit, or gives up since it does not pay, is tried packet by packet. The rays
//! that are left go by themselves (`bvh/traverse/wavefront.rs`), with what their group has learnt, in runs that are as
//! long as can be; or, with memory for it, as a stream. Where tries do not pay, few are made (`patience.rs`): rays that
//! have nothing in common hardly pay for a try.

#[cfg(feature = "std")]
use super::giving_up::work_apart;
use super::learnt::{Learnt, kind_of};
use super::packet_source::PacketSource;
use super::patience::{LONGEST, LONGEST_IF_COHERENT, SHORTEST, SHORTEST_IN_SMALL_TREE};
use super::together::{Apart, Together};
use super::tree_group::Boxes;
use crate::Accuracy;
use crate::bvh::traverse::packet_set::{PacketSet, RUN};
use crate::bvh::traverse::small_tree;
#[cfg(feature = "alloc")]
use crate::bvh::traverse::stream::KeptMemory;
use crate::bvh::traverse::stream::{self, StreamMemory};
use crate::bvh::traverse::wavefront;
use crate::bvh::tree::Bvh;
use crate::coherence::Coherence;
use crate::filter::block::FilterBlock;
use crate::geometry::sphere_run::SphereRun;
use crate::lanes::Lanes;
use crate::linear;
use crate::query::Query;

/// What a caller says of the rays, memory for streams, and what is learnt of rays.
#[derive(Debug)]
#[cfg_attr(not(feature = "std"), expect(unreachable_pub, reason = "a trait of levels names it"))]
pub struct Ways<'a> {
    pub(crate) coherence: Coherence,
    /// Memory of the caller's.
    pub(crate) lent: Option<StreamMemory<'a>>,
    /// Memory that is taken if none is lent.
    #[cfg(feature = "alloc")]
    pub(crate) kept: &'a mut KeptMemory,
    pub(crate) learnt: &'a mut Learnt,
    #[cfg(feature = "std")]
    pub(crate) alone: Option<Alone<'a>>,
}

/// Of up to 64 packets those that do not go together, a bit each: left to the caller, if there are at most `most`.
#[derive(Debug)]
#[cfg(feature = "std")]
#[expect(unreachable_pub, reason = "a field of a public type has it")]
pub struct Alone<'a> {
    pub(crate) packets: &'a mut u64,
    pub(crate) most: usize,
}

impl Ways<'_> {
    /// Returns memory for streams of so many rays that go by themselves; rays that are said to be incoherent get only lent memory, and
    /// rays whose work is counted none.
    #[inline(always)]
    fn memory<Q: Query>(&mut self, bvh: &Bvh<'_>, rays: usize) -> Option<StreamMemory<'_>> {
        // (What a stream does is not counted.)
        #[cfg(feature = "std")]
        if self.learnt.work.is_some() {
            return None;
        }
        #[cfg(feature = "alloc")]
        if self.lent.is_none() && self.coherence != Coherence::Incoherent {
            let sharing = &self.learnt.sharing[kind_of::<Q>()];
            return self.kept.lend::<Q>(bvh, sharing, rays);
        }
        let _ = (bvh, rays, Q::ANY);
        self.lent.as_mut().map(StreamMemory::again)
    }
}

/// How many packets of a tree that is listed are made at a time: they are still in the nearest cache when they are answered. (With 16, one
/// sphere ran at 0.97 of the speed.)
const LISTED_PACKETS: usize = 4;

/// Answers every ray: incoherent rays one by one, others in the groups and packets that pay.
#[inline(always)]
pub(crate) fn traverse<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    bvh: &Bvh<'_>,
    mut ways: Ways<'_>,
    mut source: PacketSource<'_, L::Array>,
    answers: &mut [Q::Packet<L::Array>],
) {
    let count = source.count().min(answers.len());
    let (coherence, is_listed) = (ways.coherence, small_tree::is_listed(bvh));
    // Spheres that no bound sees are tested first, for all packets: all begin with these hits.
    // (Tiles are then made once more below: such spheres are rare, and whether tiles are whole is known only as they are made.)
    let is_met_first = is_listed | !bvh.outside.is_empty();
    if coherence == Coherence::Incoherent && !is_listed {
        source.make::<L>(token, 0..count);
    }
    if is_met_first {
        let outside = bvh.outside();
        let spheres: &dyn SphereRun = if is_listed { &bvh.spheres } else { &outside };
        let at_once = if is_listed { LISTED_PACKETS } else { count.max(1) };
        let (source, answers) = (&mut source, answers.get_mut(..count).unwrap_or_default());
        // Out of line: the block of spheres takes 2 KiB of stack, which a traversal need not have.
        L::out_of_line(
            token,
            #[inline(always)]
            || meet::<L, Q>(tier, token, spheres, (source, at_once), answers),
        );
    }
    if is_listed {
        return;
    }

    let is_coherent = coherence == Coherence::Coherent;
    let is_small = small_tree::leaf_count(bvh).is_some();
    let gaps = [
        if is_small { SHORTEST_IN_SMALL_TREE } else { SHORTEST },
        if is_coherent { LONGEST_IF_COHERENT } else { LONGEST },
    ];
    #[cfg(feature = "alloc")]
    let mut boxes = Boxes::new(ways.learnt.efforts);
    #[cfg(not(feature = "alloc"))]
    let mut boxes = Boxes::new(None);
    // Packets from `from` on are not answered; those before `run` go ray by ray, and nothing is known of them.
    let (mut from, mut run) = (0, 0);
    #[cfg(feature = "alloc")]
    {
        ways.learnt.apart = [0, count];
    }
    while from < count {
        let mut apart = Apart { packets: PacketSet::EMPTY, are_all: true };
        let mut end = count;
        if coherence != Coherence::Incoherent {
            end = count.min(run + RUN);
            let at = run..end;
            let mut together = Together { boxes: &mut boxes, learnt: &mut *ways.learnt, gaps };
            together.answer::<L, Q>(tier, token, bvh, (&mut source, at), answers, &mut apart);
            #[cfg(feature = "alloc")]
            {
                ways.learnt.efforts = boxes.efforts;
            }
        }
        if apart.are_all && end < count {
            run = end;
            continue;
        }
        let whole = if apart.are_all { end } else { run };
        #[cfg(feature = "std")]
        let left = whole - from + if apart.are_all { 0 } else { apart.packets.count() };
        #[cfg(feature = "std")]
        if let Some(alone) = &mut ways.alone
            && left <= alone.most
        {
            for number in from..end {
                let is_alone = number < whole || apart.packets.contains(number - run);
                *alone.packets |= u64::from(is_alone) << (number % 64);
            }
            // What `answers` held before is no answer.
            if coherence == Coherence::Incoherent
                && bvh.outside.is_empty()
                && let Some(answers) = answers.get_mut(from..end)
            {
                answers.fill(Q::none::<L::Array>());
            }
            ways.learnt.apart[0] += left;
            (from, run) = (end, end);
            continue;
        }
        // One call, since each call is compiled anew.
        let runs = [(from, whole, None), (whole, end, Some(&apart.packets))];
        for number in 0..runs.len() {
            let (from, to, waiting) = runs[number];
            if let Some(answers) = answers.get_mut(from..to)
                && from < to
                && !waiting.is_some_and(PacketSet::is_empty)
            {
                let rays = (source.packets(from..to), waiting);
                #[cfg(feature = "alloc")]
                let packets = waiting.map_or(to - from, PacketSet::count);
                #[cfg(feature = "alloc")]
                {
                    ways.learnt.apart[0] += packets;
                }
                let kind = kind_of::<Q>();
                let mut sharing = ways.learnt.sharing[kind];
                // (Without the packets that groups have answered: calls of 2,048 rays take 0.723 of the work of ray by ray, not 0.719.)
                match &mut ways.memory::<Q>(bvh, L::COUNT * (to - from)) {
                    Some(memory) => {
                        let how = (memory, &mut sharing);
                        stream::traverse::<L, Q>(tier, token, bvh, how, rays, answers);
                    }
                    None => {
                        sharing.pass_over(L::COUNT * (to - from));
                        let entered = wavefront::traverse::<L, Q>(tier, token, bvh, rays, answers);
                        #[cfg(feature = "std")]
                        ways.learnt.add_work(work_apart(bvh, L::COUNT * packets, entered.boxes));
                        #[cfg(not(feature = "std"))]
                        let _ = entered;
                    }
                }
                ways.learnt.sharing[kind] = sharing;
            }
        }
        (from, run) = (end, end);
    }
}

/// Answers every ray by some spheres alone, so many packets at a time.
#[inline(always)]
fn meet<L: Lanes, Q: Query>(
    tier: impl Accuracy,
    token: L::Token,
    spheres: &dyn SphereRun,
    (source, at_once): (&mut PacketSource<'_, L::Array>, usize),
    answers: &mut [Q::Packet<L::Array>],
) {
    // A ray by itself pays for no block.
    if linear::goes_ray_by_ray::<L>(answers.len()) {
        let all = 0..answers.len();
        source.make::<L>(token, all.clone());
        return linear::traverse_some::<L, Q>(tier, token, spheres, source.packets(all), answers);
    }
    let (mut block, mut from) = (FilterBlock::empty(), 0);
    while from < answers.len() {
        let to = answers.len().min(from + at_once);
        source.make::<L>(token, from..to);
        if let Some(answers) = answers.get_mut(from..to) {
            for answer in answers.iter_mut() {
                *answer = Q::none::<L::Array>();
            }
            let (rays, spheres) = (source.packets(from..to), (spheres, &mut block));
            linear::meet_filtered::<L, Q, _>(tier, token, spheres, rays, answers);
        }
        from = to;
    }
}

#[cfg(all(test, proofs))]
mod tests {
    use crate::proofs::work::{Kind, Work};
    use crate::{Exact, HitPacket, Intersect, Ray, RayPacket, SphereTree, Trace, Vec3};

    /// To prepare the filter takes longer than to test a ray.
    #[test]
    fn a_ray_in_one_lane_prepares_no_filter() {
        let tree = SphereTree::new([[0.0, 0.0, 5.0, 1.0], [0.0, 0.0, 9.0, 1.0]]);
        let packet = [RayPacket::<[f32; 1]>::new(&[Ray::new(Vec3::ZERO, Vec3::Z)])];
        let mut hits = [HitPacket::<[f32; 1]>::none()];
        let work = Work::of(|| {
            tree.closest_hit_lanes::<f32>(Exact, (), &mut Trace::new(), &packet, &mut hits);
        });
        assert_eq!((work.count(Kind::ListGroup), hits[0].t), (0, [4.0]));
    }
}
