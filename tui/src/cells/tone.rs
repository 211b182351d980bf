//! Letters without colour: tone and shape together, as they look from reading distance.
//!
//! From there an eye sees neither ink nor paper but their mean around each point, and the picture likewise. So letter
//! and picture are blurred by half of a cell's width, as if the cells around were as this one is on average, and
//! compared by lightness in each of 2 x 4 parts.

use super::letters::{LETTERS, Letter};
use super::masks::Cover;
use crate::color::{lightness, luminance};
use spherule_kernel::Vec3;
use std::sync::LazyLock;

/// The luminance of the ink of most terminals: not white, but the grey of 229.
const INK: f32 = 0.78;

/// How each letter looks.
#[derive(Debug)]
pub struct Tones(Vec<Cover>);

/// The weights with which a part sees those next to it in one direction, and the one after.
const TAPS: [f32; 3] = [0.399_05, 0.242_04, 0.054_01];

/// The parts of a cell, blurred.
fn blurred(parts: Cover) -> Cover {
    let mean = parts.iter().sum::<f32>() / 8.0;
    let weight = |a: usize, b: usize| TAPS.get(a.abs_diff(b)).copied().unwrap_or(0.0);
    std::array::from_fn(|part| {
        let (mut sum, mut all) = (0.0, 0.0);
        for (other, value) in parts.iter().enumerate() {
            let weight = weight(part / 2, other / 2) * weight(part % 2, other % 2);
            sum += weight * value;
            all += weight;
        }
        sum + (1.0 - all) * mean
    })
}

impl Tones {
    pub(super) fn of_letters() -> &'static Self {
        static TONES: LazyLock<Tones> = LazyLock::new(|| {
            let look = |letter: &Letter| blurred(letter.cover).map(|cover| lightness(INK * cover));
            Tones(LETTERS.iter().map(look).collect())
        });
        &TONES
    }

    /// The letter that looks most like the light of 2 x 4 parts.
    pub(super) fn nearest(&self, parts: &[Vec3; 8]) -> &'static Letter {
        let wanted = blurred(parts.map(luminance)).map(lightness);
        let distance =
            |look: &Cover| look.iter().zip(&wanted).map(|(a, b)| (a - b) * (a - b)).sum::<f32>();
        let mut best = (f32::INFINITY, 0);
        for (index, look) in self.0.iter().enumerate() {
            let distance = distance(look);
            if distance < best.0 {
                best = (distance, index);
            }
        }
        &LETTERS[best.1]
    }
}
