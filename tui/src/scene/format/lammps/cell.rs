//! The box of a frame of a dump, in fractions of which positions may be.

use super::super::words::Words;
use crate::scene::input::Input;
use crate::scene::read_error::ReadError;
use glam::{DMat3, DVec3};

/// A corner of the box, and its three edges.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cell {
    origin: DVec3,
    edges: DMat3,
}

impl Cell {
    /// Reads the three lines below `ITEM: BOX BOUNDS`. A box `is_general` if they are its edges, and its corner behind them.
    ///
    /// # Errors
    /// [`ReadError`] at the first line without the numbers that it should have.
    pub(super) fn read(input: &mut Input, is_general: bool) -> Result<Self, ReadError> {
        if is_general { Self::of_edges(input) } else { Self::of_bounds(input) }
    }

    fn of_edges(input: &mut Input) -> Result<Self, ReadError> {
        let mut cell = Self::default();
        for axis in 0..3 {
            let mut words = Words::of(input.expect("the box")?);
            let edge = cell.edges.col_mut(axis);
            *edge = DVec3::new(
                words.number("x of an edge")?,
                words.number("y of an edge")?,
                words.number("z of an edge")?,
            );
            cell.origin[axis] = words.number("the origin")?;
        }
        Ok(cell)
    }

    /// Of a box that is sheared the bounds are those of a box around it.
    fn of_bounds(input: &mut Input) -> Result<Self, ReadError> {
        let (mut low, mut high, mut tilt) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        for axis in 0..3 {
            let mut words = Words::of(input.expect("the box")?);
            low[axis] = words.number("low")?;
            high[axis] = words.number("high")?;
            tilt[axis] = words.number("tilt").unwrap_or(0.0);
        }
        let [xy, xz, yz] = tilt.to_array();
        let corners = [0.0, xy, xz, xy + xz];
        low.x -= corners.iter().copied().fold(0.0, f64::min);
        high.x -= corners.iter().copied().fold(0.0, f64::max);
        low.y -= yz.min(0.0);
        high.y -= yz.max(0.0);
        let length = high - low;
        let [a, b, c] = [[length.x, 0.0, 0.0], [xy, length.y, 0.0], [xz, yz, length.z]];
        Ok(Self { origin: low, edges: DMat3::from_cols_array_2d(&[a, b, c]) })
    }

    /// Where a position in fractions of the box is.
    pub(super) fn point(&self, [x, y, z]: [f64; 3]) -> DVec3 {
        self.origin + x * self.edges.x_axis + y * self.edges.y_axis + z * self.edges.z_axis
    }
}
