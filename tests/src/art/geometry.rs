//! The shapes of block characters, by Unicode's charts "Block Elements", "Symbols for Legacy Computing"
//! and its supplement.

use super::cell::{Coverage, HEIGHT, WIDTH, even, rectangles};

/// The area of a block character, or of a space; `None` for every other.
///
/// Shades are even tones, as if their dots were too small to see.
#[must_use]
pub fn coverage(character: char) -> Option<Coverage> {
    let place = |first: char| u32::from(character) - u32::from(first);
    let eighths = |count: u32| count as f32 / 8.0;
    let lower = |share: f32| rectangles(&[[0.0, 1.0 - share, 1.0, 1.0]]);
    let left = |share: f32| rectangles(&[[0.0, 0.0, share, 1.0]]);
    let upper = |share: f32| rectangles(&[[0.0, 0.0, 1.0, share]]);
    let right = |share: f32| rectangles(&[[1.0 - share, 0.0, 1.0, 1.0]]);
    // The eighths that Block Elements lacks.
    let others = |first: char| eighths([2, 3, 5, 6, 7][place(first) as usize]);
    Some(match character {
        ' ' | '\u{a0}' => even(0.0),
        '▀' => upper(0.5),
        '▁'..='█' => lower(eighths(place('▁') + 1)),
        '▉'..='▏' => left(eighths(7 - place('▉'))),
        '▐' => right(0.5),
        '░'..='▓' => even((place('░') + 1) as f32 / 4.0),
        '▔' => upper(0.125),
        '▕' => right(0.125),
        '▖'..='▟' => mosaic(QUADRANTS[place('▖') as usize], 2),
        '\u{1fb00}'..='\u{1fb3b}' => mosaic(nth(&SEXTANTS_ELSEWHERE, place('\u{1fb00}'))?, 3),
        '\u{1cd00}'..='\u{1cde5}' => mosaic(nth(&OCTANTS_ELSEWHERE, place('\u{1cd00}'))?, 4),
        '\u{1cea8}' => mosaic(0b0000_0001, 4),
        '\u{1ceab}' => mosaic(0b0000_0010, 4),
        '\u{1cea3}' => mosaic(0b0100_0000, 4),
        '\u{1cea0}' => mosaic(0b1000_0000, 4),
        '\u{1fbe6}' => mosaic(0b0001_0100, 4),
        '\u{1fbe7}' => mosaic(0b0010_1000, 4),
        '\u{1fb70}'..='\u{1fb75}' => {
            let start = eighths(place('\u{1fb70}') + 1);
            rectangles(&[[start, 0.0, start + 0.125, 1.0]])
        }
        '\u{1fb76}'..='\u{1fb7b}' => {
            let start = eighths(place('\u{1fb76}') + 1);
            rectangles(&[[0.0, start, 1.0, start + 0.125]])
        }
        '\u{1fb3c}'..='\u{1fb51}' => diagonal(DIAGONALS[place('\u{1fb3c}') as usize]),
        // The same edges, and the other side filled.
        '\u{1fb52}'..='\u{1fb67}' => {
            diagonal(DIAGONALS[place('\u{1fb52}') as usize]).map(|share| 1.0 - share)
        }
        '\u{1fb68}'..='\u{1fb6b}' => quarters(place('\u{1fb68}')).map(|share| 1.0 - share),
        '\u{1fb6c}'..='\u{1fb6f}' => quarters(place('\u{1fb6c}')),
        '\u{1fb82}'..='\u{1fb86}' => upper(others('\u{1fb82}')),
        '\u{1fb87}'..='\u{1fb8b}' => right(others('\u{1fb87}')),
        _ => return None,
    })
}

/// Which of 2 x 2 parts each quadrant character covers; the first part is the lowest bit.
const QUADRANTS: [u8; 10] =
    [0b0100, 0b1000, 0b0001, 0b1101, 0b1001, 0b0111, 0b1011, 0b0010, 0b0110, 0b1110];

/// Sextants and octants stand in the order of their bits. Shapes that are other characters are left out: none, the
/// halves, all; and of octants also those made of quadrants, and quarters of the cell.
const SEXTANTS_ELSEWHERE: [u8; 4] = [0b00_00_00, 0b01_01_01, 0b10_10_10, 0b11_11_11];
const OCTANTS_ELSEWHERE: [u8; 26] = [
    // Shapes made of quadrants: both rows of an upper or a lower one.
    0b0000_0000,
    0b0000_0101,
    0b0000_1010,
    0b0000_1111,
    0b0101_0000,
    0b0101_0101,
    0b0101_1010,
    0b0101_1111,
    0b1010_0000,
    0b1010_0101,
    0b1010_1010,
    0b1010_1111,
    0b1111_0000,
    0b1111_0101,
    0b1111_1010,
    0b1111_1111,
    // Corners and middles.
    0b0000_0001,
    0b0000_0010,
    0b0100_0000,
    0b1000_0000,
    0b0001_0100,
    0b0010_1000,
    // Rows from the top and from the bottom.
    0b0000_0011,
    0b0011_1111,
    0b1100_0000,
    0b1111_1100,
];

/// The bits of the `n`-th character, without those in `elsewhere`.
fn nth(elsewhere: &[u8], n: u32) -> Option<u8> {
    (0..=u8::MAX).filter(|bits| !elsewhere.contains(bits)).nth(n as usize)
}

/// The parts whose bits are set, of 2 x `rows` equal parts, row by row.
fn mosaic(bits: u8, rows: u8) -> Coverage {
    let covered = (0..2 * rows).filter(|part| bits >> part & 1 == 1);
    let parts = covered.map(|part| {
        let (x, y) = (f32::from(part % 2) / 2.0, f32::from(part / 2) / f32::from(rows));
        [x, y, x + 0.5, y + 1.0 / f32::from(rows)]
    });
    rectangles(&parts.collect::<Vec<_>>())
}

/// A place on the border: halves of the width, thirds of the height.
type Place = [u8; 2];

/// For each diagonal from U+1FB3C on where its edge starts and ends, and a corner that is filled, as the names say.
const DIAGONALS: [(Place, Place, Place); 22] = [
    ([0, 2], [1, 3], [0, 3]),
    ([0, 2], [2, 3], [0, 3]),
    ([0, 1], [1, 3], [0, 3]),
    ([0, 1], [2, 3], [0, 3]),
    ([0, 0], [1, 3], [0, 3]),
    ([0, 1], [1, 0], [2, 3]),
    ([0, 1], [2, 0], [2, 3]),
    ([0, 2], [1, 0], [2, 3]),
    ([0, 2], [2, 0], [2, 3]),
    ([0, 3], [1, 0], [2, 3]),
    ([0, 2], [2, 1], [2, 3]),
    ([1, 3], [2, 2], [2, 3]),
    ([0, 3], [2, 2], [2, 3]),
    ([1, 3], [2, 1], [2, 3]),
    ([0, 3], [2, 1], [2, 3]),
    ([1, 3], [2, 0], [2, 3]),
    ([1, 0], [2, 1], [0, 3]),
    ([0, 0], [2, 1], [0, 3]),
    ([1, 0], [2, 2], [0, 3]),
    ([0, 0], [2, 2], [0, 3]),
    ([1, 0], [2, 3], [0, 3]),
    ([0, 1], [2, 2], [0, 3]),
];

/// How many points of a pixel, side by side, an area is sampled at.
const POINTS: usize = 16;

/// The share of each pixel's points that are filled; places are in shares of the cell.
fn counted(filled: impl Fn(f32, f32) -> bool) -> Coverage {
    std::array::from_fn(|pixel| {
        let points = (0..POINTS * POINTS).filter(|point| {
            let at =
                |pixel: usize, point: usize| pixel as f32 + (point as f32 + 0.5) / POINTS as f32;
            let x = at(pixel % WIDTH, point % POINTS) / WIDTH as f32;
            filled(x, at(pixel / WIDTH, point / POINTS) / HEIGHT as f32)
        });
        points.count() as f32 / (POINTS * POINTS) as f32
    })
}

fn diagonal((from, to, corner): (Place, Place, Place)) -> Coverage {
    let [from, to, corner] =
        [from, to, corner].map(|[x, y]| [f32::from(x) / 2.0, f32::from(y) / 3.0]);
    let side =
        |x: f32, y: f32| (x - from[0]) * (to[1] - from[1]) > (y - from[1]) * (to[0] - from[0]);
    let filled = side(corner[0], corner[1]);
    counted(|x, y| side(x, y) == filled)
}

/// Triangles from a side to the middle: left, upper, right, lower.
fn quarters(side: u32) -> Coverage {
    counted(|x, y| {
        let distances = [x, y, 1.0 - x, 1.0 - y];
        let nearest = (0..4).min_by(|&a: &usize, &b| distances[a].total_cmp(&distances[b]));
        nearest == Some(side as usize)
    })
}
