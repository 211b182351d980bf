//! The colours that numbers stand for: the 16 of some well-known themes, and xterm's 256.

/// Red, green and blue, sRGB-encoded.
pub type Rgb = [u8; 3];

/// The 8 colours of a theme and their bright ones.
pub type Sixteen = [Rgb; 16];

/// The 16 colours of a theme; `None` if it is not known here.
#[must_use]
pub fn sixteen(name: &str) -> Option<Sixteen> {
    let (_, digits) = THEMES.iter().find(|(known, _)| *known == name)?;
    let color = |word| {
        u32::from_str_radix(word, 16).map(|rgb| [(rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8])
    };
    let colors = digits.split_whitespace().map(color).collect::<Result<Vec<_>, _>>();
    colors.ok()?.try_into().ok()
}

/// The 16 colours of xterm.
///
/// # Panics
/// Never: the theme is known here.
#[must_use]
pub fn xterm() -> Sixteen {
    sixteen("xterm").expect("a known theme")
}

/// By their sources: the defaults of xterm and of the VGA's text mode, GNOME's Tango, Ethan Schoonover's Solarized.
const THEMES: [(&str, &str); 4] = [
    (
        "xterm",
        "000000 cd0000 00cd00 cdcd00 0000ee cd00cd 00cdcd e5e5e5 \
         7f7f7f ff0000 00ff00 ffff00 5c5cff ff00ff 00ffff ffffff",
    ),
    (
        "vga",
        "000000 aa0000 00aa00 aa5500 0000aa aa00aa 00aaaa aaaaaa \
         555555 ff5555 55ff55 ffff55 5555ff ff55ff 55ffff ffffff",
    ),
    (
        "tango",
        "2e3436 cc0000 4e9a06 c4a000 3465a4 75507b 06989a d3d7cf \
         555753 ef2929 8ae234 fce94f 729fcf ad7fa8 34e2e2 eeeeec",
    ),
    (
        "solarized",
        "073642 dc322f 859900 b58900 268bd2 d33682 2aa198 eee8d5 \
         002b36 cb4b16 586e75 657b83 839496 6c71c4 93a1a1 fdf6e3",
    ),
];

/// The colour at `index` of xterm's 256. The first 16 are the theme's; then come a cube of 6 x 6 x 6, and greys.
#[must_use]
pub fn indexed(index: u8, sixteen: &Sixteen) -> Rgb {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let index = usize::from(index);
    if let Some(&color) = sixteen.get(index) {
        return color;
    }
    let cube = index - 16;
    match cube {
        0..216 => [cube / 36, cube / 6 % 6, cube % 6].map(|step| LEVELS[step]),
        _ => [(8 + 10 * (cube - 216)) as u8; 3],
    }
}
