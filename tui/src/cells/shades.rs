//! 16 colours: a cell shows two of them, side by side or as one shade.
//!
//! A cell gets the glyph that was fitted, with the colours nearest to its own, or a shade, of which the eye sees the
//! mean of ink and paper. The one that is nearer to the samples is taken. Both are judged by how ink, paper and, above
//! all, their mean look. A shade of two colours far apart costs something, since it is seen as dots.

use super::fitted::Fitted;
use super::letter::LETTERS;
use super::{Cell, Color};
use crate::color::oklab;
use crate::palette::Entry;
use crate::style::Charset;
use spherule_kernel::Vec3;

/// Glyphs that look even, and how much of the cell they cover.
const BLOCKS: [(char, f32); 3] = [('░', 0.25), ('▒', 0.5), ('▓', 0.75)];
/// Letters that look even; their ink is measured.
const LETTER_SHADES: &str = ".:=+*oxa%#@M";

/// The weight of the look of the whole beside that of ink and paper.
const WHOLE: f32 = 1.0;
/// The weight of the squared distance of two colours where they are dots of a shade.
const DOTS: f32 = 0.02;
/// Entries that are tried for ink and for paper.
const NEAREST: usize = 3;

/// Two entries and a glyph: what they look like together.
#[derive(Clone, Copy, Debug)]
struct Shade {
    glyph: char,
    ink: Color,
    paper: Color,
    look: Vec3,
    cost: f32,
}

/// Finds the two colours of a cell.
#[derive(Clone, Debug, Default)]
pub struct Shades {
    entries: Vec<Entry>,
    shades: Vec<Shade>,
}

impl Shades {
    /// Takes colours from `entries`, and shades from glyphs that go with `charset`.
    #[must_use]
    pub fn new(entries: Vec<Entry>, charset: Charset) -> Self {
        let glyphs: Vec<_> = match charset {
            Charset::Ascii => {
                let shade = |glyph| LETTERS.iter().find(|letter| letter.glyph == glyph);
                let letters = LETTER_SHADES.chars().filter_map(shade);
                letters.map(|letter| (letter.glyph, letter.mean)).collect()
            }
            _ => BLOCKS.to_vec(),
        };
        let mut shades: Vec<_> = entries
            .iter()
            .map(|&Entry { color, look, .. }| Shade {
                glyph: ' ',
                ink: color,
                paper: color,
                look,
                cost: 0.0,
            })
            .collect();
        for ink in &entries {
            for paper in &entries {
                for &(glyph, share) in &glyphs {
                    let look = oklab(paper.light + share * (ink.light - paper.light));
                    let apart = (ink.look - paper.look).length_squared();
                    let cost = DOTS * share * (1.0 - share) * apart;
                    // Of two that look the same, the one whose ink is lighter is taken, as most are.
                    if apart > 0.0 && (charset == Charset::Ascii || ink.look.x >= paper.look.x) {
                        shades.push(Shade {
                            glyph,
                            ink: ink.color,
                            paper: paper.color,
                            look,
                            cost,
                        });
                    }
                }
            }
        }
        Self { entries, shades }
    }

    /// The cell that looks most like `fit` with these colours of ink and paper.
    #[must_use]
    pub fn cell(&self, fit: &Fitted, [ink, paper]: [Vec3; 2]) -> Cell {
        let share = fit.share();
        let (ink_look, paper_look) = (oklab(ink), oklab(paper));
        let whole = oklab(paper + share * (ink - paper));
        let mut best = (f32::INFINITY, Cell::BLANK);
        for shade in &self.shades {
            let apart = |look: Vec3| (shade.look - look).length_squared();
            let cost = share * apart(ink_look)
                + (1.0 - share) * apart(paper_look)
                + WHOLE * apart(whole)
                + shade.cost;
            if cost < best.0 {
                let &Shade { glyph, ink, paper, .. } = shade;
                best = (cost, Cell { glyph, foreground: ink, background: paper });
            }
        }
        if fit.glyph != ' ' {
            for a in self.nearest(ink_look) {
                for b in self.nearest(paper_look) {
                    let mean = oklab(b.light + share * (a.light - b.light));
                    let cost = share * (a.look - ink_look).length_squared()
                        + (1.0 - share) * (b.look - paper_look).length_squared()
                        + WHOLE * (mean - whole).length_squared();
                    if cost < best.0 {
                        let (foreground, background) = (a.color, b.color);
                        best = (cost, Cell { glyph: fit.glyph, foreground, background });
                    }
                }
            }
        }
        best.1
    }

    /// The entries that look nearest.
    fn nearest(&self, look: Vec3) -> [&Entry; NEAREST] {
        let mut nearest = [(f32::INFINITY, &self.entries[0]); NEAREST];
        for entry in &self.entries {
            let mut next = ((entry.look - look).length_squared(), entry);
            for place in &mut nearest {
                if next.0 < place.0 {
                    std::mem::swap(place, &mut next);
                }
            }
        }
        nearest.map(|(_, entry)| entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::palette::{Theme, entries};
    use crate::style::ColorDepth;

    fn shades(charset: Charset) -> Shades {
        Shades::new(entries(ColorDepth::Ansi16, &Theme::XTERM), charset)
    }

    fn flat(shades: &Shades, light: Vec3) -> Cell {
        shades.cell(&Fitted::NONE, [light; 2])
    }

    #[test]
    fn a_colour_of_the_theme_is_a_space() {
        for charset in [Charset::Ascii, Charset::Half, Charset::Block] {
            let shades = shades(charset);
            for (index, color) in (0..).zip(Theme::XTERM.0) {
                let cell = flat(&shades, color.to_linear());
                assert_eq!((cell.glyph, cell.background), (' ', Color::Ansi16(index)));
            }
        }
    }

    #[test]
    fn between_two_colours_there_are_three_shades() {
        let shades = shades(Charset::Half);
        // Red and yellow: what is between them is orange, which the theme lacks.
        let [red, yellow] = [1, 3].map(|index: usize| Theme::XTERM.0[index].to_linear());
        for (glyph, share) in BLOCKS {
            let cell = flat(&shades, red + share * (yellow - red));
            let expected =
                Cell { glyph, foreground: Color::Ansi16(3), background: Color::Ansi16(1) };
            assert_eq!(cell, expected);
        }
    }

    #[test]
    fn halves_are_kept_where_they_differ() {
        let shades = shades(Charset::Half);
        let fit =
            Fitted {
                glyph: '▀', cover: [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0], ..Fitted::NONE
            };
        let [green, blue] = [Srgb([0, 200, 10]), Srgb([10, 0, 230])].map(Srgb::to_linear);
        let cell = shades.cell(&fit, [green, blue]);
        let expected =
            Cell { glyph: '▀', foreground: Color::Ansi16(2), background: Color::Ansi16(4) };
        assert_eq!(cell, expected);
    }

    #[test]
    fn two_greys_that_one_colour_is_nearest_to_are_told_apart() {
        let shades = shades(Charset::Half);
        let [one, other] = [Srgb([0x82; 3]), Srgb([0xa0; 3])].map(Srgb::to_linear);
        assert_eq!(shades.nearest(oklab(one))[0].color, shades.nearest(oklab(other))[0].color);
        assert_ne!(flat(&shades, one), flat(&shades, other));
    }
}
