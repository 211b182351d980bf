//! When a group gives up: what its rays would have done apart.
//!
//! # Method
//!
//! A group pays as long as its rays meet the same boxes: one test of a box serves them all. Whether they do depends on
//! the rays and on the scene, and is not known before. So a group's work is counted as it is done, and held against what
//! its rays would have done apart, as far as they have come:
//!
//! * each ray would have begun and ended by itself, and looked into the root;
//! * each ray that has hit a sphere would have come near one, and of closest hits near others, which take less;
//! * of the rays, a part enters each box that the group looks into. The part is sampled: some of the boxes are kept, evenly
//!   spaced, and held against the rays of some packets. In a small tree all rays look into all of them.
//!
//! A group that has done a quarter more than what is known of that, and so much more than what is guessed ([`OF_CLOSEST`], [`OF_ANY`]),
//! gives up, and its rays go on by themselves, with what they have hit. One that has answered all of its rays, but by more work than they
//! would have done apart, counts as one that has not paid.
//!
//! What the rays would have done apart only grows. So the sample is looked at when a group has done more than they would
//! have done by then at least, and once more when it has done more than was found: most groups that pay are never asked.
//! (Each eighth box was held against rays as it was met: 5 to 9 % of the time of a camera's rays.)
//!
//! Work is counted as by [`Effort`]; of what rays do by themselves the weights are set so that groups which pay seldom give up.

use super::box_sample::BoxSample;
use super::effort::Effort;
use super::packet_state::PacketState;
use crate::bvh::tree::Bvh;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;

/// What a ray does by itself: its beginning and its end, a node, a leaf, the roots of the first sphere that it comes near, those of
/// the next, which share a leaf, and the tier. (With rays that came near a sphere in place of those that hit one, and 20
/// for the first roots, the search finds calls that take 5.9 times the work of ray by ray, in place of 2.2. With boxes twice
/// as long where the tree is far, since rays wait for memory there: a picture of 128 by 128 of u1m 1.02 to 1.07 of the speed, of 64 by
/// 64 0.6, since its groups did not give up.)
const RAY: u32 = 4;
const RAY_NODE: u32 = 5;
const RAY_LEAF: u32 = 6;
const RAY_ROOTS: u32 = 12;
const RAY_NEXT_ROOTS: u32 = 1;
const RAY_TIER: u32 = 3;
/// The same in a small tree, where rays have no boxes, and seldom look for roots before the tier does.
const RAY_OF_SMALL_TREE: u32 = 2;
const LEAF_OF_SMALL_TREE: u32 = 1;
const ROOTS_OF_SMALL_TREE: u32 = 2;
/// What it takes to lay planes around a group: not much but in a small tree.
const FIT: u32 = 24;

/// Of what rays do apart about, in eighths: a group may do so much, and so much while it holds many spheres against rays in vain.
type Eighths = [u64; 2];
/// Of closest hits: of a group, and of a packet that is tried alone. (What a group that gives up has done is lost, and what is left
/// of it is often less than its rays do from the root. All 12 and 9: closest hits of six scenes, nine orders, AVX-512, 0.95 of the
/// speed; 28 and 30: as fast, and the search finds 3.4 times the work where rays are falsely said to be coherent.)
const OF_CLOSEST: Eighths = [20, 22];
const OF_CLOSEST_ALONE: Eighths = [16, 14];
/// Of any hit: by themselves rays end in fewer boxes than those that a group looks into. In vain less is allowed as long as the group
/// before it has not paid. (9 then, AVX2: any hits of 512 rays of a long lens, shuffled, among nested spheres 0.61 of ray by ray, in
/// place of 0.81. 4: 0.92, but bursts of 1,000 there 1.01, in place of 1.54; and where groups pay, too: 16,384 rays in scan lines
/// 2.6, in place of 3.9. 16 and 12: as fast.)
const OF_ANY: Eighths = [12, 9];
const OF_ANY_AT_FIRST: Eighths = [OF_ANY[0], 6];

/// So many spheres may be held against packets in vain for each ray, before it is asked whether that is wasted.
const SPHERES_A_RAY: u32 = 1;

/// How much a group may do.
#[derive(Clone, Copy)]
pub(super) struct Allowance {
    /// So much before it is asked whether its rays would have done less; and so many spheres in vain.
    most: u32,
    most_in_vain: u32,
    /// Whether the group before it has paid.
    is_trusted: bool,
    rays: u32,
    /// The leaves of a small tree: then rays have a way of their own through it.
    leaves: Option<u32>,
    /// What the roots of a sphere take a ray that has met one.
    next_roots: u32,
}

impl Allowance {
    /// Of a group that has done nothing, in a tree of so many leaves, if it is small; `is_any` says what is asked, `is_trusted`
    /// whether the group before it has paid.
    #[inline(always)]
    pub(super) fn of<L: Lanes>(
        states: &[PacketState<'_, L>],
        leaves: Option<u32>,
        [is_any, is_trusted]: [bool; 2],
    ) -> Self {
        let rays = live_rays(states);
        let next_roots = if is_any | leaves.is_some() { 0 } else { RAY_NEXT_ROOTS };
        let most_in_vain = SPHERES_A_RAY * rays;
        let allowance = Self { most: 0, most_in_vain, is_trusted, rays, leaves, next_roots };
        Self { most: allowance.least_apart() as u32, ..allowance }
    }

    /// What rays apart do at least: all look into the root.
    #[inline(always)]
    fn least_apart(&self) -> u64 {
        let each = self
            .leaves
            .map_or(RAY + RAY_NODE, |leaves| RAY_OF_SMALL_TREE + LEAF_OF_SMALL_TREE * leaves);
        u64::from(self.rays) * u64::from(each)
    }

    /// What the roots of spheres take rays apart, about: by itself a ray meets what is nearest first, and few others; one that hits
    /// nothing may come near none of those that the group meets.
    #[inline(always)]
    fn roots_apart<L: Lanes>(&self, effort: &Effort, states: &[PacketState<'_, L>]) -> u64 {
        let roots = match self.leaves {
            Some(_) => u64::from(ROOTS_OF_SMALL_TREE * effort.near.min(self.rays)),
            None => {
                let (hit, near) = (u64::from(rays_that_hit(states)), u64::from(effort.near));
                let next = u64::from(self.next_roots) * near * hit / u64::from(self.rays.max(1));
                u64::from(RAY_ROOTS) * hit + next
            }
        };
        roots + u64::from(RAY_TIER) * u64::from(effort.tested)
    }

    /// Whether its rays would have done less apart, as far as they have come.
    #[inline(always)]
    pub(super) fn is_wasted<L: Lanes, Q: Query>(
        &mut self,
        token: L::Token,
        effort: &Effort,
        (states, sample): (&[PacketState<'_, L>], &BoxSample),
        bvh: &Bvh<'_>,
    ) -> bool {
        if (effort.work <= self.most) & (effort.in_vain <= self.most_in_vain) {
            return false;
        }
        #[cfg(all(test, proofs))]
        if crate::proofs::work::groups_persist() {
            return false;
        }
        // By value: what another function may write is in memory from then on.
        let (allowance, effort) = (*self, *effort);
        let limits = L::out_of_line(
            token,
            #[inline(always)]
            || allowance.limits::<L, Q>(&effort, states, sample, bvh),
        );
        [self.most, self.most_in_vain] = limits.unwrap_or([self.most, self.most_in_vain]);
        limits.is_none()
    }

    /// How much it may do, and in vain; `None` if its rays would have done less apart. It may do a quarter more than they do at
    /// least, since those that go on by themselves begin anew, and of what they do about more than all, since that is not known
    /// well. While it holds many spheres against rays in vain, a third of what they do at least is enough, and less of about.
    #[inline(always)]
    fn limits<L: Lanes, Q: Query>(
        &self,
        effort: &Effort,
        states: &[PacketState<'_, L>],
        sample: &BoxSample,
        bvh: &Bvh<'_>,
    ) -> Option<[u32; 2]> {
        let most_in_vain = SPHERES_A_RAY * self.rays;
        let is_in_vain = effort.in_vain > most_in_vain;
        let [about, in_vain] = match (Q::ANY, states.len() > 1, self.is_trusted) {
            (false, true, _) => OF_CLOSEST,
            (false, false, _) => OF_CLOSEST_ALONE,
            (true, _, true) => OF_ANY,
            (true, _, false) => OF_ANY_AT_FIRST,
        };
        let (work, least) = (u64::from(effort.work), self.least_apart());
        let begin_anew = if self.leaves.is_some() { 0 } else { least / 4 };

        // What is known without boxes is enough for most groups, and all that there is in a small tree.
        let mut apart = self.roots_apart(effort, states);
        if self.leaves.is_none() && (is_in_vain | (work > least + begin_anew + apart * about / 8)) {
            apart += sample.apart::<L, Q>(states, bvh, [RAY_NODE, RAY_LEAF]);
        }

        let limit = if is_in_vain {
            least / 3 + apart * in_vain / 8
        } else {
            least + begin_anew + apart * about / 8
        };
        if work > limit {
            return None;
        }
        // To ask takes as long as some boxes.
        let most = limit.max(work + work / 8).min(u64::from(u32::MAX)) as u32;
        Some([most, if is_in_vain { u32::MAX } else { most_in_vain }])
    }

    /// Whether all that it has done is so much that the next is better not tried: of any hit more than it may do, of closest hits a
    /// quarter more than its rays would have done apart. (Of closest hits, too, more than it may do: a scanner's among 200,000 spheres
    /// 0.7 of the speed. Of any hit, too, a quarter: 0.99. What a small tree costs is known.)
    #[inline(always)]
    pub(super) fn is_at_a_loss<L: Lanes, Q: Query>(
        &mut self,
        token: L::Token,
        effort: &Effort,
        (states, sample): (&[PacketState<'_, L>], &BoxSample),
        bvh: &Bvh<'_>,
    ) -> bool {
        if Q::ANY && self.leaves.is_none() {
            return self.is_wasted::<L, Q>(token, effort, (states, sample), bvh);
        }
        #[cfg(all(test, proofs))]
        if crate::proofs::work::groups_persist() {
            return false;
        }
        let (work, least) = (u64::from(effort.work), self.least_apart());
        if self.leaves.is_some() {
            let apart = least + self.roots_apart(effort, states);
            return 10 * u64::from(effort.work.wrapping_add(FIT)) > 7 * apart;
        }
        let begin_anew = least / 4;
        if work <= least + begin_anew {
            return false;
        }
        // By value: what another function may write is in memory from then on.
        let (allowance, effort) = (*self, *effort);
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                // Boxes are held against rays where it is in doubt. (Wherever it is more than is known without: a camera's tiles
                // among 3,000 spheres 0.9 of the speed, by AVX2.)
                let roots = allowance.roots_apart(&effort, states);
                work > least + begin_anew + roots + roots / 2
                    && 4 * work > 5 * allowance.apart::<L, Q>(token, &effort, (states, sample), bvh)
            },
        )
    }

    /// What its rays would have done apart, about, as far as they have come.
    #[inline(always)]
    pub(super) fn apart<L: Lanes, Q: Query>(
        &self,
        token: L::Token,
        effort: &Effort,
        (states, sample): (&[PacketState<'_, L>], &BoxSample),
        bvh: &Bvh<'_>,
    ) -> u64 {
        // By value: what another function may write is in memory from then on.
        let (allowance, effort) = (*self, *effort);
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                let in_boxes = sample.apart::<L, Q>(states, bvh, [RAY_NODE, RAY_LEAF]);
                allowance.least_apart() + allowance.roots_apart(&effort, states) + in_boxes
            },
        )
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

/// How many rays of a group have hit a sphere.
#[inline(always)]
fn rays_that_hit<L: Lanes>(states: &[PacketState<'_, L>]) -> u32 {
    let mut rays = 0;
    for state in states {
        rays += state.best.lt(state.rays.end[1]).bits().count_ones();
    }
    rays
}

/// Fewer rays go by themselves: to lay planes around a group takes as long as some of them do.
pub(super) const LEAST_RAYS: u32 = 12;
