//! The tables against the names of the characters, which say what each of them fills.

use super::*;
use clap::ValueEnum;
use std::collections::{BTreeMap, BTreeSet};

/// A cell in 8 x 24 points: every bin of every family is a whole number of them.
const WIDTH: usize = 8;
const HEIGHT: usize = 24;
type Points = [bool; WIDTH * HEIGHT];

const GEOMETRY: [Charset; 6] = [
    Charset::Half,
    Charset::Quadrant,
    Charset::Sextant,
    Charset::Octant,
    Charset::Braille,
    Charset::Block,
];

/// The families of every charset.
fn families() -> impl Iterator<Item = (Charset, &'static Family)> {
    let of = |charset| repertoire(charset).families.iter().map(move |family| (charset, family));
    GEOMETRY.into_iter().flat_map(of)
}

/// The names of the characters, from the Unicode Character Database.
fn names() -> BTreeMap<char, &'static str> {
    let lines = include_str!("names.txt").lines().filter(|line| !line.starts_with('#'));
    let name = |line: &'static str| {
        let (code, name) = line.split_once(';').expect("code;name");
        let code = u32::from_str_radix(code, 16).expect("hexadecimal");
        (char::from_u32(code).expect("a character"), name)
    };
    lines.map(name).collect()
}

/// The points of a cell whose place, in eighths of its width and in twenty-fourths of its height, is `inside`.
fn points(inside: impl Fn(usize, usize) -> bool) -> Points {
    array::from_fn(|point| inside(point % WIDTH, point / WIDTH))
}

fn points_of(family: &Family, bits: u8) -> Points {
    let bin = |x, y| y * family.down / HEIGHT * family.across + x * family.across / WIDTH;
    points(|x, y| bits >> bin(x, y) & 1 == 1)
}

/// A side and how much of the cell there, in twenty-fourths.
fn side(side: &str, part: usize) -> Points {
    points(|x, y| match side {
        "UPPER" => y < part,
        "LOWER" => HEIGHT - 1 - y < part,
        "LEFT" => 3 * x < part,
        "RIGHT" => 3 * (WIDTH - 1 - x) < part,
        other => panic!("no side: {other}"),
    })
}

fn both(one: &Points, other: &Points) -> Points {
    array::from_fn(|point| one[point] && other[point])
}

/// What a character fills, by its name.
fn named(name: &str) -> Points {
    // Numbered parts, 1 being the first; with where each of them is.
    let numbered = [
        ("BLOCK SEXTANT-", 2, 3, "123456"),
        ("BLOCK OCTANT-", 2, 4, "12345678"),
        // Seven and eight came later, below the others.
        ("BRAILLE PATTERN DOTS-", 2, 4, "14253678"),
        ("VERTICAL ONE EIGHTH BLOCK-", 8, 1, "12345678"),
        ("HORIZONTAL ONE EIGHTH BLOCK-", 1, 8, "12345678"),
    ];
    for (start, across, down, order) in numbered {
        if let Some(numbers) = name.strip_prefix(start) {
            let order: Vec<char> = order.chars().collect();
            let bin = |x, y| y * down / HEIGHT * across + x * across / WIDTH;
            return points(|x, y| numbers.contains(order[bin(x, y)]));
        }
    }
    if let Some(quadrants) = name.strip_prefix("QUADRANT ") {
        let mut filled = [false; WIDTH * HEIGHT];
        for quadrant in quadrants.split(" AND ") {
            let (row, column) = quadrant.split_once(' ').expect("row and column");
            let quadrant = both(&side(row, 12), &side(column, 12));
            filled = array::from_fn(|point| filled[point] || quadrant[point]);
        }
        return filled;
    }
    match name {
        "SPACE" | "BRAILLE PATTERN BLANK" => return [false; WIDTH * HEIGHT],
        "FULL BLOCK" => return [true; WIDTH * HEIGHT],
        // A quarter of the cell, in its middle half.
        "MIDDLE LEFT ONE QUARTER BLOCK" => return points(|x, y| x < 4 && (6..18).contains(&y)),
        "MIDDLE RIGHT ONE QUARTER BLOCK" => return points(|x, y| x >= 4 && (6..18).contains(&y)),
        _ => {}
    }
    // A side and a part; or two of them, and what is in both.
    let mut words = name.strip_suffix(" BLOCK").expect("a block").split(' ');
    let mut filled = [true; WIDTH * HEIGHT];
    while let Some(place) = words.next() {
        let count = match words.next() {
            Some("HALF") => 12,
            Some(count) => {
                let unit = match words.next() {
                    Some("EIGHTH" | "EIGHTHS") => 3,
                    Some("QUARTER" | "QUARTERS") => 6,
                    other => panic!("no unit: {other:?} in {name}"),
                };
                let counts = ["ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN"];
                unit * (1 + counts.iter().position(|&known| known == count).expect("a count"))
            }
            None => panic!("no part: {name}"),
        };
        filled = both(&filled, &side(place, count));
    }
    filled
}

#[test]
fn every_mask_is_what_its_name_says() {
    let names = names();
    for (_, family) in families() {
        for mask in &family.masks {
            let name = names[&mask.glyph];
            assert_eq!(points_of(family, mask.bits), named(name), "{} {name}", mask.glyph);
        }
    }
}

#[test]
fn every_glyph_of_a_mosaic_is_what_its_name_says() {
    let names = names();
    for charset in GEOMETRY {
        let (across, down, glyphs) = &repertoire(charset).mosaic;
        let family = Family { across: *across, down: *down, masks: Vec::new() };
        assert_eq!(glyphs.len(), 1 << family.bins(), "{charset:?}");
        for (bits, glyph) in glyphs.iter().enumerate() {
            let name = names[glyph];
            assert_eq!(points_of(&family, bits as u8), named(name), "{glyph} {name}");
        }
    }
}

#[test]
fn names_are_told_apart() {
    // Were all names one, tables would be right whatever they hold. Braille's dots are octants, to this test.
    let mut known = BTreeMap::new();
    // Wedges are no masks.
    let is_mask = |glyph: char| {
        !('\u{2800}'..='\u{28ff}').contains(&glyph) && !('\u{1fb3c}'..='\u{1fb6f}').contains(&glyph)
    };
    for (&glyph, name) in names().iter().filter(|&(&glyph, _)| is_mask(glyph)) {
        // What no table can hold.
        let other_shape =
            [" AND LOWER ONE", " AND UPPER ONE"].iter().any(|part| name.contains(part));
        if !other_shape {
            let twin = known.insert(named(name).to_vec(), glyph);
            assert_eq!(twin, None, "{glyph} {name}");
        }
    }
    assert!(known.len() > 300);
}

#[test]
fn of_two_complements_a_family_has_one() {
    for (charset, family) in families() {
        let all = (1_u16 << family.bins()) - 1;
        let masks: BTreeSet<_> = family.masks.iter().map(|mask| u16::from(mask.bits)).collect();
        assert_eq!(masks.len(), family.masks.len(), "{charset:?}: a mask twice");
        for bits in &masks {
            assert!((1..all).contains(bits), "{charset:?}: {bits:b} of {all:b}");
            assert!(!masks.contains(&(all - bits)), "{charset:?}: {bits:b} and its complement");
        }
        // Bars and lines in one direction are few of the many masks; the others are complete.
        let expected = match (family.across, family.down, charset) {
            (4, 1, _) => 3,
            (1, 8, Charset::Block) | (8, 1, _) => 7 + 6,
            (1, 8, _) => 7,
            _ => usize::from(all / 2),
        };
        assert_eq!(masks.len(), expected, "{charset:?}");
    }
}

#[test]
fn covers_are_the_filled_part_of_each_part() {
    for (_, family) in families() {
        for mask in &family.masks {
            let filled = points_of(family, mask.bits);
            for (part, &cover) in mask.cover.iter().enumerate() {
                let inside = points(|x, y| (x / 4, y / 6) == (part % 2, part / 2));
                let count = both(&filled, &inside).iter().filter(|&&filled| filled).count();
                let expected = count as f32 / (WIDTH * HEIGHT / 8) as f32;
                assert!((cover - expected).abs() < 1e-6, "{} part {part}: {cover}", mask.glyph);
            }
            let area = mask.cover.iter().sum::<f32>() / 8.0;
            let filled = mask.bits.count_ones() as f32 / family.bins() as f32;
            assert!((area - filled).abs() < 1e-6, "{}: {area}", mask.glyph);
        }
    }
}

/// What a charset can fill, or leave.
fn shapes(charset: Charset) -> BTreeSet<Vec<bool>> {
    let mut shapes = BTreeSet::new();
    for family in &repertoire(charset).families {
        for mask in &family.masks {
            let filled = points_of(family, mask.bits);
            shapes.extend([filled.to_vec(), filled.map(|filled| !filled).to_vec()]);
        }
    }
    shapes
}

fn glyphs(charset: Charset) -> impl Iterator<Item = char> {
    let families = repertoire(charset).families.iter();
    families.flat_map(|family| family.masks.iter().map(|mask| mask.glyph))
}

#[test]
fn a_finer_charset_has_what_the_coarser_has() {
    let contained = [
        (Charset::Half, Charset::Quadrant),
        (Charset::Quadrant, Charset::Sextant),
        (Charset::Quadrant, Charset::Octant),
        (Charset::Sextant, Charset::Block),
        (Charset::Octant, Charset::Block),
    ];
    for (coarse, fine) in contained {
        let (few, many) = (shapes(coarse), shapes(fine));
        assert!(few.is_subset(&many) && few.len() < many.len(), "{coarse:?} in {fine:?}");
    }
}

#[test]
fn no_charset_has_glyphs_of_a_finer_one() {
    // What `auto` writes is in every font.
    assert_eq!(glyphs(Charset::Half).collect::<String>(), "▀▌");
    assert!(glyphs(Charset::Quadrant).max() <= Some('▟'));
    // The first of Symbols for Legacy Computing is in Unicode 13, and so are all of its sextants.
    assert!(glyphs(Charset::Sextant).max() <= Some('🬻'));
    assert_eq!(Charset::value_variants().len(), GEOMETRY.len() + 1, "ASCII is no geometry");
}

#[test]
fn opposites_fill_what_the_other_leaves() {
    let all = table(&QUADRANTS);
    let mut found = 0;
    for (bits, &glyph) in all.iter().enumerate() {
        if let Some(other) = opposite(glyph) {
            assert_eq!(other, all[15 - bits], "{glyph}");
            found += 1;
        }
    }
    // All but nothing and everything.
    assert_eq!((found, opposite(' '), opposite('█'), opposite('a')), (14, None, None, None));
}
