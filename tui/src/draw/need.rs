//! Where the few samples of a first pass do not tell what a cell looks like.

use spherule_kernel::Vec3;

/// Above this distance from a plane, in `OKLab`, a cell's samples are too few. (0.03 takes 5 % more samples, and gains
/// nothing.)
pub(super) const ENOUGH: f32 = 0.035;

/// The samples of a picture that has 2 x 2 a cell, as they look (in `OKLab`), cell by cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Looks<'a> {
    pub(super) looks: &'a [Vec3],
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Looks<'_> {
    /// Writes the needs of the cells from row `first` on.
    pub(super) fn judge(&self, first: usize, needs: &mut [f32]) {
        for (needs, row) in needs.chunks_mut(self.columns).zip(first..) {
            for (column, need) in needs.iter_mut().enumerate() {
                *need = self.need(column, row);
            }
        }
    }

    /// The greatest distance of the samples in and around a cell from a plane, in `OKLab`.
    ///
    /// There are four samples in the cell, and twelve around it. So an edge that runs between two of them is seen, and
    /// smooth shading, which two colours show well, is not. Past the edges of the picture the last samples count again.
    fn need(&self, column: usize, row: usize) -> f32 {
        let (width, height) = (2 * self.columns, 2 * self.rows);
        let xs: [usize; 4] =
            std::array::from_fn(|x| (2 * column + x).saturating_sub(1).min(width - 1));
        let mut around = [[Vec3::ZERO; 4]; 4];
        for (y, around) in around.iter_mut().enumerate() {
            let y = (2 * row + y).saturating_sub(1).min(height - 1);
            let row = y / 2 * self.columns;
            *around = xs.map(|x| self.looks[4 * (row + x / 2) + y % 2 * 2 + x % 2]);
        }
        let all = around.as_flattened();
        let low = all.iter().fold(all[0], |low, &look| low.min(look));
        let high = all.iter().fold(all[0], |high, &look| high.max(look));
        // Most of a picture is background, and flat.
        if (high - low).max_element() <= ENOUGH {
            return 0.0;
        }
        let mean = all.iter().sum::<Vec3>() / 16.0;
        // The slopes of least squares: the places are at -1.5, -0.5, 0.5 and 1.5, whose squares add up to 20 over all.
        const PLACES: [f32; 4] = [-1.5, -0.5, 0.5, 1.5];
        let (mut right, mut down) = (Vec3::ZERO, Vec3::ZERO);
        for (line, y) in around.iter().zip(PLACES) {
            for (&look, x) in line.iter().zip(PLACES) {
                right += x * look;
                down += y * look;
            }
        }
        let (right, down) = (right / 20.0, down / 20.0);
        let mut most = 0.0_f32;
        for (line, y) in around.iter().zip(PLACES) {
            for (&look, x) in line.iter().zip(PLACES) {
                let plane = mean + x * right + y * down;
                most = most.max((look - plane).length_squared());
            }
        }
        most.sqrt()
    }
}

#[cfg(test)]
mod tests;
