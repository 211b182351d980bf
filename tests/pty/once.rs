//! One picture on a terminal.

use super::emulated::{Emulated, Link};
use super::file::TestFile;
use super::look::look;
use super::picture::{OPTIONS, once, scene_file};
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, VIEW};
use rustix::process::Signal;
use std::ops::RangeInclusive;
use std::thread;
use std::time::Duration;

/// Runs the program to its end in a terminal of `columns` x `rows`, for tests of what it then shows, and where the
/// prompt comes.
fn ended(more: &[&str], variables: &[(&str, &str)], columns: u16, rows: u16) -> Session {
    let scene = scene_file(&VIEW);
    let arguments = [&[scene.path()], OPTIONS.as_slice(), more].concat();
    let mut session = Session::start(&arguments, variables, (columns, rows));
    session.ends_well();
    session
}

#[test]
fn once_leaves_a_row_for_the_prompt() {
    let session = ended(&["--once"], &[], COLUMNS, ROWS);
    let output = session.output();
    assert_eq!(look(output.screen(), ROWS - 1), once(&VIEW, COLUMNS, ROWS - 1));
    assert_eq!(output.screen().cursor_position(), (ROWS - 1, 0));
}

/// Nothing is asked, and a terminal that was started in another one has inherited a variable of it.
#[test]
fn a_terminal_that_was_started_in_another_gets_cells() {
    for (term, gets_pixels) in [("wezterm", true), ("alacritty", false)] {
        let variables = [("TERM", term), ("TERM_PROGRAM", "WezTerm")];
        let session = ended(&["--once", "--output", "auto"], &variables, COLUMNS, ROWS);
        assert_eq!(session.output().text().contains("\x1b]1337"), gets_pixels, "{term}");
    }
}

/// With the size of the terminal: a row more, and the top of the picture would be pushed out.
#[test]
fn a_picture_in_pixels_leaves_a_row_for_the_prompt() {
    let session = ended(&["--once", "--output", "kitty"], &[], COLUMNS, ROWS);
    let output = session.output();
    let sent = output.text();
    let (before, _) = sent.split_once("\x1b_Ga=T").expect("an image");
    let mut terminal = vt100::Parser::new(output.screen().size().0, output.screen().size().1, 0);
    terminal.process(before.as_bytes());
    // From there it covers all rows but the last, and the cursor stays.
    assert_eq!(terminal.screen().cursor_position(), (0, 0));
    assert!(sent.contains(&format!("r={},", ROWS - 1)) && sent.contains(",C=1,"), "{sent:?}");
    assert_eq!(output.screen().cursor_position(), (ROWS - 1, 0));
    // No row has gone out at the top.
    assert_eq!(sent.matches('\n').count(), usize::from(ROWS - 1));
}

#[test]
fn a_size_that_is_asked_for_is_kept() {
    let session = ended(&["--once", "--size", "30x7"], &[], COLUMNS, ROWS);
    assert_eq!(session.output().screen().cursor_position(), (7, 0));
}

#[test]
fn a_terminal_of_one_row_gets_a_row() {
    let session = ended(&["--once"], &[], 12, 1);
    assert_eq!(session.output().text().matches('\n').count(), 1);
}

/// A dumb terminal knows no escape sequences, so there is no viewer on it.
#[test]
fn a_dumb_terminal_gets_one_picture() {
    let session = ended(&[], &[("TERM", "dumb")], COLUMNS, ROWS);
    let output = session.output();
    assert!(!output.text().contains("\x1b[?"), "a mode is set");
    assert_eq!(look(output.screen(), ROWS - 1), once(&VIEW, COLUMNS, ROWS - 1));
}

/// It cannot take progress away again.
#[test]
fn a_dumb_terminal_gets_no_progress() {
    let start = |term| Session::start(&["tradeoff", "flake"], &[("TERM", term)], (COLUMNS, ROWS));
    let (dumb, other) = (start("dumb"), start("xterm"));
    other.wait_for_text("\x1b[K");
    thread::sleep(Duration::from_millis(300));
    let sent = dumb.output().text();
    assert!(!sent.contains('\x1b'), "{sent:?}");
}

/// That from which the command line was typed may be another one.
#[test]
fn the_size_is_that_of_the_terminal_that_is_written_to() {
    let (columns, rows) = (40, 12);
    let mut other = Session::start_script("read -r line", &[], (columns, rows));
    let scene = scene_file(&VIEW);
    let script = format!("exec \"$0\" \"$@\" >'{}'", other.terminal_name().display());
    let arguments = [&[scene.path(), "--once"], OPTIONS.as_slice()].concat();
    let mut session = Session::start_script(&script, &arguments, (100, 30));
    assert!(session.wait_for_end().success());
    let expected = once(&VIEW, columns, rows - 1);
    other.wait_until("a picture of its size", |output| look(output.screen(), rows - 1) == expected);
    other.type_in("\n");
    assert!(other.wait_for_end().success());
}

/// Over a slow link some of a picture is always under way.
#[test]
fn a_picture_that_is_broken_off_leaves_no_colours() {
    let file = TestFile::new("xyz", "1\n\nC 0 0 0\n".repeat(1000));
    let arguments = [file.path(), "--frames", "0..", "--background", "102030"];
    let arguments = [arguments.as_slice(), OPTIONS.as_slice()].concat();
    for (signal, ends_by) in [(Signal::INT, "Interrupt"), (Signal::TERM, "Terminated")] {
        let link = Some(Link::new(4 << 10, 0.5e6));
        let emulated = Emulated { link, ..Emulated::good() };
        let mut session = Session::start_in(emulated, &arguments, &[], (100, 30));
        session.wait_until("pictures", |output| output.sent.len() > 50_000);
        session.signal(signal);
        session.ends_by(ends_by);
    }
}

#[test]
fn a_locale_without_unicode_gets_ascii() {
    for (locale, charset) in [("C", "ascii"), ("C.UTF-8", "half")] {
        let scene = scene_file(&VIEW);
        let arguments = [scene.path(), "--show", "table"];
        let mut session = Session::start(&arguments, &[("LANG", locale)], (COLUMNS, ROWS));
        session.wait_until(charset, |output| {
            let text = output.contents();
            let is_done =
                text.contains(&format!("exact perspective {charset} ")) && text.contains("2^24");
            is_done && text.is_ascii() == (charset == "ascii")
        });
        session.quit("q");
    }
}

/// Bright colours are inks there: as papers they have codes that it takes for others.
#[test]
fn linux_s_console_gets_no_bright_paper() {
    let variables = [("TERM", "linux"), ("COLORTERM", "")];
    for scene in ["unit", "marbles"] {
        let mut session = Session::start(&[scene, "--once"], &variables, (COLUMNS, ROWS));
        session.ends_well();
        let sent = session.output().text();
        let pens = sent.split("\x1b[").skip(1).filter_map(|part| part.split_once('m'));
        let parameters = pens.flat_map(|(parameters, _)| parameters.split(';'));
        let codes: Vec<u8> = parameters.filter_map(|code| code.parse().ok()).collect();
        let has = |range: RangeInclusive<u8>| codes.iter().any(|code| range.contains(code));
        assert!(has(40..=47) && has(90..=97) && !has(100..=107), "{scene}: {codes:?}");
    }
}

#[test]
fn a_png_draws_nothing_and_does_not_go_to_a_terminal() {
    let file = TestFile::not_yet("png");
    let session = ended(&["--size", "4x2", "--png", file.path()], &[], COLUMNS, ROWS);
    let written = std::fs::read(file.path()).expect("a file");
    assert!(written.starts_with(b"\x89PNG"));
    assert_eq!(session.output().contents(), "");

    let mut session = Session::start(&["unit", "--png", "-"], &[], (COLUMNS, ROWS));
    assert_eq!(session.wait_for_end().exit_code(), 2);
    let shown = session.output().contents();
    assert_eq!(shown, "spherule: --png -: standard output is a terminal");
}
