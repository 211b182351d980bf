//! The fit against the definition of least squares, in double precision over all masks.

use super::*;
use crate::color::roots;
use crate::samples::CellSamples;
use crate::style::ColorDepth;
use glam::DVec3;
use proptest::prelude::*;

/// How much of each sample a mask fills; in whole numbers, over points that both grids divide.
fn filled(family: &Family, bits: u8, (width, height): (usize, usize)) -> Vec<f64> {
    let mut filled = vec![0_usize; width * height];
    for y in 0..height * family.down {
        for x in 0..width * family.across {
            let bin = y / height * family.across + x / width;
            filled[y / family.down * width + x / family.across] += usize::from(bits >> bin & 1);
        }
    }
    filled.iter().map(|&count| count as f64 / family.bins() as f64).collect()
}

/// The mean of values, by their weights.
fn mean(values: &[DVec3], weights: &[f64]) -> DVec3 {
    let sum = values.iter().zip(weights).map(|(&value, &weight)| weight * value).sum::<DVec3>();
    sum / weights.iter().sum::<f64>()
}

/// The mean square of what two colours, the best for this mask, do not show.
fn unexplained(values: &[DVec3], filled: &[f64]) -> f64 {
    let left: Vec<f64> = filled.iter().map(|filled| 1.0 - filled).collect();
    let (ink, paper) = (mean(values, filled), mean(values, &left));
    let squares = values.iter().zip(filled).map(|(&value, &filled)| {
        filled * value.distance_squared(ink) + (1.0 - filled) * value.distance_squared(paper)
    });
    squares.sum::<f64>() / values.len() as f64
}

/// How far a gain in single precision may be from the truth: sums of looks below 2 are squared.
fn rounding(gain: f64) -> f64 {
    1e-10 + 2e-6 * gain.sqrt() + 1e-5 * gain
}

fn doubles(values: &[Vec3]) -> Vec<DVec3> {
    values.iter().map(|value| value.as_dvec3()).collect()
}

/// Every mask of a charset that is no finer than the samples: its glyph, and what it fills of each.
fn candidates(charset: Charset, grid: (usize, usize)) -> Vec<(char, Vec<f64>)> {
    let families = repertoire(charset).families.iter();
    let fine = families.filter(|family| family.across <= grid.0 && family.down <= grid.1);
    fine.flat_map(|family| {
        let masks = family.masks.iter();
        masks.map(move |mask| (mask.glyph, filled(family, mask.bits, grid)))
    })
    .collect()
}

fn cells() -> impl Strategy<Value = (Charset, (u32, u32), Vec<Vec3>)> {
    let charsets =
        vec![Charset::Half, Charset::Quadrant, Charset::Sextant, Charset::Octant, Charset::Block];
    // What need spends, and grids that masks cut through.
    let grids = vec![(2, 2), (4, 8), (4, 12), (8, 12), (3, 4), (5, 6)];
    (prop::sample::select(charsets), prop::sample::select(grids), 0.01..1.0_f32).prop_flat_map(
        |(charset, grid, contrast)| {
            let light = (0.0..1.0_f32, 0.0..1.0_f32, 0.0..1.0_f32)
                .prop_map(move |(r, g, b)| Vec3::splat(0.3) + contrast * Vec3::new(r, g, b));
            let count = (grid.0 * grid.1) as usize;
            (Just(charset), Just(grid), prop::collection::vec(light, count))
        },
    )
}

fn fit(charset: Charset, (across, down): (u32, u32), light: &[Vec3]) -> Fitted {
    let style = Style { charset, depth: ColorDepth::Truecolor, ..Style::PLAIN };
    Fitter::new(&style, CellSamples { across, down }).fit(light, &mut Vec::new())
}

proptest! {
    #[test]
    fn the_mask_is_that_of_least_squares((charset, grid, light) in cells()) {
        let fitted = fit(charset, grid, &light);
        let looks = doubles(&light.iter().map(|&light| roots(light)).collect::<Vec<_>>());
        let all = candidates(charset, (grid.0 as usize, grid.1 as usize));
        let variance = unexplained(&looks, &vec![0.5; looks.len()]);
        let least = all.iter().map(|(_, filled)| unexplained(&looks, filled));
        let least = least.fold(variance, f64::min);
        let gain = variance - least;

        // Flat or without a mask that helps: one colour.
        let flat = f64::from(FLAT);
        let chosen = all.iter().find(|(glyph, _)| *glyph == fitted.glyph);
        let Some((_, filled)) = chosen else {
            prop_assert_eq!(fitted.glyph, ' ');
            prop_assert!(gain < 1.01 * flat, "{:?}: {} was to be gained", charset, gain);
            return Ok(());
        };
        prop_assert!(gain > 0.99 * flat);
        let reached = variance - unexplained(&looks, filled);
        prop_assert!(reached >= gain - 2.0 * rounding(gain), "{:?} {}: {} of {}", charset, fitted.glyph, reached, gain);

        // Colours are means in linear light.
        let lights = doubles(&light);
        let left: Vec<f64> = filled.iter().map(|filled| 1.0 - filled).collect();
        let ink = mean(&lights, filled).as_vec3();
        let paper = mean(&lights, &left).as_vec3();
        prop_assert!((fitted.ink - ink).abs().max_element() < 1e-5, "{} {}", fitted.ink, ink);
        prop_assert!((fitted.paper - paper).abs().max_element() < 1e-5, "{} {}", fitted.paper, paper);
    }

    #[test]
    fn the_gain_is_the_variance_taken_away((charset, grid, light) in cells()) {
        let looks: Vec<Vec3> = light.iter().map(|&light| roots(light)).collect();
        let mean_look = looks.iter().sum::<Vec3>() / looks.len() as f32;
        let exact = doubles(&looks);
        let variance = unexplained(&exact, &vec![0.5; looks.len()]);
        let size = (grid.0 as usize, grid.1 as usize);
        for family in &repertoire(charset).families {
            let bins = Bins::new((family.across, family.down), grid);
            let (gain, mask) = best_mask(family, &bins.means(&looks).map(|look| look - mean_look));
            let taken = variance - unexplained(&exact, &filled(family, mask.bits, size));
            let error = (f64::from(gain) - taken).abs();
            prop_assert!(error <= rounding(taken), "{:?} {}: {} {}", charset, mask.glyph, gain, taken);
        }
    }

    #[test]
    fn a_cell_of_one_colour_is_a_space(
        (charset, grid, light) in cells(),
        color in (0.0..1.0_f32, 0.0..1.0_f32, 0.0..1.0_f32),
    ) {
        let color = Vec3::new(color.0, color.1, color.2);
        let fitted = fit(charset, grid, &vec![color; light.len()]);
        prop_assert_eq!(fitted.glyph, ' ');
        prop_assert_eq!(fitted.cover, [0.0; 8]);
        for shown in [fitted.ink, fitted.paper].iter().chain(&fitted.parts) {
            prop_assert!((*shown - color).abs().max_element() < 1e-5, "{} {}", shown, color);
        }
    }

    #[test]
    fn parts_are_what_was_sampled((charset, grid, light) in cells()) {
        let fitted = fit(charset, grid, &light);
        let whole = light.iter().sum::<Vec3>() / light.len() as f32;
        let parts = fitted.parts.iter().sum::<Vec3>() / 8.0;
        prop_assert!((whole - parts).abs().max_element() < 1e-5);
        // The two colours have the mean of the cell.
        let area = fitted.cover.iter().sum::<f32>() / 8.0;
        let shown = area * fitted.ink + (1.0 - area) * fitted.paper;
        prop_assert!((whole - shown).abs().max_element() < 1e-5, "{} {}", whole, shown);
    }
}

#[test]
fn what_a_mask_shows_exactly_is_shown_by_it() {
    let (dark, bright) = (Vec3::splat(0.1), Vec3::new(0.9, 0.5, 0.2));
    for charset in
        [Charset::Half, Charset::Quadrant, Charset::Sextant, Charset::Octant, Charset::Block]
    {
        for family in &repertoire(charset).families {
            // A grid of samples that every bin is a whole number of.
            let grid = (8, 24);
            for mask in &family.masks {
                let light: Vec<Vec3> = filled(family, mask.bits, grid)
                    .iter()
                    .map(|&filled| if filled > 0.5 { bright } else { dark })
                    .collect();
                let fitted = fit(charset, (8, 24), &light);
                // Another family may have the complement, which shows the same.
                let shown =
                    fitted.cover.map(|cover| fitted.paper + cover * (fitted.ink - fitted.paper));
                for (shown, cover) in shown.iter().zip(mask.cover) {
                    let expected = dark + cover * (bright - dark);
                    let error = (*shown - expected).abs().max_element();
                    assert!(error < 1e-5, "{charset:?} {} {}", mask.glyph, fitted.glyph);
                }
                let [low, high] = if fitted.ink.x > fitted.paper.x {
                    [fitted.paper, fitted.ink]
                } else {
                    [fitted.ink, fitted.paper]
                };
                assert!((low - dark).abs().max_element() < 1e-5, "{}", mask.glyph);
                assert!((high - bright).abs().max_element() < 1e-5, "{}", mask.glyph);
            }
        }
    }
}

#[test]
fn dots_are_where_it_is_lighter_and_make_up_for_what_they_leave() {
    let (dark, bright) = (Vec3::splat(0.1), Vec3::new(0.2, 0.25, 0.15));
    let glyphs = &repertoire(Charset::Braille).mosaic.2;
    for (bits, &glyph) in glyphs.iter().enumerate().skip(1).take(254) {
        let light: Vec<Vec3> =
            (0..8).map(|bin| if bits >> bin & 1 == 1 { bright } else { dark }).collect();
        let fitted = fit(Charset::Braille, (2, 4), &light);
        assert_eq!(fitted.glyph, glyph);
        assert_eq!(fitted.parts.as_slice(), light);
        for (bin, cover) in fitted.cover.iter().enumerate() {
            assert!((cover - if bits >> bin & 1 == 1 { DOT } else { 0.0 }).abs() < 1e-6, "{glyph}");
        }
        assert!((fitted.paper - dark).abs().max_element() < 1e-6, "{glyph}");
        let whole = light.iter().sum::<Vec3>() / 8.0;
        let share = fitted.cover.iter().sum::<f32>() / 8.0;
        let shown = fitted.paper + share * (fitted.ink - fitted.paper);
        assert!((shown - whole).abs().max_element() < 1e-5, "{glyph}: {shown} {whole}");
    }
}
