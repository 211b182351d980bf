//! How much of each pixel of a cell a glyph covers.

/// Pixels of a cell, side by side.
pub const WIDTH: usize = 8;
/// Pixels of a cell, one above the other.
pub const HEIGHT: usize = 16;

/// The share of each pixel that has the colour of the ink, row by row from the top left.
pub type Coverage = [f32; WIDTH * HEIGHT];

/// The same share everywhere.
#[must_use]
pub const fn even(share: f32) -> Coverage {
    [share; WIDTH * HEIGHT]
}

/// The area covered by disjoint rectangles, each given by left, top, right and bottom in shares of the cell.
#[must_use]
pub fn rectangles(rectangles: &[[f32; 4]]) -> Coverage {
    let mut coverage = even(0.0);
    for (pixel, share) in coverage.iter_mut().enumerate() {
        let (x, y) = ((pixel % WIDTH) as f32, (pixel / WIDTH) as f32);
        // How much of the pixel that begins at `start` lies between two edges.
        let overlap =
            |start: f32, from: f32, to: f32| ((start + 1.0).min(to) - start.max(from)).max(0.0);
        *share = rectangles
            .iter()
            .map(|[left, top, right, bottom]| {
                let (width, height) = (WIDTH as f32, HEIGHT as f32);
                overlap(x, left * width, right * width) * overlap(y, top * height, bottom * height)
            })
            .sum();
    }
    coverage
}
