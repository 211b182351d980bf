//! A palette for a picture. Its colours in `OKLab` are put into boxes, and the box with the largest error is cut in two until there are
//! enough.
//!
//! Source: Paul Heckbert, "Color image quantization for frame buffer display", 1982; the cut at the mean, across the axis of
//! the largest variance, after Xiaolin Wu, "Efficient statistical computations for optimal color quantization", 1991.

use crate::color::{Srgb, oklab};
use spherule_kernel::Vec3;

/// Colours of a palette.
pub(super) const MOST: usize = 256;
/// Levels of a channel that are told apart before the cuts.
const LEVELS: usize = 32;

/// Which colour each pixel gets.
pub(super) struct Palette {
    /// At most 256.
    pub(super) colors: Vec<Srgb>,
    /// An entry for every bin.
    of_bin: Vec<u8>,
}

/// Colours that share their highest five bits a channel.
struct Bin {
    index: usize,
    count: f32,
    light: Vec3,
    look: Vec3,
}

/// A range of the bins.
struct Cluster {
    start: usize,
    end: usize,
    /// The sum of squared distances to the mean.
    error: f32,
    /// The axis across which it is cut, and the place.
    axis: usize,
    at: f32,
}

/// The bin of a colour.
fn bin([red, green, blue]: [u8; 3]) -> usize {
    let level = |channel: u8| usize::from(channel) * LEVELS / 256;
    (level(red) * LEVELS + level(green)) * LEVELS + level(blue)
}

impl Palette {
    /// The palette of a picture's pixels, three channels each: at most as many colours, and at most 256.
    pub(super) fn new(rgb: &[u8], most: usize) -> Self {
        let mut sums = vec![(0_u64, [0_u64; 3]); LEVELS * LEVELS * LEVELS];
        for pixel in rgb.as_chunks::<3>().0 {
            let (count, sum) = &mut sums[bin(*pixel)];
            *count += 1;
            for (sum, channel) in sum.iter_mut().zip(pixel) {
                *sum += u64::from(*channel);
            }
        }
        let used = sums.iter().enumerate().filter(|(_, (count, _))| *count > 0);
        let mut bins: Vec<Bin> = used
            .map(|(index, &(count, sum))| {
                let mean = sum.map(|sum| ((sum + count / 2) / count) as u8);
                let light = Srgb(mean).to_linear();
                Bin { index, count: count as f32, light, look: oklab(light) }
            })
            .collect();
        let mut boxes = vec![Cluster::new(&bins, 0, bins.len())];
        while boxes.len() < most.min(MOST) {
            let worst = (0..boxes.len()).max_by(|&a, &b| boxes[a].error.total_cmp(&boxes[b].error));
            let Some(worst) = worst.filter(|&worst| boxes[worst].error > 0.0) else { break };
            let Cluster { start, end, axis, at, .. } = boxes[worst];
            let middle = start + cut(&mut bins[start..end], |bin| bin.look[axis] < at);
            if middle == start || middle == end {
                // All bins are in one place, except for rounding.
                boxes[worst].error = 0.0;
                continue;
            }
            boxes[worst] = Cluster::new(&bins, start, middle);
            boxes.push(Cluster::new(&bins, middle, end));
        }
        let mut palette = Self { colors: Vec::new(), of_bin: vec![0; sums.len()] };
        for (entry, Cluster { start, end, .. }) in boxes.iter().enumerate() {
            let inside = &bins[*start..*end];
            let count: f32 = inside.iter().map(|bin| bin.count).sum();
            let light = inside.iter().fold(Vec3::ZERO, |sum, bin| sum + bin.count * bin.light);
            palette.colors.push(Srgb::from_linear(light / count.max(1.0)));
            for bin in inside {
                palette.of_bin[bin.index] = entry as u8;
            }
        }
        palette
    }

    /// The entry for a pixel of the picture.
    pub(super) fn entry(&self, pixel: [u8; 3]) -> u8 {
        self.of_bin[bin(pixel)]
    }
}

impl Cluster {
    fn new(bins: &[Bin], start: usize, end: usize) -> Self {
        let inside = &bins[start..end];
        let count: f32 = inside.iter().map(|bin| bin.count).sum();
        let mean =
            inside.iter().fold(Vec3::ZERO, |sum, bin| sum + bin.count * bin.look) / count.max(1.0);
        let squares = inside.iter().fold(Vec3::ZERO, |sum, bin| {
            let off = bin.look - mean;
            sum + bin.count * off * off
        });
        let axis = (0..3).max_by(|&a, &b| squares[a].total_cmp(&squares[b])).unwrap_or(0);
        Self { start, end, error: squares.element_sum(), axis, at: mean[axis] }
    }
}

/// Puts the bins that are `first` before the others, and returns how many there are.
fn cut(bins: &mut [Bin], first: impl Fn(&Bin) -> bool) -> usize {
    let mut count = 0;
    for index in 0..bins.len() {
        if first(&bins[index]) {
            bins.swap(count, index);
            count += 1;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let colors = [[0, 0, 0], [255, 0, 0], [12, 200, 99], [255; 3]];
        let palette = Palette::new(colors.repeat(7).as_flattened(), MOST);
        assert_eq!(palette.colors.len(), 4);
        for color in colors {
            assert_eq!(palette.colors[usize::from(palette.entry(color))], Srgb(color));
        }
        assert!(Palette::new(&[], MOST).colors.len() <= 1);
    }

    /// More than 2^32 / 255 white pixels.
    #[test]
    fn a_large_white_picture_is_white() {
        let rgb = vec![255; 3 * 17_000_000];
        let palette = Palette::new(&rgb, MOST);
        assert_eq!(palette.colors[usize::from(palette.entry([255; 3]))], Srgb([255; 3]));
    }

    #[test]
    fn many_colours_become_as_many_as_there_may_be_and_are_near() {
        let pixels: Vec<[u8; 3]> = (0..=255_u8)
            .flat_map(|red| (0..=255_u8).map(move |green| [red, green, red / 2 + green / 2]))
            .collect();
        assert_eq!(Palette::new(pixels.as_flattened(), 16).colors.len(), 16);
        let palette = Palette::new(pixels.as_flattened(), MOST);
        assert_eq!(palette.colors.len(), MOST);
        let far = |pixel: &[u8; 3]| {
            let entry = palette.colors[usize::from(palette.entry(*pixel))];
            oklab(Srgb(*pixel).to_linear()).distance(oklab(entry.to_linear()))
        };
        let mean = pixels.iter().map(far).sum::<f32>() / pixels.len() as f32;
        assert!(mean < 0.03, "{mean}");
    }
}
