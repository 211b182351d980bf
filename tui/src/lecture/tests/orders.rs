//! Image order and object order: their words and their counts.

use super::{Turn, named, text};

/// The numbers that follow `name`, wherever it stands.
fn numbers(text: &str, name: &str) -> Vec<u64> {
    let number = |rest: &str| -> u64 {
        let digits = rest.trim_start().split(|c: char| !c.is_ascii_digit()).next();
        digits.expect(name).parse().expect(name)
    };
    text.split(name).skip(1).map(number).collect()
}

/// Object order writes more than image order by what it overwrites.
#[test]
fn both_orders_count_the_same_writes() {
    let station = named("race");
    let text = text(station, station.turned(station.first(), Turn::Up));
    assert_eq!(text.matches(": done").count(), 2, "{text}");
    let (writes, overwritten) = (numbers(&text, "writes "), numbers(&text, "overwrite "));
    assert!(overwritten[0] == 0 && overwritten[1] > 0, "{text}");
    assert!(writes[0] > 0 && writes[0] == writes[1] - overwritten[1], "{text}");
}

#[test]
fn image_order_writes_hits_alone() {
    let [first, last] = [0, 219].map(|pixel| text(named("image-order"), [pixel, 0]));
    assert_eq!((numbers(&first, "pixels so far"), numbers(&first, "(hits)")), (vec![1], vec![0]));
    let (pixels, hits) = (numbers(&last, "pixels so far"), numbers(&last, "(hits)"));
    assert!(pixels == [220] && hits[0] > 50 && hits[0] < 200, "{last}");
}

/// The words are true of the counts.
#[test]
fn object_order_says_how_much_is_overwritten() {
    let overwritten = |reversed| {
        let text = text(named("object-order"), [5, reversed]);
        let all = text.split("all ").nth(1).expect("a sum");
        let numbers = all.split_whitespace().take(3).map(str::parse::<u64>);
        let [_, writes, overwritten] =
            numbers.map(|number| number.expect("a count")).collect::<Vec<_>>()[..]
        else {
            panic!("three counts: {text}")
        };
        assert!(overwritten < writes / 2, "much is overwritten: {text}");
        (overwritten, text)
    };
    let (some, text) = overwritten(0);
    assert!(some > 0 && text.contains("far to near: some is"), "{text}");
    let (few, text) = overwritten(1);
    assert!(few < some && text.contains("little or") && text.contains("nothing is"), "{text}");
}

#[test]
fn depths_are_written_alike() {
    let text = text(named("object-order"), [0, 0]);
    assert!(text.contains("waits, at z = -1.0 ") && text.contains("waits, at z = -3.0 "), "{text}");
}
