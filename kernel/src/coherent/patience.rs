//! Which groups are tried.

/// Which groups are tried: after each that does not pay twice as many are passed over, up to a number. The next call may
/// have other rays (a path tracer's camera, then bounces), so it begins with a try, where that costs little.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    /// So many are still passed over, of so many.
    wait: u32,
    gap: u32,
    /// How many have paid since the last that did not, at most [`FORGIVEN`].
    paid: u32,
    /// Whether one has done work in vain since the last that paid. What does not fit has done none.
    is_costly: bool,
}

/// Of so many groups one is tried, whatever was before. (Rays to a light among 20,000 spheres, in calls of one group that each began
/// with a try, took 1.35 times as long on a Zen 3.)
const WORTH_A_TRY: usize = 8;

/// After so many that paid, none is passed over for one that did not.
const FORGIVEN: u32 = 4;

/// The most that are passed over, and the most where rays are said to be coherent.
pub(super) const LONGEST: u32 = 31;
pub(super) const LONGEST_IF_COHERENT: u32 = 3;

impl Patience {
    pub(crate) const NEW: Self = Self { wait: 0, gap: 0, paid: 0, is_costly: false };

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
        if paid {
            (self.gap, self.paid) = (0, (self.paid + 1).min(FORGIVEN));
        } else {
            // One among many that pay says nothing of the next.
            self.gap = if self.paid < FORGIVEN { (2 * self.gap + 1).min(most) } else { 0 };
            self.paid = 0;
        }
        self.is_costly = !paid & (self.is_costly | in_vain);
        self.wait = self.gap;
    }
}
