//! Colours of numbers: viridis, from dark violet through green to yellow.
//!
//! Lightness grows evenly, so numbers can be told without seeing hues; to those with tritanopia the lightest few hundredths look alike. The
//! colours are those of S. van der Walt and N. Smith for matplotlib, in the polynomial that M. Zucker fitted to them. The darkest eighth is
//! left out, since it is lost on a dark ground and in a shade.

use crate::color::Srgb;
use std::cmp::Ordering;
use std::str::FromStr;

/// The numbers between which colours lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// This number and all below have the darkest colour.
    pub low: f32,
    /// This number and all above have the lightest colour.
    pub high: f32,
}

impl Range {
    /// From the least to the largest of the finite `values`; `None` if there are none.
    #[must_use]
    pub fn of(values: &[f32]) -> Option<Self> {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        finite.map(|value| Self { low: value, high: value }).reduce(Self::widened)
    }

    /// The least range that holds both, if each begins at its least number.
    #[must_use]
    pub fn widened(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Where a number lies, 0 to 1; 0.5 if all numbers are the same; `None` for NaN.
    #[must_use]
    pub fn place(self, value: f32) -> Option<f32> {
        // In double precision the difference of two floats does not overflow.
        let [low, high, value] = [self.low, self.high, value].map(f64::from);
        match value.partial_cmp(&low)? {
            _ if low != high => Some(((value - low) / (high - low)).clamp(0.0, 1.0) as f32),
            Ordering::Less => Some(0.0),
            Ordering::Equal => Some(0.5),
            Ordering::Greater => Some(1.0),
        }
    }
}

impl FromStr for Range {
    type Err = &'static str;

    /// Reads `LOW:HIGH`, two finite numbers. If the first is the larger, colours are the other way around.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number =
            |text: &str| text.trim().parse::<f32>().ok().filter(|number| number.is_finite());
        let range = text
            .split_once(':')
            .and_then(|(low, high)| Some(Self { low: number(low)?, high: number(high)? }));
        range.ok_or("LOW:HIGH, two numbers such as 0:100")
    }
}

/// The place of the darkest colour that is used.
const DARKEST: f32 = 0.125;

/// The colour at a place from 0 to 1.
#[must_use]
pub fn color_of(place: f32) -> Srgb {
    /// The coefficients of red, green and blue, one row a power, from the highest.
    const VIRIDIS: [[f32; 3]; 7] = [
        [-5.435_456, 4.645_852_6, 26.312_435],
        [4.776_385, -13.745_145, -65.353_03],
        [6.228_27, 14.179_934, 56.690_55],
        [-4.634_230_6, -5.799_101, -19.332_44],
        [-0.330_861_84, 0.214_847_56, 0.095_095_16],
        [0.105_093_04, 1.404_613_5, 1.384_590_1],
        [0.277_727_33, 0.005_407_344, 0.334_099_8],
    ];
    let x = DARKEST + (1.0 - DARKEST) * place.clamp(0.0, 1.0);
    let channel = |channel: usize| VIRIDIS.iter().fold(0.0, |sum, power| sum * x + power[channel]);
    Srgb([0, 1, 2].map(|index| (255.0 * channel(index)).round().clamp(0.0, 255.0) as u8))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::oklab;
    use crate::coloring::categories::vision::SIGHTS;

    #[test]
    fn it_gets_lighter_evenly_for_everybody() {
        let colors: Vec<_> =
            (0..=50).map(|step| color_of(step as f32 / 50.0).to_linear()).collect();
        for sight in SIGHTS {
            let looks: Vec<_> = colors.iter().map(|&color| oklab(sight.seen(color))).collect();
            let steps: Vec<_> = looks.windows(2).map(|pair| pair[1].x - pair[0].x).collect();
            let mean = steps.iter().sum::<f32>() / steps.len() as f32;
            // Even steps to those who see all colours; to the others at least upwards, or with a step of hue.
            for (step, pair) in steps.iter().zip(looks.windows(2)) {
                assert!(*step > 0.0, "{}: {step}", sight.name);
                // The lightest leave what a display has of what they see.
                assert!(
                    sight.name == "tritanopia" || pair[0].distance(pair[1]) > 0.4 * mean,
                    "{}: {pair:?}",
                    sight.name
                );
            }
        }
    }

    #[test]
    fn its_ends_are_those_of_viridis() {
        assert_eq!(color_of(1.0), color_of(7.0));
        let Srgb([red, green, blue]) = color_of(1.0);
        // fde725.
        assert!(
            red.abs_diff(0xfd) < 6 && green.abs_diff(0xe7) < 6 && blue.abs_diff(0x25) < 20,
            "{red} {green} {blue}"
        );
        let Srgb([red, green, blue]) = color_of((0.5 - DARKEST) / (1.0 - DARKEST));
        // 21918c.
        assert!(
            red.abs_diff(0x21) < 6 && green.abs_diff(0x91) < 6 && blue.abs_diff(0x8c) < 6,
            "{red} {green} {blue}"
        );
    }

    #[test]
    fn ranges_are_of_finite_numbers() {
        let range = Range { low: -1.0, high: 3.0 };
        assert_eq!(Range::of(&[f32::NAN, 3.0, -1.0, f32::INFINITY]), Some(range));
        assert_eq!(
            [-9.0, -1.0, 1.0, f32::INFINITY, f32::NAN].map(|value| range.place(value)),
            [Some(0.0), Some(0.0), Some(0.5), Some(1.0), None]
        );
        assert_eq!(Range::of(&[f32::NAN]), None);
        assert_eq!(Range::of(&[7.0, 7.0]).and_then(|range| range.place(7.0)), Some(0.5));
        let widest = Range { low: f32::MIN, high: f32::MAX };
        assert_eq!(widest.place(0.0), Some(0.5));
    }

    #[test]
    fn a_range_is_two_numbers() {
        assert_eq!("-1:2.5".parse(), Ok(Range { low: -1.0, high: 2.5 }));
        assert_eq!("2:1".parse::<Range>().map(|range| range.place(2.0)), Ok(Some(0.0)));
        for wrong in ["", "1", ":", "1:", "a:b", "1:inf", "nan:1", "1:2:3"] {
            assert!(wrong.parse::<Range>().is_err(), "{wrong}");
        }
    }
}
