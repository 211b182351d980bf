//! A picture as a PNG, written row by row as it is drawn.

use crate::error::Error;
use crate::whole_file::WholeFile;
use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};
use std::io::{self, Write};
use std::path::Path;

/// Bytes a chunk of the file.
const CHUNK: usize = 1 << 16;

/// Writes a picture of `width` x `height` pixels to the file `name`, or to standard output if that is `-`; `draw` writes
/// its rows, from the top: red, green and blue of every pixel, sRGB-encoded.
///
/// # Errors
/// [`Error`] if the file cannot be written. Then there is no file of this name, or it is as it was.
pub fn write(
    name: &Path,
    (width, height): (u32, u32),
    draw: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let failed = |error: io::Error| Error::of_file(name, &error);
    let file = WholeFile::create(name).map_err(failed)?;
    let mut output = Output { file, error: None };
    let encoded = encode(&mut output, (width, height), draw);
    let Output { file, error } = output;
    let written = error.map_or(encoded, Err).and_then(|()| file.finish());
    written.map_err(failed)
}

/// A PNG in memory, made fast rather than small; rows from the top: red, green and blue of every pixel.
///
/// # Errors
/// If the number of pixels is not `width` x `height`.
pub fn bytes(width: u32, height: u32, rgb: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fastest);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

fn encode(
    output: &mut Output,
    (width, height): (u32, u32),
    draw: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut encoder = Encoder::new(output, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    let mut rows = writer.stream_writer_with_size(CHUNK)?;
    draw(&mut rows)?;
    rows.finish()?;
    Ok(writer.finish()?)
}

/// Remembers why the file could not be written, since the encoder hands on only the text of an error.
struct Output {
    file: WholeFile,
    error: Option<io::Error>,
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes).map_err(|error| {
            let kind = error.kind();
            if kind != io::ErrorKind::Interrupted {
                self.error.get_or_insert(error);
            }
            kind.into()
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
