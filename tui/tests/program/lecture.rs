//! The lecture, printed.

use crate::run::{is_of_size, prints};
use spherule::lecture::stations::STATIONS;
use std::fs;
use std::path::Path;

fn lecture(words: &str) -> String {
    prints(&format!("lecture {words}"))
}

#[test]
fn the_list_names_every_station_and_its_sources() {
    let list = lecture("--list");
    for (number, entry) in (1..).zip(&STATIONS) {
        assert!(list.contains(&format!("{number:>2}  {} ", entry.name)), "{}", entry.name);
        assert!(list.contains(entry.topic), "{}", entry.name);
        for source in entry.sources {
            assert!(list.contains(source.file), "{}", entry.name);
        }
    }
    assert!(list.contains("Triangles"));
}

#[test]
fn sources_are_where_they_are_said_to_be() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for source in STATIONS.iter().flat_map(|entry| entry.sources) {
        let text = fs::read_to_string(root.join(source.file)).expect(source.file);
        for symbol in source.symbols {
            assert!(text.contains(symbol), "{symbol} in {}", source.file);
        }
    }
}

#[test]
fn every_station_is_printed_by_number_and_by_name() {
    let mut all = String::new();
    for (number, entry) in (1..).zip(&STATIONS) {
        let page = lecture(&format!("--once --station {number}"));
        assert!(is_of_size(&page, "80x24"), "{page}");
        assert!(page.starts_with(&format!(" {number:>2}/14  {}", entry.title)), "{page}");
        assert!(page.is_ascii() && !page.contains('\x1b'), "{page}");
        assert_eq!(lecture(&format!("--station {}", entry.name)), page);
        all += &page;
    }
    // Into a pipe all of them.
    assert_eq!(lecture(""), all);
    assert_eq!(lecture("--once"), all);
}

#[test]
fn colour_is_there_when_it_is_asked_for() {
    for number in 1..=STATIONS.len() {
        let colored = lecture(&format!("--station {number} --color 16"));
        assert!(colored.contains("\x1b["), "{colored}");
        let plain = lecture(&format!("--station {number} --color never"));
        assert!(!plain.contains('\x1b'));
    }
}

#[test]
fn a_size_is_kept_and_one_that_is_too_small_is_named() {
    for number in 1..=STATIONS.len() {
        let large = lecture(&format!("--station {number} --size 132x50"));
        assert!(is_of_size(&large, "132x50") && !large.contains("needs"), "{large}");
        let small = lecture(&format!("--station {number} --size 40x10"));
        assert!(is_of_size(&small, "40x10"), "{small}");
        assert!(small.ends_with("needs 80x24, has 40x10                  \n"), "{small}");
        assert!(is_of_size(&lecture(&format!("--station {number} --size 1x1")), "1x1"));
    }
}
