//! When a group gives up: what its rays would have done apart.
//!
//! # Method
//!
//! A group pays as long as its rays meet the same boxes: one test of a box serves them all. Whether they do depends on
//! the rays and on the scene, and is not known before. So a group's work is counted as it is done, and compared with what
//! its rays would have done apart so far:
//!
//! * each ray would have begun and ended by itself, and looked into the root;
//! * each ray that has hit a sphere would have come near one, and for closest hits near others, which take less;
//! * a part of the rays would have entered each box that the group looks into. The part is sampled: some of the boxes are kept,
//!   evenly spaced, and tested against the rays of some packets. In a small tree all rays look into all leaves.
//!
//! A group gives up if it has done more than the known part of that work, a quarter of it, and the multiple of the guessed part that
//! [`OF_CLOSEST`] or [`OF_ANY`] allows. Its rays then go on by themselves, with what they have hit. A group that has answered all of its
//! rays, but by more work than they would have done apart, counts as one that has not paid.
//!
//! The work that the rays would have done apart only grows. So the sample is looked at when a group has done more than the
//! least that they would have done by then, and again when it has done more than was found: most groups that pay are never checked.
//! (Testing each eighth box against rays as it was met took 5 to 9 % of the time of a camera's rays.)
//!
//! [`Effort`] counts the work; the weights of what rays do by themselves are set so that groups which pay seldom give up.

use super::box_sample::BoxSample;
use super::effort::Effort;
use super::packet_state::PacketState;
#[cfg(feature = "std")]
use crate::bvh::traverse::small_tree;
use crate::bvh::tree::Bvh;
use crate::lanes::{LaneMask, Lanes};
use crate::query::Query;

/// What a ray does by itself: its beginning and its end, a node, a leaf, the roots of the first sphere that it comes near, the roots
/// of the next, which share a leaf, and the tier. (With rays that came near a sphere counted instead of rays that hit one, and 20
/// for the first roots, the search finds calls that take 5.9 times the work of ray by ray, instead of 2.2. With boxes that take twice
/// as long where the tree is far, since rays wait for memory there, a picture of 128 by 128 of u1m ran at 1.02 to 1.07 of the speed,
/// one of 64 by 64 at 0.6, since its groups did not give up.)
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
/// What laying planes around a group takes: little, except in a small tree.
const FIT: u32 = 24;

/// The guessed part of what rays do apart, in eighths: how much of it a group may do, and how much while it tests many spheres in vain.
type Eighths = [u64; 2];
/// For closest hits: of a group, and of a packet that is tried alone. (A group that gives up loses its work, and the work left to it
/// is often less than its rays do from the root. With 12 and 9 for all, closest hits of six scenes and nine orders ran at 0.95 of the
/// speed, AVX-512. With 28 and 30 they ran as fast, but the search finds 3.4 times the work where rays are falsely said to be coherent.)
const OF_CLOSEST: Eighths = [20, 22];
const OF_CLOSEST_ALONE: Eighths = [16, 14];
/// For any hit: rays by themselves end after fewer boxes than a group looks into. Less is allowed in vain as long as the group before
/// has not paid. (With 9 then, any hits of 512 shuffled rays of a long lens among nested spheres ran at 0.61 of the speed of ray by
/// ray, instead of 0.81, AVX2. With 4 they ran at 0.92, but bursts of 1,000 there at 1.01, instead of 1.54; and 16,384 rays in scan
/// lines, where groups pay, at 2.6, instead of 3.9. 16 and 12 are as fast.)
const OF_ANY: Eighths = [12, 9];
const OF_ANY_AT_FIRST: Eighths = [OF_ANY[0], 6];

/// How many spheres a group may test in vain for each ray, before it checks whether that is wasted.
const SPHERES_A_RAY: u32 = 1;

/// How much a group may do.
#[derive(Clone, Copy)]
pub(super) struct Allowance {
    /// How much work it may do, and how many spheres it may test in vain, before it checks whether its rays would have done less.
    most: u32,
    most_in_vain: u32,
    /// Whether the group before it has paid.
    is_trusted: bool,
    rays: u32,
    /// How many leaves a small tree has: there rays by themselves enter no boxes.
    leaves: Option<u32>,
    /// What the roots of each next sphere take a ray that has met one.
    next_roots: u32,
}

impl Allowance {
    /// For a group that has done nothing; `leaves` is how many a small tree has, `is_any` whether any hit is asked, `is_trusted`
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

    /// The least that rays do apart: all look into the root.
    #[inline(always)]
    fn least_apart(&self) -> u64 {
        let each = self
            .leaves
            .map_or(RAY + RAY_NODE, |leaves| RAY_OF_SMALL_TREE + LEAF_OF_SMALL_TREE * leaves);
        u64::from(self.rays) * u64::from(each)
    }

    /// About what the roots of spheres take rays apart. A ray by itself meets the nearest sphere first, and few others; a ray that
    /// hits nothing may come near none of the spheres that the group meets.
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

    /// Returns whether the group's rays would have done less apart so far.
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
        // Copied, since the compiler keeps in memory what another function may write.
        let (allowance, effort) = (*self, *effort);
        let limits = L::out_of_line(
            token,
            #[inline(always)]
            || allowance.limits::<L, Q>(&effort, states, sample, bvh),
        );
        [self.most, self.most_in_vain] = limits.unwrap_or([self.most, self.most_in_vain]);
        limits.is_none()
    }

    /// Returns how much the group may do, and how many spheres it may test in vain; `None` if its rays would have done less apart.
    /// It may do a quarter more than the least that they do, since rays that go on by themselves begin anew, and more than all of
    /// the guessed part, which is not known well. While it tests many spheres in vain, it may do a third of the least, and the
    /// second of [`Eighths`].
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

        // What is known without boxes is enough for most groups; in a small tree there is nothing else.
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
        // A check takes as long as some boxes.
        let most = limit.max(work + work / 8).min(u64::from(u32::MAX)) as u32;
        Some([most, if is_in_vain { u32::MAX } else { most_in_vain }])
    }

    /// Returns whether the group has done so much that the next is better not tried: for any hit more than it may do, for closest hits
    /// a quarter more than its rays would have done apart. (With more than it may do for closest hits, too, a scanner's rays among
    /// 200,000 spheres ran at 0.7 of the speed; with a quarter for any hit, too, at 0.99. What a small tree costs is known.)
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
        // Copied, since the compiler keeps in memory what another function may write.
        let (allowance, effort) = (*self, *effort);
        L::out_of_line(
            token,
            #[inline(always)]
            || {
                // Boxes are tested against rays only in doubt. (With tests wherever the work is more than is known without boxes, a
                // camera's tiles among 3,000 spheres ran at 0.9 of the speed, AVX2.)
                let roots = allowance.roots_apart(&effort, states);
                work > least + begin_anew + roots + roots / 2
                    && 4 * work > 5 * allowance.apart::<L, Q>(token, &effort, (states, sample), bvh)
            },
        )
    }

    /// About what the group's rays would have done apart so far.
    #[inline(always)]
    pub(super) fn apart<L: Lanes, Q: Query>(
        &self,
        token: L::Token,
        effort: &Effort,
        (states, sample): (&[PacketState<'_, L>], &BoxSample),
        bvh: &Bvh<'_>,
    ) -> u64 {
        // Copied, since the compiler keeps in memory what another function may write.
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

/// About what so many rays do by themselves that have entered so many boxes, as far as that is known without their hits.
#[cfg(feature = "std")]
#[inline(always)]
pub(super) fn work_apart(bvh: &Bvh<'_>, rays: usize, boxes: u32) -> u64 {
    let rays = rays as u64;
    match small_tree::leaf_count(bvh) {
        Some(leaves) => {
            let each = RAY_OF_SMALL_TREE + LEAF_OF_SMALL_TREE * leaves + ROOTS_OF_SMALL_TREE;
            rays * u64::from(each)
        }
        None => rays * u64::from(RAY + RAY_ROOTS) + u64::from(boxes) * u64::from(RAY_LEAF),
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

/// Fewer rays go by themselves, since laying planes around a group takes as long as some of them do.
pub(super) const LEAST_RAYS: u32 = 12;
