//! Images by the protocol of iTerm2: a PNG in an operating system command.
//!
//! Source: iTerm2's documentation, "Images".

use crate::picture::Image;
use crate::png_file;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Appends an image where the cursor is, in so many columns and rows.
pub(super) fn write(image: &Image, (columns, rows): (u16, u16), out: &mut Vec<u8>) {
    // A vector takes all there is.
    let file = png_file::bytes(image.width, image.height, &image.rgb).unwrap_or_default();
    let begin = format!(
        "\x1b]1337;File=inline=1;size={};width={columns};height={rows};preserveAspectRatio=0:",
        file.len()
    );
    out.extend_from_slice(begin.as_bytes());
    out.extend_from_slice(STANDARD.encode(file).as_bytes());
    out.push(0x07);
}
