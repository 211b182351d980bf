//! Which blocks of a picture are measured, if all of them are too many.

/// Every so many-th block of every so many-th row of blocks. Of the rows that are taken, every other begins half a step
/// later, so that no column is left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blocks {
    across: u32,
    down: u32,
    /// The steps along a row, and from row to row.
    steps: [u32; 2],
}

impl Blocks {
    /// As many of `across` x `down` blocks as `most` allows, and one at least if there are any.
    pub(super) fn new(across: u32, down: u32, most: usize) -> Self {
        let most = (most as u64).max(1);
        let all = u64::from(across) * u64::from(down);
        let mut step = all.div_ceil(most).max(1);
        loop {
            // As square as the picture allows.
            let rows = step.isqrt().min(down.into()).max(step.div_ceil(u64::from(across.max(1))));
            let steps = [step.div_ceil(rows), rows].map(|step| step as u32);
            let blocks = Self { across, down, steps };
            if blocks.count() <= most {
                return blocks;
            }
            step += 1 + step / 64;
        }
    }

    /// Column and row of every block that is taken, row by row.
    pub(super) fn each(self) -> impl Iterator<Item = (u32, u32)> {
        let [along, rows] = self.steps;
        let taken = (0..self.down).step_by(rows as usize).zip([0, along / 2].into_iter().cycle());
        taken.flat_map(move |(row, first)| {
            (first..self.across).step_by(along as usize).map(move |column| (column, row))
        })
    }

    fn count(self) -> u64 {
        let [along, rows] = self.steps;
        let taken = self.down.div_ceil(rows);
        let of_row = |first: u32| u64::from(self.across.saturating_sub(first).div_ceil(along));
        u64::from(taken.div_ceil(2)) * of_row(0) + u64::from(taken / 2) * of_row(along / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_blocks_are_all_taken_in_order() {
        let all: Vec<_> = Blocks::new(3, 2, 6).each().collect();
        assert_eq!(all, [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)]);
        assert_eq!(Blocks::new(0, 9, 6).each().count(), 0);
    }

    #[test]
    fn no_more_are_taken_than_there_may_be_and_not_far_fewer() {
        for (across, down) in [(63, 63), (128, 128), (1, 4096), (4096, 1), (7, 900), (4096, 4096)] {
            for most in [1, 2, 5, 512, 8192] {
                let blocks = Blocks::new(across, down, most);
                let count = blocks.each().count();
                assert_eq!(count as u64, blocks.count());
                let least = most.min((across * down) as usize) / 4;
                assert!((least.max(1)..=most).contains(&count), "{across}x{down}: {count}");
            }
        }
    }

    /// A grid of 16 x 16 over the picture.
    #[test]
    fn they_are_from_everywhere() {
        for side in [63, 128, 256] {
            let mut seen = [false; 256];
            for (column, row) in Blocks::new(side, side, 512).each() {
                seen[(row * 16 / side * 16 + column * 16 / side) as usize] = true;
            }
            let seen = seen.iter().filter(|&&seen| seen).count();
            assert!(seen > 230, "{side}: {seen}");
        }
    }
}
