//! The program asks the terminal what it can do, and never trusts it.

use super::emulated::{
    ATTRIBUTES, BACKGROUND, CELL_PIXELS, Emulated, IMAGE, Manner, PEN, Rule, STATUS, SYNCHRONIZED,
};
use super::look::look;
use super::output::{BEGIN, Output};
use super::picture::{first, scene_file};
use super::session::Session;
use super::viewer::{COLUMNS, PICTURE_ROWS, ROWS, VIEW, Viewer};
use spherule_tests::binary::spherule;
use std::thread;
use std::time::Duration;
use vt100::Color;

const TERMINALS: &str = include_str!("../cases/terminals.txt");
const QUESTIONS: [(&str, &str); 7] = [
    ("attributes", ATTRIBUTES),
    ("status", STATUS),
    ("synchronized", SYNCHRONIZED),
    ("cell-pixels", CELL_PIXELS),
    ("background", BACKGROUND),
    ("pen", PEN),
    ("image", IMAGE),
];

/// What a terminal with white paper answers.
const ON_WHITE: [Rule; 2] =
    [(BACKGROUND, "\x1b]11;rgb:ffff/ffff/ffff\x1b\\"), (ATTRIBUTES, "\x1b[?62c")];

/// What the terminals of the file answer.
fn terminals() -> Vec<(&'static str, Vec<Rule>)> {
    let mut terminals: Vec<(&str, Vec<Rule>)> = Vec::new();
    for line in TERMINALS.lines().filter(|line| !line.starts_with('#')) {
        let mut words = line.splitn(3, ' ');
        let mut next = || words.next().expect("three words");
        let (terminal, name, answer) = (next(), next(), next());
        let question = QUESTIONS.iter().find(|(word, _)| *word == name).expect("a question").1;
        let answer = answer.replace("\\e", "\x1b").replace("\\\\", "\\").leak();
        match terminals.last_mut().filter(|(last, _)| *last == terminal) {
            Some((_, rules)) => rules.push((question, answer)),
            None => terminals.push((terminal, vec![(question, answer)])),
        }
    }
    terminals
}

fn knows(rules: &[Rule], asked: &str, part: &str) -> bool {
    rules.iter().any(|(question, answer)| *question == asked && answer.contains(part))
}

fn shows_the_picture(output: &Output) -> bool {
    look(output.screen(), PICTURE_ROWS) == first() && output.status().contains("? help  q quit")
}

/// Asserts that the picture is right, all keys work, and nothing is left behind.
fn assert_is_usable(mut viewer: Viewer, what: &str) {
    viewer.wait_for_look(what, first());
    type_tiers(&mut viewer);
    viewer.wait_for_look(what, first());
    println!("{what}");
    viewer.session.quit("q");
    assert_eq!(viewer.session.output().contents(), "", "{what}");
}

/// Types keys of tiers, the last of which is the first picture's.
fn type_tiers(viewer: &mut Viewer) {
    for (key, tier) in [("1", " fast "), ("3", " exact ")] {
        viewer.session.type_in(key);
        viewer.session.wait_for_status(tier);
    }
}

#[test]
fn every_terminal_shows_the_picture_and_is_left_as_it_was() {
    let terminals = terminals();
    assert!(terminals.iter().any(|(name, _)| *name == "tmux") && terminals.len() == 6);
    for (name, rules) in terminals {
        for is_torn in [false, true] {
            let mut emulated = Emulated::with(&rules);
            emulated.answers.is_torn = is_torn;
            let term = if name == "linux" { "linux" } else { "xterm-256color" };
            let viewer = Viewer::start_in(emulated, &[], &[("TERM", term)], (COLUMNS, ROWS));
            let what = format!("{name}, torn: {is_torn}");
            viewer.wait_for_look(&what, first());
            {
                let sent = viewer.session.output().text();
                // Torn answers may come late, and count only from then on.
                if !is_torn {
                    let is_known = knows(&rules, SYNCHRONIZED, ";2$");
                    assert_eq!(sent.contains(BEGIN), is_known, "{what}");
                    let asked = sent.matches(STATUS).count();
                    assert!(asked > 1, "{what}: it is not asked how far it has come");
                }
                let strings = ["\x1bP", "\x1b]", "\x1b_"];
                assert!(term != "linux" || !strings.iter().any(|begin| sent.contains(begin)));
            }
            assert_is_usable(viewer, &what);
        }
    }
}

#[test]
fn a_silent_terminal_is_waited_for_no_longer_than_a_moment_and_asked_no_more() {
    let viewer = Viewer::start_on(Emulated::with(&[]), &[]);
    viewer.wait_for_look("the picture", first());
    let sent = viewer.session.output().text();
    assert_eq!([ATTRIBUTES, STATUS, BEGIN].map(|what| sent.matches(what).count()), [1, 1, 0]);
    assert_is_usable(viewer, "silent");
}

#[test]
fn no_probe_asks_nothing() {
    let viewer = Viewer::start_as(&["--no-probe"]);
    viewer.wait_for_look("the picture", first());
    let sent = viewer.session.output().text();
    for question in QUESTIONS {
        assert!(!sent.contains(question.1), "{question:?}");
    }
    assert_is_usable(viewer, "not asked");
}

/// Three seconds late, useful answers still count, and none acts as a key.
#[test]
fn late_answers_count_from_then_on() {
    // All of them wait at once.
    thread::scope(|scope| {
        for (name, rules) in terminals() {
            scope.spawn(move || late_answers_count(name, rules));
        }
    });
}

fn late_answers_count(name: &str, rules: Vec<Rule>) {
    let answers = Manner { rules, delay: Duration::from_secs(3), is_torn: false };
    let is_known = knows(&answers.rules, SYNCHRONIZED, ";2$");
    let mut viewer = Viewer::start_on(Emulated { answers, link: None }, &[]);
    viewer.wait_for_look(name, first());
    thread::sleep(Duration::from_millis(3300));
    let sent = viewer.session.output().sent.len();
    type_tiers(&mut viewer);
    let has_brackets = viewer.session.output().text_after(sent).contains(BEGIN);
    assert_eq!(has_brackets, is_known, "{name}");
    assert_is_usable(viewer, name);
}

/// Left before the first answers come, the program takes them all the same: a shell would read them as keys, and echo them.
#[test]
fn late_answers_do_not_reach_the_shell() {
    let rules = vec![(STATUS, "\x1b[0n"), (ATTRIBUTES, "\x1b[?62;22c")];
    let answers = Manner { rules, delay: Duration::from_millis(400), is_torn: false };
    let scene = scene_file(&VIEW);
    let then = format!("'{}' '{}'; sleep 1", spherule().display(), scene.path());
    let (emulated, arguments) = (Emulated { answers, link: None }, ["-c", then.as_str()]);
    let mut session = Session::start_program(emulated, "sh", &arguments, &[], (COLUMNS, ROWS));
    session.wait_for_text(ATTRIBUTES);
    session.type_in("q");
    assert!(session.wait_for_end().success());
    let sent = session.output().text();
    assert!(!sent.contains("^[["), "{sent:?}");
}

/// Half an answer with keys in it, whole ones that follow it at once, and a stream without an end.
#[test]
fn half_a_string_for_ever_is_no_key() {
    // All of them wait at once.
    thread::scope(|scope| {
        for half in ["\x1b]11;rgb:q c", "\x1b]11;rgb:1e1e/q"] {
            scope.spawn(move || half_an_answer_is_no_key(half));
        }
        scope.spawn(a_stream_is_no_key);
    });
}

fn half_an_answer_is_no_key(half: &'static str) {
    let viewer = Viewer::start_on(Emulated::with(&[(BACKGROUND, half)]), &[]);
    viewer.wait_for_look(half, first());
    // Until the program has given up on the answer.
    thread::sleep(Duration::from_millis(700));
    assert_is_usable(viewer, half);
}

fn a_stream_is_no_key() {
    let mut viewer = Viewer::start_on(Emulated::with(&[]), &[]);
    viewer.wait_for_look("the picture", first());
    viewer.session.type_in("\x1b]11;");
    for _ in 0..300 {
        viewer.session.type_in("q c ");
        thread::sleep(Duration::from_millis(5));
    }
    assert!(shows_the_picture(&viewer.session.output()), "a key of it acted");
    thread::sleep(Duration::from_millis(700));
    assert_is_usable(viewer, "a stream");
}

/// A terminal of unknown name reports its depth; the user's option counts more.
#[test]
fn colours_are_as_many_as_the_terminal_tells() {
    let depth = |rules: &[Rule], arguments: &[&str], variables: &[(&str, &str)]| {
        let arguments = [&["unit"], arguments].concat();
        let emulated = Emulated::with(rules);
        let mut session = Session::start_in(emulated, &arguments, variables, (COLUMNS, ROWS));
        let found = session.wait_for("a picture", |output| {
            let edge = (0..COLUMNS).filter_map(|column| output.screen().cell(10, column));
            let mut colors = edge.map(vt100::Cell::fgcolor);
            colors.find(|color| *color != Color::Default)
        });
        session.quit("q");
        matches!(found, Color::Rgb(..))
    };
    let over_ssh = [("TERM", "xterm-256color"), ("COLORTERM", "")];
    let (rest, told) = ((ATTRIBUTES, "\x1b[?62c"), (PEN, "\x1bP1$r0;48:2::1:2:3m\x1b\\"));
    assert!(!depth(&[rest], &[], &over_ssh));
    assert!(depth(&[told, rest], &[], &over_ssh));
    assert!(!depth(&[told, rest], &["--color", "256"], &over_ssh));
    assert!(!depth(&[told, rest], &["--no-probe"], &over_ssh));
    let palette = (PEN, "\x1bP1$r0;48:5:16m\x1b\\");
    assert!(!depth(&[palette, rest], &[], &[]));
    assert!(depth(&[palette, rest], &["--color", "truecolor"], &[]));
}

/// Without a light, white spheres would be lost there.
#[test]
fn white_spheres_are_seen_on_a_white_terminal() {
    let (emulated, arguments) = (Emulated::with(&ON_WHITE), ["unit", "--color", "truecolor"]);
    let mut session = Session::start_in(emulated, &arguments, &[], (COLUMNS, ROWS));
    session.wait_until("the sphere", |output| {
        let middle = output.screen().cell(PICTURE_ROWS / 2, COLUMNS / 2);
        output.corner() == Some(Color::Rgb(0, 0, 0))
            && middle.is_some_and(|cell| cell.bgcolor() == Color::Rgb(255, 255, 255))
    });
    session.quit("q");
}

/// Nothing is written on what no sphere covers.
#[test]
fn without_colour_the_background_is_blank_on_a_white_terminal() {
    for charset in ["ascii", "braille"] {
        let (emulated, arguments) = (Emulated::with(&ON_WHITE), ["caffeine", "--charset", charset]);
        let variables = [("NO_COLOR", "1")];
        let mut session = Session::start_in(emulated, &arguments, &variables, (COLUMNS, ROWS));
        session.wait_until("the picture", |output| {
            let status = output.status();
            status.contains("? help") && !status.contains("drawing ...")
        });
        let shown = |left, right| -> String {
            let output = session.output();
            let rows = 0..PICTURE_ROWS;
            let lines = rows.map(|row| output.screen().contents_between(row, left, row, right));
            // Braille has a blank of its own.
            lines.collect::<String>().replace([' ', '\u{2800}'], "")
        };
        assert_eq!(shown(0, 2), "", "{charset}");
        assert_ne!(shown(0, COLUMNS), "", "{charset}");
        session.quit("q");
    }
}

/// If a scene names no background, the terminal's own shows.
#[test]
fn the_background_is_the_terminals_where_nobody_names_one() {
    let rules = [(BACKGROUND, "\x1b]11;rgb:f0f0/e0e0/d0d0\x1b\\"), (ATTRIBUTES, "\x1b[?62c")];
    let corner = |arguments: &[&str], expected: Color| {
        let arguments = [arguments, &["--color", "truecolor"]].concat();
        let emulated = Emulated::with(&rules);
        let mut session = Session::start_in(emulated, &arguments, &[], (COLUMNS, ROWS));
        session.wait_until("the background", |output| output.corner() == Some(expected));
        session.quit("q");
    };
    corner(&["unit"], Color::Rgb(0xf0, 0xe0, 0xd0));
    corner(&["unit", "--background", "#102030"], Color::Rgb(0x10, 0x20, 0x30));
    corner(&["unit", "--no-probe"], Color::Rgb(0, 0, 0));
}
