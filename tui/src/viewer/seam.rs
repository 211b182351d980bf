//! The seam between two tiers.

/// Where the seam is, counted from the middle: so it stays in the middle whatever the size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Seam {
    /// Columns to the right of the middle.
    right: i16,
}

impl Seam {
    /// The seam in this column of `columns`, or in the nearest that there is.
    pub(super) fn at(column: i32, columns: u16) -> Self {
        let column = column.clamp(0, last(columns));
        Self { right: (column - i32::from(columns / 2)) as i16 }
    }

    /// The column of the seam in a picture of `columns`.
    pub(super) fn column(self, columns: u16) -> u16 {
        let column = i32::from(columns / 2) + i32::from(self.right);
        column.clamp(0, last(columns)) as u16
    }
}

/// The last column of so many; the first if there is none.
fn last(columns: u16) -> i32 {
    i32::from(columns.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_in_a_column_of_the_picture() {
        assert_eq!(Seam::default().column(80), 40);
        for columns in [0, 1, 2, 7, 80, 4096] {
            for column in [-1, 0, 1, 3, 79, 5000] {
                let seam = Seam::at(column, columns);
                let nearest = column.clamp(0, (i32::from(columns) - 1).max(0));
                assert_eq!(i32::from(seam.column(columns)), nearest, "{column} of {columns}");
            }
        }
    }

    #[test]
    fn it_keeps_its_distance_from_the_middle() {
        let seam = Seam::at(50, 80);
        assert_eq!((seam.column(100), seam.column(60), seam.column(12)), (60, 40, 11));
        assert_eq!(seam.column(80), 50);
    }
}
