//! When a cell of 256 colours that showed one colour goes on to show one.

use super::*;

const STYLE: Style = Style { depth: ColorDepth::Ansi256, charset: Charset::Half, ..Style::PLAIN };

/// Cells whose halves are grey and `apart` in `OKLab`, of many shades; and cells of their means.
fn halves_and_means(apart: f32) -> [Vec<Fitted>; 2] {
    // Of grey, lightness is the cube root of its light.
    let grey = |lightness: f32| Vec3::splat(lightness.powi(3));
    let halves: Vec<Fitted> = (0..200)
        .map(|shade| 0.3 + 0.003 * shade as f32)
        .map(|lightness| Fitted {
            ink: grey(lightness + apart / 2.0),
            paper: grey(lightness - apart / 2.0),
            ..Fitted::UPPER
        })
        .collect();
    let means = halves.iter().map(|fit| {
        let mean = (fit.ink + fit.paper) / 2.0;
        Fitted { ink: mean, paper: mean, ..Fitted::NONE }
    });
    let means: Vec<Fitted> = means.collect();
    [halves, means]
}

/// Rows of a picture in motion, from row `first` on, of so many columns.
fn painted(
    fits: &[Fitted],
    columns: usize,
    first: usize,
    before: Option<(&[Cell], usize)>,
) -> Vec<Cell> {
    let mut cells = vec![Cell::BLANK; fits.len() - first * columns];
    let how = (&STYLE, Eye::MOVING, false);
    Painter::default().paint(how, (fits, 0), columns, first, &mut cells, before);
    cells
}

fn in_two_colors(cells: &[Cell]) -> usize {
    cells.iter().filter(|cell| cell.glyph != ' ').count()
}

#[test]
fn one_color_stays_one_while_both_are_alike() {
    let paint = |apart, had_one: bool| {
        let [halves, means] = halves_and_means(apart);
        let before = painted(&means, 200, 0, None);
        let cells = painted(&halves, 200, 0, had_one.then_some((&before[..], 0)));
        (before, cells)
    };
    // Below the border, where half of it would show two; above it some do.
    assert!(in_two_colors(&paint(0.047, false).1) > 50);
    assert!(in_two_colors(&paint(0.053, true).1) > 0);
    // The one colour is that of the mean.
    let (before, cells) = paint(0.047, true);
    assert_eq!(cells, before);
}

/// A band finds its cells in a frame that begins above it, or with it.
#[test]
fn a_band_is_painted_as_in_the_whole() {
    let [halves, means] = halves_and_means(0.047);
    let before = painted(&means, 20, 0, None);
    let whole = painted(&halves, 20, 0, Some((&before[..], 0)));
    assert_eq!(in_two_colors(&whole), 0);
    for known in 0..=4 {
        let band = painted(&halves, 20, 4, Some((&before[20 * known..], known)));
        assert_eq!(band, whole[80..], "from row {known} on");
    }
}
