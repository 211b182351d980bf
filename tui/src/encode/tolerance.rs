//! What it costs the eye to see another cell than the one that is wanted, and what a byte costs the line.
//!
//! # Method
//!
//! A cell can show what is there already, what the pen's own colours make, or the cell itself. The one whose error + price x bytes is least
//! is taken: then no other choice cell by cell has less error for as many bytes. The error is the squared distance in `OKLab`, in the mean
//! over the cell.
//!
//! Source: G. J. Sullivan, T. Wiegand, "Rate-distortion optimization for video compression", IEEE Signal Processing
//! Magazine 15 (6), 1998.

use super::perceived::Perceived;
use crate::cells::{Cell, Color};
use glam::Vec3;

/// The bytes of a cell of one colour, for which the tolerance is meant: `ESC [ 48;2;r;g;b m` and a blank.
const USUAL_BYTES: f32 = 18.0;
/// No part of a cell may be off by so many times the tolerance ...
const REACH: f32 = 3.0;
/// ... nor by more than this, which can be seen.
const VISIBLE: f32 = 0.03;
/// How much of a cell is ink, unless it has none or nothing else. (Letters have less, and their paper counts for too
/// little then, but is no farther off than `REACH`.)
const INK: f32 = 0.5;

/// What errors cost, in squared distances in `OKLab`. Colours that are not `Rgb` are equal or too far apart. At first nothing may be off.
#[derive(Debug, Default)]
pub(super) struct Tolerance {
    distance: f32,
    /// The largest square of a distance, of any part.
    most: f32,
    price: f32,
    perceived: Perceived,
}

impl Tolerance {
    /// Sets the tolerance to `distance`, at most to 0.03.
    pub(super) fn set(&mut self, distance: f32) {
        self.distance = distance.clamp(0.0, VISIBLE);
        self.most = (REACH * self.distance).min(VISIBLE).powi(2);
        self.price = self.distance * self.distance / USUAL_BYTES;
    }

    /// The error that so many bytes are worth.
    pub(super) fn price(&self, bytes: usize) -> f32 {
        self.price * bytes as f32
    }

    /// The square of the distance of two inks or two papers; infinite if that is too far.
    fn apart(&self, a: Color, b: Color) -> f32 {
        if a == b { 0.0 } else { self.across(a, b) }
    }

    /// The same for an ink and a paper: the terminal's own ink and paper are not alike.
    fn across(&self, a: Color, b: Color) -> f32 {
        let (Color::Rgb(a), Color::Rgb(b)) = (a, b) else { return f32::INFINITY };
        let [a, b]: [Vec3; 2] = [self.perceived.color(a), self.perceived.color(b)];
        self.unless_too_far(a.distance_squared(b))
    }

    /// Returns `square`, or infinity where that is too large for any part of a cell.
    pub(super) fn unless_too_far(&self, square: f32) -> f32 {
        if square <= self.most { square } else { f32::INFINITY }
    }

    /// The colour in `OKLab`.
    pub(super) fn perceived(&self, rgb: [u8; 3]) -> Vec3 {
        self.perceived.color(rgb)
    }

    /// Whether nothing may be off.
    pub(super) fn is_none(&self) -> bool {
        self.distance <= 0.0
    }

    /// The error of `shown` where `wanted` should be; infinite if any part is too far off. How the inks of two different glyphs lie on each
    /// other is not known, and taken to be by chance.
    pub(super) fn error(&self, shown: &Cell, wanted: &Cell) -> f32 {
        if look_same(shown, wanted) {
            return 0.0;
        }
        if self.is_none() {
            return f32::INFINITY;
        }
        let [own, other] = [shown, wanted].map(|cell| ink(cell.glyph));
        let paper = || self.apart(shown.background, wanted.background);
        let inks = || self.apart(shown.foreground, wanted.foreground);
        // A part without a share does not count, however far off it is. Once one part is too far off, no other is computed.
        let add = |sum: f32, share: f32, square: &dyn Fn() -> f32| {
            if share > 0.0 && sum.is_finite() { sum + share * square() } else { sum }
        };
        if shown.glyph == wanted.glyph {
            return add(add(0.0, own, &inks), 1.0 - own, &paper);
        }
        let ink_on_paper = || self.across(shown.foreground, wanted.background);
        let paper_on_ink = || self.across(shown.background, wanted.foreground);
        let sum = add(0.0, (1.0 - own) * other, &paper_on_ink);
        let sum = add(sum, own * (1.0 - other), &ink_on_paper);
        add(add(sum, (1.0 - own) * (1.0 - other), &paper), own * other, &inks)
    }
}

/// How much of a cell is ink.
pub(super) fn ink(glyph: char) -> f32 {
    match glyph {
        ' ' => 0.0,
        '\u{2588}' => 1.0,
        _ => INK,
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
    fn near_colours_have_an_error_and_others_are_too_far() {
        let tolerance = tolerance(0.01);
        assert!(tolerance.apart(GREY, NEAR) < 1e-4 && tolerance.apart(GREY, FAR).is_infinite());
        assert_eq!(tolerance.apart(Color::Default, Color::Default), 0.0);
        assert!(tolerance.apart(Color::Ansi256(244), GREY).is_infinite());
        let [grey, near] = [GREY, NEAR].map(|paper| cell(' ', paper, paper));
        let exact = Tolerance::default();
        assert!(exact.error(&grey, &near).is_infinite() && exact.error(&grey, &grey) == 0.0);
    }

    /// What is written over a picture has the terminal's own colours.
    #[test]
    fn text_is_never_taken_for_blank() {
        let tolerance = tolerance(0.01);
        let text = |glyph| cell(glyph, Color::Default, Color::Default);
        for (shown, wanted) in [(' ', 'x'), ('x', ' '), ('x', 'y')] {
            let error = tolerance.error(&text(shown), &text(wanted));
            assert!(error.is_infinite(), "{shown} for {wanted}");
        }
    }

    #[test]
    fn parts_count_by_their_share_and_none_may_be_far_off() {
        let tolerance = tolerance(0.01);
        let error = |shown, wanted| tolerance.error(&shown, &wanted);
        let near = tolerance.across(GREY, NEAR);
        assert!(near > 0.0 && near < 1e-4, "{near}");
        assert_eq!(error(cell(' ', FAR, GREY), cell(' ', GREY, NEAR)), near);
        assert_eq!(error(cell('\u{2580}', FAR, GREY), cell('\u{2580}', FAR, NEAR)), near / 2.0);
        assert_eq!(error(cell('\u{2580}', GREY, NEAR), cell('\u{258c}', NEAR, GREY)), near / 2.0);
        assert_eq!(error(cell('\u{2580}', GREY, NEAR), cell(' ', FAR, GREY)), near / 2.0);
        assert_eq!(error(cell(' ', FAR, GREY), cell('\u{2588}', NEAR, FAR)), near);
        for (shown, wanted) in [
            (cell('\u{2580}', GREY, NEAR), cell('\u{258c}', NEAR, FAR)),
            (cell('\u{2580}', FAR, NEAR), cell(' ', FAR, NEAR)),
            (cell('\u{2580}', FAR, FAR), cell('\u{258c}', NEAR, FAR)),
            (cell('\u{2580}', FAR, GREY), cell('\u{2580}', NEAR, GREY)),
        ] {
            assert!(error(shown, wanted).is_infinite(), "{shown:?} for {wanted:?}");
        }
    }

    #[test]
    fn a_cell_of_one_colour_stays_within_the_tolerance() {
        let tolerance = tolerance(0.02);
        let bytes = "\u{1b}[48;2;100;100;1m ".len();
        assert!((tolerance.price(bytes).sqrt() - 0.02).abs() < 0.001);
    }

    #[test]
    fn parts_reach_three_times_the_tolerance_and_no_farther_than_is_seen() {
        let grey = |level: u8| cell(' ', GREY, Color::Rgb([level; 3]));
        let reaches = |tolerance: &Tolerance, levels: u8| {
            tolerance.error(&grey(128 + levels), &grey(128)).is_finite()
        };
        // A level is 0.0035.
        assert!(reaches(&tolerance(0.004), 3) && !reaches(&tolerance(0.004), 4));
        assert!(reaches(&tolerance(0.02), 8) && !reaches(&tolerance(0.02), 9));
    }
}
