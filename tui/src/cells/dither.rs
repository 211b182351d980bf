//! 256 colours: what none of them is, four of them are together.
//!
//! A colour is mixed of four entries of the palette, chosen one after the other so that the mean so far looks most
//! like it; an entry that looks far from it costs something, since it is seen as a dot. Sorted by lightness, each of
//! four neighbours in a square shows one. Which one depends on the place alone: a picture at rest stays as it is, and
//! what moves takes no pattern along.
//!
//! Source: J. Yliluoma, "Arbitrary-palette positional dithering algorithm", 2011, the second; by distance in `OKLab`
//! of means in linear light.

use super::Color;
use crate::color::{Srgb, oklab};
use crate::palette::Entry;
use spherule_kernel::Vec3;

/// Entries of a mix.
const MIX: usize = 4;
/// How many of the entries are looked at: those that look nearest.
const NEAREST: usize = 16;
/// What the squared distance of an entry itself counts beside that of the mean.
const DOT: f32 = 0.1;
/// Which of a mix each place of a square shows, so that two of a row or column differ as little as can be.
const ORDER: [[usize; 2]; 2] = [[0, 2], [3, 1]];

/// Finds mixes, and remembers them.
#[derive(Clone, Debug, Default)]
pub struct Dither {
    entries: Vec<Entry>,
    /// For each colour of 6 bits a channel, the place of its mix and 1; 0 if it is not known yet.
    places: Vec<u32>,
    mixes: Vec<[Color; MIX]>,
}

impl Dither {
    /// Of these entries.
    #[must_use]
    pub fn new(entries: Vec<Entry>) -> Self {
        Self { entries, places: vec![0; 1 << 18], mixes: Vec::new() }
    }

    /// What the place `(x, y)` shows of a colour, which is rounded to 6 bits a channel.
    #[must_use]
    pub fn color(&mut self, light: Vec3, (x, y): (usize, usize)) -> Color {
        let encoded = Srgb::from_linear(light).0;
        let [red, green, blue] = encoded.map(|channel| usize::from(channel >> 2));
        let slot = red << 12 | green << 6 | blue;
        if self.places[slot] == 0 {
            // Replicate the upper bits, so that black and white stay what they are.
            let rounded = Srgb(encoded.map(|channel| channel & !3 | channel >> 6));
            self.mixes.push(self.mix(rounded.to_linear()));
            self.places[slot] = self.mixes.len() as u32;
        }
        self.mixes[self.places[slot] as usize - 1][ORDER[y % 2][x % 2]]
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
