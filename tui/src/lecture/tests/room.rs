//! What a station draws, and its text: nothing is cut, and nothing is written over.

use super::{TURNS, named};
use crate::lecture::canvas::Canvas;
use crate::lecture::frame::{self, LEAST};
use crate::lecture::station::{Numbers, Station};
use crate::lecture::stations::STATIONS;
use crate::style::Style;
use std::collections::HashSet;

/// Each arrow held down, then each other one from there.
#[test]
fn texts_have_room_beside_pictures() {
    let room = frame::room(LEAST);
    for station in &STATIONS {
        let mut seen = HashSet::new();
        for (one, other) in TURNS.iter().flat_map(|one| TURNS.map(|other| (*one, other))) {
            let mut numbers = station.first();
            for turn in [one; 45].into_iter().chain([other; 45]) {
                numbers = station.turned_in(room, numbers, turn);
                if seen.insert(numbers) {
                    check_room(station, numbers);
                }
            }
        }
        assert!(seen.len() > 8, "{}: {}", station.name, seen.len());
    }
}

fn check_room(station: &Station, numbers: Numbers) {
    let (columns, rows) = frame::room(LEAST);
    let mut canvas = Canvas::new(columns, rows, Style::PLAIN);
    let text = (station.draw)(numbers, &mut canvas);
    let picture = canvas.into_cells().lines();
    let case = || format!("{} {numbers:?}:\n{text}", station.name);
    if station.text == 0 {
        // What reaches the last column may be cut.
        assert!(picture.iter().all(|row| row.ends_with(' ')), "{}", case());
        return;
    }
    let left = usize::from(columns) - station.text as usize + 1;
    assert!(text.lines().count() <= usize::from(rows), "{}", case());
    for (line, row) in text.lines().zip(&picture) {
        assert!(left + line.len() <= row.len(), "{line:?} is cut: {}", case());
        let below = &row[left..left + line.len()];
        assert!(below.trim().is_empty(), "{line:?} over {below:?}: {}", case());
    }
}

/// Both ends of the interval are drawn on the number line, wherever they are.
#[test]
fn the_ends_of_an_interval_are_seen() {
    let station = named("interval");
    let (columns, rows) = frame::room(LEAST);
    let [least, greatest] = [-8, 32];
    for ends in [[least, greatest], [greatest, greatest], [least, least], [0, 28]] {
        let mut canvas = Canvas::new(columns, rows, Style::PLAIN);
        (station.draw)(ends, &mut canvas);
        let cells = canvas.into_cells();
        let has = |glyph| cells.cells().iter().any(|cell| cell.glyph == glyph);
        assert!(has(']') && (ends[0] == ends[1] || has('[')), "{ends:?}");
    }
}
