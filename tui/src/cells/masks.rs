//! The glyphs that are geometry: which parts of a cell each of them fills.
//!
//! A family cuts the cell into a grid of up to eight equal bins. Bit `i` of a mask is bin `i`, row by row from the
//! top left; the tables name the glyph that fills just the bins of a mask, in the order of the masks.
//!
//! Source: The Unicode Standard 16.0, charts Block Elements (U+2580), Braille Patterns (U+2800), Symbols for Legacy
//! Computing (U+1FB00) and its Supplement (U+1CC00). The tests hold the tables against the names of the characters.

use crate::style::Charset;
use std::array;
use std::sync::LazyLock;

/// Upper and lower half.
const HALVES: [&str; 1] = [" ▀▄█"];

const QUADRANTS: [&str; 1] = [" ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"];

const SEXTANTS: [&str; 4] =
    [" 🬀🬁🬂🬃🬄🬅🬆🬇🬈🬉🬊🬋🬌🬍🬎", "🬏🬐🬑🬒🬓▌🬔🬕🬖🬗🬘🬙🬚🬛🬜🬝", "🬞🬟🬠🬡🬢🬣🬤🬥🬦🬧▐🬨🬩🬪🬫🬬", "🬭🬮🬯🬰🬱🬲🬳🬴🬵🬶🬷🬸🬹🬺🬻█"];

const OCTANTS: [&str; 16] = [
    " 𜺨𜺫🮂𜴀▘𜴁𜴂𜴃𜴄▝𜴅𜴆𜴇𜴈▀",
    "𜴉𜴊𜴋𜴌🯦𜴍𜴎𜴏𜴐𜴑𜴒𜴓𜴔𜴕𜴖𜴗",
    "𜴘𜴙𜴚𜴛𜴜𜴝𜴞𜴟🯧𜴠𜴡𜴢𜴣𜴤𜴥𜴦",
    "𜴧𜴨𜴩𜴪𜴫𜴬𜴭𜴮𜴯𜴰𜴱𜴲𜴳𜴴𜴵🮅",
    "𜺣𜴶𜴷𜴸𜴹𜴺𜴻𜴼𜴽𜴾𜴿𜵀𜵁𜵂𜵃𜵄",
    "▖𜵅𜵆𜵇𜵈▌𜵉𜵊𜵋𜵌▞𜵍𜵎𜵏𜵐▛",
    "𜵑𜵒𜵓𜵔𜵕𜵖𜵗𜵘𜵙𜵚𜵛𜵜𜵝𜵞𜵟𜵠",
    "𜵡𜵢𜵣𜵤𜵥𜵦𜵧𜵨𜵩𜵪𜵫𜵬𜵭𜵮𜵯𜵰",
    "𜺠𜵱𜵲𜵳𜵴𜵵𜵶𜵷𜵸𜵹𜵺𜵻𜵼𜵽𜵾𜵿",
    "𜶀𜶁𜶂𜶃𜶄𜶅𜶆𜶇𜶈𜶉𜶊𜶋𜶌𜶍𜶎𜶏",
    "▗𜶐𜶑𜶒𜶓▚𜶔𜶕𜶖𜶗▐𜶘𜶙𜶚𜶛▜",
    "𜶜𜶝𜶞𜶟𜶠𜶡𜶢𜶣𜶤𜶥𜶦𜶧𜶨𜶩𜶪𜶫",
    "▂𜶬𜶭𜶮𜶯𜶰𜶱𜶲𜶳𜶴𜶵𜶶𜶷𜶸𜶹𜶺",
    "𜶻𜶼𜶽𜶾𜶿𜷀𜷁𜷂𜷃𜷄𜷅𜷆𜷇𜷈𜷉𜷊",
    "𜷋𜷌𜷍𜷎𜷏𜷐𜷑𜷒𜷓𜷔𜷕𜷖𜷗𜷘𜷙𜷚",
    "▄𜷛𜷜𜷝𜷞▙𜷟𜷠𜷡𜷢▟𜷣▆𜷤𜷥█",
];

/// Halves and quadrants, each before its complement, which is in as many fonts, and as long.
const OPPOSITES: &str = "▀▄▌▐▘▟▝▙▖▜▗▛▚▞";

/// The glyph that fills what `glyph` leaves, if it is as common.
#[must_use]
pub fn opposite(glyph: char) -> Option<char> {
    // Most are spaces, and few are anything else.
    if !('▀'..='▟').contains(&glyph) {
        return None;
    }
    let place = OPPOSITES.chars().position(|other| other == glyph)?;
    OPPOSITES.chars().nth(place ^ 1)
}

/// Which bit of a code of Braille is the dot in each bin. A font fills some part of the bin.
const DOTS: [u32; 8] = [0, 3, 1, 4, 2, 5, 6, 7];

fn braille() -> Vec<char> {
    let dots = |mask: u32| (0..8).map(|bin: usize| (mask >> bin & 1) << DOTS[bin]).sum::<u32>();
    (0..256).filter_map(|mask| char::from_u32(0x2800 + dots(mask))).collect()
}

/// Eighths from the left, 1 to 7, and from the bottom.
const LEFT_EIGHTHS: &str = "▏▎▍▌▋▊▉";
const LOWER_EIGHTHS: &str = "▁▂▃▄▅▆▇";
/// Single eighths, 2 to 7, from the left and from the top.
const UPRIGHT_LINES: &str = "🭰🭱🭲🭳🭴🭵";
const LEVEL_LINES: &str = "🭶🭷🭸🭹🭺🭻";

/// A glyph by the part of the cell that it fills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mask {
    /// The character.
    pub glyph: char,
    /// The bins that it fills.
    pub bits: u8,
    /// How much of each of 2 x 4 parts of the cell it fills, row by row.
    pub cover: Cover,
}

/// How much of 2 x 4 parts of a cell is filled, row by row: what a reader sees of a glyph from some way off.
pub type Cover = [f32; 8];

impl Mask {
    /// Nothing is filled.
    pub const SPACE: Self = Self { glyph: ' ', bits: 0, cover: [0.0; 8] };
}

/// The masks of one grid of bins. Of two that are each other's complement, it has one.
#[derive(Clone, Debug)]
pub struct Family {
    /// Bins side by side.
    pub across: usize,
    /// Bins one above the other.
    pub down: usize,
    /// The masks that fill some bins, but not all.
    pub masks: Vec<Mask>,
}

impl Family {
    /// How many bins.
    #[must_use]
    pub fn bins(&self) -> usize {
        self.across * self.down
    }

    fn new(across: usize, down: usize, glyphs: impl Iterator<Item = (u8, char)>) -> Self {
        let mask = |(bits, glyph)| Mask { glyph, bits, cover: cover(across, down, bits) };
        Self { across, down, masks: glyphs.map(mask).collect() }
    }

    /// All masks of a table. Of two that are each other's complement it has the one with the lower code, which is in
    /// more fonts, and shorter.
    fn of_table(across: usize, down: usize, table: &[char]) -> Self {
        let all = table.len() - 1;
        let masks = (1..all).filter(|&bits| table[bits] < table[all - bits]);
        Self::new(across, down, masks.map(|bits| (bits as u8, table[bits])))
    }
}

fn cover(across: usize, down: usize, bits: u8) -> Cover {
    array::from_fn(|part| {
        let bins = (0..across).flat_map(|column| (0..down).map(move |row| (column, row)));
        let filled = bins.filter(|(column, row)| bits >> (row * across + column) & 1 == 1);
        let area = |(column, row)| {
            overlap((part % 2, 2), (column, across)) * overlap((part / 2, 4), (row, down))
        };
        filled.map(area).sum()
    })
}

/// How much of `part` lies in `other`. Each is (index, count): one of `count` equal parts.
pub(super) fn overlap(part: (usize, usize), other: (usize, usize)) -> f32 {
    // In units of 1 / (count * count): whole numbers.
    let start = (part.0 * other.1).max(other.0 * part.1);
    let end = ((part.0 + 1) * other.1).min((other.0 + 1) * part.1);
    end.saturating_sub(start) as f32 / other.1 as f32
}

/// What a charset has besides the space.
#[derive(Debug)]
pub struct Repertoire {
    /// The grids that a mask may be of.
    pub families: Vec<Family>,
    /// The finest grid that has a glyph for every mask: bins side by side, one above the other, and the glyphs.
    pub mosaic: (usize, usize, Vec<char>),
}

fn table(rows: &[&str]) -> Vec<char> {
    rows.iter().flat_map(|row| row.chars()).collect()
}

/// Bars from the left, by quarters, and from the bottom, by eighths. They are in all fonts that have sextants. The
/// former are quarters, since cells that get sextants have four columns of samples.
fn bars() -> [Family; 2] {
    let quarters = LEFT_EIGHTHS.chars().skip(1).step_by(2);
    let upright = quarters.zip(1..).map(|(glyph, count)| (!(0xff << count), glyph));
    let level = LOWER_EIGHTHS.chars().zip(1..).map(|(glyph, count)| (!(0xff >> count), glyph));
    [Family::new(4, 1, upright), Family::new(1, 8, level)]
}

fn eighths() -> [Family; 2] {
    let bars = |glyphs: &'static str, bits: fn(u8) -> u8| {
        glyphs.chars().zip(1..).map(move |(glyph, count)| (bits(count), glyph))
    };
    let lines =
        |glyphs: &'static str| glyphs.chars().zip(1..).map(|(glyph, bin)| (1_u8 << bin, glyph));
    let upright = bars(LEFT_EIGHTHS, |count| !(0xff << count)).chain(lines(UPRIGHT_LINES));
    let level = bars(LOWER_EIGHTHS, |count| !(0xff >> count)).chain(lines(LEVEL_LINES));
    [Family::new(8, 1, upright), Family::new(1, 8, level)]
}

/// What `charset` has; nothing for ASCII, which is no geometry.
#[must_use]
pub fn repertoire(charset: Charset) -> &'static Repertoire {
    static ALL: LazyLock<[Repertoire; 6]> = LazyLock::new(|| {
        let [halves, quadrants, sextants, octants] =
            [&HALVES[..], &QUADRANTS, &SEXTANTS, &OCTANTS].map(table);
        let braille = braille();
        let family = Family::of_table;
        let (two, four) = (family(1, 2, &halves), family(2, 2, &quadrants));
        let (six, eight) = (family(2, 3, &sextants), family(2, 4, &octants));
        let left_half = Family::new(2, 1, [(1, '▌')].into_iter());
        let dots = family(2, 4, &braille);
        let [upright, level] = eighths();
        let [upright_bars, level_bars] = bars();
        let block = vec![four.clone(), six.clone(), eight.clone(), upright, level];
        [
            Repertoire { families: vec![two, left_half], mosaic: (1, 2, halves) },
            Repertoire { families: vec![four.clone()], mosaic: (2, 2, quadrants) },
            Repertoire {
                families: vec![four.clone(), six, upright_bars.clone(), level_bars.clone()],
                mosaic: (2, 3, sextants),
            },
            Repertoire {
                families: vec![four, eight, upright_bars, level_bars],
                mosaic: (2, 4, octants.clone()),
            },
            Repertoire { families: vec![dots], mosaic: (2, 4, braille) },
            Repertoire { families: block, mosaic: (2, 4, octants) },
        ]
    });
    &ALL[match charset {
        Charset::Ascii | Charset::Half => 0,
        Charset::Quadrant => 1,
        Charset::Sextant => 2,
        Charset::Octant => 3,
        Charset::Braille => 4,
        Charset::Block => 5,
    }]
}

#[cfg(test)]
mod tests;
