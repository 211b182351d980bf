//! What may stay on the screen though something else is wanted.

use crate::cells::{Cell, Color};
use crate::color::{Srgb, oklab};

/// Channels that differ by more are no colours that look alike.
const UNLIKE: u8 = 128;

/// How far colours may be from what is wanted, in `OKLab`; of colours that the terminal has no light for, not at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tolerance(f32);

impl Tolerance {
    /// Not at all.
    pub(super) const NONE: Self = Self(0.0);

    /// At most 0.03, which can be seen.
    pub(super) fn new(distance: f32) -> Self {
        Self(distance.clamp(0.0, 0.03))
    }

    /// Whether `a` may be shown for `b`.
    pub(super) fn allows(self, a: Color, b: Color) -> bool {
        a == b || self.0 > 0.0 && distance(a, b) <= self.0
    }

    /// Whether ink of this colour is not seen on paper of that one. The terminal's own ink is not its own paper.
    fn hides(self, ink: Color, paper: Color) -> bool {
        self.0 > 0.0 && matches!(ink, Color::Rgb(_)) && self.allows(ink, paper)
    }

    /// Whether `shown` may stay where `wanted` should be: each part that is of one colour in both is near enough. Of
    /// two glyphs no one knows which parts these are, so all may be.
    pub(super) fn lets_stay(self, shown: &Cell, wanted: &Cell) -> bool {
        if self.0 <= 0.0 || !self.allows(shown.background, wanted.background) {
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
    pub(super) fn without_ink(self, cell: &Cell) -> Cell {
        let is_alike = cell.glyph != ' ' && self.hides(cell.foreground, cell.background);
        if is_alike { Cell { glyph: ' ', foreground: cell.background, ..*cell } } else { *cell }
    }
}

fn distance(a: Color, b: Color) -> f32 {
    let (Color::Rgb(a), Color::Rgb(b)) = (a, b) else { return f32::INFINITY };
    if a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > UNLIKE) {
        return f32::INFINITY;
    }
    oklab(Srgb(a).to_linear()).distance(oklab(Srgb(b).to_linear()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: Color = Color::Rgb([128; 3]);
    const NEAR: Color = Color::Rgb([129, 128, 128]);
    const FAR: Color = Color::Rgb([150, 128, 128]);

    fn cell(glyph: char, foreground: Color, background: Color) -> Cell {
        Cell { glyph, foreground, background }
    }

    #[test]
    fn near_colours_are_allowed_and_others_are_not() {
        let tolerance = Tolerance::new(0.01);
        assert!(tolerance.allows(GREY, NEAR) && !tolerance.allows(GREY, FAR));
        assert!(tolerance.allows(Color::Default, Color::Default));
        assert!(!tolerance.allows(Color::Ansi256(244), GREY));
        assert!(!Tolerance::new(0.0).allows(GREY, NEAR) && Tolerance::new(0.0).allows(GREY, GREY));
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
        let tolerance = Tolerance::new(0.01);
        let text = |glyph| cell(glyph, Color::Default, Color::Default);
        assert_eq!(tolerance.without_ink(&text('x')), text('x'));
        for (shown, wanted) in [(' ', 'x'), ('x', ' '), ('x', 'y')] {
            assert!(!tolerance.lets_stay(&text(shown), &text(wanted)), "{shown} for {wanted}");
        }
    }

    #[test]
    fn a_glyph_stays_for_another_where_neither_can_be_seen() {
        let tolerance = Tolerance::new(0.01);
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
