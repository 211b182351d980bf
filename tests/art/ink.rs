//! The program's tables of ink against the fonts. If what is measured changes, write them again:
//!
//! ```text
//! cargo test -p spherule-tests -- --ignored pin_ink
//! ```

use spherule::ink;
use spherule_tests::art::font::Font;
use spherule_tests::art::ink::{lines, parts};
use std::fs;

const TABLES: [(&str, &[u128; 95], Font); 2] = [
    ("UNIFONT", &ink::UNIFONT, Font::Unifont),
    ("DEJAVU_SANS_MONO", &ink::DEJAVU_SANS_MONO, Font::DejaVuSansMono),
];

#[test]
fn ink_is_as_measured() {
    for (name, table, font) in TABLES {
        for character in ' '..='~' {
            let kept = ink::coverage(table, character).expect("ASCII");
            let measured = parts(font, character).map(|part| f32::from(part) / 15.0);
            assert_eq!(kept, measured, "{character:?} of {name}");
        }
    }
}

#[test]
#[ignore = "writes tui/src/ink.rs"]
fn pin_ink() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tui/src/ink.rs");
    let mut source = fs::read_to_string(path).expect(path);
    for (name, _, font) in TABLES {
        let head = format!("pub const {name}: [u128; 95] = [\n");
        let start = source.find(&head).expect("the table") + head.len();
        let end = start + source[start..].find("];").expect("its end");
        source.replace_range(start..end, &lines(font));
    }
    fs::write(path, source).expect(path);
}
