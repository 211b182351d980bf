//! The order in which the tiles of a picture are traced: neighbours in the order are neighbours in the picture, so that
//! packets which go through a structure together visit less of it.

use super::Camera;
use crate::lanes::LaneArray;

/// The side of the largest square, in tiles.
const SQUARE: u32 = 4;

impl Camera {
    /// The first pixels of the tiles that cover a picture of `width` x `height` pixels, each once. If there is room, four tiles from a
    /// multiple of four on form a square, and so do sixteen from a multiple of sixteen on (Morton order in squares, the squares from left
    /// to right).
    ///
    /// ```
    /// use spherule_kernel::Camera;
    ///
    /// let corners: Vec<_> = Camera::tile_corners::<[f32; 16]>(12, 8).collect();
    /// assert_eq!(corners, [(0, 0), (4, 0), (0, 4), (4, 4), (8, 0), (8, 4)]);
    /// ```
    pub fn tile_corners<A: LaneArray>(
        width: u32,
        height: u32,
    ) -> impl Iterator<Item = (u32, u32)> + Clone {
        let (across, down) = Self::tile::<A>();
        let tiles = tile_order(width.div_ceil(across), height.div_ceil(down));
        tiles.map(move |(column, row)| (column * across, row * down))
    }
}

/// The places, column and row, of `columns` x `rows` tiles.
fn tile_order(columns: u32, rows: u32) -> impl Iterator<Item = (u32, u32)> + Clone {
    let squares = (0..columns.div_ceil(SQUARE))
        .flat_map(move |column| (0..rows.div_ceil(SQUARE)).map(move |row| (column, row)));
    squares
        .flat_map(|(column, row)| {
            (0..SQUARE * SQUARE).map(move |place| {
                let (right, down) = (every_other_bit(place), every_other_bit(place / 2));
                // With one lane, a picture may have so many tiles that a number is too large: those
                // are no tiles.
                let column =
                    column.checked_mul(SQUARE).and_then(|column| column.checked_add(right));
                (column, row.checked_mul(SQUARE).and_then(|row| row.checked_add(down)))
            })
        })
        .filter_map(move |tile| match tile {
            (Some(column), Some(row)) if column < columns && row < rows => Some((column, row)),
            _ => None,
        })
}

/// Bits 0 and 2, side by side.
fn every_other_bit(place: u32) -> u32 {
    place & 1 | place >> 1 & 2
}

#[cfg(all(test, proofs))]
mod tests {
    extern crate std;

    use super::*;
    use std::vec::Vec;

    #[test]
    fn every_tile_comes_once() {
        for (columns, rows) in [(0, 3), (3, 0), (1, 1), (7, 5), (40, 2), (9, 4), (5, 11)] {
            let mut tiles: Vec<_> = tile_order(columns, rows).collect();
            tiles.sort_unstable();
            let all = (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
            assert!(all.eq(tiles), "{columns} x {rows}");
        }
    }

    #[test]
    fn neighbours_are_squares() {
        let side = |tiles: &[(u32, u32)]| {
            let extent = |axis: fn(&(u32, u32)) -> u32| {
                let values = tiles.iter().map(axis);
                values.clone().max().unwrap_or(0) - values.min().unwrap_or(0) + 1
            };
            (extent(|tile| tile.0), extent(|tile| tile.1))
        };
        for rows in [2, 4, 6, 8] {
            let tiles: Vec<_> = tile_order(12, rows).collect();
            assert!(tiles.chunks(4).all(|tiles| side(tiles) == (2, 2)), "{rows} rows");
        }
        for rows in [4, 8] {
            let tiles: Vec<_> = tile_order(12, rows).collect();
            assert!(tiles.chunks(16).all(|tiles| side(tiles) == (4, 4)), "{rows} rows");
        }
    }
}
