//! Colour: sRGB as files and terminals write it, linear light as shading and averaging need it.
//!
//! Linear light is a [`Vec3`] of red, green and blue, 1 being the display's full intensity.

use spherule_kernel::Vec3;
use std::str::FromStr;
use std::sync::LazyLock;

/// Red, green and blue, sRGB-encoded: `#rrggbb`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Srgb(pub [u8; 3]);

impl Srgb {
    /// All off.
    pub const BLACK: Self = Self([0; 3]);
    /// All on.
    pub const WHITE: Self = Self([255; 3]);

    /// In linear light, each channel in `[0, 1]`.
    #[must_use]
    pub fn to_linear(self) -> Vec3 {
        Vec3::from_array(self.0.map(|channel| DECODED[usize::from(channel)]))
    }

    /// The nearest encoding of linear light; below 0 and NaN count as 0, above 1 as 1.
    ///
    /// It takes a table of 2^14 steps. The result is the inverse of [`Srgb::to_linear`], and elsewhere within one level
    /// of the exact encoding.
    #[must_use]
    #[inline]
    pub fn from_linear(light: Vec3) -> Self {
        // A cast saturates, so the index is in the table whatever the number is.
        let table = &*ENCODED;
        Self(
            light
                .to_array()
                .map(|channel| table[((channel * STEPS as f32 + 0.5) as usize).min(STEPS)]),
        )
    }
}

impl FromStr for Srgb {
    type Err = String;

    /// Reads `#rrggbb`, in digits of either case.
    fn from_str(text: &str) -> Result<Self, String> {
        let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
        let bytes = digits
            .filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))
            .and_then(|digits| u32::from_str_radix(digits, 16).ok());
        match bytes {
            Some(number) => Ok(Self([(number >> 16) as u8, (number >> 8) as u8, number as u8])),
            None => Err(format!("{text:?} is not a colour: write \"#rrggbb\"")),
        }
    }
}

/// The luminance of linear light, by the weights of Rec. 709; 1 for white.
#[must_use]
#[inline]
pub fn luminance(light: Vec3) -> f32 {
    light.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// How light a luminance looks, 0 to 1: the cube root, as in CIE L* and `OKLab`.
#[must_use]
#[inline]
pub fn lightness(luminance: f32) -> f32 {
    luminance.clamp(0.0, 1.0).cbrt()
}

/// Linear light in `OKLab`: lightness, green to red, blue to yellow. Equal steps look equal.
///
/// Source: Björn Ottosson, "A perceptual color space for image processing", 2020.
#[must_use]
pub fn oklab(light: Vec3) -> Vec3 {
    let long = cube_root(light.dot(Vec3::new(0.412_221_46, 0.536_332_55, 0.051_445_995)));
    let medium = cube_root(light.dot(Vec3::new(0.211_903_5, 0.680_699_5, 0.107_396_96)));
    let short = cube_root(light.dot(Vec3::new(0.088_302_46, 0.281_718_85, 0.629_978_7)));
    let cones = Vec3::new(long, medium, short);
    Vec3::new(
        cones.dot(Vec3::new(0.210_454_26, 0.793_617_8, -0.004_072_047)),
        cones.dot(Vec3::new(1.977_998_5, -2.428_592_2, 0.450_593_7)),
        cones.dot(Vec3::new(0.025_904_037, 0.782_771_77, -0.808_675_77)),
    )
}

/// The square root of each channel of linear light, about as displays encode it. Equal steps look alike more than in
/// linear light, and it costs a tenth of [`oklab`]. Below 0 and NaN count as 0.
#[must_use]
#[inline]
pub fn roots(light: Vec3) -> Vec3 {
    light.max(Vec3::ZERO).map(f32::sqrt)
}

/// The cube root within 4 ulp, up to 1e38. Returns 0 for NaN, and for numbers not above 1e-30, where there is no light
/// to speak of. Above 1e38 sums overflow, and it returns NaN.
///
/// It takes a third of the exponent by integers, then two steps of Halley's. A picture needs some hundred thousand cube
/// roots, and the standard library's costs five times as much.
#[inline]
fn cube_root(x: f32) -> f32 {
    if x.is_nan() || x <= 1e-30 {
        return 0.0;
    }
    let mut root = f32::from_bits(x.to_bits() / 3 + 0x2a51_37a0);
    for _ in 0..2 {
        let cube = root * root * root;
        root *= (cube + x + x) / (cube + cube + x);
    }
    root
}

const STEPS: usize = 1 << 14;

/// The linear light of an encoded channel (IEC 61966-2-1), `encoded` in `[0, 1]`.
fn decode(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

static DECODED: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|level| decode(level as f32 / 255.0)));

/// The level whose light is nearest in the encoding, for each step of linear light.
static ENCODED: LazyLock<Box<[u8; STEPS + 1]>> = LazyLock::new(|| {
    let mut table = Box::new([255; STEPS + 1]);
    let mut step = 0;
    for level in 0..=254_u8 {
        let end = decode((f32::from(level) + 0.5) / 255.0) * STEPS as f32;
        while step as f32 <= end {
            table[step] = level;
            step += 1;
        }
    }
    table
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_survives_linear_light() {
        for level in 0..=255 {
            let color = Srgb([level, 255 - level, level / 2]);
            assert_eq!(Srgb::from_linear(color.to_linear()), color);
        }
    }

    #[test]
    fn the_table_is_within_a_level_of_the_formula() {
        for step in 0..=100_000 {
            let light = step as f32 / 100_000.0;
            let exact = if light <= 0.003_130_8 {
                light * 12.92
            } else {
                1.055 * light.powf(1.0 / 2.4) - 0.055
            };
            let level = f32::from(Srgb::from_linear(Vec3::splat(light)).0[0]);
            assert!((level - exact * 255.0).abs() < 1.0, "{light}: {level}");
        }
    }

    #[test]
    fn light_out_of_range_is_clamped() {
        let light = Vec3::new(-1.0, f32::NAN, f32::INFINITY);
        assert_eq!(Srgb::from_linear(light), Srgb([0, 0, 255]));
    }

    #[test]
    fn colours_are_six_digits() {
        assert_eq!("#d04020".parse(), Ok(Srgb([0xd0, 0x40, 0x20])));
        assert_eq!("#D04020".parse(), Ok(Srgb([0xd0, 0x40, 0x20])));
        for wrong in ["", "#", "d04020", "#d0402", "#d040200", "#d0402g", "#+04020", "#ééé"] {
            assert!(wrong.parse::<Srgb>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn oklab_of_white_and_grey_has_no_hue() {
        assert!((oklab(Vec3::ONE) - Vec3::X).abs().max_element() < 1e-4);
        let grey = oklab(Vec3::splat(0.125));
        assert!((grey - Vec3::new(0.5, 0.0, 0.0)).abs().max_element() < 1e-4);
    }

    #[test]
    fn cube_roots_are_within_four_ulp() {
        let ulps = |x: f32| {
            let exact = f64::from(x).cbrt();
            let ulp = f64::from((exact as f32).next_up()) - f64::from(exact as f32);
            (f64::from(cube_root(x)) - exact).abs() / ulp
        };
        // A million of all magnitudes.
        let (first, last) = (1.01e-30_f32.to_bits(), 1e38_f32.to_bits());
        let worst = (first..=last).step_by(1867).map(f32::from_bits).map(ulps).fold(0.0, f64::max);
        assert!(worst <= 4.0, "{worst} ulp");
        // Every seventh number between 0.5 and 4, whose exponents leave each remainder by three.
        let all = (0.5_f32.to_bits()..4.0_f32.to_bits()).step_by(7).map(f32::from_bits);
        let worst = all.map(ulps).fold(0.0, f64::max);
        assert!(worst <= 4.0, "{worst} ulp");
    }

    #[test]
    fn what_has_no_cube_root_of_light_is_dark() {
        for dark in [0.0, -0.0, 1e-30, 1e-45, -1e-30, -1.0, f32::MIN, f32::NEG_INFINITY, f32::NAN] {
            assert_eq!(cube_root(dark).to_bits(), 0, "{dark}");
        }
        assert!((cube_root(1.0) - 1.0).abs() < 1e-6 && (cube_root(8.0) - 2.0).abs() < 1e-6);
        // Beyond the sums' range, which no light reaches.
        assert!(cube_root(1e38).is_finite() && cube_root(f32::INFINITY).is_nan());
    }
}
