//! What a terminal answers when it is asked: never a key.
//!
//! Sources: xterm's "Control Sequences" (ctlseqs), DEC STD 070, kitty's "Terminal graphics protocol".

use crate::color::Srgb;

/// The longest answer that is understood.
const LONGEST: usize = 256;
/// The most pixels of a cell, in width and height: a terminal that claims more is not believed.
pub(super) const LARGEST_CELL: u16 = 512;
/// A background of no palette: a terminal that tells it back has 24 bits.
pub(super) const RARE_COLOR: [u8; 3] = [1, 2, 3];

/// An answer that is understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply {
    /// Primary device attributes (DA1): every terminal answers these, and in the order in which it was asked.
    Attributes {
        /// Whether it shows sixels.
        sixel: bool,
    },
    /// Whether it holds its picture back between the brackets of mode 2026 (DECRPM).
    Synchronized(bool),
    /// How many pixels a cell has (XTWINOPS 16): width, height.
    CellPixels(u16, u16),
    /// The colour behind cells that have none of their own (OSC 11).
    Background(Srgb),
    /// Whether it has 24 bits of colour, by what it tells of the pen (DECRQSS): the colour itself, or an entry of a palette.
    Truecolor(bool),
    /// What it says of an image by kitty's protocol: its number, and whether all is well.
    Image(u32, bool),
    /// How many colours an image in sixels may have (XTSMGRAPHICS 1).
    SixelColors(u16),
    /// How many pixels such an image may have, across and down (XTSMGRAPHICS 2).
    SixelPixels(u32, u32),
    /// It has taken what was sent to it so far (DSR 5).
    Status,
}

/// Reads what follows `ESC [`, up to the `last` byte.
pub(super) fn of_sequence(parameters: &[u8], last: u8) -> Option<Reply> {
    let text = str::from_utf8(parameters).ok()?;
    match last {
        b'c' => {
            let mut attributes = text.strip_prefix('?')?.split(';');
            Some(Reply::Attributes { sixel: attributes.any(|attribute| attribute == "4") })
        }
        b'n' => (text == "0").then_some(Reply::Status),
        b'S' => {
            let mut numbers = text.strip_prefix('?')?.split(';').map(str::parse::<u32>);
            let mut next = || numbers.next()?.ok();
            // The second number is 0 if all is well.
            match (next()?, next()?, next().filter(|&number| number > 0)?, next()) {
                (1, 0, colors, None) => {
                    Some(Reply::SixelColors(u16::try_from(colors).unwrap_or(u16::MAX)))
                }
                (2, 0, width, Some(height @ 1..)) => Some(Reply::SixelPixels(width, height)),
                _ => None,
            }
        }
        b't' => {
            let mut sizes = text.strip_prefix("6;")?.split(';').map(str::parse::<u16>);
            let mut next = || sizes.next()?.ok().filter(|size| (1..=LARGEST_CELL).contains(size));
            let (height, width) = (next()?, next()?);
            Some(Reply::CellPixels(width, height))
        }
        b'y' => {
            let state = text.strip_prefix("?2026;")?.strip_suffix('$')?;
            // Set, reset, or set for good; 0 is a mode that it does not know, 4 one that is never set.
            Some(Reply::Synchronized(matches!(state, "1" | "2" | "3")))
        }
        _ => None,
    }
}

/// Reads a string that `ESC` and `kind` introduced.
pub(super) fn of_string(kind: u8, content: &[u8]) -> Option<Reply> {
    let text = str::from_utf8(content).ok().filter(|text| text.len() <= LONGEST)?;
    match kind {
        b']' => background(text.strip_prefix("11;")?).map(Reply::Background),
        b'P' => {
            let pen = text.strip_prefix("1$r")?.strip_suffix('m')?;
            depth(pen).map(Reply::Truecolor)
        }
        b'_' => {
            let (keys, message) = text.strip_prefix('G')?.split_once(';')?;
            let id = keys.split(',').find_map(|key| key.strip_prefix("i=")?.parse().ok())?;
            Some(Reply::Image(id, message == "OK"))
        }
        _ => None,
    }
}

/// `rgb:R/G/B` or `rgba:R/G/B/A`, each of one to four hexadecimal digits: fractions of the largest number with as many
/// digits.
fn background(text: &str) -> Option<Srgb> {
    let channels = text.strip_prefix("rgb:").or_else(|| text.strip_prefix("rgba:"))?;
    let mut channels = channels.split('/').map(|digits| {
        let most = match digits.len() {
            count @ 1..=4 => (1_u32 << (4 * count)) - 1,
            _ => return None,
        };
        let is_plain = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let level = u32::from_str_radix(digits, 16).ok().filter(|_| is_plain);
        level.map(|level| ((level * 255 + most / 2) / most) as u8)
    });
    let mut next = || channels.next().flatten();
    Some(Srgb([next()?, next()?, next()?]))
}

/// Whether the pen's background is the colour that was asked for, instead of an entry of a palette; `None` if no
/// background is told. There are colons or semicolons between the numbers, and a colour space or none.
fn depth(pen: &str) -> Option<bool> {
    let pen = pen.replace(':', ";");
    let [red, green, blue] = RARE_COLOR;
    let color = format!("{red};{green};{blue}");
    let is_told = |rest: &str| {
        let rest = rest.strip_prefix(';').unwrap_or(rest);
        rest.strip_prefix(&*color).is_some_and(|rest| rest.is_empty() || rest.starts_with(';'))
    };
    let is_rare = pen.match_indices("48;2;").any(|(at, start)| is_told(&pen[at + start.len()..]));
    if is_rare { Some(true) } else { pen.contains("48;5;").then_some(false) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pens_are_told_in_several_ways() {
        for (pen, expected) in [
            ("0;48:2:1:2:3", Some(true)),
            ("0;48:2::1:2:3", Some(true)),
            ("48;2;1;2;3", Some(true)),
            ("0;48;2;1;2;3;1", Some(true)),
            ("0;48:5:16", Some(false)),
            ("0;48;2;1;2;33", None),
            ("0;38:2:1:2:3", None),
            ("0", None),
            ("", None),
        ] {
            let reply = of_string(b'P', format!("1$r{pen}m").as_bytes());
            assert_eq!(reply, expected.map(Reply::Truecolor), "{pen}");
        }
        assert_eq!(of_string(b'P', b"0$r"), None);
        assert_eq!(of_string(b'P', b"1$r2 q"), None);
    }

    #[test]
    fn backgrounds_have_one_to_four_digits() {
        for (text, color) in [
            ("11;rgb:ffff/8080/0000", Some([255, 128, 0])),
            ("11;rgb:ff/80/00", Some([255, 128, 0])),
            ("11;rgb:f/8/0", Some([255, 136, 0])),
            ("11;rgba:1e1e/1e1e/2e2e/ffff", Some([0x1e, 0x1e, 0x2e])),
            ("11;rgb:ff/80", None),
            ("11;rgb:fffff/0/0", None),
            ("11;rgb:+f/0/0", None),
            ("11;#ffffff", None),
            ("10;rgb:ff/80/00", None),
        ] {
            let expected = color.map(|color| Reply::Background(Srgb(color)));
            assert_eq!(of_string(b']', text.as_bytes()), expected, "{text}");
        }
    }

    #[test]
    fn what_is_not_ours_is_nothing() {
        assert_eq!(of_string(b'_', b"Gi=31;ENOTSUP:no"), Some(Reply::Image(31, false)));
        assert_eq!(of_string(b'_', b"Ga=d;OK"), None);
        assert_eq!(of_string(b'_', b"Gi=31"), None);
        assert_eq!(of_string(b'^', b"11;rgb:ff/ff/ff"), None);
        assert_eq!(of_string(b']', &[b'1'; 1000]), None);
        assert_eq!(of_sequence(b"6;0;9", b't'), None);
        assert_eq!(of_sequence(b"6;512;256", b't'), Some(Reply::CellPixels(256, 512)));
        for too_large in ["6;60000;60000", "6;513;256", "6;20;513"] {
            assert_eq!(of_sequence(too_large.as_bytes(), b't'), None, "{too_large}");
        }
        assert_eq!(of_sequence(b"?1;0;16", b'S'), Some(Reply::SixelColors(16)));
        assert_eq!(of_sequence(b"?1;0;65536", b'S'), Some(Reply::SixelColors(65535)));
        assert_eq!(of_sequence(b"?2;0;1000;800", b'S'), Some(Reply::SixelPixels(1000, 800)));
        for no_limit in ["?1;3;0", "?1;0;0", "?1;3", "?2;0;0;0", "?2;0;1000", "?3;0;1;1", "1"] {
            assert_eq!(of_sequence(no_limit.as_bytes(), b'S'), None, "{no_limit}");
        }
        assert_eq!(of_sequence(b"?2026;0$", b'y'), Some(Reply::Synchronized(false)));
        assert_eq!(of_sequence(b"?2026;2$", b'y'), Some(Reply::Synchronized(true)));
        assert_eq!(of_sequence(b"?25;2$", b'y'), None);
        assert_eq!(of_sequence(b">1;10;0", b'c'), None);
    }
}
