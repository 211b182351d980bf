//! What one step of back-projection does to pictures whose lack is known.

use super::*;
use crate::cells::masks::repertoire;
use proptest::prelude::*;

/// A cell by the number of its mask, and its colours.
fn cell(mask: usize, [ink, paper]: [Vec3; 2]) -> Fitted {
    let families = &repertoire(Charset::Block).families;
    let masks: Vec<_> = families.iter().flat_map(|family| &family.masks).collect();
    // Now and then a space.
    let Some(mask) = masks.get(mask % (masks.len() + masks.len() / 8)) else {
        return shown(Fitted { ink, paper, ..Fitted::NONE });
    };
    shown(Fitted { glyph: mask.glyph, cover: mask.cover, ink, paper, ..Fitted::NONE })
}

/// The same cell, of a picture that is just what it shows.
fn shown(fit: Fitted) -> Fitted {
    let parts = fit.cover.map(|cover| cover * fit.ink + (1.0 - cover) * fit.paper);
    Fitted { parts, ..fit }
}

fn color(range: Range<f32>) -> impl Strategy<Value = Vec3> {
    (range.clone(), range.clone(), range).prop_map(|(r, g, b)| Vec3::new(r, g, b))
}

/// Columns, and cells of whole rows, with colours in a range.
fn pictures(range: Range<f32>) -> impl Strategy<Value = (usize, Vec<Fitted>)> {
    (1..7_usize, 1..7_usize).prop_flat_map(move |(columns, rows)| {
        let cell = (0..1000_usize, color(range.clone()), color(range.clone()));
        let cell = cell.prop_map(|(mask, ink, paper)| self::cell(mask, [ink, paper]));
        (Just(columns), prop::collection::vec(cell, columns * rows))
    })
}

fn corrected(fits: &[Fitted], columns: usize, rows: Range<usize>) -> Vec<[Vec3; 2]> {
    let mut corrected = Vec::new();
    let handing = Handing::new(1.0, Charset::Half);
    Residual::default().correct(fits, columns, rows, handing, &mut corrected);
    corrected
}

proptest! {
    #[test]
    fn a_picture_that_is_shown_exactly_stays((columns, fits) in pictures(0.0..1.0)) {
        let rows = fits.len() / columns;
        for (fit, [ink, paper]) in fits.iter().zip(corrected(&fits, columns, 0..rows)) {
            prop_assert!((ink - fit.ink).abs().max_element() < 1e-5, "{ink} {}", fit.ink);
            prop_assert!((paper - fit.paper).abs().max_element() < 1e-5, "{paper} {}", fit.paper);
        }
    }

    #[test]
    fn a_constant_lack_comes_back_in_full(
        (columns, mut fits) in pictures(0.3..0.7),
        lack in color(-0.07..0.07),
    ) {
        let rows = fits.len() / columns;
        // Halves: each of their colours has parts of its own.
        for fit in &mut fits {
            *fit = shown(Fitted { cover: Fitted::UPPER.cover, ..*fit });
        }
        let lacking: Vec<Fitted> =
            fits.iter().map(|fit| Fitted { parts: fit.parts.map(|part| part + lack), ..*fit }).collect();
        for (fit, [ink, paper]) in lacking.iter().zip(corrected(&lacking, columns, 0..rows)) {
            prop_assert!((ink - fit.ink - lack).abs().max_element() < 1e-5, "{ink} {}", fit.ink);
            prop_assert!((paper - fit.paper - lack).abs().max_element() < 1e-5, "{paper} {}", fit.paper);
        }
    }

    #[test]
    fn colours_stay_what_a_display_has((columns, fits) in pictures(0.0..1.0), lack in color(-2.0..2.0)) {
        let rows = fits.len() / columns;
        let lacking: Vec<Fitted> =
            fits.iter().map(|fit| Fitted { parts: fit.parts.map(|part| part + lack), ..*fit }).collect();
        for color in corrected(&lacking, columns, 0..rows).iter().flatten() {
            prop_assert!(color.cmpge(Vec3::ZERO).all() && color.cmple(Vec3::ONE).all(), "{color}");
        }
    }

    #[test]
    fn corrections_stay_near_what_was_sampled((columns, mut fits) in pictures(0.0..1.0), lack in color(-2.0..2.0)) {
        fits[0].parts = fits[0].parts.map(|part| (part + lack).clamp(Vec3::ZERO, Vec3::ONE));
        let rows = fits.len() / columns;
        for (fit, [ink, paper]) in fits.iter().zip(corrected(&fits, columns, 0..rows)) {
            let parts = fit.parts.iter().chain([&fit.ink, &fit.paper]);
            let low = parts.clone().fold(Vec3::ONE, |low, &part| low.min(part));
            let high = parts.fold(Vec3::ZERO, |high, &part| high.max(part));
            for color in [ink, paper] {
                prop_assert!(color.cmpge(low - 1e-6).all(), "{color} {low}");
                prop_assert!(color.cmple(high + 1e-6).all(), "{color} {high}");
            }
        }
    }

    #[test]
    fn a_row_is_the_same_whatever_else_is_asked_for(
        (columns, mut fits) in pictures(0.0..1.0),
        lack in prop::collection::vec(color(-0.5..0.5), 36),
    ) {
        let rows = fits.len() / columns;
        for (fit, &lack) in fits.iter_mut().zip(lack.iter().cycle()) {
            fit.parts[3] += lack;
        }
        let all = corrected(&fits, columns, 0..rows);
        for row in 0..rows {
            let expected = &all[row * columns..][..columns];
            prop_assert_eq!(&corrected(&fits, columns, row..row + 1)[..], expected);
            // One row on each side is all that a row depends on: a strip knows no more.
            let known = row.saturating_sub(1)..(row + 2).min(rows);
            let strip = &fits[known.start * columns..known.end * columns];
            let row = row - known.start;
            prop_assert_eq!(&corrected(strip, columns, row..row + 1)[..], expected);
        }
    }
}

/// Papers of 5 x 5 cells of which the middle one lacks light in one part; each has parts that differ from it by this.
fn around_a_lack(contrast: f32, lack: f32) -> Vec<f32> {
    let grey = Vec3::splat(0.5);
    let mut fits = vec![shown(Fitted { ink: grey, paper: grey, ..Fitted::NONE }); 25];
    for fit in &mut fits {
        for (part, light) in fit.parts.iter_mut().enumerate() {
            *light += if (part / 2 + part % 2) % 2 == 0 { contrast } else { -contrast };
        }
    }
    fits[12].parts[2] += Vec3::splat(lack);
    corrected(&fits, 5, 0..5).iter().map(|[_, paper]| paper.x).collect()
}

#[test]
fn what_a_cell_lacks_goes_to_those_around_it() {
    // What comes back is a bell around the part, and adds up to all of it.
    let (with, without) = (around_a_lack(0.1, 0.1), around_a_lack(0.1, 0.0));
    let more: Vec<f32> = with.iter().zip(&without).map(|(with, without)| with - without).collect();
    assert!((8.0 * more.iter().sum::<f32>() - 0.1).abs() < 1e-5, "{more:?}");
    for (cell, &one) in more.iter().enumerate() {
        let (column, row) = (cell % 5, cell / 5);
        // Three parts away: in 2 x 4 a cell.
        let near = (0..=3).contains(&column) && (1..=3).contains(&row);
        assert!(near || one.abs() < 1e-7, "{column} {row}: {one}");
        assert!(one <= more[12]);
    }
    // The part is at the cell's left: more goes there than to the right.
    assert!(more[11] > more[13] && more[13] > 0.0, "{more:?}");
}

#[test]
fn what_is_even_stays_even() {
    for (cell, paper) in around_a_lack(0.0, 0.4).into_iter().enumerate() {
        assert!(cell == 12 || paper.to_bits() == 0.5_f32.to_bits(), "{cell}: {paper}");
    }
}

#[test]
fn of_fine_glyphs_nothing_is_handed_across_a_silhouette() {
    // A dark cell with a sliver of light in it, beside one that lacks light.
    let dark = Vec3::splat(0.01);
    let mut fits = vec![shown(Fitted { ink: dark, paper: dark, ..Fitted::NONE }); 2];
    fits[0].parts[1] = Vec3::splat(0.6);
    fits[1].parts = [Vec3::splat(0.6); 8];
    for (charset, is_handed) in [(Charset::Half, true), (Charset::Block, false)] {
        let mut corrected = Vec::new();
        let handing = Handing::new(1.0, charset);
        Residual::default().correct(&fits, 2, 0..1, handing, &mut corrected);
        assert_eq!(corrected[0][1].x > 0.02, is_handed, "{charset:?}: {}", corrected[0][1]);
    }
}

#[test]
fn a_part_counts_where_some_of_it_is_covered() {
    // A letter covers less than half of any part.
    let bright = Vec3::splat(0.8);
    let mut fit = Fitted { parts: [Vec3::splat(0.2); 8], ..Fitted::NONE };
    fit.parts[3] = bright;
    for (cover, expected) in [(0.05, 0.2), (0.3, 0.8)] {
        fit.cover[3] = cover;
        let [low, high] = limits(&fit, 0, Vec3::splat(0.2), f32::INFINITY);
        assert_eq!((low.x, high.x), (0.2, expected), "{cover}");
    }
}
