//! Pictures in files.

use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};
use spherule_tests::art::light::Light;
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Columns of pixels between two pictures.
const GAP: usize = 8;

/// Writes a picture.
pub(crate) fn write_png(light: &Light, path: &Path) -> Result<(), Box<dyn Error>> {
    let size = (light.width.try_into()?, light.height().try_into()?);
    let mut encoder = Encoder::new(BufWriter::new(File::create(path)?), size.0, size.1);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.set_compression(Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(light.colors().as_flattened())?;
    writer.finish()?;
    Ok(())
}

/// Pictures of the same height side by side, a grey line between them.
pub(crate) fn beside(pictures: &[Light]) -> Light {
    let mut all = Light { width: 0, pixels: Vec::new() };
    for y in 0..pictures.first().map_or(0, Light::height) {
        for (i, picture) in pictures.iter().enumerate() {
            all.pixels.extend(std::iter::repeat_n([0.2; 3], if i == 0 { 0 } else { GAP }));
            all.pixels.extend_from_slice(&picture.pixels[y * picture.width..][..picture.width]);
        }
        if y == 0 {
            all.width = all.pixels.len();
        }
    }
    all
}
