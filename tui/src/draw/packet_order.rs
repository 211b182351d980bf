//! The order in which the packets of a picture are traced.

use spherule_kernel::Camera;

/// The side of the largest block, in tiles.
const BLOCK: u32 = 4;

/// The samples in the top left of the packets of a grid of `width` x `height` samples, so that
/// neighbours in the order are neighbours in the picture.
pub fn packet_corners(width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> + Clone {
    let (across, down) = Camera::tile::<[f32; 16]>();
    let tiles = tile_order(width.div_ceil(across), height.div_ceil(down));
    tiles.map(move |(column, row)| (column * across, row * down))
}

/// The places, column and row, of `columns` x `rows` tiles: if there is room, four from a multiple of
/// four on are a square, and so are sixteen (Morton order in blocks, the blocks from left to right).
///
/// So packets that traverse a structure together look into less of it.
fn tile_order(columns: u32, rows: u32) -> impl Iterator<Item = (u32, u32)> + Clone {
    let blocks = (0..columns.div_ceil(BLOCK))
        .flat_map(move |column| (0..rows.div_ceil(BLOCK)).map(move |row| (column, row)));
    blocks
        .flat_map(|(column, row)| {
            (0..BLOCK * BLOCK).map(move |place| {
                (BLOCK * column + every_other_bit(place), BLOCK * row + every_other_bit(place / 2))
            })
        })
        .filter(move |&(column, row)| column < columns && row < rows)
}

/// Bits 0 and 2, side by side.
fn every_other_bit(place: u32) -> u32 {
    place & 1 | place >> 1 & 2
}

#[cfg(test)]
mod tests {
    use super::*;

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
