//! The colours that a terminal has, and what a person sees in them.
//!
//! In the palettes the nearest colour is the one that looks nearest: by distance in `OKLab`.

use crate::color::{Srgb, oklab};
use crate::counted::counted;
use spherule_kernel::Vec3;
use std::str::FromStr;

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorDepth {
    /// None: glyphs alone.
    Never,
    /// The 16 of the user's theme.
    Ansi16,
    /// The xterm palette.
    Ansi256,
    /// 24 bits.
    Truecolor,
}

/// A colour as a terminal names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Color {
    /// The terminal's own.
    #[default]
    Default,
    /// One of the 16 that the user's theme defines.
    Ansi16(u8),
    /// One of the xterm palette of 256.
    Ansi256(u8),
    /// Red, green, blue, sRGB-encoded.
    Rgb([u8; 3]),
}

/// What a terminal's 16 colours are, and which of them it has behind characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Theme {
    /// Black, red, green, yellow, blue, magenta, cyan, white, and the same bright.
    pub colors: [Srgb; 16],
    /// How many of them can be paper, the first ones: all, or the eight that are not bright.
    pub papers: u8,
}

/// The themes that have names.
pub const THEMES: [(&str, Theme); 4] = [
    ("xterm", Theme::XTERM),
    ("vga", Theme::VGA),
    ("tango", Theme::TANGO),
    ("solarized", Theme::SOLARIZED),
];

impl Theme {
    /// Of xterm as it is built.
    pub const XTERM: Self = Self::new([
        0x00_0000, 0xcd_0000, 0x00_cd00, 0xcd_cd00, 0x00_00ee, 0xcd_00cd, 0x00_cdcd, 0xe5_e5e5,
        0x7f_7f7f, 0xff_0000, 0x00_ff00, 0xff_ff00, 0x5c_5cff, 0xff_00ff, 0x00_ffff, 0xff_ffff,
    ]);
    /// Of the text modes of VGA, and of the Linux console.
    pub const VGA: Self = Self::new([
        0x00_0000, 0xaa_0000, 0x00_aa00, 0xaa_5500, 0x00_00aa, 0xaa_00aa, 0x00_aaaa, 0xaa_aaaa,
        0x55_5555, 0xff_5555, 0x55_ff55, 0xff_ff55, 0x55_55ff, 0xff_55ff, 0x55_ffff, 0xff_ffff,
    ]);
    /// Of the Tango Desktop Project, as GNOME Terminal has it.
    pub const TANGO: Self = Self::new([
        0x2e_3436, 0xcc_0000, 0x4e_9a06, 0xc4_a000, 0x34_65a4, 0x75_507b, 0x06_989a, 0xd3_d7cf,
        0x55_5753, 0xef_2929, 0x8a_e234, 0xfc_e94f, 0x72_9fcf, 0xad_7fa8, 0x34_e2e2, 0xee_eeec,
    ]);
    /// Of Ethan Schoonover's Solarized.
    pub const SOLARIZED: Self = Self::new([
        0x07_3642, 0xdc_322f, 0x85_9900, 0xb5_8900, 0x26_8bd2, 0xd3_3682, 0x2a_a198, 0xee_e8d5,
        0x00_2b36, 0xcb_4b16, 0x58_6e75, 0x65_7b83, 0x83_9496, 0x6c_71c4, 0x93_a1a1, 0xfd_f6e3,
    ]);

    const fn new(digits: [u32; 16]) -> Self {
        let mut colors = [Srgb::BLACK; 16];
        let mut index = 0;
        while index < 16 {
            let [_, red, green, blue] = digits[index].to_be_bytes();
            colors[index] = Srgb([red, green, blue]);
            index += 1;
        }
        Self { colors, papers: 16 }
    }

    /// The paper of a colour's name: a bright one that cannot be paper is what it is without its brightness.
    #[must_use]
    pub fn paper(&self, color: Color) -> Color {
        match color {
            Color::Ansi16(index) if index >= self.papers => Color::Ansi16(index % 8),
            color => color,
        }
    }
}

impl FromStr for Theme {
    type Err = String;

    /// Reads a name, or 16 colours of six hexadecimal digits, `#` or not, with commas between them.
    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, theme)) = THEMES.iter().find(|(name, _)| *name == text) {
            return Ok(*theme);
        }
        let names = THEMES.map(|(name, _)| name).join(", ");
        let colors = text.split(',').map(|color| {
            let digits = color.trim();
            let digits = digits.strip_prefix('#').unwrap_or(digits);
            format!("#{digits}").parse::<Srgb>()
        });
        let colors = colors
            .collect::<Result<Vec<_>, _>>()
            .map_err(|_| format!("{names}, or 16 colours such as cd0000,00cd00"))?;
        let count = colors.len();
        let colors = colors.try_into().map_err(|_| {
            let colors = counted(count as u64, "colour");
            format!("{colors}; 16 are needed")
        })?;
        Ok(Self { colors, papers: 16 })
    }
}

/// The colour of the xterm palette of 256 at `index`. From 16 on it is a cube of 6 x 6 x 6, and 24 greys; below 16 it
/// is the theme: xterm's own.
#[must_use]
pub fn xterm_256(index: u8) -> Srgb {
    let level = |step: u8| if step == 0 { 0 } else { 55 + 40 * step };
    match index {
        0..16 => Theme::XTERM.colors[usize::from(index)],
        16..232 => Srgb([(index - 16) / 36, (index - 16) / 6 % 6, (index - 16) % 6].map(level)),
        232.. => Srgb([8 + 10 * (index - 232); 3]),
    }
}

/// A colour to choose.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub color: Color,
    /// In linear light.
    pub light: Vec3,
    /// In `OKLab`.
    pub look: Vec3,
    /// Whether it can be paper; ink it can always be.
    pub is_paper: bool,
}

/// The colours of a depth; none if there are too many or too few to list.
#[must_use]
pub fn entries(depth: ColorDepth, theme: &Theme) -> Vec<Entry> {
    let entry = |color, srgb: Srgb, is_paper| {
        let light = srgb.to_linear();
        Entry { color, light, look: oklab(light), is_paper }
    };
    match depth {
        ColorDepth::Never | ColorDepth::Truecolor => Vec::new(),
        ColorDepth::Ansi16 => (0..)
            .zip(theme.colors)
            .map(|(index, srgb)| entry(Color::Ansi16(index), srgb, index < theme.papers))
            .collect(),
        // The first 16 are the theme's: with 240 others, none of them is worth the doubt.
        ColorDepth::Ansi256 => {
            (16..=255).map(|index| entry(Color::Ansi256(index), xterm_256(index), true)).collect()
        }
    }
}

/// The colour of a terminal of this depth that looks most like `srgb`, if only as ink; the terminal's own if there are no
/// colours.
#[must_use]
pub fn shown(srgb: Srgb, depth: ColorDepth, theme: &Theme) -> Color {
    shown_by(srgb, depth, theme, |_| true)
}

/// The same by those entries alone that `may` be taken.
pub(crate) fn shown_by(
    srgb: Srgb,
    depth: ColorDepth,
    theme: &Theme,
    may: fn(&Entry) -> bool,
) -> Color {
    match depth {
        ColorDepth::Never => Color::Default,
        ColorDepth::Truecolor => Color::Rgb(srgb.0),
        ColorDepth::Ansi16 | ColorDepth::Ansi256 => {
            let look = oklab(srgb.to_linear());
            let away = |entry: &Entry| entry.look.distance_squared(look);
            let entries = entries(depth, theme).into_iter().filter(may);
            let nearest = entries.min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.map_or(Color::Default, |entry| entry.color)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_the_xterm_palette() {
        assert_eq!(xterm_256(16), Srgb::BLACK);
        assert_eq!(xterm_256(21), Srgb([0, 0, 255]));
        assert_eq!(xterm_256(67), Srgb([95, 135, 175]));
        assert_eq!(xterm_256(231), Srgb::WHITE);
        assert_eq!(xterm_256(232), Srgb([8, 8, 8]));
        assert_eq!(xterm_256(255), Srgb([238, 238, 238]));
    }

    #[test]
    fn themes_have_names_or_are_lists() {
        assert_eq!("vga".parse(), Ok(Theme::VGA));
        let list = Theme::TANGO.colors.map(|Srgb([r, g, b])| format!("{r:02x}{g:02X}{b:02x}"));
        assert_eq!(list.join(",").parse(), Ok(Theme::TANGO));
        assert_eq!(list.map(|color| format!("#{color}")).join(", ").parse(), Ok(Theme::TANGO));
    }

    #[test]
    fn other_lists_are_none() {
        let error = |text: &str| text.parse::<Theme>().expect_err(text);
        assert!(error("amber").contains("solarized"));
        assert!(error("").contains("16 colours"));
        assert_eq!(error("000000"), "1 colour; 16 are needed");
        assert_eq!(error(&["000000"; 15].join(",")), "15 colours; 16 are needed");
        assert_eq!(error(&["000000"; 17].join(",")), "17 colours; 16 are needed");
        assert!(error(&["00000"; 16].join(",")).contains("such as"));
    }

    #[test]
    fn entries_name_what_they_show() {
        let theme = entries(ColorDepth::Ansi16, &Theme::VGA);
        assert_eq!((theme.len(), theme[3].color), (16, Color::Ansi16(3)));
        assert_eq!(Srgb::from_linear(theme[3].light), Srgb([0xaa, 0x55, 0]));
        let cube = entries(ColorDepth::Ansi256, &Theme::VGA);
        assert_eq!((cube.len(), cube[0].color), (240, Color::Ansi256(16)));
        assert!(entries(ColorDepth::Truecolor, &Theme::VGA).is_empty());
    }

    #[test]
    fn bright_colours_may_be_inks_alone() {
        let theme = Theme { papers: 8, ..Theme::VGA };
        let papers = |theme| {
            let entries = entries(ColorDepth::Ansi16, theme);
            entries.iter().filter(|entry| entry.is_paper).count()
        };
        assert_eq!((papers(&theme), papers(&Theme::VGA)), (8, 16));
        assert_eq!(shown(Srgb::WHITE, ColorDepth::Ansi16, &theme), Color::Ansi16(15));
        let red = Color::Ansi16(9);
        assert_eq!((theme.paper(red), Theme::VGA.paper(red)), (Color::Ansi16(1), red));
        assert_eq!(theme.paper(Color::Default), Color::Default);
    }
}
