//! Colours of a file that does not say how bright the brightest is.

use crate::color::Srgb;

/// The colours. They go from 0 to 1, unless the largest is far beyond: then to 255, or to 65,535.
pub(super) fn srgb(colors: &[[f32; 3]]) -> Vec<Srgb> {
    let most = colors.iter().flatten().copied().fold(0.0, f32::max);
    // What was computed may end a little above: if colours went further, all would be nearly black.
    let scale = match most {
        ..2.0 => 255.0,
        ..256.0 => 1.0,
        _ => 1.0 / 257.0,
    };
    let channel = |share: f32| (scale * share).round().clamp(0.0, 255.0) as u8;
    colors.iter().map(|color| Srgb(color.map(channel))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_tells_how_far_colours_go() {
        for (color, expected) in [
            ([1.0, 0.0, 0.5], [255, 0, 128]),
            ([1.02, 0.0, 0.5], [255, 0, 128]),
            ([255.0, -1.0, 128.0], [255, 0, 128]),
            ([65535.0, 257.0, 32896.0], [255, 1, 128]),
        ] {
            assert_eq!(srgb(&[color, [0.0; 3]]), [Srgb(expected), Srgb([0; 3])], "{color:?}");
        }
        assert!(srgb(&[]).is_empty());
    }
}
