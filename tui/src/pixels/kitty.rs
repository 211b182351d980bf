//! Images by kitty's protocol: deflated pixels in pieces, behind the text.
//!
//! Every frame is an image of its own, with one of two numbers in turn. The image before is removed when the next is
//! there, so nothing flickers. tmux knows no images: under it, they are wrapped for the terminal behind it, and shown
//! by placeholders, which are text to tmux.
//!
//! Source: kitty's "Terminal graphics protocol".

use super::diacritics::mark;
use crate::picture::Image;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process;

/// The numbers of the viewer's images; the images of others are left alone. They have 24 bits, as colours of placeholders have.
pub const NUMBERS: [u32; 2] = [0x53_5048, 0x53_5049];
/// Bytes of a piece, encoded: no more is allowed.
const PIECE: usize = 4096;
/// Images are behind text, and behind the background of text that has one.
const LAYER: i32 = i32::MIN / 2 - 1;
/// Shows the part of an image that its marks and its colour name.
const PLACEHOLDER: char = '\u{10EEEE}';

/// Appends image `number` in so many columns and rows, and what removes the other one.
pub(super) fn write(
    image: &Image,
    cells: (u16, u16),
    number: u32,
    through_tmux: bool,
    out: &mut Vec<u8>,
) {
    let [even, odd] = NUMBERS;
    if through_tmux {
        // The same number: placeholders stay, whatever they show.
        send(image, even, &format!("U=1,{},q=2", size(cells)), through_tmux, out);
        placeholders(cells, even, out);
        return;
    }
    let (own, other) = if number.is_multiple_of(2) { (even, odd) } else { (odd, even) };
    out.extend_from_slice(b"\x1b[H");
    // The first image is answered: a terminal that is silent, or complains, has no such images.
    let quiet = if number == 0 { 0 } else { 2 };
    send(image, own, &format!("{},C=1,z={LAYER},q={quiet}", size(cells)), false, out);
    if number > 0 {
        command(&format!("a=d,d=I,i={other},q=2"), "", false, out);
    }
}

/// Appends an image where the cursor is, which is then in its last row, or below if it is higher than the screen.
pub(super) fn write_in_line(
    image: &Image,
    cells: (u16, u16),
    through_tmux: bool,
    is_higher: bool,
    out: &mut Vec<u8>,
) {
    if through_tmux {
        let number = lasting_number();
        send(image, number, &format!("U=1,{},q=2", size(cells)), true, out);
        for row in 0..cells.1 {
            if row > 0 {
                out.push(b'\n');
            }
            placeholder_row(cells.0, row, number, out);
        }
    } else if is_higher {
        // Without a number, so that the next one leaves it where it is.
        command_with_pixels(image, &format!("{},q=2", size(cells)), false, out);
    } else {
        // Where the image is as wide as the screen, the cursor itself would go a row too far.
        let down = cells.1.saturating_sub(1);
        if down > 0 {
            let room = "\n".repeat(down.into());
            out.extend_from_slice(format!("{room}\x1b[{down}A").as_bytes());
        }
        command_with_pixels(image, &format!("{},C=1,q=2", size(cells)), false, out);
        if down > 0 {
            out.extend_from_slice(format!("\x1b[{down}B").as_bytes());
        }
    }
}

/// The number of an image that stays when the program has ended: another process has another one. The highest of its 24
/// bits is set, which is not set in [`NUMBERS`].
fn lasting_number() -> u32 {
    0x80_0000 | (process::id() & 0x7f_ffff)
}

/// Appends what removes both images and frees their memory.
pub(super) fn remove(through_tmux: bool, out: &mut Vec<u8>) {
    for number in NUMBERS {
        command(&format!("a=d,d=I,i={number},q=2"), "", through_tmux, out);
    }
}

fn size((columns, rows): (u16, u16)) -> String {
    format!("c={columns},r={rows}")
}

fn send(image: &Image, number: u32, keys: &str, through_tmux: bool, out: &mut Vec<u8>) {
    command_with_pixels(image, &format!("i={number},{keys}"), through_tmux, out);
}

fn command_with_pixels(image: &Image, keys: &str, through_tmux: bool, out: &mut Vec<u8>) {
    let mut deflated = ZlibEncoder::new(Vec::new(), Compression::fast());
    // A vector takes all there is.
    let _ = deflated.write_all(&image.rgb);
    let payload = STANDARD.encode(deflated.finish().unwrap_or_default());
    let mut keys = format!("a=T,f=24,o=z,s={},v={},{keys},", image.width, image.height);
    let mut pieces = payload.as_bytes().chunks(PIECE).peekable();
    while let Some(piece) = pieces.next() {
        let _ = write!(keys, "m={}", u8::from(pieces.peek().is_some()));
        // Base64 is text.
        command(&keys, str::from_utf8(piece).unwrap_or_default(), through_tmux, out);
        keys.clear();
    }
}

fn command(keys: &str, payload: &str, through_tmux: bool, out: &mut Vec<u8>) {
    let separator = if payload.is_empty() { "" } else { ";" };
    // tmux hands on the contents of its string, in which every escape is written twice.
    let (begin, end) = if through_tmux {
        ("\x1bPtmux;\x1b\x1b_G", "\x1b\x1b\\\x1b\\")
    } else {
        ("\x1b_G", "\x1b\\")
    };
    for part in [begin, keys, separator, payload, end] {
        out.extend_from_slice(part.as_bytes());
    }
}

/// Appends cells that show the image, from the top left on.
fn placeholders((columns, rows): (u16, u16), number: u32, out: &mut Vec<u8>) {
    for row in 0..rows {
        out.extend_from_slice(format!("\x1b[{}H", row + 1).as_bytes());
        placeholder_row(columns, row, number, out);
    }
}

/// Appends a row of placeholders; nothing past the last row that can be named.
fn placeholder_row(columns: u16, row: u16, number: u32, out: &mut Vec<u8>) {
    let (Some(mark_of_row), Some(mark_of_column)) = (mark(row), mark(0)) else { return };
    let [_, red, green, blue] = number.to_be_bytes();
    let mut text = format!("\x1b[38;2;{red};{green};{blue}m");
    for column in 0..columns {
        text.push(PLACEHOLDER);
        // The next placeholders go on from the first.
        if column == 0 {
            text.extend([mark_of_row, mark_of_column]);
        }
    }
    text += "\x1b[m";
    out.extend_from_slice(text.as_bytes());
}
