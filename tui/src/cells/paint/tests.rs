//! When a cell of 256 colours that showed one colour goes on to show one.

use super::*;

/// Cells of a picture in motion whose halves are grey and `apart` in `OKLab`, of many shades; a cell before had one
/// colour, or was of no use. Returns how many cells show two colours.
fn in_two_colors(apart: f32, had_one: bool) -> usize {
    let style = Style { depth: ColorDepth::Ansi256, charset: Charset::Half, ..Style::PLAIN };
    // Of grey, lightness is the cube root of its light.
    let grey = |lightness: f32| Vec3::splat(lightness.powi(3));
    let halves: Vec<Fitted> = (0..200)
        .map(|shade| 0.3 + 0.003 * shade as f32)
        .map(|lightness| Fitted {
            glyph: '▀',
            cover: [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            ink: grey(lightness + apart / 2.0),
            paper: grey(lightness - apart / 2.0),
            ..Fitted::NONE
        })
        .collect();
    let means = halves.iter().map(|fit| {
        let mean = (fit.ink + fit.paper) / 2.0;
        Fitted { ink: mean, paper: mean, ..Fitted::NONE }
    });
    let (means, count) = (means.collect::<Vec<_>>(), halves.len());

    let mut painter = Painter::default();
    let mut before = vec![Cell::BLANK; count];
    painter.paint((&style, Eye::MOVING, false), (&means, 0), count, 0, &mut before, None);
    let mut cells = vec![Cell::BLANK; count];
    let before = had_one.then_some((&before[..], 0));
    painter.paint((&style, Eye::MOVING, false), (&halves, 0), count, 0, &mut cells, before);
    cells.iter().filter(|cell| cell.glyph != ' ').count()
}

#[test]
fn one_color_stays_one_while_both_are_alike() {
    // Below the border, where half of it would show two; above it some do.
    assert!(in_two_colors(0.047, false) > 50);
    assert_eq!(in_two_colors(0.047, true), 0);
    assert!(in_two_colors(0.053, true) > 0);
}
