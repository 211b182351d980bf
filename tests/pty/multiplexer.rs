//! In tmux and GNU screen, which show a terminal of their own.

use super::emulated::{ATTRIBUTES, Emulated, PEN, STATUS};
use super::output::Output;
use super::picture::first;
use super::viewer::{COLUMNS, ROWS, Viewer};
use std::thread;
use std::time::Duration;

/// The value of `TMUX`.
const IN_TMUX: &str = "/tmp/tmux-1000/default,1,0";
/// The question about images, for the terminal behind tmux.
const WRAPPED: &str = "\x1bPtmux;\x1b\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\x1b\\\x1b\\";
/// What that terminal answers.
const HAS_IMAGES: &str = "\x1b_Gi=31;OK\x1b\\";
const PLACEHOLDER: &str = "\u{10EEEE}";

/// The viewer with `more` options in one that has such attributes.
fn start(attributes: &'static str, more: &[&str], term: &str, tmux: &str) -> Viewer {
    let emulated = Emulated::with(&[(STATUS, "\x1b[0n"), (ATTRIBUTES, attributes)]);
    Viewer::start_in(emulated, more, &[("TERM", term), ("TMUX", tmux)], (COLUMNS, ROWS))
}

fn wait_for_cells(viewer: &Viewer) {
    viewer.wait_for_look("cells", first());
}

/// They would take a question about images for a title, which stays, and GNU screen hands on what is in a DCS.
#[test]
fn they_are_asked_what_they_understand() {
    for (term, tmux, gets_dcs) in [
        ("tmux-256color", IN_TMUX, true),
        ("screen-256color", IN_TMUX, true),
        ("tmux-256color", "", true),
        ("screen.xterm-256color", "", false),
    ] {
        let viewer = start("\x1b[?1;2c", &[], term, tmux);
        wait_for_cells(&viewer);
        let sent = viewer.session.output().text();
        assert!(!sent.contains("\x1b_"), "{term}, {tmux}: {sent:?}");
        assert_eq!(sent.contains(PEN), gets_dcs, "{term}, {tmux}: {sent:?}");
        viewer.quit();
    }
}

/// What is wrapped reaches the terminal behind tmux only if that is allowed. tmux itself answers first.
#[test]
fn there_are_pixels_if_the_terminal_behind_tmux_answers() {
    for (attributes, gets_pixels) in
        [("\x1b[?1;2c\x1b_Gi=31;OK\x1b\\", true), ("\x1b[?1;2c", false)]
    {
        let mut viewer = start(attributes, &["--output", "kitty"], "tmux-256color", IN_TMUX);
        if gets_pixels {
            viewer.session.wait_for_text(PLACEHOLDER);
        } else {
            viewer.session.wait_for_words("the terminal cannot show");
            viewer.session.type_in("3");
            wait_for_cells(&viewer);
            assert!(!viewer.session.output().text().contains(PLACEHOLDER));
        }
        assert!(viewer.session.output().text().contains(WRAPPED));
        viewer.quit();
    }
}

/// The viewer in a tmux behind which the terminal has not answered.
fn start_before_the_answer() -> Viewer {
    start("\x1b[?1;2c", &["--output", "kitty"], "tmux-256color", IN_TMUX)
}

#[test]
fn a_terminal_behind_tmux_that_answers_late_gets_pixels() {
    let mut viewer = start_before_the_answer();
    let is_denied = |output: &Output| output.contents().contains("the terminal cannot show");
    viewer.session.wait_until("a word about it", is_denied);
    viewer.session.type_in(HAS_IMAGES);
    viewer.session.wait_until("placeholders", |output| {
        output.text().contains(PLACEHOLDER) && !is_denied(output)
    });
    viewer.quit();
}

/// Left after tmux's own answer, the program takes the other one, too: a shell would read it as keys, and echo it.
#[test]
fn the_answer_from_behind_tmux_does_not_reach_the_shell() {
    let mut viewer = start_before_the_answer();
    viewer.session.wait_for_text(WRAPPED);
    thread::sleep(Duration::from_millis(250));
    viewer.session.type_in("q");
    thread::sleep(Duration::from_millis(150));
    viewer.session.type_in(HAS_IMAGES);
    assert!(viewer.session.wait_for_end().success());
    let sent = viewer.session.output().text();
    assert!(!sent.contains("^[_"), "{sent:?}");
    assert_eq!(viewer.session.unread(), 0);
}

/// tmux says that it has sixels, whatever the terminal behind it has.
#[test]
fn auto_takes_no_sixels_of_tmux() {
    let viewer = start("\x1b[?1;2;4c", &["--output", "auto"], "tmux-256color", IN_TMUX);
    wait_for_cells(&viewer);
    assert!(!viewer.session.output().text().contains("\x1bP0;1"));
    viewer.quit();
}
