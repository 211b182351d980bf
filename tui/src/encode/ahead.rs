//! A colour that suits the cells to come as well.
//!
//! # Method
//!
//! A colour that was sent stays in the pen, and each cell to the right may be drawn with it for a byte. Along a gradient the colour of the
//! first cell suits them worst: all the others lie on one side of it. The mean of the cells has a quarter of that error. So the means of the
//! first two, three and more are tried, and for each the cells to come are foreseen: a cell stays as it is shown, is drawn with the colour
//! that is held, or brings its own, which is held from then on. The mean that costs least is sent.

use super::tolerance::{Tolerance, ink};
use crate::cells::{Cell, Color};
use glam::Vec3;

/// How many cells are foreseen. (With 4 there are as many bytes, and 0.1 dB less; with 8 there are 0.3 % fewer, and it takes 5 % more
/// time.)
const CELLS: usize = 6;
/// The bytes that a cell's own colour counts as. It has some 18, but is no mean of what follows in turn: with 18, 22, 28 and 36 bytes a
/// frame has 38.8, 38.2, 37.6 and 37.1 kB, at 47.8, 47.7, 47.4 and 47.3 dB (with 8 cells foreseen).
const OWN_BYTES: usize = 28;

/// One of the two colours of a cell.
#[derive(Clone, Copy)]
pub(super) enum Layer {
    Ink,
    Paper,
}

/// A colour that a cell wants.
#[derive(Clone, Copy, Default)]
struct Wanted {
    rgb: [u8; 3],
    /// In `OKLab`.
    perceived: Vec3,
    /// How much of the cell has it.
    share: f32,
    /// What it costs to leave the cell as it is.
    kept: f32,
}

/// Returns a colour for a cell, of which `share` has the colour `own`, and for the cells that follow; leaving these as they are has the
/// `errors`.
pub(super) fn color(
    tolerance: &Tolerance,
    layer: Layer,
    (own, share): (Color, f32),
    next: &[Cell],
    errors: &[f32],
) -> Color {
    let Color::Rgb(rgb) = own else { return own };
    let first = Wanted { rgb, perceived: tolerance.perceived(rgb), share, kept: f32::INFINITY };
    let mut wanted = [first; CELLS];
    let mut count = 1;
    for (cell, &error) in next.iter().zip(errors).take(CELLS - 1) {
        let ink = ink(cell.glyph);
        let (color, share) = match layer {
            Layer::Ink => (cell.foreground, ink),
            Layer::Paper => (cell.background, 1.0 - ink),
        };
        if share > 0.0 {
            let Color::Rgb(rgb) = color else { break };
            wanted[count] = Wanted { rgb, perceived: tolerance.perceived(rgb), share, kept: error };
            count += 1;
        }
    }
    cheapest(tolerance, &wanted[..count]).map_or(own, Color::Rgb)
}

/// Returns the mean of the first few of `wanted` that costs least.
fn cheapest(tolerance: &Tolerance, wanted: &[Wanted]) -> Option<[u8; 3]> {
    let (mut perceived, mut light) = (Vec3::ZERO, [0.0; 3]);
    let mut best = (f32::INFINITY, None);
    for (many, next) in (1_u8..).zip(wanted) {
        perceived += next.perceived;
        light = std::array::from_fn(|channel| light[channel] + f32::from(next.rgb[channel]));
        let cost = cost(tolerance, perceived / f32::from(many), wanted, best.0);
        if cost < best.0 {
            best = (cost, Some(light.map(|sum| (sum / f32::from(many)).round() as u8)));
        }
    }
    best.1
}

/// The cost of showing `wanted` if the colour `sent` is sent for the first of them; `most` or more if it is not less than that.
fn cost(tolerance: &Tolerance, sent: Vec3, wanted: &[Wanted], most: f32) -> f32 {
    let error = |held: Vec3, wanted: &Wanted| {
        wanted.share * tolerance.unless_too_far(held.distance_squared(wanted.perceived))
    };
    let (glyph, own) = (tolerance.price(1), tolerance.price(OWN_BYTES));
    let [first, others @ ..] = wanted else { return 0.0 };
    let (mut held, mut cost) = (sent, error(sent, first));
    for next in others {
        if cost >= most {
            break;
        }
        let drawn = glyph + error(held, next);
        if own < drawn.min(next.kept) {
            held = next.perceived;
        }
        cost += next.kept.min(drawn).min(own);
    }
    cost
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper(levels: &[u8], errors: &[f32]) -> Color {
        let mut tolerance = Tolerance::default();
        tolerance.set(0.01);
        let cell = |&level: &u8| Cell { background: Color::Rgb([level; 3]), ..Cell::BLANK };
        let cells: Vec<_> = levels.iter().map(cell).collect();
        color(&tolerance, Layer::Paper, (cells[0].background, 1.0), &cells[1..], errors)
    }

    #[test]
    fn along_a_gradient_the_mean_is_sent() {
        let gradient = [120, 121, 122, 123, 124];
        assert_eq!(paper(&gradient, &[f32::INFINITY; 4]), Color::Rgb([122; 3]));
    }

    #[test]
    fn cells_that_stay_and_cells_that_are_too_far_have_no_say() {
        assert_eq!(paper(&[120, 122, 124], &[0.0; 2]), Color::Rgb([120; 3]));
        assert_eq!(paper(&[120, 200, 200], &[f32::INFINITY; 2]), Color::Rgb([120; 3]));
        assert_eq!(paper(&[120], &[]), Color::Rgb([120; 3]));
    }

    /// A level is 0.0035, and a colour of its own worth the square of 0.0125.
    #[test]
    fn a_colour_is_held_as_long_as_that_is_cheaper_than_another() {
        assert_eq!(paper(&[120, 124], &[f32::INFINITY]), Color::Rgb([122; 3]));
        assert_eq!(paper(&[120, 128], &[f32::INFINITY]), Color::Rgb([120; 3]));
    }
}
