//! What a station of the lecture is: words, two numbers that arrows change, and a function from these to a drawing.

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

/// A number that arrows change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knob {
    first: i32,
    /// What an arrow to the right adds, and one upwards.
    steps: [i32; 2],
    /// The least and the greatest.
    ends: [i32; 2],
    /// What follows them.
    past: Past,
    /// The greatest that is seen in a picture of so many columns and rows, if that may be less.
    most: Option<fn([i32; 2]) -> i32>,
    /// The side of the picture beside the text along which it leads, if it is the place of a cell.
    side: Option<Side>,
}

/// Where a step leads that would go past an end.
#[derive(Clone, Copy, Debug)]
enum Past {
    /// To the end.
    End,
    /// Nowhere: the number stays.
    Nowhere,
    /// To the other end, around.
    Around,
}

/// A side of a picture.
#[derive(Clone, Copy, Debug)]
enum Side {
    Columns,
    Rows,
}

/// Farther from the middle than any cell of a terminal.
const FAR: i32 = 4096;

impl Knob {
    /// A number within `ends`.
    pub(super) const fn within(first: i32, steps: [i32; 2], ends: [i32; 2]) -> Self {
        Self { first, steps, ends, past: Past::End, most: None, side: None }
    }

    /// A number from 0 to `count` - 1, around in a circle.
    pub(super) const fn around(first: i32, steps: [i32; 2], count: i32) -> Self {
        Self { past: Past::Around, ..Self::within(first, steps, [0, count - 1]) }
    }

    /// One of `count` pixels, in rows of `columns`: on and back, up and down.
    pub(super) const fn pixel(first: i32, columns: i32, count: i32) -> Self {
        let steps = [1, -columns];
        Self { past: Past::Nowhere, ..Self::within(first, steps, [0, count - 1]) }
    }

    /// The same, but in a picture of so many columns and rows no more than `most`.
    pub(super) const fn up_to(self, most: fn([i32; 2]) -> i32) -> Self {
        Self { most: Some(most), ..self }
    }

    /// The column of a cell, from the middle of the picture beside the text.
    pub(super) const fn column(first: i32) -> Self {
        Self { side: Some(Side::Columns), ..Self::within(first, [1, 0], [-FAR, FAR]) }
    }

    /// The row of a cell, downwards from the middle.
    pub(super) const fn row(first: i32) -> Self {
        Self { side: Some(Side::Rows), ..Self::within(first, [0, -1], [-FAR, FAR]) }
    }

    /// The nearest number that is seen in a picture of so many columns and rows.
    fn seen(&self, number: i32, picture: [i32; 2]) -> i32 {
        let number = self.most.map_or(number, |most| number.min(most(picture)));
        let [columns, rows] = picture;
        let count = match self.side {
            None => return number,
            Some(Side::Columns) => columns,
            Some(Side::Rows) => rows,
        };
        number.clamp(-(count / 2), count - 1 - count / 2)
    }

    fn turned(&self, number: i32, turn: Turn) -> i32 {
        let [right, up] = self.steps;
        let step = match turn {
            Turn::Left => -right,
            Turn::Right => right,
            Turn::Up => up,
            Turn::Down => -up,
        };
        let ([least, greatest], next) = (self.ends, number.saturating_add(step));
        match self.past {
            Past::Around => next.rem_euclid(greatest + 1),
            Past::Nowhere if !(least..=greatest).contains(&next) => number,
            Past::End | Past::Nowhere => next.clamp(least, greatest),
        }
    }
}

/// The numbers of a station.
pub(super) type Numbers = [i32; 2];

/// Where the code of a station's subject stands.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// A file, from the root of the repository.
    pub file: &'static str,
    /// What to look for in it.
    pub symbols: &'static [&'static str],
}

/// One screen of the lecture.
#[derive(Debug)]
pub struct Station {
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
    pub(super) knobs: [Knob; 2],
    /// How many columns at the right are for text.
    pub(super) text: i32,
    /// Computes what is shown, draws it, and returns the text; a canvas has at least the room that the least page
    /// leaves.
    pub(super) draw: fn(Numbers, &mut Canvas) -> String,
}

impl Station {
    /// The first numbers.
    pub(super) fn first(&self) -> Numbers {
        self.knobs.map(|knob| knob.first)
    }

    /// The numbers after an arrow.
    pub(super) fn turned(&self, [one, other]: Numbers, turn: Turn) -> Numbers {
        [self.knobs[0].turned(one, turn), self.knobs[1].turned(other, turn)]
    }

    /// The numbers after an arrow, on a canvas of so many columns and rows: no arrow leads past what is seen, from where
    /// another would have to lead back.
    pub(super) fn turned_in(
        &self,
        (columns, rows): (u16, u16),
        numbers: Numbers,
        turn: Turn,
    ) -> Numbers {
        let picture = [i32::from(columns) - self.text, i32::from(rows)];
        let seen = |[one, other]: Numbers| {
            [self.knobs[0].seen(one, picture), self.knobs[1].seen(other, picture)]
        };
        seen(self.turned(seen(numbers), turn))
    }

    /// Draws all of it.
    pub(super) fn show(&self, numbers: Numbers, canvas: &mut Canvas) {
        let text = (self.draw)(numbers, canvas);
        canvas.write_lines(canvas.columns() - self.text + 1, 0, text.lines());
    }
}

/// A number that is read back to the same bits.
pub(super) fn number(x: f32) -> String {
    // Without the sign of -0.
    format!("{:?}", x + 0.0)
}

/// A number with three decimals.
pub(super) fn decimals(x: f32) -> String {
    let text = format!("{x:.3}");
    // Without the sign of what is rounded to 0.
    if text == "-0.000" { "0.000".to_owned() } else { text }
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
