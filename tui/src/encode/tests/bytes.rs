//! Which bytes an update writes.

use super::*;

fn one_line(cells: &[Cell]) -> CellGrid {
    grid_of(cells.len().try_into().expect("short"), 1, cells)
}

/// The encoder of a terminal that shows a picture, and room for what comes next.
fn showing(grid: &CellGrid) -> (Encoder, Vec<u8>) {
    let mut encoder = Encoder::new();
    encoder.encode(grid, &mut Vec::new());
    (encoder, Vec::new())
}

fn encoded(cells: &[Cell]) -> String {
    let mut bytes = Vec::new();
    full(&one_line(cells), &mut bytes);
    String::from_utf8(bytes).expect("UTF-8")
}

fn ink(glyph: char, foreground: Color) -> Cell {
    Cell { glyph, foreground, background: Color::Default }
}

#[test]
fn no_colour_no_escape() {
    assert_eq!(encoded(&[ink('a', Color::Default), Cell::BLANK]), "a \n");
    assert_eq!(encoded(&[ink('\x1b', Color::Default)]), "?\n");
}

#[test]
fn every_depth_has_its_parameters() {
    let both = |color| encoded(&[Cell { glyph: 'x', foreground: color, background: color }]);
    assert_eq!(both(Color::Ansi16(1)), "\x1b[31;41mx\x1b[0m\n");
    assert_eq!(both(Color::Ansi16(15)), "\x1b[97;107mx\x1b[0m\n");
    assert_eq!(both(Color::Ansi256(208)), "\x1b[38;5;208;48;5;208mx\x1b[0m\n");
    assert_eq!(both(Color::Rgb([0, 50, 255])), "\x1b[38;2;0;50;255;48;2;0;50;255mx\x1b[0m\n");
}

#[test]
fn colours_are_said_once() {
    let red = Color::Ansi16(1);
    let line = [ink('a', red), ink(' ', Color::Default), ink('b', red), ink('c', Color::Default)];
    assert_eq!(encoded(&line), "\x1b[31ma b\x1b[mc\x1b[0m\n");
    let background = |glyph, foreground| Cell { glyph, foreground, background: Color::Ansi16(4) };
    let line = [background('a', red), background('b', Color::Default), background(' ', red)];
    assert_eq!(encoded(&line), "\x1b[31;44ma\x1b[39mb \x1b[0m\n");
}

/// A grid of such lines, in the terminal's own colours.
fn written(lines: &[&str]) -> CellGrid {
    let mut grid = CellGrid::new(lines[0].len() as u16, lines.len() as u16);
    for (row, line) in (0..).zip(lines) {
        grid.write(0, row, line, Color::Default, Color::Default);
    }
    grid
}

/// The status line is sent with the frame, and by itself.
#[test]
fn a_row_is_sent_by_itself() {
    let (mut encoder, mut bytes) = (Encoder::new(), Vec::new());
    encoder.encode_row(&written(&["abc", "def"]), 1, &mut bytes);
    assert!(bytes.is_empty(), "nothing is known of the rest");
    encoder.encode_part(&written(&["abc", "def"]), Economy::NONE, &mut bytes);
    bytes.clear();
    encoder.encode_row(&written(&["abcd", "xyzd"]), 1, &mut bytes);
    encoder.encode_row(&written(&["abc", "def", "ghi"]), 2, &mut bytes);
    assert!(bytes.is_empty(), "what is known has another size");
    encoder.encode_row(&written(&["xyz", "deF"]), 1, &mut bytes);
    encoder.encode_row(&written(&["xyz", "deF"]), 2, &mut bytes);
    assert_eq!(bytes, b"\x1b[2;3HF");
    encoder.bracket(0, &mut bytes);
    assert_eq!(bytes, b"\x1b[2;3HF", "no brackets for a terminal that may not know them");
}

/// A level of grey, which a tolerance would leave.
#[test]
fn a_row_by_itself_is_exact() {
    let blank = |level| Cell { background: Color::Rgb([level; 3]), ..Cell::BLANK };
    let (mut encoder, mut bytes) = showing(&one_line(&[blank(128)]));
    encoder.encode_row(&one_line(&[blank(129)]), 0, &mut bytes);
    assert_eq!(bytes, b"\x1b[H\x1b[48;2;129;129;129m \x1b[m");
}

#[test]
fn a_screen_is_cleared_unless_it_is_known() {
    let (mut encoder, mut bytes) = (Encoder::new(), Vec::new());
    assert!(encoder.clear(3, 2, &mut bytes));
    assert_eq!(bytes, b"\x1b[m\x1b[2J\x1b[H");
    bytes.clear();
    assert!(!encoder.clear(3, 2, &mut bytes));
    encoder.encode(&CellGrid::new(3, 2), &mut bytes);
    assert!(bytes.is_empty(), "it is blank already");
    assert!(encoder.clear(3, 1, &mut bytes) && encoder.clear(2, 1, &mut bytes));
}

#[test]
fn what_was_drawn_over_is_written_again() {
    let lines = written(&[" bc", "def"]);
    let (mut encoder, mut bytes) = showing(&lines);
    encoder.covered(1, &lines);
    encoder.encode(&lines, &mut bytes);
    assert_eq!(bytes, b"\x1b[;2Hbc");
}

fn changes(from: &[&str], to: &[&str]) -> String {
    between(&written(from), &written(to))
}

/// What turns a terminal that knows brackets from one picture to another.
fn between(from: &CellGrid, to: &CellGrid) -> String {
    let (mut encoder, mut bytes) = (Encoder::new(), Vec::new());
    encoder.set_synchronized(true);
    encoder.encode(from, &mut bytes);
    bytes.clear();
    encoder.encode(to, &mut bytes);
    String::from_utf8(bytes).expect("UTF-8")
}

fn frame(body: &str) -> String {
    format!("\x1b[?2026h{body}\x1b[?2026l")
}

#[test]
fn the_cursor_goes_the_shortest_way() {
    assert_eq!(changes(&["abc", "def"], &["abc", "def"]), "");
    assert_eq!(changes(&["abc", "def"], &["Abc", "def"]), frame("\x1b[HA"));
    assert_eq!(changes(&["abc", "def"], &["abc", "dEf"]), frame("\x1b[2;2HE"));
    // A gap of three is written again, a gap of five is jumped.
    assert_eq!(changes(&["abcdefg"], &["AbcdEfg"]), frame("\x1b[HAbcdE"));
    assert_eq!(changes(&["abcdefg"], &["AbcdefG"]), frame("\x1b[HA\x1b[5CG"));
    // Straight down, a step back, and from the last column by a carriage return.
    assert_eq!(changes(&["abc", "def"], &["Abc", "dEf"]), frame("\x1b[HA\nE"));
    assert_eq!(changes(&["abcd", "efgh"], &["abCd", "efGh"]), frame("\x1b[;3HC\n\x08G"));
    assert_eq!(changes(&["abc", "def"], &["abC", "Def"]), frame("\x1b[;3HC\r\nD"));
    let lower = changes(&["abc", "def", "ghi"], &["abc", "deF", "Ghi"]);
    assert_eq!(lower, frame("\x1b[2;3HF\r\nG"));
}

#[test]
fn a_mark_is_inverse_without_a_colour_and_leaves_nothing_behind() {
    let line = |text: &str, marked: Option<u16>| {
        let mut grid = written(&[text]);
        if let Some(column) = marked {
            grid.set_mark(Some((column, 0)));
        }
        grid
    };
    let moved = |from, to| between(&line("abc", from), &line("abc", to));
    assert_eq!(moved(None, Some(1)), frame("\x1b[;2H\x1b[7mb\x1b[m"));
    assert_eq!(moved(Some(0), Some(1)), frame("\x1b[Ha\x1b[7mb\x1b[m"));
    assert_eq!(moved(Some(1), None), frame("\x1b[;2Hb"));
    assert_eq!(moved(Some(2), Some(2)), "");
    // In a gap it is jumped over, since no pen suits it.
    let changed = between(&line("abc", Some(1)), &line("xbz", Some(1)));
    assert_eq!(changed, frame("\x1b[Hx\x1b[Cz"));
}

#[test]
fn a_new_size_is_drawn_in_full() {
    let (mut encoder, mut bytes) = showing(&CellGrid::new(4, 2));
    encoder.encode(&CellGrid::new(3, 2), &mut bytes);
    assert!(bytes.windows(4).any(|piece| piece == b"\x1b[2J"));
    let mut empty = Vec::new();
    encoder.encode(&CellGrid::new(0, 0), &mut empty);
    assert!(!empty.is_empty());
}

#[test]
fn ink_and_paper_change_places_where_that_is_shorter() {
    let cell = |glyph, foreground, background| Cell {
        glyph,
        foreground: Color::Ansi256(foreground),
        background: Color::Ansi256(background),
    };
    // The second cell's ink is the first one's paper; the third is the second, exchanged by hand.
    let line = one_line(&[cell('▀', 100, 101), cell('▀', 101, 102), cell('▄', 102, 101)]);
    let text = between(&one_line(&[Cell::BLANK; 3]), &line);
    assert!(text.contains("\x1b[38;5;100;48;5;101m▀\x1b[38;5;102m▄▄\x1b[m"), "{text:?}");
}

/// What the bytes did not suffice for stays as it was, also before a mark, which is written whatever it costs.
#[test]
fn cells_left_for_the_next_frame_are_not_painted_over() {
    let line =
        |glyph, colors: [u8; 4]| one_line(&colors.map(|color| ink(glyph, Color::Ansi256(color))));
    let (before, mut after) = (line('a', [1, 1, 1, 1]), line('b', [2, 3, 4, 5]));
    after.set_mark(Some((3, 0)));
    let (mut encoder, mut bytes) = showing(&before);
    encoder.encode_part(&after, Economy { tolerance: 0.0, most_bytes: 1 }, &mut bytes);
    let shown = encoder.shown().expect("something").cells();
    assert_eq!(shown[0], after.cells()[0]);
    assert_eq!(shown[1..3], before.cells()[1..3]);
    assert_eq!(shown[3], after.cells()[3]);
}

/// Within a tolerance of 0.01 in `OKLab`, of which a level of grey is a third.
#[test]
fn bytes_are_saved_where_what_they_buy_is_not_seen() {
    let grey = |level| Color::Rgb([level; 3]);
    let cell = |glyph, ink, paper| Cell { glyph, foreground: grey(ink), background: grey(paper) };
    let sent = |cells: &[Cell]| {
        let (mut encoder, mut bytes) = (Encoder::new(), Vec::new());
        let economy = Economy { tolerance: 0.01, ..Economy::NONE };
        encoder.encode_part(&one_line(cells), economy, &mut bytes);
        String::from_utf8(bytes).expect("UTF-8").replace("\x1b[m\x1b[2J\x1b[H", "")
    };
    // Four levels off: the middle of both; eight: its own.
    let blank = |level| cell(' ', level, level);
    assert_eq!(sent(&[blank(128), blank(132)]), "\x1b[48;2;130;130;130m  \x1b[m");
    let apart = "\x1b[48;2;128;128;128m \x1b[48;2;136;136;136m \x1b[m";
    assert_eq!(sent(&[blank(128), blank(136)]), apart);
    // Ink and paper that look alike: their middle. Others: both.
    assert_eq!(sent(&[cell('\u{2580}', 128, 132)]), "\x1b[48;2;130;130;130m \x1b[m");
    let both = "\x1b[38;2;128;128;128;48;2;140;140;140m\u{2580}\x1b[m";
    assert_eq!(sent(&[cell('\u{2580}', 128, 140)]), both);
    // Half of a cell may be farther off than all of it.
    let line = [cell('\u{2580}', 128, 200), cell('\u{2580}', 131, 200)];
    assert_eq!(sent(&line), "\x1b[38;2;130;130;130;48;2;200;200;200m\u{2580}\u{2580}\x1b[m");
}
