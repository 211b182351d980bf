//! 256 colours: what none of them is, four of them are together.
//!
//! A colour is mixed of four entries of the palette, chosen one after the other so that the mean so far looks most
//! like it; an entry that looks far from it costs something, since it is seen as a dot. Sorted by lightness, each of
//! four neighbours in a square shows one; in a cell of one colour the halves side by side show the lightest and the
//! darkest, and in the next row the other two, which is finer still. Which one depends on the place alone: a picture
//! at rest stays as it is, and what moves takes no pattern along.
//!
//! Source: J. Yliluoma, "Arbitrary-palette positional dithering algorithm", 2011, the second; by distance in `OKLab`
//! of means in linear light.

use super::Color;
use crate::color::{Srgb, oklab};
use crate::palette::Entry;
use spherule_kernel::Vec3;
use std::collections::HashMap;

/// Entries of a mix.
const MIX: usize = 4;
/// How many of the entries are looked at: those that look nearest.
const NEAREST: usize = 16;
/// What the squared distance of an entry itself counts beside that of the mean.
const DOT: f32 = 0.05;
/// Which of a mix each place of a square shows, so that two of a row or column differ as little as can be.
const ORDER: [[usize; 2]; 2] = [[0, 2], [3, 1]];

/// Mixes that are remembered: some frames' worth.
const MOST_KEPT: usize = 1 << 16;

/// Finds mixes, and remembers them.
#[derive(Clone, Debug, Default)]
pub struct Dither {
    entries: Vec<Entry>,
    mixes: HashMap<Srgb, [Color; MIX]>,
}

impl Dither {
    /// Of these entries.
    #[must_use]
    pub fn new(entries: Vec<Entry>) -> Self {
        Self { entries, mixes: HashMap::new() }
    }

    /// What the place `(x, y)` shows of a colour, which is rounded to 8 bits a channel.
    #[must_use]
    pub fn color(&mut self, light: Vec3, (x, y): (usize, usize)) -> Color {
        self.mix_of(light)[ORDER[y % 2][x % 2]]
    }

    /// The two that a cell of row `y` shows of a colour, side by side.
    #[must_use]
    pub fn pair(&mut self, light: Vec3, y: usize) -> [Color; 2] {
        let mix = self.mix_of(light);
        if y.is_multiple_of(2) { [mix[0], mix[3]] } else { [mix[1], mix[2]] }
    }

    fn mix_of(&mut self, light: Vec3) -> [Color; MIX] {
        let color = Srgb::from_linear(light);
        if let Some(mix) = self.mixes.get(&color) {
            return *mix;
        }
        let mix = self.mix(color.to_linear());
        if self.mixes.len() == MOST_KEPT {
            self.mixes.clear();
        }
        self.mixes.insert(color, mix);
        mix
    }

    fn mix(&self, light: Vec3) -> [Color; MIX] {
        let look = oklab(light);
        let distance = |entry: &Entry| (entry.look - look).length_squared();
        let mut near: Vec<_> = self.entries.iter().map(|entry| (distance(entry), entry)).collect();
        let by_distance = |a: &(f32, &Entry), b: &(f32, &Entry)| a.0.total_cmp(&b.0);
        if near.len() > NEAREST {
            near.select_nth_unstable_by(NEAREST, by_distance);
            near.truncate(NEAREST);
        }
        near.sort_by(by_distance);

        let mut sum = Vec3::ZERO;
        let mut mix = std::array::from_fn(|chosen| {
            let cost = |&(distance, entry): &(f32, &Entry)| {
                let mean = (sum + entry.light) / (chosen + 1) as f32;
                (oklab(mean) - look).length_squared() + DOT * distance
            };
            let mut best = (f32::INFINITY, near[0].1);
            for candidate in &near {
                let cost = cost(candidate);
                if cost < best.0 {
                    best = (cost, candidate.1);
                }
            }
            sum += best.1.light;
            best.1
        });
        mix.sort_by(|a, b| a.look.x.total_cmp(&b.look.x));
        mix.map(|entry| entry.color)
    }
}
