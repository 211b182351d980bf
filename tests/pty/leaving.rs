//! How the program stops, goes on and ends, and what it leaves behind.

use super::emulated::{Emulated, STATUS};
use super::look::last_row;
use super::modes::is_cooked;
use super::picture::{first, scene_file};
use super::session::{Session, command};
use super::viewer::{COLUMNS, ROWS, STOPPED, VIEW, Viewer};
use super::window::Window;
use rustix::process::Signal;
use spherule_tests::binary::spherule;
use std::thread;
use std::time::{Duration, Instant};

/// Asserts that after a stop the terminal is the shell's, and the program's when it goes on.
fn assert_is_left_and_taken_again(mut viewer: Viewer, go_on: impl FnOnce(&mut Session)) {
    assert!(is_cooked(&viewer.session.modes()), "the shell gets no lines");
    viewer.session.wait_until("the normal screen", |output| !output.screen().alternate_screen());
    assert_eq!(viewer.session.left_behind(), [""; 0]);
    let sent = viewer.session.output().sent.len();
    go_on(&mut viewer.session);
    viewer.wait_for_picture("the picture again", first());
    assert!(!is_cooked(&viewer.session.modes()));
    let redrawn = viewer.session.output().text_after(sent).contains("\x1b[2J");
    assert!(redrawn, "not drawn in full");
    viewer.quit();
}

#[test]
fn ctrl_z_stops_a_job_and_fg_draws_again() {
    let mut viewer = Viewer::start_as_job();
    viewer.session.type_in("\x1a");
    viewer.session.wait_until("the shell", |output| output.sent.ends_with(STOPPED.as_bytes()));
    assert_is_left_and_taken_again(viewer, |session| session.type_in("\n"));
}

/// What leads its session is all that runs in its terminal: no one would be told of a stop.
#[test]
fn ctrl_z_without_a_shell_stops_nothing_and_says_so() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1a");
    viewer.session.wait_for_words("no shell to continue it");
    assert!(!is_cooked(&viewer.session.modes()));
    viewer.session.type_in("3");
    viewer.wait_for_picture("the picture", first());
    viewer.quit();
}

#[test]
fn sigtstp_stops_and_sigcont_draws_again() {
    let viewer = Viewer::start();
    viewer.session.signal(Signal::TSTP);
    viewer.session.wait_until_stopped();
    assert_is_left_and_taken_again(viewer, |session| session.signal(Signal::CONT));
}

#[test]
fn after_a_stop_that_cannot_be_caught_it_draws_again() {
    let viewer = Viewer::start();
    viewer.session.signal(Signal::STOP);
    viewer.session.wait_until_stopped();
    let sent = viewer.session.output().sent.len();
    viewer.session.signal(Signal::CONT);
    viewer.session.wait_until("a full frame", |output| {
        output.text_after(sent).contains("\x1b[2J") && output.shows_a_frame()
    });
    viewer.quit();
}

/// A good terminal whose answers are so late.
fn late(delay: Duration) -> Emulated {
    let mut emulated = Emulated::good();
    emulated.answers.delay = delay;
    emulated
}

/// The shell has had the answers that came meanwhile, so they are not waited for when it is left.
#[test]
fn after_a_stop_that_cannot_be_caught_it_leaves_at_once() {
    // It would wait for half a second. A loaded machine may need more than one try.
    let is_at_once = || leaves_after_a_stop() < Duration::from_millis(400);
    assert!((0..5).any(|_| is_at_once()));
}

/// How long it takes to leave after it was stopped with an answer on its way.
fn leaves_after_a_stop() -> Duration {
    const DELAY: Duration = Duration::from_millis(300);
    let mut viewer = Viewer::start_on(late(DELAY), &[]);
    viewer.wait_for_look("the picture", first());
    viewer.session.wait_for_peace();
    viewer.session.type_in("1");
    viewer.session.wait_for_status(" fast ");
    viewer.session.signal(Signal::STOP);
    viewer.session.wait_until_stopped();
    thread::sleep(2 * DELAY);
    viewer.session.take_input();
    viewer.session.signal(Signal::CONT);
    viewer.session.wait_for_peace();
    let asked = Instant::now();
    viewer.session.type_in("q");
    assert!(viewer.session.wait_for_exit().success());
    asked.elapsed()
}

/// However it ends while answers are on their way: a terminal that is given back would echo them.
#[test]
fn answers_on_their_way_do_not_reach_the_shell() {
    type End = fn(&mut Session);
    let ways: [(&str, End); 3] = [
        ("SIGTERM", |session| session.signal(Signal::TERM)),
        ("SIGTSTP", |session| session.signal(Signal::TSTP)),
        ("a panic", |session| session.type_in("!")),
    ];
    // All of them wait at once.
    thread::scope(|scope| {
        for (what, end) in ways {
            scope.spawn(move || {
                let emulated = late(Duration::from_millis(150));
                let variables = [("SPHERULE_TEST_PANIC", "1")];
                let mut viewer = Viewer::start_in(emulated, &[], &variables, (COLUMNS, ROWS));
                viewer.session.wait_for_peace();
                viewer.session.type_in(" ");
                viewer
                    .session
                    .wait_until("frames", |output| output.text().matches(STATUS).count() > 6);
                end(&mut viewer.session);
                viewer
                    .session
                    .wait_until("the normal screen", |output| !output.screen().alternate_screen());
                thread::sleep(Duration::from_secs(1));
                assert!(is_cooked(&viewer.session.modes()), "{what}");
                let sent = viewer.session.output().text();
                assert!(!sent.contains("^[["), "{what}: {sent:?}");
            });
        }
    });
}

#[test]
fn every_key_that_quits_does() {
    for key in ["q", "\x03", "\x1b"] {
        println!("{key:?}");
        Viewer::start().session.quit(key);
    }
}

/// As GNU screen and Linux's console, which have no alternate screen, show it.
#[test]
fn without_an_alternate_screen_the_prompt_comes_below_the_picture() {
    let mut viewer = Viewer::start();
    viewer.session.quit("q");
    let output = viewer.session.output();
    let sent = output.text().replace("\x1b[?1049h", "").replace("\x1b[?1049l", "");
    let (rows, columns) = output.screen().size();
    let mut terminal = vt100::Parser::new(rows, columns, 0);
    terminal.process(sent.as_bytes());
    assert_eq!(terminal.screen().cursor_position(), (ROWS - 1, 0));
    assert_eq!(last_row(terminal.screen()).trim(), "");
    assert!(!terminal.screen().contents().trim().is_empty(), "no picture");
}

#[test]
fn a_panic_is_told_on_the_normal_screen() {
    let mut viewer = Viewer::start_with(&[("SPHERULE_TEST_PANIC", "1")], COLUMNS, ROWS);
    viewer.wait_for_frame();
    viewer.session.type_in("!");
    let status = viewer.session.wait_for_end();
    assert_eq!(status.exit_code(), 101, "{status}");
    assert_eq!(viewer.session.left_behind(), [""; 0]);
    let shown = viewer.session.output().contents();
    assert!(shown.contains("panicked at"), "{shown}");
}

#[test]
fn unasked_for_the_panic_key_does_nothing() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("!");
    viewer.quit();
}

#[test]
fn signals_restore_and_kill() {
    for (signal, name) in [
        (Signal::TERM, "Terminated"),
        (Signal::HUP, "Hangup"),
        (Signal::INT, "Interrupt"),
        (Signal::QUIT, "Quit"),
        (Signal::XCPU, "CPU time limit exceeded"),
        (Signal::USR1, "User defined signal 1"),
        (Signal::USR2, "User defined signal 2"),
        (Signal::ALARM, "Alarm clock"),
    ] {
        let mut viewer = Viewer::start();
        viewer.session.signal(signal);
        viewer.session.ends_by(name);
    }
    // A file that may not grow is an error where it is written.
    let viewer = Viewer::start();
    viewer.session.signal(Signal::XFSZ);
    viewer.quit();
}

#[test]
fn killed_while_it_is_stopped_it_leaves_the_terminal_alone() {
    let mut viewer = Viewer::start();
    viewer.session.signal(Signal::TSTP);
    viewer.session.wait_until_stopped();
    viewer.session.signal(Signal::TERM);
    viewer.session.signal(Signal::CONT);
    viewer.session.ends_by("Terminated");
}

#[test]
fn a_terminal_that_takes_nothing_does_not_keep_it_alive() {
    let mut viewer = Viewer::start();
    viewer.session.block_output();
    viewer.session.type_in(" ");
    viewer.session.signal(Signal::TERM);
    let status = viewer.session.wait_for_exit();
    assert_eq!(status.signal(), Some("Terminated"), "{status}");
    assert!(is_cooked(&viewer.session.modes()));
}

/// Also where it is in the middle of a frame.
#[test]
fn it_ends_with_its_terminal() {
    type Until = fn(&[u8]) -> bool;
    let scene = scene_file(&VIEW);
    // A terminal that answers nothing gets no brackets: the status line ends a frame.
    let has_status: Until = |sent| sent.windows(6).any(|bytes| bytes == b"q quit");
    let cases: [(&[&str], (u16, u16), Until); 2] = [
        (&[scene.path()], (COLUMNS, ROWS), has_status),
        (&["marbles", "--no-probe"], (200, 60), |sent| sent.len() >= 20_000),
    ];
    for (arguments, size, until) in cases {
        println!("{arguments:?}");
        let mut window = Window::open(command(spherule(), arguments, &[]), size);
        window.read_until(until);
        window.close();
    }
}

/// The checks above can fail: they find everything that a careless program leaves behind, one by
/// one.
#[test]
fn what_is_left_behind_is_found() {
    let cases: [(&str, &[&str]); 9] = [
        ("printf 'hello\\n'", &[]),
        ("printf '\\033[?1049h'", &["alternate screen", "mode 1049"]),
        ("printf '\\033[?25l'", &["hidden cursor", "mode 25"]),
        ("printf '\\033[?1002h'", &["mouse", "mode 1002"]),
        ("printf '\\033[?7l\\033[?2026h'", &["mode 7", "mode 2026"]),
        ("printf '\\033[31m'", &["foreground colour"]),
        ("stty raw", &["line discipline"]),
        ("stty -echo", &["line discipline"]),
        ("saved=$(stty -g); stty raw; stty \"$saved\"", &[]),
    ];
    for (script, expected) in cases {
        let mut session = Session::start_script(script, &[], (COLUMNS, ROWS));
        assert!(session.wait_for_end().success());
        assert_eq!(session.left_behind(), expected, "{script}");
    }
}
