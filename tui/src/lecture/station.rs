//! What a station of the lecture is, and how it writes numbers.

use super::canvas::Canvas;
use spherule_kernel::Vec3;

/// An arrow key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    Left,
    Right,
    Up,
    Down,
}

impl Turn {
    /// Steps to the right, and steps upwards.
    pub(super) fn steps(self) -> (i32, i32) {
        match self {
            Self::Left => (-1, 0),
            Self::Right => (1, 0),
            Self::Up => (0, 1),
            Self::Down => (0, -1),
        }
    }
}

/// One screen of the lecture.
pub(super) trait Station {
    /// An arrow changes the numbers.
    fn turn(&mut self, turn: Turn);

    /// Computes what is shown, and draws it; a canvas has at least the room that the least page leaves.
    fn draw(&self, canvas: &mut Canvas);
}

/// Where the code of a station's subject stands.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// A file, from the root of the repository.
    pub file: &'static str,
    /// What to look for in it.
    pub symbols: &'static [&'static str],
}

/// A station, and what is said about it.
#[derive(Debug)]
pub struct Entry {
    /// In a word: what `--station` takes besides the number.
    pub name: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// The part of the lecture.
    pub topic: &'static str,
    /// What it shows, in two lines.
    pub(super) words: [&'static str; 2],
    /// What the arrows do.
    pub(super) arrows: &'static str,
    /// The code that does it.
    pub sources: &'static [Source],
    /// Makes it, with its first numbers.
    pub(super) start: fn() -> Box<dyn Station>,
}

/// A number that is read back to the same bits.
pub(super) fn number(x: f32) -> String {
    // Without the sign of -0.
    format!("{:?}", x + 0.0)
}

/// As [`number`], coordinate by coordinate.
pub(super) fn vector(v: Vec3) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// A vector in the plane that charts show.
pub(super) fn flat(v: Vec3) -> String {
    format!("({}, {})", number(v.x), number(v.y))
}

/// The unit vector at so many degrees from x towards y, in that plane.
pub(super) fn at_degrees(degrees: i32) -> Vec3 {
    let (sin, cos) = (degrees as f32).to_radians().sin_cos();
    Vec3::new(cos, sin, 0.0)
}
