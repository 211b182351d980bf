//! 16 colours: a cell shows two of them, side by side or as one shade.
//!
//! A cell gets the glyph that was fitted, with the colours nearest to its own, or a shade, of which the eye sees the
//! mean of ink and paper. The one that is nearer to the samples is taken. Both are judged by how ink, paper and, above
//! all, their mean look. A shade of two colours far apart costs something, since it is seen as dots.
//!
//! Some terminals have only eight of the colours for paper. There another is ink alone: a whole block of it, or the rest of the glyph.

use super::fitted::{Fitted, rank};
use super::letter::LETTERS;
use super::masks::opposite;
use super::{Cell, Color};
use crate::color::oklab;
use crate::palette::Entry;
use crate::style::Charset;
use spherule_kernel::Vec3;

/// Glyphs that look even, and how much of the cell they cover.
const BLOCKS: [(char, f32); 3] = [('░', 0.25), ('▒', 0.5), ('▓', 0.75)];
/// All ink.
const FULL: char = '█';
/// Letters that look even; their ink is measured.
const LETTER_SHADES: &str = ".:=+*oxa%#@M";

/// The weight of the look of the whole beside that of ink and paper.
const WHOLE: f32 = 1.0;
/// The weight of the squared distance of two colours where they are dots of a shade.
const DOTS: f32 = 0.02;
/// Entries that are tried for ink and for paper.
const NEAREST: usize = 3;

/// How two palette entries look in one glyph.
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
        let is_ascii = charset == Charset::Ascii;
        let papers = || entries.iter().filter(|entry| entry.is_paper);
        let even = |glyph, ink, paper, look| Shade { glyph, ink, paper, look, cost: 0.0 };
        let mut shades: Vec<_> =
            papers().map(|&Entry { color, look, .. }| even(' ', color, color, look)).collect();
        if let Some(paper) = papers().next().filter(|_| !is_ascii) {
            let inks = entries.iter().filter(|entry| !entry.is_paper);
            shades.extend(inks.map(|ink| even(FULL, ink.color, paper.color, ink.look)));
        }
        for ink in &entries {
            for paper in papers() {
                for &(glyph, share) in &glyphs {
                    let look = oklab(paper.light + share * (ink.light - paper.light));
                    let apart = (ink.look - paper.look).length_squared();
                    let cost = DOTS * share * (1.0 - share) * apart;
                    // Of two that look the same, the one whose ink is lighter is taken, as most are.
                    let is_other = ink.is_paper && ink.look.x < paper.look.x;
                    if apart > 0.0 && (is_ascii || !is_other) {
                        let (ink, paper) = (ink.color, paper.color);
                        shades.push(Shade { glyph, ink, paper, look, cost });
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
        let own = (fit.glyph != ' ').then_some((fit.glyph, share, [ink_look, paper_look]));
        // Where all colours can be paper, it would only be the same again.
        let other = opposite(fit.glyph).filter(|_| self.entries.iter().any(|ink| !ink.is_paper));
        let other = other.map(|glyph| (glyph, 1.0 - share, [paper_look, ink_look]));
        for (glyph, share, [ink_look, paper_look]) in own.into_iter().chain(other) {
            for a in self.nearest(ink_look, |_| true) {
                for b in self.nearest(paper_look, |entry| entry.is_paper) {
                    let mean = oklab(b.light + share * (a.light - b.light));
                    let cost = share * (a.look - ink_look).length_squared()
                        + (1.0 - share) * (b.look - paper_look).length_squared()
                        + WHOLE * (mean - whole).length_squared();
                    if cost < best.0 {
                        let (foreground, background) = (a.color, b.color);
                        best = (cost, Cell { glyph, foreground, background });
                    }
                }
            }
        }
        best.1
    }

    /// The entries that look nearest, of those that `may` be taken.
    fn nearest(&self, look: Vec3, may: impl Fn(&Entry) -> bool) -> [&Entry; NEAREST] {
        let mut nearest = [(f32::NEG_INFINITY, &self.entries[0]); NEAREST];
        for entry in self.entries.iter().filter(|&entry| may(entry)) {
            rank(&mut nearest, (-(entry.look - look).length_squared(), entry));
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
            for (index, color) in (0..).zip(Theme::XTERM.colors) {
                let cell = flat(&shades, color.to_linear());
                assert_eq!((cell.glyph, cell.background), (' ', Color::Ansi16(index)));
            }
        }
    }

    #[test]
    fn between_two_colours_there_are_three_shades() {
        let shades = shades(Charset::Half);
        // Red and yellow: what is between them is orange, which the theme lacks.
        let [red, yellow] = [1, 3].map(|index: usize| Theme::XTERM.colors[index].to_linear());
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
        let [green, blue] = [Srgb([0, 200, 10]), Srgb([10, 0, 230])].map(Srgb::to_linear);
        let cell = shades.cell(&Fitted::UPPER, [green, blue]);
        let expected =
            Cell { glyph: '▀', foreground: Color::Ansi16(2), background: Color::Ansi16(4) };
        assert_eq!(cell, expected);
    }

    #[test]
    fn two_greys_that_one_colour_is_nearest_to_are_told_apart() {
        let shades = shades(Charset::Half);
        let [one, other] = [Srgb([0x82; 3]), Srgb([0xa0; 3])].map(Srgb::to_linear);
        let nearest = |light| shades.nearest(oklab(light), |_| true)[0].color;
        assert_eq!(nearest(one), nearest(other));
        assert_ne!(flat(&shades, one), flat(&shades, other));
    }

    #[test]
    fn where_eight_colours_can_be_paper_no_other_is() {
        let theme = Theme { papers: 8, ..Theme::VGA };
        let upper = Fitted::UPPER;
        for charset in [Charset::Ascii, Charset::Half, Charset::Block] {
            let shades = Shades::new(entries(ColorDepth::Ansi16, &theme), charset);
            for ink in theme.colors.map(Srgb::to_linear) {
                for paper in theme.colors.map(Srgb::to_linear) {
                    let cells = [shades.cell(&upper, [ink, paper]), flat(&shades, paper)];
                    for cell in cells {
                        assert!(matches!(cell.background, Color::Ansi16(0..8)), "{cell:?}");
                    }
                }
            }
        }
        // What is bright all the same is ink.
        let shades = Shades::new(entries(ColorDepth::Ansi16, &theme), Charset::Half);
        let [black, white] = [Color::Ansi16(0), Color::Ansi16(15)];
        let cell = |glyph| Cell { glyph, foreground: white, background: black };
        assert_eq!(flat(&shades, Vec3::ONE), cell(FULL));
        assert_eq!(shades.cell(&upper, [Vec3::ONE, Vec3::ZERO]), cell('▀'));
        assert_eq!(shades.cell(&upper, [Vec3::ZERO, Vec3::ONE]), cell('▄'));
    }
}
