//! What may stay on the screen though something else is wanted.

use super::perceived::Perceived;
use crate::cells::{Cell, Color};

/// Channels that differ by more are no colours that look alike.
const UNLIKE: u8 = 128;

/// How far colours may be from what is wanted, in `OKLab`; of colours that the terminal has no light for, not at all.
/// At first it is zero.
#[derive(Debug, Default)]
pub(super) struct Tolerance {
    most: f32,
    perceived: Perceived,
}

impl Tolerance {
    /// Sets it to `distance`, at most to 0.03, which can be seen.
    pub(super) fn set(&mut self, distance: f32) {
        self.most = distance.clamp(0.0, 0.03);
    }

    /// Whether `a` may be shown for `b`.
    pub(super) fn allows(&self, a: Color, b: Color) -> bool {
        a == b || self.most > 0.0 && self.distance(a, b) <= self.most
    }

    fn distance(&self, a: Color, b: Color) -> f32 {
        let (Color::Rgb(a), Color::Rgb(b)) = (a, b) else { return f32::INFINITY };
        if a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > UNLIKE) {
            return f32::INFINITY;
        }
        self.perceived.color(a).distance(self.perceived.color(b))
    }

    /// Whether ink of this colour is not seen on paper of that one. The terminal's own ink is not its own paper.
    fn hides(&self, ink: Color, paper: Color) -> bool {
        self.most > 0.0 && matches!(ink, Color::Rgb(_)) && self.allows(ink, paper)
    }

    /// Whether `shown` may stay where `wanted` should be: each part that is of one colour in both is near enough. Of
    /// two glyphs no one knows which parts these are, so all may be.
    pub(super) fn lets_stay(&self, shown: &Cell, wanted: &Cell) -> bool {
        if self.most <= 0.0 || !self.allows(shown.background, wanted.background) {
            return false;
        }
        if shown.glyph == wanted.glyph {
            return wanted.glyph == ' ' || self.allows(shown.foreground, wanted.foreground);
        }
        let inks = [(shown, wanted), (wanted, shown)];
        inks.iter().all(|(of, other)| {
            of.glyph == ' '
                || self.hides(of.foreground, other.background)
                    && (other.glyph == ' ' || self.allows(of.foreground, other.foreground))
        })
    }

    /// `cell` without its ink, if that looks alike.
    pub(super) fn without_ink(&self, cell: &Cell) -> Cell {
        let is_alike = cell.glyph != ' ' && self.hides(cell.foreground, cell.background);
        if is_alike { Cell { glyph: ' ', foreground: cell.background, ..*cell } } else { *cell }
    }
}

/// Whether a terminal shows both alike, to the bit: the ink of a space cannot be seen.
pub(super) fn look_same(a: &Cell, b: &Cell) -> bool {
    a.background == b.background
        && a.glyph == b.glyph
        && (a.foreground == b.foreground || a.glyph == ' ')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Srgb, oklab};

    const GREY: Color = Color::Rgb([128; 3]);
    const NEAR: Color = Color::Rgb([129, 128, 128]);
    const FAR: Color = Color::Rgb([150, 128, 128]);

    fn tolerance(distance: f32) -> Tolerance {
        let mut tolerance = Tolerance::default();
        tolerance.set(distance);
        tolerance
    }

    fn cell(glyph: char, foreground: Color, background: Color) -> Cell {
        Cell { glyph, foreground, background }
    }

    #[test]
    fn near_colours_are_allowed_and_others_are_not() {
        let tolerance = tolerance(0.01);
        assert!(tolerance.allows(GREY, NEAR) && !tolerance.allows(GREY, FAR));
        assert!(tolerance.allows(Color::Default, Color::Default));
        assert!(!tolerance.allows(Color::Ansi256(244), GREY));
        let exact = Tolerance::default();
        assert!(!exact.allows(GREY, NEAR) && exact.allows(GREY, GREY));
    }

    /// The quick answer is no other.
    #[test]
    fn channels_that_are_far_apart_are_colours_that_are() {
        for levels in 0..(256 - usize::from(UNLIKE) - 1) {
            let level = levels as u8;
            for channel in 0..3 {
                for rest in [0, 128, 255] {
                    let mut pair = [[rest; 3]; 2];
                    (pair[0][channel], pair[1][channel]) = (level, level + UNLIKE + 1);
                    let [a, b] = pair.map(|color| oklab(Srgb(color).to_linear()));
                    assert!(a.distance(b) > 0.03, "{pair:?}: {}", a.distance(b));
                }
            }
        }
    }

    /// What is written over a picture has the terminal's own colours.
    #[test]
    fn text_is_never_taken_for_blank() {
        let tolerance = tolerance(0.01);
        let text = |glyph| cell(glyph, Color::Default, Color::Default);
        assert_eq!(tolerance.without_ink(&text('x')), text('x'));
        for (shown, wanted) in [(' ', 'x'), ('x', ' '), ('x', 'y')] {
            assert!(!tolerance.lets_stay(&text(shown), &text(wanted)), "{shown} for {wanted}");
        }
    }

    #[test]
    fn a_glyph_stays_for_another_where_neither_can_be_seen() {
        let tolerance = tolerance(0.01);
        let stays = |shown, wanted| tolerance.lets_stay(&shown, &wanted);
        assert!(stays(cell('▀', GREY, NEAR), cell('▌', NEAR, GREY)));
        assert!(stays(cell(' ', FAR, NEAR), cell('▌', NEAR, GREY)));
        assert!(stays(cell('▌', NEAR, GREY), cell(' ', FAR, NEAR)));
        assert!(!stays(cell('▀', GREY, NEAR), cell('▌', NEAR, FAR)));
        assert!(!stays(cell('▀', FAR, NEAR), cell(' ', FAR, NEAR)));
        assert!(!stays(cell('▀', FAR, FAR), cell('▌', NEAR, FAR)));
        assert!(stays(cell('▀', FAR, GREY), cell('▀', FAR, NEAR)));
        assert!(!stays(cell('▀', FAR, GREY), cell('▀', NEAR, GREY)));
    }
}
