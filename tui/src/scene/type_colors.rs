//! The colours of types without an element.

use crate::color::Srgb;

/// Colours that the colour-blind tell apart, for types without an element: M. Okabe, K. Ito, "Color Universal Design"
/// (2002), without black.
const TYPE_COLORS: [Srgb; 7] = [
    Srgb([0x56, 0xb4, 0xe9]),
    Srgb([0xe6, 0x9f, 0x00]),
    Srgb([0x00, 0x9e, 0x73]),
    Srgb([0xcc, 0x79, 0xa7]),
    Srgb([0xf0, 0xe4, 0x42]),
    Srgb([0xd5, 0x5e, 0x00]),
    Srgb([0x00, 0x72, 0xb2]),
];

/// The colour of a type: by its number, so that types which come and go between frames keep theirs, else by its `place`
/// among the types.
pub(super) fn type_color(place: usize, name: &str) -> Srgb {
    let count = TYPE_COLORS.len();
    let number = name.parse::<i32>().ok();
    let number = number.map(|number| (i64::from(number) - 1).rem_euclid(count as i64) as usize);
    TYPE_COLORS[number.unwrap_or(place % count)]
}
