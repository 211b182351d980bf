//! Wedges: glyphs whose edge runs from one border of the cell to another.
//!
//! The border has points at its corners, at thirds of its height and at half of its width; a wedge is what lies on one side of the line
//! between two of them. Four more are quarters, whose tip is the middle of the cell. Of two wedges that are each other's complement, one is
//! here.
//!
//! Source: The Unicode Standard 13.0, chart Symbols for Legacy Computing (U+1FB3C to U+1FB6F).

use super::columns::{Line, lines};
use super::masks::Cover;
use std::array;
use std::sync::LazyLock;

/// What a wedge covers is measured in 8 x 8 bins.
pub const ACROSS: usize = 8;
/// Bins, row by row.
pub const BINS: usize = ACROSS * ACROSS;

/// A wedge.
#[derive(Clone, Debug)]
pub struct Wedge {
    /// The character.
    pub glyph: char,
    /// What it covers of 2 x 4 parts.
    pub cover: Cover,
    /// The covered share of each bin.
    pub bins: [f32; BINS],
    /// The lines of shares that are not empty.
    pub lines: Vec<Line>,
    /// The mean share.
    pub mean: f32,
    /// The sum of squared differences of the shares from the mean.
    pub energy: f32,
}

/// A place in the cell: halves of its width, sixths of its height from the top.
type Place = [f32; 2];

const LOWER_LEFT: Place = [0.0, 6.0];
const LOWER_RIGHT: Place = [2.0, 6.0];

/// Where the edges begin and end, and a corner on the side that is filled, from U+1FB3C on.
const EDGES: [(Place, Place, Place); 22] = [
    ([0.0, 4.0], [1.0, 6.0], LOWER_LEFT),
    ([0.0, 4.0], [2.0, 6.0], LOWER_LEFT),
    ([0.0, 2.0], [1.0, 6.0], LOWER_LEFT),
    ([0.0, 2.0], [2.0, 6.0], LOWER_LEFT),
    ([0.0, 0.0], [1.0, 6.0], LOWER_LEFT),
    ([0.0, 2.0], [1.0, 0.0], LOWER_RIGHT),
    ([0.0, 2.0], [2.0, 0.0], LOWER_RIGHT),
    ([0.0, 4.0], [1.0, 0.0], LOWER_RIGHT),
    ([0.0, 4.0], [2.0, 0.0], LOWER_RIGHT),
    ([0.0, 6.0], [1.0, 0.0], LOWER_RIGHT),
    ([0.0, 4.0], [2.0, 2.0], LOWER_RIGHT),
    ([1.0, 6.0], [2.0, 4.0], LOWER_RIGHT),
    ([0.0, 6.0], [2.0, 4.0], LOWER_RIGHT),
    ([1.0, 6.0], [2.0, 2.0], LOWER_RIGHT),
    ([0.0, 6.0], [2.0, 2.0], LOWER_RIGHT),
    ([1.0, 6.0], [2.0, 0.0], LOWER_RIGHT),
    ([1.0, 0.0], [2.0, 2.0], LOWER_LEFT),
    ([0.0, 0.0], [2.0, 2.0], LOWER_LEFT),
    ([1.0, 0.0], [2.0, 4.0], LOWER_LEFT),
    ([0.0, 0.0], [2.0, 4.0], LOWER_LEFT),
    ([1.0, 0.0], [2.0, 6.0], LOWER_LEFT),
    ([0.0, 2.0], [2.0, 4.0], LOWER_LEFT),
];

/// Quarters: the border that each stands on, from U+1FB6C on.
const QUARTERS: [(Place, Place); 4] = [
    ([0.0, 0.0], [0.0, 6.0]),
    ([0.0, 0.0], [2.0, 0.0]),
    ([2.0, 0.0], [2.0, 6.0]),
    ([0.0, 6.0], [2.0, 6.0]),
];
const MIDDLE: Place = [1.0, 3.0];

/// All wedges.
pub static WEDGES: LazyLock<Vec<Wedge>> = LazyLock::new(|| {
    let edges = ('\u{1fb3c}'..).zip(EDGES).map(|(glyph, edge)| (glyph, vec![edge]));
    let quarters = ('\u{1fb6c}'..).zip(QUARTERS).map(|(glyph, (from, to))| {
        // On the border's side of both lines to the middle.
        (glyph, vec![(from, MIDDLE, to), (to, MIDDLE, from)])
    });
    edges.chain(quarters).map(|(glyph, edges)| wedge(glyph, &edges)).collect()
});

fn wedge(glyph: char, edges: &[(Place, Place, Place)]) -> Wedge {
    let share = |column: usize, row: usize| {
        let (left, top) = (column as f32 / 4.0, row as f32 * 0.75);
        let corners =
            [[left, top], [left + 0.25, top], [left + 0.25, top + 0.75], [left, top + 0.75]];
        let inside = edges.iter().fold(corners.to_vec(), |area, &edge| cut(&area, edge));
        area(&inside) / (0.25 * 0.75)
    };
    let bins: [f32; BINS] = array::from_fn(|bin| share(bin % ACROSS, bin / ACROSS));
    let cover = array::from_fn(|part| {
        let of_part =
            (0..BINS).filter(|bin| bin % ACROSS / 4 == part % 2 && bin / ACROSS / 2 == part / 2);
        of_part.map(|bin| bins[bin]).sum::<f32>() / 8.0
    });
    let mean = bins.iter().sum::<f32>() / BINS as f32;
    let energy = bins.iter().map(|share| (share - mean) * (share - mean)).sum();
    Wedge { glyph, cover, bins, lines: lines(&bins, ACROSS).collect(), mean, energy }
}

/// The part of a convex area on the side of the line from `a` to `b` where `filled` is.
///
/// Source: I. Sutherland and G. Hodgman, "Reentrant polygon clipping", 1974.
fn cut(area: &[Place], (a, b, filled): (Place, Place, Place)) -> Vec<Place> {
    let beyond = |p: Place| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let side = |p: Place| beyond(p) * beyond(filled).signum();
    let mut inside = Vec::new();
    for (place, &from) in area.iter().enumerate() {
        let to = area[(place + 1) % area.len()];
        let (start, end) = (side(from), side(to));
        if start >= 0.0 {
            inside.push(from);
        }
        if start * end < 0.0 {
            let share = start / (start - end);
            inside.push([from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]);
        }
    }
    inside
}

/// The area of a polygon, by the trapezoids under its edges.
fn area(corners: &[Place]) -> f32 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let twice: f32 = edges.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum();
    twice.abs() / 2.0
}

#[cfg(test)]
mod tests;
