//! What the points of charts are called: on the least page, every name that the text uses is seen.

use super::{LEAST, Numbers, Turn, named, text};
use crate::lecture::frame;

/// The picture alone.
fn picture(name: &str, numbers: Numbers) -> String {
    let station = named(name);
    let columns = usize::from(frame::room(LEAST).0) - station.text as usize;
    let text = text(station, numbers);
    text.lines().map(|line| format!("{}\n", &line[..columns])).collect()
}

#[test]
fn every_point_of_the_ray_is_seen_wherever_it_goes() {
    for degrees in (0..360).step_by(5) {
        for quarters in -12..=16 {
            let seen = picture("ray", [quarters, degrees]);
            assert!(seen.contains('*') && seen.contains("r(t)"), "{seen}");
        }
        // The place of r(t) is none of these.
        let seen = picture("ray", [-12, degrees]);
        for name in ["1", "2", "3", "4", "o p"] {
            assert!(seen.contains(name), "{name}: {seen}");
        }
    }
}

#[test]
fn the_origin_is_seen_as_far_as_it_is_moved() {
    for name in ["algebraic", "geometric"] {
        let station = named(name);
        for turn in [Turn::Left, Turn::Right] {
            let far = (0..50).fold(station.first(), |numbers, _| station.turned(numbers, turn));
            let seen = picture(name, far);
            assert!(seen.contains("o p"), "{name}: {seen}");
        }
    }
}

#[test]
fn the_sum_of_vectors_covers_no_name() {
    for halves in 1..=6 {
        for degrees in (0..360).step_by(10) {
            let seen = picture("vectors", [degrees, halves]);
            assert!(seen.contains("a+b"), "{seen}");
        }
        let seen = picture("vectors", [300, halves]);
        assert!(seen.contains("> a") && seen.contains("> b"), "{seen}");
    }
    let short = picture("vectors", [0, 1]);
    assert!(short.contains("> a") && short.contains("a+b"), "{short}");
}

#[test]
fn the_triangle_has_all_its_names() {
    let seen = picture("geometric", named("geometric").first());
    for name in ["o p", "> d", "* t1", "* t2", "+ c", "m", "l"] {
        assert!(seen.contains(name), "{name}: {seen}");
    }
    assert_eq!(seen.matches("dt").count(), 2, "{seen}");
}
