//! Colours of a display: encoded, and the light that they stand for (IEC 61966-2-1).

use super::palette::Rgb;
use std::sync::LazyLock;

/// The linear light of every 8-bit level.
static LEVELS: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|level| light(level as f64 / 255.0) as f32));

/// The light of a level between 0 and 1.
fn light(level: f64) -> f64 {
    if level <= 0.04045 { level / 12.92 } else { ((level + 0.055) / 1.055).powf(2.4) }
}

/// Linear light.
#[must_use]
pub fn decoded(color: Rgb) -> [f32; 3] {
    color.map(|channel| LEVELS[usize::from(channel)])
}

/// The nearest colour of 8 bits a channel; light outside the display's range is clamped.
#[must_use]
pub fn encoded(light: [f32; 3]) -> Rgb {
    light.map(|channel| {
        let channel = f64::from(channel.clamp(0.0, 1.0));
        let level = match channel {
            0.0..=0.003_130_8 => 12.92 * channel,
            _ => 1.055 * channel.powf(1.0 / 2.4) - 0.055,
        };
        (255.0 * level).round() as u8
    })
}
