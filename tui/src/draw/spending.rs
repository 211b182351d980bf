//! How many samples a picture may take, and who gets them if there are not enough for all.

use super::need::ENOUGH;
use std::ops::Range;

/// How many samples a picture may take; shadow rays are not counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spending {
    /// As many as it needs.
    ByNeed,
    /// At most this many. The few samples of every cell are taken whatever they sum up to, and nothing is saved on
    /// samples whose number the style names. Colours are those for [an eye that follows a movement](crate::cells::eye),
    /// and of 256 colours the nearest, [unmixed](crate::cells::dither).
    AtMost(u64),
}

/// What a picture took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// How many samples, each a ray of the camera.
    pub samples: u64,
    /// How many rays, shadow rays among them.
    pub rays: u64,
    /// Whether every cell got what it needs, including mixed colours.
    pub is_full: bool,
}

impl Effort {
    /// The effort of a picture without a cell.
    pub const NONE: Self = Self { samples: 0, rays: 0, is_full: true };

    /// The effort of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            samples: self.samples + other.samples,
            rays: self.rays + other.rays,
            is_full: self.is_full && other.is_full,
        }
    }
}

/// Which cells get more than the few samples, and how many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grant {
    /// Which of the grids of samples, counted from the finest.
    pub(super) grid: usize,
    /// Cells whose need is greater than this get that grid.
    pub(super) above: f32,
}

impl Grant {
    /// Every cell in need gets the finest grid.
    pub(super) const FULL: Self = Self { grid: 0, above: ENOUGH };
}

impl Spending {
    /// The part of the spending for `some` of `all` columns.
    #[must_use]
    pub fn part(self, some: usize, all: usize) -> Self {
        match self {
            Self::ByNeed => Self::ByNeed,
            Self::AtMost(most) => Self::AtMost(most * some as u64 / (all as u64).max(1)),
        }
    }

    /// What is left for `rows`, of `all` rows of a picture, after they have taken so many samples.
    pub(super) fn left(self, rows: &Range<usize>, all: usize, samples: u64) -> Self {
        match self {
            Self::ByNeed => Self::ByNeed,
            Self::AtMost(most) => {
                let before = |row: usize| u128::from(most) * row as u128 / all.max(1) as u128;
                // No more than `most`, which is 64 bits.
                let share = (before(rows.end) - before(rows.start)) as u64;
                Self::AtMost(share.saturating_sub(samples))
            }
        }
    }

    /// Shares it out among cells with these `needs`. Each gets as many samples as one of the `grids` has.
    ///
    /// With `ByNeed`, all who are in need get the finest grid; else they get the finest that suffices for all of them. If
    /// none does, those who need it most get the coarsest: of equals either all or none get it, so the order does not
    /// matter. `sorted` is memory.
    pub(super) fn grant(self, needs: &[f32], grids: &[u32], sorted: &mut Vec<f32>) -> Grant {
        let Self::AtMost(most) = self else { return Grant::FULL };
        let needy = || needs.iter().copied().filter(|&need| need > ENOUGH);
        let count = needy().count() as u64;
        let suffices = |&samples: &u32| count * u64::from(samples) <= most;
        if let Some(grid) = grids.iter().position(suffices) {
            return Grant { grid, ..Grant::FULL };
        }
        let Some((&coarsest, finer)) = grids.split_last() else { return Grant::FULL };
        sorted.clear();
        sorted.extend(needy());
        // Fewer than there are in need, or that grid would have sufficed.
        let served = (most / u64::from(coarsest)) as usize;
        let (_, &mut above, _) = sorted.select_nth_unstable_by(served, |a, b| b.total_cmp(a));
        Grant { grid: finer.len(), above }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRIDS: [u32; 3] = [96, 32, 16];
    const NEEDS: [f32; 6] = [0.0, 0.3, 0.1, ENOUGH, 0.2, 0.1];

    fn grant(most: u64, needs: &[f32]) -> Grant {
        Spending::AtMost(most).grant(needs, &GRIDS, &mut Vec::new())
    }

    #[test]
    fn the_finest_grid_that_suffices_for_all_in_need() {
        assert_eq!(Spending::ByNeed.grant(&NEEDS, &GRIDS, &mut Vec::new()), Grant::FULL);
        assert_eq!(grant(4 * 96, &NEEDS), Grant::FULL);
        assert_eq!(grant(4 * 96 - 1, &NEEDS), Grant { grid: 1, above: ENOUGH });
        assert_eq!(grant(4 * 16, &NEEDS), Grant { grid: 2, above: ENOUGH });
        assert_eq!(grant(0, &[ENOUGH; 5]), Grant::FULL);
        assert_eq!(grant(0, &[]), Grant::FULL);
    }

    #[test]
    fn those_who_need_it_most_if_none_does() {
        let served = |most| {
            let Grant { grid, above } = grant(most, &NEEDS);
            assert_eq!(grid, 2);
            NEEDS.iter().filter(|&&need| need > above).count()
        };
        // The third would be one of two equals.
        let counts: Vec<_> = [0, 15, 16, 32, 48, 63].map(served).into();
        assert_eq!(counts, [0, 0, 1, 2, 2, 2]);
        let mut reversed = NEEDS;
        reversed.reverse();
        assert_eq!(grant(32, &reversed), grant(32, &NEEDS));
    }

    #[test]
    fn columns_share_it() {
        assert_eq!(Spending::AtMost(100).part(1, 4), Spending::AtMost(25));
        assert_eq!(Spending::AtMost(100).part(0, 0), Spending::AtMost(0));
        assert_eq!(Spending::ByNeed.part(1, 4), Spending::ByNeed);
    }

    #[test]
    fn rows_share_it() {
        let of = |rows: Range<usize>| Spending::AtMost(1000).left(&rows, 7, 100);
        assert_eq!(of(0..7), Spending::AtMost(900));
        let shares = [0..3, 3..6, 6..7].map(|rows| match of(rows) {
            Spending::AtMost(left) => left + 100,
            Spending::ByNeed => 0,
        });
        assert_eq!(shares, [428, 429, 143]);
        assert_eq!(Spending::AtMost(5).left(&(0..7), 7, 100), Spending::AtMost(0));
        assert_eq!(Spending::AtMost(u64::MAX).left(&(0..7), 7, 0), Spending::AtMost(u64::MAX));
        assert_eq!(Spending::ByNeed.left(&(0..7), 7, 100), Spending::ByNeed);
    }
}
