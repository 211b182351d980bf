//! The samples of a cell in columns: a number of each sample, eight samples a line.
//!
//! The left half of the cell comes before the right one. So the eight samples of a line are neighbours on two rows or
//! four, and most lines lie in one bin of a grid: what fills a part of the cell is computed from the lines of that part.

use spherule_kernel::Vec3;
use wide::{f32x4, f32x8};

/// The most samples that are looked at.
pub const MOST: usize = 256;
/// Samples side by side.
pub const LANES: usize = 8;

/// A number of each sample, 0 behind the last.
pub type Column = [f32x8; MOST / LANES];

/// An empty column.
pub const EMPTY: Column = [f32x8::ZERO; MOST / LANES];

/// A line that is not empty: its place in a column, and its numbers.
pub type Line = (u8, f32x8);

/// The colours of samples, a column a channel.
#[derive(Clone, Debug)]
pub struct Columns {
    channels: [Column; 3],
    count: usize,
}

impl Default for Columns {
    fn default() -> Self {
        Self { channels: [EMPTY; 3], count: 0 }
    }
}

/// Into how many parts a row of samples is cut.
fn parts(across: usize) -> usize {
    if across.is_multiple_of(2) { 2 } else { 1 }
}

/// Which sample, counted row by row, is at each place of a column.
pub fn order(across: usize, count: usize) -> impl Iterator<Item = usize> {
    let width = across / parts(across);
    (0..across).step_by(width).flat_map(move |left| {
        let rows = (0..count).step_by(across);
        rows.flat_map(move |row| row + left..row + left + width)
    })
}

/// The lines of numbers, row by row, that are not all 0.
pub fn lines(numbers: &[f32], across: usize) -> impl Iterator<Item = Line> {
    let mut column = [[0.0; LANES]; MOST / LANES];
    for (place, sample) in order(across, numbers.len()).enumerate() {
        column[place / LANES][place % LANES] = numbers[sample];
    }
    let lines = (0..).zip(column).take(numbers.len().div_ceil(LANES));
    lines.filter(|(_, line)| *line != [0.0; LANES]).map(|(line, numbers)| (line, numbers.into()))
}

impl Columns {
    /// Takes the colours of a grid of samples; rows past [`MOST`] samples are left out.
    pub fn take(&mut self, colors: &[Vec3], across: usize) {
        let rows = colors.len().min(MOST) / across;
        self.count = rows * across;
        let width = across / parts(across);
        let mut place = 0;
        let mut lanes = [[0.0; LANES]; 3];
        for left in (0..across).step_by(width) {
            for row in colors.chunks_exact(across).take(rows) {
                for color in &row[left..left + width] {
                    for (lanes, &value) in lanes.iter_mut().zip(color.as_ref()) {
                        lanes[place % LANES] = value;
                    }
                    place += 1;
                    if place % LANES == 0 {
                        self.write(place / LANES - 1, lanes);
                    }
                }
            }
        }
        if place % LANES > 0 {
            lanes.iter_mut().for_each(|lanes| lanes[place % LANES..].fill(0.0));
            self.write(place / LANES, lanes);
        }
    }

    fn write(&mut self, line: usize, lanes: [[f32; LANES]; 3]) {
        for (channel, lanes) in self.channels.iter_mut().zip(lanes) {
            channel[line] = f32x8::new(lanes);
        }
    }

    /// Takes the [roots](crate::color::roots) of light.
    pub fn take_roots(&mut self, light: &Self) {
        self.count = light.count;
        for (roots, light) in self.channels.iter_mut().zip(&light.channels) {
            for (root, &light) in roots.iter_mut().zip(light).take(lines_of(self.count)) {
                // NaN counts as 0.
                *root = light.max(f32x8::ZERO).sqrt();
            }
        }
    }

    /// How many samples there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The lines that hold samples, channel by channel.
    #[must_use]
    pub fn channels(&self) -> [&[f32x8]; 3] {
        self.channels.each_ref().map(|channel| &channel[..lines_of(self.count)])
    }

    /// The sum of all colours.
    #[must_use]
    pub fn sum(&self) -> Vec3 {
        let sum = |channel: &[f32x8]| channel.iter().fold(f32x8::ZERO, |sum, &line| sum + line);
        let [r, g, b] = self.channels().map(sum);
        let [r, g, b, _] = sums([r, g, b, f32x8::ZERO]);
        Vec3::new(r, g, b)
    }

    /// The sum of all colours, each times its number in a column.
    #[must_use]
    #[inline]
    pub fn times(&self, column: &[f32x8]) -> Vec3 {
        let times = |channel: &[f32x8]| {
            let products = channel.iter().zip(column).map(|(&values, &weight)| weight * values);
            products.fold(f32x8::ZERO, |sum, product| sum + product)
        };
        let [r, g, b] = self.channels.each_ref().map(|channel| times(channel));
        let [r, g, b, _] = sums([r, g, b, f32x8::ZERO]);
        Vec3::new(r, g, b)
    }

    /// The sum of all colours, each times its number in these lines.
    #[must_use]
    #[inline]
    pub fn weighted_sum(&self, lines: impl Iterator<Item = Line>) -> Vec3 {
        let [mut r, mut g, mut b] = [f32x8::ZERO; 3];
        for (line, weight) in lines {
            let line = usize::from(line);
            r += weight * self.channels[0][line];
            g += weight * self.channels[1][line];
            b += weight * self.channels[2][line];
        }
        let [r, g, b, _] = sums([r, g, b, f32x8::ZERO]);
        Vec3::new(r, g, b)
    }
}

/// The sum of the numbers of each line. (Adding one line after the other, number by number, took a third of the time of a letter.)
#[must_use]
#[inline]
pub fn sums(lines: [f32x8; 4]) -> [f32; 4] {
    let [a, b, c, d] = f32x4::transpose(lines.map(|line| {
        let [a, b, c, d, e, f, g, h] = line.to_array();
        f32x4::new([a, b, c, d]) + f32x4::new([e, f, g, h])
    }));
    ((a + b) + (c + d)).to_array()
}

/// How many lines so many samples take.
fn lines_of(count: usize) -> usize {
    count.div_ceil(LANES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::roots;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_sample_is_at_one_place(across in 1..=16_usize, down in 1..=16_usize) {
            let mut places: Vec<usize> = order(across, across * down).collect();
            let half = places.len() / 2;
            if across.is_multiple_of(2) {
                prop_assert!(places[..half].iter().all(|sample| sample % across < across / 2));
            }
            places.sort_unstable();
            prop_assert_eq!(places, (0..across * down).collect::<Vec<_>>());
        }

        #[test]
        fn colours_and_numbers_are_in_the_same_order(
            (across, values) in (1..=16_usize, 1..=16_usize).prop_flat_map(|(across, down)| {
                (Just(across), prop::collection::vec((-0.5..1.0_f32, 0.0..1.0_f32), across * down))
            }),
        ) {
            let (values, weights): (Vec<f32>, Vec<f32>) = values.into_iter().unzip();
            let light: Vec<Vec3> = values.iter().map(|&value| Vec3::new(value, 1.0, -1.0)).collect();
            let (mut columns, mut looks) = (Columns::default(), Columns::default());
            // What was there before leaves nothing behind.
            columns.take(&[Vec3::splat(9.0); MOST], 16);
            looks.take_roots(&columns);
            columns.take(&light, across);
            looks.take_roots(&columns);
            prop_assert_eq!(columns.count(), light.len());
            for (place, sample) in order(across, light.len()).enumerate() {
                let found = looks.channels().map(|channel| channel[place / LANES].to_array()[place % LANES]);
                prop_assert_eq!(Vec3::from_array(found), roots(light[sample]));
            }
            let weighted = columns.weighted_sum(lines(&weights, across));
            let expected: f64 = values.iter().zip(&weights).map(|(&value, &weight)| f64::from(value) * f64::from(weight)).sum();
            prop_assert!((f64::from(weighted.x) - expected).abs() < 1e-4);
            let ones: f32 = weights.iter().sum();
            prop_assert!((weighted.y - ones).abs() < 1e-4 && weighted.z == -weighted.y);
            prop_assert!((columns.sum().x - values.iter().sum::<f32>()).abs() < 1e-4);
        }
    }

    #[test]
    fn no_light_is_black() {
        let (mut light, mut looks) = (Columns::default(), Columns::default());
        light.take(&[Vec3::new(f32::NAN, -1.0, 4.0)], 1);
        looks.take_roots(&light);
        assert_eq!(looks.channels().map(|channel| channel[0].to_array()[0]), [0.0, 0.0, 2.0]);
    }

    #[test]
    fn most_lines_lie_in_one_bin() {
        // Four columns of samples and twelve rows: a line is a sextant.
        for (place, sample) in order(4, 48).enumerate() {
            let (x, y) = (sample % 4, sample / 4);
            assert_eq!(place / LANES, x / 2 * 3 + y / 4);
        }
        // Eight columns: an octant of eight rows.
        for (place, sample) in order(8, 64).enumerate() {
            let (x, y) = (sample % 8, sample / 8);
            assert_eq!(place / LANES, x / 4 * 4 + y / 2);
        }
    }
}
