//! Letters without colour: tone and shape together, as they look from across the room.
//!
//! From there an eye sees neither ink nor paper but their mean around each point, and the picture likewise. So letters
//! and picture are blurred by half of a cell's width and compared by lightness in each of 2 x 4 parts of a cell. Each
//! cell first gets the letter that looks most like its own light; then every other cell, and after that the rest,
//! chooses again beside what its neighbours have: what is too dark here makes up for what is too light there.
//!
//! Source: J. Besag, "On the statistical analysis of dirty pictures", 1986, for the choice cell by cell.

use super::Cell;
use super::fitted::Fitted;
use super::letter::{LETTERS, Letter};
use super::masks::Cover;
use super::residual::TAPS;
use crate::color::{lightness, luminance};
use spherule_kernel::Vec3;
use std::array;
use std::ops::Range;
use std::sync::LazyLock;

/// The luminance of the ink of most terminals: not white, but the grey of 229.
const INK: f32 = 0.78;

/// How far a part is seen in other parts.
const REACH: usize = TAPS.len() / 2;
/// The parts that are seen in a cell: its own 2 x 4 and those around it.
const WIDE: usize = 2 + 2 * REACH;
const HIGH: usize = 4 + 2 * REACH;
/// How many rows of cells around a cell influence its letter.
pub(super) const HALO: usize = 2;

/// The lightness that a cell should have, given the picture's: letters reach 0.6. A cell darker than the first number is paper. The tone is
/// kept up to the second, and above it compressed so far that white comes out as the third.
///
/// Of the values around these that keep the order of tones, these are nearest to the truth: the correlation is 0.97 on flake and 0.93 on
/// marbles. With the first at 0.08 a dark background is full of dots: on flake it gains 2 dB from afar, loses 0.03 of correlation, and
/// looks bad. Where whites are not compressed, FLIP falls by up to 1.3 % (with white at 1.5 and the knee at 0.3 by 1 to 3 %, to 0.91 to
/// 1.01 of chafa's: no curve led to 0.97 in all scenes). But then all that is bright is `@`, and the balls of marbles can no longer be told
/// from the ground.
const TONE: [f32; 3] = [0.093, 0.44, 0.8];

/// In motion, the squared error of the letter of the frame before is multiplied by this, so that it stays if it is about as good: letters
/// of one tone have nothing else in common, and all of their ink changes. (On caffeine the error of changes is 1.6 of chafa's with 1, and
/// 0.86 with 0.5.)
const KEPT: f32 = 0.25;

fn tone(lightness: f32) -> f32 {
    let [black, knee, white] = TONE;
    let tone = (lightness - black).max(0.0) / (1.0 - black);
    if tone < knee { tone } else { knee + (tone - knee) * (white - knee) / (1.0 - knee) }
}

/// How much of a part `x`, `y` of what is around a cell is seen in each of the cell's parts.
static SEEN: LazyLock<Vec<Cover>> = LazyLock::new(|| {
    let weight = |own: usize, other: usize| TAPS.get(other.wrapping_sub(own)).copied();
    let all = (0..WIDE * HIGH).map(|place| {
        array::from_fn(|part| {
            let across = weight(part % 2, place % WIDE).unwrap_or(0.0);
            across * weight(part / 2, place / WIDE).unwrap_or(0.0)
        })
    });
    all.collect()
});

/// The lightness of ink that covers so many 4096ths.
static LIGHTNESS: LazyLock<Vec<f32>> =
    LazyLock::new(|| (0..=4096).map(|cover| lightness(INK * cover as f32 / 4096.0)).collect());

fn shown_lightness(cover: f32) -> f32 {
    LIGHTNESS[((cover * 4096.0) as usize).min(4096)]
}

/// What each letter adds to the parts of its own cell.
static OWN: LazyLock<Vec<Cover>> = LazyLock::new(|| {
    let own = |letter: &Letter| {
        let mut around = [0.0; WIDE * HIGH];
        for (part, cover) in letter.cover.iter().enumerate() {
            around[(part / 2 + REACH) * WIDE + part % 2 + REACH] = *cover;
        }
        seen(&around)
    };
    LETTERS.iter().map(own).collect()
});

fn seen(around: &[f32; WIDE * HIGH]) -> Cover {
    let mut seen = [0.0; 8];
    for (value, weights) in around.iter().zip(&*SEEN) {
        for (seen, weight) in seen.iter_mut().zip(weights) {
            *seen += weight * value;
        }
    }
    seen
}

/// Returns the letter that looks most like what is wanted, beside what is seen of others. A letter that was there before stays if it is
/// about as good.
fn nearest(wanted: &Cover, others: &Cover, before: Option<char>) -> usize {
    let mut best = (f32::INFINITY, 0);
    for (index, own) in OWN.iter().enumerate() {
        let mut distance = 0.0;
        for ((own, other), wanted) in own.iter().zip(others).zip(wanted) {
            let apart = shown_lightness(own + other) - wanted;
            distance += apart * apart;
        }
        if before == Some(LETTERS[index].glyph) {
            distance *= KEPT;
        }
        if distance < best.0 {
            best = (distance, index);
        }
    }
    best.1
}

/// The letter for light of 2 x 4 parts, as if all around were as the cell is on average.
pub(super) fn alone(parts: &[Vec3; 8]) -> &'static Letter {
    let light = parts.map(luminance);
    let mean = light.iter().sum::<f32>() / 8.0;
    let mut around = [mean; WIDE * HIGH];
    for (part, light) in light.iter().enumerate() {
        around[(part / 2 + REACH) * WIDE + part % 2 + REACH] = *light;
    }
    let wanted = seen(&around).map(|light| tone(lightness(light)));
    // The others have the ink that the mean wants, so far as letters have it.
    let ink = (tone(lightness(mean)).powi(3) / INK).min(0.33);
    for y in 0..4 {
        around[(y + REACH) * WIDE + REACH..][..2].fill(0.0);
    }
    let others = seen(&around.map(|light| if light == 0.0 { 0.0 } else { ink }));
    &LETTERS[nearest(&wanted, &others, None)]
}

/// Chooses letters beside each other, and keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct Tones {
    /// What is there of the rows that are looked at: what should be seen, and the letters.
    wanted: Vec<Cover>,
    covers: Vec<Cover>,
    glyphs: Vec<char>,
}

impl Tones {
    /// Returns the letters of `rows` of a picture of so many `columns`. `fits` has the letters that cells get alone. In motion, `before`
    /// has the cells of the frame before, and the row with which they begin.
    pub fn choose(
        &mut self,
        fits: &[Fitted],
        columns: usize,
        rows: Range<usize>,
        before: Option<(&[Cell], usize)>,
    ) -> &[char] {
        let all = fits.len() / columns;
        let near = rows.start.saturating_sub(HALO)..(rows.end + HALO).min(all);
        let fits = &fits[near.start * columns..near.end * columns];
        let height = near.len();
        self.covers.clear();
        self.covers.extend(fits.iter().map(|fit| fit.cover));
        self.glyphs.clear();
        self.glyphs.extend(fits.iter().map(|fit| fit.glyph));
        let light: Vec<_> = fits.iter().map(|fit| fit.parts.map(luminance)).collect();
        self.wanted.clear();
        self.wanted.extend((0..fits.len()).map(|cell| {
            let around = around(&light, columns, height, (cell % columns, cell / columns));
            seen(&around).map(|light| tone(lightness(light)))
        }));

        let glyph_before = |column: usize, row: usize| {
            let (cells, first) = before?;
            Some(cells.get(row.checked_sub(first)? * columns + column)?.glyph)
        };
        for (row, place) in near.clone().enumerate() {
            for column in 0..columns {
                let glyph = glyph_before(column, place);
                let letter =
                    glyph.and_then(|glyph| LETTERS.iter().find(|letter| letter.glyph == glyph));
                if let Some(letter) = letter {
                    self.covers[row * columns + column] = letter.cover;
                }
            }
        }
        for turn in 0..2 {
            for (row, place) in near.clone().enumerate() {
                for column in 0..columns {
                    if (place + column) % 2 != turn {
                        continue;
                    }
                    let cell = row * columns + column;
                    self.covers[cell] = [0.0; 8];
                    let others = seen(&around(&self.covers, columns, height, (column, row)));
                    let before = glyph_before(column, place);
                    let letter = &LETTERS[nearest(&self.wanted[cell], &others, before)];
                    (self.covers[cell], self.glyphs[cell]) = (letter.cover, letter.glyph);
                }
            }
        }
        &self.glyphs[(rows.start - near.start) * columns..(rows.end - near.start) * columns]
    }
}

/// The parts in and around a cell; past the edges the last ones count again.
fn around(
    parts: &[Cover],
    columns: usize,
    rows: usize,
    (column, row): (usize, usize),
) -> [f32; WIDE * HIGH] {
    array::from_fn(|place| {
        let x = (2 * column + place % WIDE).saturating_sub(REACH).min(2 * columns - 1);
        let y = (4 * row + place / WIDE).saturating_sub(REACH).min(4 * rows - 1);
        parts[y / 4 * columns + x / 2][y % 4 * 2 + x % 2]
    })
}
