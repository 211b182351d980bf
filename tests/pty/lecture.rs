//! Walks through the lecture.

use super::emulated::{ATTRIBUTES, STATUS, SYNCHRONIZED};
use super::output::Output;
use super::session::Session;
use spherule::lecture::stations::STATIONS;

/// Starts the lecture on a terminal of the least size, with colour.
fn start(more: &[&str]) -> Session {
    Session::start(&[&["lecture"], more].concat(), &[], (80, 24))
}

/// The text on the screen. (The terminal's model also knows whether blanks at the end of a line were written.)
fn contents(output: &Output) -> String {
    let contents = output.contents();
    contents.lines().map(|line| format!("{}\n", line.trim_end())).collect()
}

/// Waits until the screen shows a text, and gives all that it shows.
fn shown(session: &Session, text: &str) -> String {
    session.wait_for(text, |output| {
        let contents = contents(output);
        (output.sent.ends_with(b"\x1b[?2026l") && contents.contains(text)).then_some(contents)
    })
}

fn heading(index: usize) -> String {
    format!("{:>2}/14  {}", index + 1, STATIONS[index].title)
}

#[test]
fn n_goes_through_all_stations_and_arrows_change_them() {
    let mut session = start(&[]);
    for index in 0..STATIONS.len() {
        let first = shown(&session, &heading(index));
        // Left and down: in every station one of them changes something.
        session.type_in("\x1b[D\x1b[B");
        session.wait_until("another page", |output| contents(output) != first);
        session.type_in("r");
        session.wait_until("the first page", |output| contents(output) == first);
        session.type_in("n");
    }
    shown(&session, &heading(0));
    session.quit("q");
}

#[test]
fn b_goes_back_and_so_do_the_keys_for_pages() {
    let mut session = start(&["--station", "nearest"]);
    shown(&session, &heading(11));
    for (key, index) in [("b", 10), ("\x1b[5~", 9), ("\x1b[6~", 10), ("n", 11)] {
        session.type_in(key);
        shown(&session, &heading(index));
    }
    session.quit("\x03");
}

#[test]
fn help_opens_and_escape_closes_it_before_it_quits() {
    let mut session = start(&[]);
    let first = shown(&session, &heading(0));
    session.type_in("?");
    let help = shown(&session, "Page Down");
    assert!(help.contains("Triangles are left out"), "{help}");
    session.type_in("\x1b");
    session.wait_until("the page under it", |output| contents(output) == first);
    session.quit("\x1b");
}

#[test]
fn it_follows_the_size_and_says_what_it_needs() {
    let mut session = start(&["--station", "5"]);
    shown(&session, &heading(4));
    session.resize(60, 20);
    shown(&session, "needs 80x24, has 60x20");
    session.resize(120, 40);
    let large = shown(&session, "q quit");
    assert!(!large.contains("needs"), "{large}");
    session.quit("q");
}

/// A walk has the terminal's size.
#[test]
fn a_station_of_a_size_is_written() {
    let mut session = start(&["--size", "79x24", "--station", "1"]);
    assert!(session.wait_for_end().success());
    let output = session.output();
    assert!(!output.text().contains("\x1b[?"), "a mode is set");
    assert!(contents(&output).contains("needs 80x24, has 79x24"), "{}", contents(&output));
}

#[test]
fn no_probe_asks_nothing() {
    let mut session = start(&["--no-probe"]);
    for index in [0, 1] {
        session.wait_for_words(&heading(index));
        session.type_in("n");
    }
    for question in [ATTRIBUTES, STATUS, SYNCHRONIZED] {
        assert!(!session.output().text().contains(question), "{question:?}");
    }
    session.quit("q");
}
