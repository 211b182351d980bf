//! Which groups are tried, and which packets of them.

use super::packet_group::GROUP;

/// Which groups are tried: after each group that does not pay, twice as many are passed over, up to a limit; but none if the
/// group before it has paid, since where every second group pays it is better to try all. The next call may have other rays (a
/// path tracer's camera, then bounces), so it begins with a try, where that costs little.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// How many groups are still passed over, and of how many.
    wait: u8,
    gap: u8,
    /// Whether the last group has paid: then none is passed over if the next does not pay.
    has_paid: bool,
    /// Whether a group has done work in vain since the last that paid. A group that does not fit has done none.
    is_costly: bool,
}

/// A call of so many groups begins with a try, whatever was before. (Rays to a light among 20,000 spheres, in calls of one group that
/// each began with a try, took 1.35 times as long on a Zen 3.)
const WORTH_A_TRY: usize = 8;

/// How many groups are passed over after the first that does not pay. In a small tree a group takes as much as its rays take apart,
/// so learning must cost less: with the longer gap there, calls of 512 rays of a beam over 64 spheres run at 0.75 of the speed of ray
/// by ray, instead of 0.65, and calls of a scanner's rays at 1.30, instead of 1.36 (AVX-512). (With it in all trees, any hits of 512
/// scan lines among nested spheres ran at 0.73, instead of 0.92, since their first group does not pay; the mean of eight scenes
/// was 1.004.)
pub(super) const SHORTEST: u8 = 1;
pub(super) const SHORTEST_IN_SMALL_TREE: u8 = 3;
/// The most groups that are passed over, and the most where rays are said to be coherent: with 3, rays that are falsely said to be
/// coherent run at 0.42 to 0.65 of the speed of ray by ray among nested spheres.
pub(super) const LONGEST: u8 = 31;
pub(super) const LONGEST_IF_COHERENT: u8 = 15;

impl Patience {
    pub(crate) const NEW: Self = Self { wait: 0, gap: 0, has_paid: false, is_costly: false };

    /// Begins a call of so many groups.
    #[inline(always)]
    pub(super) fn begin(&mut self, groups: usize) {
        if !self.is_costly | (groups >= WORTH_A_TRY) {
            self.wait = 0;
        }
    }

    /// Returns whether the next group is tried.
    #[inline(always)]
    pub(super) fn tries(&mut self) -> bool {
        let tries = self.wait == 0;
        self.wait = self.wait.saturating_sub(1);
        tries
    }

    /// Whether the last group that was tried has paid.
    #[inline(always)]
    pub(super) fn has_paid(&self) -> bool {
        self.has_paid
    }

    /// Takes the outcome of a try: whether it paid, and whether it did work in vain; at least `least` and
    /// at most `most` groups are passed over then.
    #[inline(always)]
    pub(super) fn take(&mut self, (paid, in_vain): (bool, bool), [least, most]: [u8; 2]) {
        if paid {
            self.gap = 0;
        } else if !self.has_paid {
            self.gap = (2 * self.gap + 1).max(least).min(most);
        }
        self.has_paid = paid;
        self.is_costly = !paid & (self.is_costly | in_vain);
        self.wait = self.gap;
    }
}

/// Which packets are tried one by one. Packets at the same place of their groups are often alike: the lowest rays of a scanner's
/// fan, or every second packet of two sources. So where some packets pay, each place learns by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketPatience {
    any: Patience,
    at: [Patience; GROUP],
    /// The place of the packet that is tried first: another after each try in vain, since the try ends there.
    first: u8,
}

/// Packets of a group: a bit for each.
pub(super) type Places = u8;

impl PacketPatience {
    pub(crate) const NEW: Self = Self { any: Patience::NEW, at: [Patience::NEW; GROUP], first: 0 };

    /// Begins a call of so many groups.
    #[inline(always)]
    pub(super) fn begin(&mut self, groups: usize) {
        self.any.begin(groups);
        for place in &mut self.at {
            place.begin(groups);
        }
    }

    /// Whether one of the last packets that were tried has paid.
    #[inline(always)]
    pub(super) fn has_paid(&self) -> bool {
        self.any.has_paid()
    }

    /// Returns which packets of the next group are tried, and the place of the first.
    #[inline(always)]
    pub(super) fn tries(&mut self) -> (Places, usize) {
        let mut places = 0;
        if self.any.tries() {
            for place in 0..GROUP {
                places |= u8::from(self.at[place].tries()) << place;
            }
        }
        (places, usize::from(self.first))
    }

    /// Takes the outcome of a try: which packets were tried, which paid, and which did work in vain.
    #[inline(always)]
    pub(super) fn take(&mut self, [tried, paid, in_vain]: [Places; 3], gaps: [u8; 2]) {
        self.any.take((paid != 0, in_vain != 0), gaps);
        if paid == 0 {
            self.first = (self.first + 1) % GROUP as u8;
            return;
        }
        for place in 0..GROUP {
            let is_in = |places: Places| places >> place & 1 != 0;
            if is_in(tried) {
                self.at[place].take((is_in(paid), is_in(in_vain)), gaps);
            }
        }
    }
}
