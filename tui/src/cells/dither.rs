//! 256 colours: four of them together show a colour that none of them is.
//!
//! A colour is mixed of four entries of the palette, chosen one after the other so that the mean so far looks most like it. An entry that
//! looks far from the colour costs something, since from the chair it is seen as a dot: mostly the four are two neighbours in the palette.
//! They are sorted by lightness, and each of four neighbours in a square shows one. Which one depends on the place alone: a picture at rest
//! stays as it is, and what moves takes no pattern along. What moves in the viewer gets the nearest entries: there each mix would be sent
//! again for every shade that passes, which doubles the bytes of a frame.
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
/// The weight of an entry's own squared distance beside that of the mean. (0.05 gains 2 dB from afar, and gives noise on flat ground: on
/// marbles FLIP is 1.05 of chafa's instead of 0.92, and SSIM 0.2 less. 1: 0.003, and 0.3 dB less from afar.)
const DOT: f32 = 0.6;
/// Which of a mix each place of a square shows, so that two of a row or column differ as little as can be.
const ORDER: [[usize; 2]; 2] = [[0, 2], [3, 1]];

/// In motion the entry of the frame before stays if its squared distance is at most this many times that of the nearest entry. (On flake
/// the error of changes is 1.13 of chafa's with 2, and 1.19 with 1.)
const KEPT: f32 = 2.0;

/// Mixes that are remembered: some frames' worth.
const MOST_KEPT: usize = 1 << 16;

/// Finds mixes, and remembers them.
#[derive(Clone, Debug, Default)]
pub struct Dither {
    entries: Vec<Entry>,
    mixes: HashMap<Srgb, [Color; MIX]>,
    /// The nearest entries, by the upper 6 bits of each channel.
    nearest: HashMap<Srgb, Color>,
}

impl Dither {
    /// Mixes these entries.
    #[must_use]
    pub fn new(entries: Vec<Entry>) -> Self {
        Self { entries, mixes: HashMap::new(), nearest: HashMap::new() }
    }

    /// The colour that the place `(x, y)` shows for `light`, which is rounded to 8 bits a channel.
    #[must_use]
    pub fn color(&mut self, light: Vec3, (x, y): (usize, usize)) -> Color {
        self.mix_of(light)[ORDER[y % 2][x % 2]]
    }

    /// The entry that looks nearest to a colour, which is rounded to 6 bits a channel.
    #[must_use]
    pub fn nearest(&mut self, light: Vec3) -> Color {
        // Replicate the upper bits, so that black and white stay what they are.
        let rounded = Srgb(Srgb::from_linear(light).0.map(|channel| channel & !3 | channel >> 6));
        *self.nearest.entry(rounded).or_insert_with(|| {
            let look = oklab(rounded.to_linear());
            let distance = |entry: &&Entry| (entry.look - look).length_squared();
            let by_distance = |a: &&Entry, b: &&Entry| distance(a).total_cmp(&distance(b));
            self.entries.iter().min_by(by_distance).map_or(Color::Default, |entry| entry.color)
        })
    }

    /// Returns the nearest entry, or the one that was there `before` if that looks about as near. So an entry is left late, and then for
    /// good.
    #[must_use]
    pub fn as_before(&mut self, light: Vec3, before: Option<Color>) -> Color {
        let nearest = self.nearest(light);
        let entry = |color: Color| self.entries.iter().find(|entry| entry.color == color);
        let Some(before) = before.filter(|&before| before != nearest).and_then(entry) else {
            return nearest;
        };
        let look = oklab(light);
        let distance = |entry: &Entry| (entry.look - look).length_squared();
        let least = entry(nearest).map_or(0.0, distance);
        if distance(before) <= KEPT * least { before.color } else { nearest }
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
            let costs = near.iter().map(|near| (cost(near), near.1));
            let best = costs.min_by(by_distance).map_or(near[0].1, |best| best.1);
            sum += best.light;
            best
        });
        mix.sort_by(|a, b| a.look.x.total_cmp(&b.look.x));
        mix.map(|entry| entry.color)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::palette::{Theme, entries, xterm_256};
    use crate::style::ColorDepth;

    fn dither() -> Dither {
        Dither::new(entries(ColorDepth::Ansi256, &Theme::XTERM))
    }

    fn light(color: Color) -> Vec3 {
        let Color::Ansi256(index) = color else { panic!("{color:?} is not of the palette") };
        xterm_256(index).to_linear()
    }

    /// Colours of all kinds, dark ones too.
    fn colors() -> impl Iterator<Item = Vec3> {
        let levels = [0, 9, 40, 77, 120, 163, 208, 255];
        let all = levels.map(|red| levels.map(|green| levels.map(|blue| Srgb([red, green, blue]))));
        all.into_iter().flatten().flatten().map(Srgb::to_linear)
    }

    fn distance(one: Vec3, other: Vec3) -> f32 {
        (oklab(one) - oklab(other)).length()
    }

    const PLACES: [(usize, usize); 4] = [(0, 0), (1, 0), (0, 1), (1, 1)];

    #[test]
    fn entries_are_themselves() {
        let mut dither = dither();
        for index in 16..=255 {
            let light = xterm_256(index).to_linear();
            let shown = PLACES.map(|place| dither.color(light, place));
            for color in shown.into_iter().chain([dither.nearest(light)]) {
                // Some colours have two names.
                assert_eq!(self::light(color), light);
            }
        }
    }

    #[test]
    fn four_are_nearer_than_one_and_each_place_shows_one() {
        let mut dither = dither();
        let (mut mixed, mut single) = (0.0, 0.0);
        for wanted in colors() {
            let places = [(4, 6), (5, 6), (4, 7), (5, 7)];
            let four = places.map(|place| dither.color(wanted, place));
            mixed += distance(four.map(light).iter().sum::<Vec3>() / 4.0, wanted);
            single += distance(light(dither.nearest(wanted)), wanted);
        }
        assert!(mixed < 0.9 * single, "{mixed} of {single}");
    }

    #[test]
    fn noise_and_mean_are_weighed() {
        // Entries that may be farther off (0.45 in place of 0.6) are seen one by one at 0.0353, entries that may not (0.8) have a mean
        // that is off by 0.0310.
        let mut dither = dither();
        let (mut noise, mut off, mut count) = (0.0, 0.0, 0.0);
        for wanted in colors() {
            let four = PLACES.map(|place| light(dither.color(wanted, place)));
            noise += four.map(|light| distance(light, wanted)).iter().sum::<f32>() / 4.0;
            off += distance(four.iter().sum::<Vec3>() / 4.0, wanted);
            count += 1.0;
        }
        let (noise, off) = (noise / count, off / count);
        assert!(noise < 0.0351 && off < 0.0304, "{noise} {off}");
    }

    #[test]
    fn an_entry_stays_while_it_is_about_as_near() {
        let mut dither = dither();
        let [dark, light] = [20, 21].map(|index| xterm_256(index).to_linear());
        // A slope of blues from one to the other and back: each is left late.
        let mut shown = dither.nearest(dark);
        let mut seen = Vec::new();
        for step in (0..=40).chain((0..40).rev()) {
            let share = step as f32 / 40.0;
            shown = dither.as_before(dark + share * (light - dark), Some(shown));
            seen.push(shown == Color::Ansi256(21));
        }
        let up = seen.iter().position(|&is_light| is_light).expect("the lighter") as f32;
        let down = seen[up as usize..].iter().position(|&is_light| !is_light).expect("the darker");
        assert!(up > 20.0 && up < 30.0, "{up}");
        let down = 80.0 - up - down as f32;
        assert!(down < 20.0 && down > 10.0, "{down}");
        assert_eq!(dither.as_before(dark, None), Color::Ansi256(20));
    }

    #[test]
    fn nothing_else_looks_nearer_than_the_nearest() {
        let mut dither = dither();
        for wanted in colors() {
            let least = (16..=255).map(|index| distance(xterm_256(index).to_linear(), wanted));
            let least = least.fold(f32::INFINITY, f32::min);
            // Colours are rounded first.
            assert!(distance(light(dither.nearest(wanted)), wanted) < least + 0.02);
        }
    }
}
