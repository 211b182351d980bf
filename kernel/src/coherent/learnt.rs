//! What a trace learns of its rays from call to call: which of them pay together.

use super::packet_group::GROUP;
use super::patience::{PacketPatience, Patience};
#[cfg(feature = "alloc")]
use crate::bvh::traverse::stream::MOST_SORTED;
use crate::bvh::traverse::stream::Sharing;
#[cfg(feature = "alloc")]
use crate::bvh::tree::Bvh;
use crate::query::Query;

/// Closest hits and any hits learn apart. Together where memory is short: a trace that a firmware copies by a function is
/// 900 bytes of flash.
pub(super) const KINDS: usize = if cfg!(feature = "alloc") { 2 } else { 1 };

/// Which kind of query it is: a place in what is learnt.
#[inline(always)]
pub(super) fn kind_of<Q: Query>() -> usize {
    usize::from(Q::ANY) % KINDS
}

/// What is learnt of rays as they come: which of them pay together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Learnt {
    pub(super) groups: [Patience; KINDS],
    pub(super) packets: [PacketPatience; KINDS],
    pub(super) sharing: [Sharing; KINDS],
    /// Of the last packets how many went by themselves, and how many they were.
    #[cfg(feature = "alloc")]
    pub(super) apart: [usize; 2],
}

impl Learnt {
    /// Nothing.
    pub(crate) const NOTHING: Self = Self {
        groups: [Patience::NEW; KINDS],
        packets: [PacketPatience::NEW; KINDS],
        sharing: [Sharing::NOTHING; KINDS],
        #[cfg(feature = "alloc")]
        apart: [0; 2],
    };

    /// Begins a call of so many packets.
    #[inline(always)]
    pub(crate) fn begin_call<Q: Query>(&mut self, packets: usize) {
        let (kind, groups) = (kind_of::<Q>(), packets.div_ceil(GROUP));
        self.groups[kind].begin(groups);
        self.packets[kind].begin(groups);
    }

    /// How many of the next rays, of which there are so many, a call likes to have at once: more than few where some go by
    /// themselves, and a stream of them may pay.
    #[cfg(feature = "alloc")]
    pub(crate) fn many_at_once<Q: Query>(&self, bvh: &Bvh<'_>, rays: usize) -> Option<usize> {
        let [apart, all] = self.apart;
        let sharing = &self.sharing[kind_of::<Q>()];
        if SOME * apart < all || all == 0 || !sharing.may_pay::<Q>(bvh, rays) {
            return None;
        }
        let sorts = sharing.may_sort::<Q>(bvh, rays);
        // Of those some may go together as groups: twice as many as go down as a stream.
        let together = 2 * Sharing::together(rays);
        Some(rays.min(if sorts { MOST_SORTED } else { together }))
    }
}

/// One in so many is some.
#[cfg(feature = "alloc")]
const SOME: usize = 4;
