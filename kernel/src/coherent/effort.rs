//! What a group has done, and what its rays would have done apart: when it gives up.
//!
//! # Method
//!
//! A group pays as long as its rays meet the same boxes: one test of a box serves them all. Whether they do depends on
//! the rays and on the scene, and is not known before. So a group's work is counted as it is done, and held against what
//! its rays would have done apart, as far as they have come:
//!
//! * each ray would have begun and ended by itself;
//! * each ray that came near a sphere would have met one;
//! * of the rays, a part enters each box that the group looks into. The part is sampled: some boxes are held against the
//!   rays of one packet. In a small tree all rays look into all of them.
//!
//! A group that has done more gives up. So does one that holds many spheres against the rays of packets
//! which come near few of them: its packets are too wide, and that is seen after some leaves. The rays go on by
//! themselves, with what they have hit.
//!
//! Work is counted in steps of some 5 ns on a Zen 3 (AVX2). The weights start from a fit to the times of 243 scenes and
//! orders of rays, groups and rays by themselves, which was a sixth off in the mean; then they were set so that groups which
//! pay seldom give up.

use super::packet_state::PacketState;
use crate::bvh::node::{BvhNode, LEAF as IS_LEAF, WIDTH};
use crate::bvh::traverse::boxes::enter_about;
use crate::lanes::{LaneMask, Lanes};

/// What a group does: a node, a leaf, a leaf against a packet's planes, a sphere against a packet's rays, and the roots of
/// one that any of them comes near; and the tier, where two may be closest.
const NODE: u32 = 16;
const LEAF: u32 = 3;
const PACKET: u32 = 5;
const SPHERE: u32 = 2;
const ROOTS: u32 = 16;
const TIER: u32 = 30;
/// What a ray does by itself: its beginning and its end, a node, a leaf, and the roots of spheres that it comes near.
const RAY: u32 = 7;
const RAY_NODE: u32 = 5;
const RAY_LEAF: u32 = 6;
const RAY_ROOTS: u32 = 16;
/// The same in a small tree, where rays have no boxes, and seldom look for roots before the tier does.
const RAY_OF_SMALL_TREE: u32 = 2;
const LEAF_OF_SMALL_TREE: u32 = 1;
const ROOTS_OF_SMALL_TREE: u32 = 2;
/// What it takes to lay planes around a group: not much but in a small tree.
const FIT: u32 = 24;
/// So many spheres may be held against packets for each that a ray comes near, and for each ray: of groups that pay two
/// to six a sphere that is near, of those that are too wide fifty and more.
const SPHERES_A_ROOT: u32 = 5;
const SPHERES_IN_VAIN: u32 = 1;
/// So many times the tier may test spheres of which one is a ray's closest, for a packet: it takes fifty times as long as
/// to hold one against a ray. (Of groups that pay a packet has one at most in most scenes.)
pub(super) const MOST_TESTS: u32 = 4;
/// One box in so many is a sample, in the end: the second, the fourth, the eighth, and so on.
const STRIDE: u32 = 8;

/// What a group has done.
pub(super) struct Effort {
    rays: u32,
    /// Whether the tree is small: then rays have a way of their own through it.
    is_small_tree: bool,
    /// Without roots.
    work: u32,
    /// Spheres that were held against packets, and how many may have been before it is asked whether that was in vain.
    spheres: u32,
    most_spheres: u32,
    /// What its rays would have done in boxes; all look into the root.
    apart: u32,
    /// Boxes until the next sample, how many it stands for, and the packet that it is of.
    until: u32,
    stride: u32,
    packet: usize,
}

impl Effort {
    /// Of a group that has done nothing, in a tree of so many leaves, if it is small.
    #[inline(always)]
    pub(super) fn of<L: Lanes>(states: &[PacketState<'_, L>], leaves: Option<u32>) -> Self {
        let rays = live_rays(states);
        let most_spheres = SPHERES_IN_VAIN * rays;
        Self {
            rays,
            is_small_tree: leaves.is_some(),
            work: 0,
            spheres: 0,
            most_spheres,
            apart: rays * leaves.map_or(RAY_NODE, |leaves| LEAF_OF_SMALL_TREE * leaves),
            until: if leaves.is_some() { u32::MAX } else { 1 },
            stride: 2,
            packet: 0,
        }
    }

    /// Counts a node that was looked into.
    #[inline(always)]
    pub(super) fn node(&mut self) {
        self.work = self.work.wrapping_add(NODE);
    }

    /// Counts a leaf that was looked into.
    #[inline(always)]
    pub(super) fn leaf(&mut self) {
        self.work = self.work.wrapping_add(LEAF);
    }

    /// Counts a leaf against the planes of a packet, which left in so many spheres.
    #[inline(always)]
    pub(super) fn spheres(&mut self, places: u32) {
        self.work = self.work.wrapping_add(PACKET + SPHERE * places.count_ones());
        self.spheres = self.spheres.wrapping_add(places.count_ones());
    }

    /// Whether the next box is a sample.
    #[inline(always)]
    pub(super) fn samples(&mut self) -> bool {
        self.until = self.until.saturating_sub(1);
        (self.until == 0) | (self.spheres > self.most_spheres)
    }

    /// Whether the rays would have done less apart, as far as they have come: to the box in that slot of a node, which
    /// is a sample.
    #[inline(always)]
    pub(super) fn is_wasted<L: Lanes>(
        &mut self,
        states: &[PacketState<'_, L>],
        node: &BvhNode,
        slot: usize,
    ) -> bool {
        #[cfg(all(test, proofs))]
        if crate::proofs::work::groups_persist() {
            return false;
        }
        let mut roots = 0_u32;
        for state in states {
            roots = roots.wrapping_add(state.spheres_near);
        }
        let in_vain = SPHERES_IN_VAIN * self.rays;
        self.most_spheres = SPHERES_A_ROOT.saturating_mul(roots).saturating_add(in_vain);
        if self.spheres > self.most_spheres {
            return true;
        }

        let Some(state) = states.get(self.packet) else { return false };
        self.packet = if self.packet + 1 < states.len() { self.packet + 1 } else { 0 };
        let enter = state.live & enter_about(&state.rays, state.best, node, slot);
        let is_leaf = node.child[slot % WIDTH] & IS_LEAF != 0;
        let each = self.stride * states.len() as u32 * if is_leaf { RAY_LEAF } else { RAY_NODE };
        self.apart = self.apart.wrapping_add(each * enter.bits().count_ones());
        self.until = self.stride;
        self.stride = (2 * self.stride).min(STRIDE);

        // A quarter more, since rays that go on by themselves begin anew.
        self.takes(states, 4, 5)
    }

    /// Whether all that it has done is so much more that the next is better not tried. (What a small tree costs is known;
    /// of others half of the rays' own work may not have been seen.)
    #[inline(always)]
    pub(super) fn is_at_a_loss<L: Lanes>(&mut self, states: &[PacketState<'_, L>]) -> bool {
        if self.is_small_tree {
            self.work = self.work.wrapping_add(FIT);
            return self.takes(states, 10, 7);
        }
        self.takes(states, 1, 2)
    }

    /// Whether what it has done is more than a multiple of what its rays would have done apart.
    #[inline(always)]
    fn takes<L: Lanes>(&self, states: &[PacketState<'_, L>], part: u64, of: u64) -> bool {
        #[cfg(all(test, proofs))]
        if crate::proofs::work::groups_persist() {
            return false;
        }
        let (mut roots, mut ray_roots, mut tests) = (0_u32, 0_u32, 0_u32);
        for state in states {
            tests = tests.wrapping_add(state.tests);
            roots = roots.wrapping_add(state.spheres_near);
            ray_roots = ray_roots.wrapping_add(state.rays_near);
        }
        let work = u64::from(self.work)
            + u64::from(ROOTS) * u64::from(roots)
            + u64::from(TIER) * u64::from(tests);
        // By itself a ray meets what is nearest first, and few others.
        let [ray, ray_root] = if self.is_small_tree {
            [RAY_OF_SMALL_TREE, ROOTS_OF_SMALL_TREE]
        } else {
            [RAY, RAY_ROOTS]
        };
        let apart = ray * self.rays + ray_root * ray_roots.min(self.rays);
        part * work > of * (u64::from(apart) + u64::from(self.apart))
    }
}

/// How many rays of a group can hit anything.
#[inline(always)]
pub(super) fn live_rays<L: Lanes>(states: &[PacketState<'_, L>]) -> u32 {
    let mut rays = 0;
    for state in states {
        rays += state.live.bits().count_ones();
    }
    rays
}

/// Fewer rays go by themselves: to lay planes around a group takes as long as some of them do.
pub(super) const LEAST_RAYS: u32 = 12;

/// Which groups are tried: after each that does not pay twice as many are passed over, up to a number. The next call may
/// have other rays (a path tracer's camera, then bounces), so it begins with a try, where that costs little.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// So many are still passed over, of so many.
    wait: u32,
    gap: u32,
    /// Whether one has done work in vain since the last that paid. What does not fit has done none.
    is_costly: bool,
}

/// Of so many groups one is tried, whatever was before. (Rays to a light among 20,000 spheres, in calls of one group that each began
/// with a try, took 1.35 times as long on a Zen 3.)
const WORTH_A_TRY: usize = 8;

/// The most that are passed over, and the most where rays are said to be coherent.
pub(super) const LONGEST: u32 = 31;
pub(super) const LONGEST_IF_COHERENT: u32 = 3;

impl Patience {
    pub(crate) const NEW: Self = Self { wait: 0, gap: 0, is_costly: false };

    /// Begins a call of so many groups.
    #[inline(always)]
    pub(super) fn begin(&mut self, groups: usize) {
        if !self.is_costly | (groups >= WORTH_A_TRY) {
            self.wait = 0;
        }
    }

    /// Whether the next is tried.
    #[inline(always)]
    pub(super) fn tries(&mut self) -> bool {
        let tries = self.wait == 0;
        self.wait = self.wait.saturating_sub(1);
        tries
    }

    /// Takes what became of one that was tried: whether it paid, or did work in vain; at most `most` are passed over then.
    #[inline(always)]
    pub(super) fn take(&mut self, (paid, in_vain): (bool, bool), most: u32) {
        self.gap = if paid { 0 } else { (2 * self.gap + 1).min(most) };
        self.is_costly = !paid & (self.is_costly | in_vain);
        self.wait = self.gap;
    }
}
