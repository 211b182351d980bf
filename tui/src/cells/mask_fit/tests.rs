//! The fit against the definition of least squares, in double precision over all masks.

use super::*;
use crate::cells::braille::DOT;
use crate::cells::fit::Fitter;
use crate::color::{luminance, roots};
use crate::samples::CellSamples;
use crate::style::{CHAIR, ColorDepth, Style};
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

/// All that have masks, but Braille.
const CHARSETS: [Charset; 5] =
    [Charset::Half, Charset::Quadrant, Charset::Sextant, Charset::Octant, Charset::Block];

fn cells() -> impl Strategy<Value = (Charset, (u32, u32), Vec<Vec3>)> {
    // What need spends, and grids that masks cut through.
    let grids = vec![(2, 2), (4, 8), (4, 12), (8, 8), (8, 12), (3, 4), (5, 6)];
    (prop::sample::select(&CHARSETS), prop::sample::select(grids), 0.01..0.7_f32).prop_flat_map(
        |(charset, grid, contrast)| {
            let light = (0.0..1.0_f32, 0.0..1.0_f32, 0.0..1.0_f32)
                .prop_map(move |(r, g, b)| Vec3::splat(0.3) + contrast * Vec3::new(r, g, b));
            let count = (grid.0 * grid.1) as usize;
            (Just(charset), Just(grid), prop::collection::vec(light, count))
        },
    )
}

fn fitter(eye: Eye, charset: Charset, (across, down): (u32, u32)) -> Fitter {
    let style = Style { charset, depth: ColorDepth::Truecolor, ..Style::PLAIN };
    Fitter::new(&style, eye, CellSamples { across, down })
}

fn fit_for(eye: Eye, charset: Charset, grid: (u32, u32), light: &[Vec3]) -> Fitted {
    fitter(eye, charset, grid).fit(light, &mut FitMemory::default(), None)
}

fn fit(charset: Charset, grid: (u32, u32), light: &[Vec3]) -> Fitted {
    fit_for(Eye::at(CHAIR), charset, grid, light)
}

/// The mean distance of samples to the colours of their layers.
fn missed(values: &[DVec3], filled: &[f64], [ink, paper]: [DVec3; 2]) -> f64 {
    let distances = values.iter().zip(filled).map(|(value, filled)| {
        filled * value.distance(ink) + (1.0 - filled) * value.distance(paper)
    });
    distances.sum::<f64>() / values.len() as f64
}

proptest! {
    #[test]
    fn no_mask_of_least_squares_misses_less((charset, grid, light) in cells()) {
        let fitted = fit(charset, grid, &light);
        let looks = doubles(&light.iter().map(|&light| roots(light)).collect::<Vec<_>>());
        let size = (grid.0 as usize, grid.1 as usize);
        let mut all = candidates(charset, size);
        let variance = unexplained(&looks, &vec![0.5; looks.len()]);
        let by_gain = |one: &&(char, Vec<f64>), other: &&(char, Vec<f64>)| {
            unexplained(&looks, &one.1).total_cmp(&unexplained(&looks, &other.1))
        };
        let best = all.iter().min_by(by_gain).expect("masks").1.clone();
        let gain = variance - unexplained(&looks, &best);
        // Flat: one colour.
        let flat = f64::from(FLAT);
        if fitted.glyph == ' ' {
            prop_assert!(gain < 1.01 * flat, "{:?}: {} was to be gained", charset, gain);
            return Ok(());
        }
        prop_assert!(gain > 0.99 * flat);
        all.extend(WEDGES.iter().map(|wedge| (wedge.glyph, wedge.bins.map(f64::from).to_vec())));
        let filled = &all.iter().find(|(glyph, _)| *glyph == fitted.glyph).expect("a glyph").1;
        let colors = [fitted.ink, fitted.paper].map(|color| roots(color).as_dvec3());
        let left: Vec<f64> = best.iter().map(|filled| 1.0 - filled).collect();
        let means = [mean(&looks, &best), mean(&looks, &left)];
        let (reached, of_means) = (missed(&looks, filled, colors), missed(&looks, &best, means));
        // Distances below what is seen count as alike.
        prop_assert!(reached <= of_means + 0.03, "{:?} {}: {} {}", charset, fitted.glyph, reached, of_means);
    }

    #[test]
    fn the_gain_is_the_variance_taken_away((charset, grid, light) in cells()) {
        let size = (grid.0 as usize, grid.1 as usize);
        let looks: Vec<Vec3> = light.iter().map(|&light| roots(light)).collect();
        let mean_look = looks.iter().sum::<Vec3>() / looks.len() as f32;
        let mut columns = Columns::default();
        columns.take(&looks, size.0);
        let exact = doubles(&looks);
        let variance = unexplained(&exact, &vec![0.5; looks.len()]);
        for family in &repertoire(charset).families {
            let bins = Bins::new((family.across, family.down), grid);
            let (gain, mask) = MaskSearch::new(family).best(&bins.means(&columns).map(|look| look - mean_look));
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
        let fitted = fit_for(Eye::at(f32::INFINITY), charset, grid, &light);
        let whole = light.iter().sum::<Vec3>() / light.len() as f32;
        let parts = fitted.parts.iter().sum::<Vec3>() / 8.0;
        prop_assert!((whole - parts).abs().max_element() < 1e-5);
        // Seen from afar, the two colours have the mean of the cell.
        let area = fitted.cover.iter().sum::<f32>() / 8.0;
        let shown = area * fitted.ink + (1.0 - area) * fitted.paper;
        prop_assert!((whole - shown).abs().max_element() < 1e-5, "{} {}", whole, shown);
    }

    #[test]
    fn a_glyph_that_is_as_good_stays((charset, grid, light) in cells(), noise in prop::collection::vec(-1e-3..1e-3_f32, 96)) {
        let fitter = fitter(Eye::MOVING, charset, grid);
        let mut memory = FitMemory::default();
        let first = fitter.fit(&light, &mut memory, Some(&Fitted::NONE));
        let next: Vec<Vec3> = light.iter().zip(&noise).map(|(&light, &noise)| light + noise).collect();
        let again = fitter.fit(&next, &mut memory, Some(&first));
        let apart = roots(first.ink).distance(roots(first.paper));
        // A change that cannot be seen is allowed.
        if first.glyph == ' ' || light.len() <= FEW || apart < 0.1 {
            return Ok(());
        }
        prop_assert_eq!(again.glyph, first.glyph);
        // A glyph that no such cell can have is not kept.
        let none = Fitted { glyph: 'x', ..first };
        prop_assert_eq!(fitter.fit(&light, &mut memory, Some(&none)).glyph, first.glyph);
    }
}

#[test]
fn what_a_mask_shows_exactly_is_shown_by_it() {
    let (dark, bright) = (Vec3::splat(0.1), Vec3::new(0.9, 0.5, 0.2));
    for charset in CHARSETS {
        for family in &repertoire(charset).families {
            // A grid of samples that every bin is a whole number of.
            let grid = (8, 24);
            for mask in &family.masks {
                let filled = filled(family, mask.bits, grid);
                let light = filled.iter().map(|&part| if part > 0.5 { bright } else { dark });
                let light: Vec<Vec3> = light.collect();
                let fitted = fit(charset, (8, 24), &light);
                // Another family may have the complement, which shows the same.
                let shown =
                    fitted.cover.map(|cover| fitted.paper + cover * (fitted.ink - fitted.paper));
                for (shown, cover) in shown.iter().zip(mask.cover) {
                    let expected = dark + cover * (bright - dark);
                    let error = (*shown - expected).abs().max_element();
                    assert!(error < 1e-5, "{charset:?} {} {}", mask.glyph, fitted.glyph);
                }
                let mut colors = [fitted.ink, fitted.paper];
                colors.sort_by(|one, other| one.x.total_cmp(&other.x));
                let [low, high] = colors;
                assert!((low - dark).abs().max_element() < 1e-5, "{}", mask.glyph);
                assert!((high - bright).abs().max_element() < 1e-5, "{}", mask.glyph);
            }
        }
    }
}

#[test]
fn dots_are_where_it_is_lighter_and_the_farther_the_eye_the_brighter() {
    let (dark, bright) = (Vec3::splat(0.1), Vec3::new(0.2, 0.25, 0.15));
    let glyphs = &repertoire(Charset::Braille).mosaic.2;
    for (bits, &glyph) in glyphs.iter().enumerate().skip(1).take(254) {
        let light: Vec<Vec3> =
            (0..8).map(|bin| if bits >> bin & 1 == 1 { bright } else { dark }).collect();
        let fits = [0.0, CHAIR, f32::INFINITY]
            .map(|distance| fit_for(Eye::at(distance), Charset::Braille, (2, 4), &light));
        for fitted in &fits {
            assert_eq!(fitted.glyph, glyph);
            assert_eq!(fitted.parts.as_slice(), light);
            for (bin, cover) in fitted.cover.iter().enumerate() {
                let expected = if bits >> bin & 1 == 1 { DOT } else { 0.0 };
                assert!((cover - expected).abs() < 1e-6, "{glyph}");
            }
            // Where nothing is cut, the mean of looks is kept.
            let whole = light.iter().map(|&light| roots(light)).sum::<Vec3>() / 8.0;
            let shown =
                roots(fitted.paper) + fitted.share() * (roots(fitted.ink) - roots(fitted.paper));
            let is_cut = fitted.ink.max_element() >= 1.0 || fitted.paper.min_element() <= 0.0;
            let is_kept = (shown - whole).abs().max_element() < 1e-5;
            assert!(is_cut || is_kept, "{glyph}: {shown} {whole}");
        }
        assert!(fits.is_sorted_by_key(|fit| luminance(fit.ink)), "{glyph}");
    }
}
