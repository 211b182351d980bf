//! What a trace learns of its rays from call to call: which of them pay together.

use super::packet_group::GROUP;
use super::patience::{PacketPatience, Patience};
#[cfg(feature = "alloc")]
use super::ray_order::{GainByOrder, is_far};
#[cfg(feature = "alloc")]
use crate::bvh::traverse::small_tree;
use crate::bvh::traverse::stream::Sharing;
#[cfg(feature = "alloc")]
use crate::bvh::tree::Bvh;
#[cfg(feature = "alloc")]
use crate::coherence::Coherence;
use crate::query::Query;
use core::ops::Range;

/// Closest hits and any hits learn separately, except where memory is short: there a trace that a firmware copies by a function is
/// 900 bytes of flash.
pub(super) const KINDS: usize = if cfg!(feature = "alloc") { 2 } else { 1 };

/// Returns the kind of query: a place in what is learnt.
#[inline(always)]
pub(super) fn kind_of<Q: Query>() -> usize {
    usize::from(Q::ANY && KINDS == 2)
}

/// What is learnt of rays as they come: which of them pay together.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(not(feature = "std"), expect(unreachable_pub, reason = "a trait of levels names it"))]
pub struct Learnt {
    pub(super) groups: [Patience; KINDS],
    pub(super) packets: [PacketPatience; KINDS],
    pub(super) sharing: [Sharing; KINDS],
    /// How many of the last packets went by themselves, and how many packets there were.
    #[cfg(feature = "alloc")]
    pub(crate) apart: [usize; 2],
    /// Of groups on trial: what they did, and what their rays would have done apart. `None` if they are not on trial.
    #[cfg(feature = "alloc")]
    pub(crate) efforts: Option<[u64; 2]>,
    /// What rays do by themselves, and in a depth list, in steps as of groups. `None` if it is not counted.
    #[cfg(feature = "std")]
    pub(crate) work: Option<u64>,
    /// Of up to 64 packets those that a depth list has not answered, a bit each. `None` if it tests these against all spheres.
    #[cfg(feature = "std")]
    pub(crate) unanswered: Option<u64>,
}

impl Learnt {
    /// Nothing.
    pub(crate) const NOTHING: Self = Self {
        groups: [Patience::NEW; KINDS],
        packets: [PacketPatience::NEW; KINDS],
        sharing: [Sharing::NOTHING; KINDS],
        #[cfg(feature = "alloc")]
        apart: [0; 2],
        #[cfg(feature = "alloc")]
        efforts: None,
        #[cfg(feature = "std")]
        work: None,
        #[cfg(feature = "std")]
        unanswered: None,
    };
    /// Nothing, for groups on trial.
    #[cfg(feature = "alloc")]
    pub(crate) const ON_TRIAL: Self = Self { efforts: Some([0; 2]), ..Self::NOTHING };

    /// Begins a call of so many packets.
    #[inline(always)]
    pub(crate) fn begin_call<Q: Query>(&mut self, packets: usize) {
        let (kind, groups) = (kind_of::<Q>(), packets.div_ceil(GROUP));
        self.groups[kind].begin(groups);
        self.packets[kind].begin(groups);
    }

    /// Counts the work of the next packets.
    #[cfg(feature = "std")]
    pub(crate) fn count_work(&mut self) {
        (self.efforts, self.work) = (Some([0; 2]), Some(0));
    }

    /// Returns the work of these packets.
    #[cfg(feature = "std")]
    pub(crate) fn counted_work(&mut self) -> f32 {
        let [of_groups, _] = self.efforts.take().unwrap_or_default();
        (of_groups + self.work.take().unwrap_or_default()) as f32
    }

    /// Counts what rays did by themselves, or in a depth list.
    #[inline(always)]
    pub(super) fn add_work(&mut self, work: u64) {
        #[cfg(feature = "std")]
        if let Some(counted) = &mut self.work {
            *counted = counted.wrapping_add(work);
        }
        let _ = work;
    }

    /// Returns whether packets that a depth list does not answer are left to the caller; if so, notes these.
    #[inline(always)]
    pub(super) fn are_left(&mut self, packets: Range<usize>) -> bool {
        #[cfg(feature = "std")]
        if let Some(unanswered) = &mut self.unanswered {
            for packet in packets {
                *unanswered |= 1 << (packet % u64::BITS as usize);
            }
            return true;
        }
        let _ = packets;
        false
    }

    /// Returns how many of the next `rays` a call should take at once, if some of them go by themselves and a stream of those may
    /// pay; `None` if not.
    #[cfg(feature = "alloc")]
    pub(crate) fn many_at_once<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> Option<usize> {
        if !self.are_some_apart() || !self.sharing[kind_of::<Q>()].may_pay::<Q>(bvh, rays) {
            return None;
        }
        // Some of them may go together as groups, so these are twice as many as a stream takes.
        Some(rays.min(2 * Sharing::together(rays)))
    }

    /// Returns what the next rays would gain by another order; `None` if nothing.
    #[cfg(feature = "alloc")]
    pub(crate) fn gain_by_order<Q: Query>(
        &self,
        bvh: &Bvh<'_>,
        coherence: Coherence,
    ) -> Option<GainByOrder> {
        if !self.are_some_apart() || small_tree::leaf_count(bvh).is_some() {
            return None;
        }
        let (in_groups, is_far) = (coherence != Coherence::Incoherent, is_far(bvh));
        Some(GainByOrder { in_groups, is_far, is_any: Q::ANY, radius: bvh.radius() })
    }

    /// Returns whether some of the last packets went by themselves.
    #[cfg(feature = "alloc")]
    fn are_some_apart(&self) -> bool {
        let [apart, all] = self.apart;
        SOME * apart >= all && all > 0
    }
}

/// One packet in so many counts as some.
#[cfg(feature = "alloc")]
const SOME: usize = 4;
