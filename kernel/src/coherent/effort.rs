//! What a group has done, and what its rays would have done apart: when it gives up.
//!
//! # Method
//!
//! A group pays as long as its rays meet the same boxes: one test of a box serves them all. Whether they do depends on
//! the rays and on the scene, and is not known before. So a group's work is counted as it is done, and held against what
//! its rays would have done apart, as far as they have come:
//!
//! * for what a ray does by itself before it can know anything, no group is asked;
//! * each ray that came near a sphere would have met it;
//! * of the rays, a part enters each box that the group looks into: once that much is done, every eighth box is held
//!   against every ray.
//!
//! A group that has done more than its rays would have done gives up. So does one that holds many spheres against the rays
//! of packets which come near few of them: its packets are too wide, and that is seen after some leaves. The rays go on by
//! themselves, with what they have hit.
//!
//! Work is counted in steps of some 5 ns, fitted to the times of 243 scenes and orders of rays on a Zen 3 (AVX2), groups
//! and rays by themselves: a sixth off in the mean.

use super::packet_state::PacketState;
use crate::bvh::node::{BvhNode, LEAF as IS_LEAF, WIDTH};
use crate::bvh::traverse::boxes::enter_about;
use crate::lanes::{LaneMask, Lanes};

/// What a group does: a node, a leaf, a leaf against a packet's planes, a sphere against a packet's rays, and the roots of
/// one that any of them comes near.
const NODE: u32 = 16;
const LEAF: u32 = 3;
const PACKET: u32 = 5;
const SPHERE: u32 = 2;
const ROOTS: u32 = 16;
/// What a ray does by itself: its beginning, its end and some boxes; a node, a leaf, and the roots of spheres that it
/// comes near. (With half as many boxes for free, a tenth of the groups gave up that take 0.5 to 0.7 of the time.)
const RAY: u32 = 32;
const RAY_NODE: u32 = 5;
const RAY_LEAF: u32 = 6;
const RAY_ROOTS: u32 = 16;
/// So many spheres may be held against packets for each that a ray comes near, and for each ray: of groups that pay two
/// to six a sphere that is near, of those that are too wide fifty and more.
const SPHERES_A_ROOT: u32 = 8;
const SPHERES_IN_VAIN: u32 = 2;
/// One box in so many is a sample.
const STRIDE: u32 = 8;

/// What a group has done.
pub(super) struct Effort {
    rays: u32,
    /// Without roots.
    work: u32,
    /// Spheres that were held against packets, and how many may have been before it is asked whether that was in vain.
    spheres: u32,
    most_spheres: u32,
    /// What its rays would have done in boxes since then.
    apart: u32,
    /// Boxes until the next sample.
    until: u32,
}

impl Effort {
    /// Of a group that has done nothing.
    #[inline(always)]
    pub(super) fn of<L: Lanes>(states: &[PacketState<'_, L>]) -> Self {
        let mut rays = 0;
        for state in states {
            rays += state.live.bits().count_ones();
        }
        let most_spheres = SPHERES_IN_VAIN * rays;
        Self { rays, work: 0, spheres: 0, most_spheres, apart: 0, until: 0 }
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
        if self.spheres > self.most_spheres {
            return true;
        }
        if self.work <= RAY * self.rays {
            return false;
        }
        let samples = self.until == 0;
        self.until = if samples { STRIDE - 1 } else { self.until - 1 };
        samples
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
        let (mut rays, mut roots, mut ray_roots) = (0_u32, 0_u32, 0_u32);
        for state in states {
            let enter = state.live & enter_about(&state.rays, state.best, node, slot);
            rays += enter.bits().count_ones();
            roots = roots.wrapping_add(state.spheres_near);
            ray_roots = ray_roots.wrapping_add(state.rays_near);
        }
        self.most_spheres =
            SPHERES_A_ROOT.saturating_mul(roots).saturating_add(SPHERES_IN_VAIN * self.rays);
        if self.spheres > self.most_spheres {
            return true;
        }
        let is_leaf = node.child[slot % WIDTH] & IS_LEAF != 0;
        let each = STRIDE * if is_leaf { RAY_LEAF } else { RAY_NODE };
        self.apart = self.apart.wrapping_add(each * rays);
        let work = u64::from(self.work) + u64::from(ROOTS) * u64::from(roots);
        let apart = u64::from(self.apart) + u64::from(RAY_ROOTS) * u64::from(ray_roots);
        // Half as much again, since rays that go on by themselves begin anew.
        2 * work > 3 * (apart + u64::from(RAY * self.rays))
    }
}

/// Which groups are tried: after each that does not pay twice as many are passed over, up to a number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// So many are still passed over, of so many.
    wait: u32,
    gap: u32,
}

/// The most that are passed over.
const LONGEST: u32 = 31;

impl Patience {
    pub(crate) const NEW: Self = Self { wait: 0, gap: 0 };

    /// Whether the next is tried.
    #[inline(always)]
    pub(super) fn tries(&mut self) -> bool {
        let tries = self.wait == 0;
        self.wait = self.wait.saturating_sub(1);
        tries
    }

    /// Takes what became of one that was tried.
    #[inline(always)]
    pub(super) fn take(&mut self, paid: bool) {
        self.gap = if paid { 0 } else { (2 * self.gap + 1).min(LONGEST) };
        self.wait = self.gap;
    }
}
