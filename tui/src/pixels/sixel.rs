//! Images in sixels: bands of six rows, in each one run of columns a colour.
//!
//! Source: "VT330/VT340 Programmer Reference Manual", volume 2, chapter 14.

use super::median_cut::{MOST, Palette};
use crate::picture::Image;
use std::io::Write;

/// Rows of a band.
const BAND: usize = 6;

/// Appends an image of so many colours where the cursor is, which is then in its last row.
pub(super) fn write(image: &Image, colors: u16, out: &mut Vec<u8>) {
    let (width, height) = (image.width as usize, image.height as usize);
    let palette = Palette::new(&image.rgb, colors.into());
    // No pixel is without a colour; such pixels would stay as they are. Pixels are square, and so
    // many.
    let _ = write!(out, "\x1bP0;1;0q\"1;1;{width};{height}");
    for (entry, color) in palette.colors.iter().enumerate() {
        let [red, green, blue] = color.0.map(percent);
        let _ = write!(out, "#{entry};2;{red};{green};{blue}");
    }
    // For every colour, which rows of each column have it.
    let mut columns = vec![0_u8; MOST * width];
    for (place, band) in image.rgb.chunks(3 * width.max(1) * BAND).enumerate() {
        if place > 0 {
            out.push(b'-');
        }
        let mut used = [false; MOST];
        for (row, pixels) in band.chunks(3 * width).enumerate() {
            for (column, pixel) in pixels.as_chunks::<3>().0.iter().enumerate() {
                let entry = usize::from(palette.entry(*pixel));
                used[entry] = true;
                columns[entry * width + column] |= 1 << row;
            }
        }
        let mut is_first = true;
        for entry in (0..MOST).filter(|&entry| used[entry]) {
            // Back to the left for the next colour.
            let back = if is_first { "" } else { "$" };
            let _ = write!(out, "{back}#{entry}");
            is_first = false;
            let columns = &mut columns[entry * width..][..width];
            push_runs(columns, out);
            columns.fill(0);
        }
    }
    out.extend_from_slice(b"\x1b\\");
}

/// A channel in hundredths, as sixels name colours.
pub fn percent(channel: u8) -> u8 {
    ((u16::from(channel) * 100 + 127) / 255) as u8
}

/// What is empty at the end is left out.
fn push_runs(columns: &[u8], out: &mut Vec<u8>) {
    let length = columns.iter().rposition(|&sixel| sixel != 0).map_or(0, |last| last + 1);
    for run in columns[..length].chunk_by(|a, b| a == b) {
        let sixel = run[0] + b'?';
        if run.len() > 3 {
            let _ = write!(out, "!{}", run.len());
            out.push(sixel);
        } else {
            out.extend(std::iter::repeat_n(sixel, run.len()));
        }
    }
}
