//! How a class of errors looks in a cell: a colour, or a letter.

use super::verdict::Class;
use crate::cells::Cell;
use crate::color::{Srgb, luminance};
use crate::palette::{shown, shown_by};
use crate::style::{Charset, ColorDepth, Style};

/// The least ulp of every grey but the first, which is no error at all.
pub(super) const BANDS: [u64; 6] = [1, 2, 4, 16, 256, 65_536];

/// Wrong decisions have colours that colour-blind people tell apart, from each other and from grey: vermillion, sky
/// blue, yellow and blue of M. Okabe and K. Ito, "Color Universal Design", 2008. Rounding errors are grey, the lighter
/// the worse.
const OTHER_SPHERE: u32 = 0xf0_e442;
const FALSE_HIT: u32 = 0xd5_5e00;
const LOST_HIT: u32 = 0x56_b4e9;
const OTHER_ROOT: u32 = 0x00_72b2;
const GREYS: [u32; 7] =
    [0x30_3030, 0x4a_4a4a, 0x68_6868, 0x8a_8a8a, 0xae_aeae, 0xd4_d4d4, 0xff_ffff];
const MISS: u32 = 0;

/// Which of [`BANDS`] an error is in, by its power of two.
pub(super) fn band(log: u8) -> usize {
    let least = 1_u64 << log.min(63);
    BANDS.partition_point(|&from| from <= least).saturating_sub(1)
}

/// The letter of a class.
pub(super) fn letter(class: Class) -> char {
    match class {
        Class::Miss => ' ',
        Class::Right => '.',
        Class::Off(log) => char::from(b'0' + log.min(9)),
        Class::OtherRoot => 'R',
        Class::LostHit => 'L',
        Class::FalseHit => 'F',
        Class::OtherSphere => 'S',
    }
}

fn color(class: Class) -> Srgb {
    let digits = match class {
        Class::Miss => MISS,
        Class::Right => GREYS[0],
        Class::Off(log) => GREYS[1 + band(log)],
        Class::OtherRoot => OTHER_ROOT,
        Class::LostHit => LOST_HIT,
        Class::FalseHit => FALSE_HIT,
        Class::OtherSphere => OTHER_SPHERE,
    };
    let [_, red, green, blue] = digits.to_be_bytes();
    Srgb([red, green, blue])
}

/// The cells of all classes, as a style has them.
#[derive(Debug)]
pub(super) struct Marks {
    /// Whether cells have letters: without colour, in ASCII, and where there are not enough colours for all.
    pub(super) has_letters: bool,
    /// The cells of miss, right, off by a power of two from 0 to 31, and the wrong decisions.
    cells: [Cell; 38],
}

impl Marks {
    pub(super) fn new(style: &Style) -> Self {
        let has_letters = style.charset == Charset::Ascii
            || matches!(style.depth, ColorDepth::Never | ColorDepth::Ansi16);
        let classes = [Class::Miss, Class::Right].into_iter().chain((0..32).map(Class::Off));
        let decisions =
            [Class::OtherRoot, Class::LostHit, Class::FalseHit, Class::OtherSphere].into_iter();
        let mut cells = [Cell::BLANK; 38];
        for (cell, class) in cells.iter_mut().zip(classes.chain(decisions)) {
            if has_letters {
                cell.glyph = letter(class);
            }
            if style.depth != ColorDepth::Never {
                let paper = color(class);
                let is_dark = luminance(paper.to_linear()) < 0.18;
                let ink = if is_dark { Srgb::WHITE } else { Srgb::BLACK };
                let (depth, theme) = (style.depth, &style.theme);
                cell.background = shown_by(paper, depth, theme, |entry| entry.is_paper);
                if cell.glyph != ' ' {
                    cell.foreground = shown(ink, depth, theme);
                }
            }
        }
        Self { has_letters, cells }
    }

    pub(super) fn cell(&self, class: Class) -> Cell {
        self.cells[match class {
            Class::Miss => 0,
            Class::Right => 1,
            Class::Off(log) => 2 + usize::from(log.min(31)),
            Class::OtherRoot => 34,
            Class::LostHit => 35,
            Class::FalseHit => 36,
            Class::OtherSphere => 37,
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::Color;
    use crate::palette::Theme;

    const DECISIONS: [Class; 4] =
        [Class::OtherRoot, Class::LostHit, Class::FalseHit, Class::OtherSphere];

    fn one_a_look() -> Vec<Class> {
        let greys = BANDS.map(|from| Class::Off(from.ilog2() as u8));
        [Class::Miss, Class::Right].into_iter().chain(greys).chain(DECISIONS).collect()
    }

    #[test]
    fn bands_are_what_their_names_say() {
        let bands: Vec<_> = (0..32).map(band).collect();
        assert_eq!(bands[..5], [0, 1, 2, 2, 3]);
        assert_eq!((bands[7], bands[8], bands[15], bands[16], bands[31]), (3, 4, 4, 5, 5));
    }

    #[test]
    fn every_look_has_a_colour_or_a_letter_of_its_own() {
        for depth in
            [ColorDepth::Never, ColorDepth::Ansi16, ColorDepth::Ansi256, ColorDepth::Truecolor]
        {
            for charset in [Charset::Ascii, Charset::Half, Charset::Block] {
                let style = Style { charset, depth, ..Style::PLAIN };
                let few_papers = Theme { papers: 8, ..Theme::VGA };
                for style in [style, Style { theme: few_papers, ..style }] {
                    every_look_is_its_own(&style);
                }
            }
        }
    }

    fn every_look_is_its_own(style: &Style) {
        let (marks, mut seen) = (Marks::new(style), Vec::new());
        for class in one_a_look() {
            let cell = marks.cell(class);
            let look = (cell.glyph, cell.background);
            assert!(!seen.contains(&look), "{style:?}: {class:?}, {seen:?}");
            assert!(
                cell.glyph == ' '
                    || cell.background == Color::Default
                    || cell.foreground != cell.background
            );
            if let Color::Ansi16(paper) = cell.background {
                assert!(paper < style.theme.papers, "{style:?}: {class:?}");
            }
            seen.push(look);
        }
    }

    #[test]
    fn the_worse_the_rounding_the_lighter() {
        let light = |class| luminance(color(class).to_linear());
        let classes = one_a_look();
        let (greys, _) = classes.split_at(2 + BANDS.len());
        assert!(greys.windows(2).all(|pair| light(pair[0]) < light(pair[1])));
    }
}
