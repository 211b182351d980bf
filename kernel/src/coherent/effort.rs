//! What a group has done, as counts.
//!
//! Work is counted in steps of some 5 ns on a Zen 3 (AVX2). The weights start from a fit to the times of 243 scenes and
//! orders of rays, of groups and of rays by themselves; the fit was a sixth off in the mean. The weight of a sphere is between what it
//! takes there and on a Zen 5, where a sphere takes as long, and the other kinds half the time.

/// What a group does: a node, a leaf, a leaf against a packet's planes, a sphere against a packet's rays, and the roots of
/// one that any of them comes near; and the tier, for rays of which two spheres may be the closest.
const NODE: u32 = 16;
const LEAF: u32 = 3;
const PACKET: u32 = 5;
const SPHERE: u32 = 3;
const ROOTS: u32 = 16;
const TIER: u32 = 45;
/// How many spheres may be tested against packets for each that a ray comes near: groups that pay test two to six, groups that are
/// too wide fifty and more.
const SPHERES_A_ROOT: u32 = 5;

/// What a group has done.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// All of it.
    pub(super) work: u32,
    /// Spheres that were tested against packets, beyond `SPHERES_A_ROOT` for each that a ray came near.
    pub(super) in_vain: u32,
    /// How many times a ray came near a sphere, and how many times the tier tested a ray.
    pub(super) near: u32,
    pub(super) tested: u32,
    /// What a leaf takes.
    leaf: u32,
}

impl Effort {
    /// For a group of so many packets that has done nothing.
    #[inline(always)]
    pub(super) fn of(packets: usize) -> Self {
        let leaf = LEAF + PACKET * packets as u32;
        Self { work: 0, in_vain: 0, near: 0, tested: 0, leaf }
    }

    /// Counts a node that was looked into.
    #[inline(always)]
    pub(super) fn node(&mut self) {
        self.work = self.work.wrapping_add(NODE);
    }

    /// Counts a leaf that was looked into.
    #[inline(always)]
    pub(super) fn leaf(&mut self) {
        self.work = self.work.wrapping_add(self.leaf);
    }

    /// Counts spheres that were tested against the rays of packets.
    #[inline(always)]
    pub(super) fn spheres(&mut self, spheres: u32) {
        self.work = self.work.wrapping_add(SPHERE * spheres);
        self.in_vain = self.in_vain.wrapping_add(spheres);
    }

    /// Counts the roots of a sphere that so many rays come near.
    #[inline(always)]
    pub(super) fn roots(&mut self, rays: u32) {
        self.work = self.work.wrapping_add(ROOTS);
        self.in_vain = self.in_vain.saturating_sub(SPHERES_A_ROOT);
        self.near = self.near.wrapping_add(rays);
    }

    /// Counts a test by the tier, for so many rays.
    #[inline(always)]
    pub(super) fn test(&mut self, rays: u32) {
        self.work = self.work.wrapping_add(TIER);
        self.tested = self.tested.wrapping_add(rays);
    }
}
