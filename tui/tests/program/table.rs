//! `--show table`: bars over a picture, whose numbers are those of `tradeoff`.

use crate::run::{is_of_size, json, prints};
use spherule_kernel::Tier;

/// A row of a table: the tier, nanoseconds a ray, wrong rays in a million, ulp.
fn rows_of_table(text: &str) -> Vec<(String, f64, u64, Option<u64>)> {
    let names = Tier::ALL.map(|tier| format!(" {} ", tier.as_str()));
    let rows = text.lines().filter(|line| names.iter().any(|name| line.starts_with(name)));
    let row = |line: &str| {
        let words = line.split([' ', '#']).filter(|word| !word.is_empty());
        let [tier, ns, wrong, ulp] = words.take(4).collect::<Vec<_>>()[..] else {
            panic!("four words: {line}")
        };
        let whole = |word: &str| word.replace(',', "").parse().ok();
        let (ns, wrong) = (ns.parse().expect("a time"), whole(wrong).expect("a count"));
        (tier.to_owned(), ns, wrong, whole(ulp))
    };
    rows.map(row).collect()
}

/// The table says what `tradeoff` reports of the same rays.
#[test]
fn a_table_is_what_tradeoff_reports() {
    for words in ["edge --size 80x24", "far --size 90x30 --order object", "unit --size 70x20"] {
        let report = json(&format!("tradeoff {words} --json --threads 1"));
        let text = prints(&format!("{words} --once --show table --threads 1"));
        assert!(text.is_ascii() && text.contains(", 1 thread "), "{text}");
        assert_eq!(text.contains("object order"), words.contains("object"), "{text}");
        let (table, tiers) = (rows_of_table(&text), report["tiers"].as_array().expect("a list"));
        assert_eq!(table.len(), tiers.len(), "{text}");
        for ((tier, ns, wrong, ulp), reported) in table.into_iter().zip(tiers) {
            assert_eq!(reported["accuracy"], *tier);
            assert!(ns > 0.0);
            let sum: u64 = ["wrong_hits", "wrong_misses", "wrong_sphere"]
                .map(|key| reported[key].as_u64().expect(key))
                .iter()
                .sum();
            let kind = reported["rays_kind"].as_str().expect("a kind");
            let line = text.lines().find(|line| line.contains(&format!("{kind} rays")));
            let rays = line.and_then(|line| line.split_whitespace().next()).expect("their number");
            let rays: u64 = rays.replace(',', "").parse().expect("a number");
            assert_eq!(wrong, (1_000_000 * sum).div_ceil(rays), "{words} {tier}");
            assert_eq!(ulp, reported["ulp_max"].as_u64(), "{words} {tier}");
        }
    }
}

#[test]
fn a_table_of_every_size_and_depth() {
    for size in ["1x1", "2x1", "61x14", "62x13", "200x9", "300x40"] {
        let (columns, rows) = size.split_once('x').expect("a size");
        let [wide, high] = [columns, rows].map(|count| count.parse::<u32>().expect("n"));
        for (charset, color) in [("ascii", "never"), ("half", "16"), ("block", "truecolor")] {
            let options = format!("--charset {charset} --color {color} --size {size}");
            let text = prints(&format!("marbles --once --show table {options}"));
            assert_eq!(text.lines().count().to_string(), rows);
            assert!(!text.contains('\x1b') || color != "never", "{size}");
            if charset == "ascii" {
                assert!(text.is_ascii() && is_of_size(&text, size), "{size}");
                let fits = wide >= 62 && high >= 13;
                assert_eq!(text.contains("ulp: logarithms"), fits, "{text}");
                assert_eq!(text.contains("table needs"), !fits && wide > 20, "{text}");
            }
        }
    }
}
