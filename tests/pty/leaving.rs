//! How the program stops, goes on and ends, and what it leaves behind.

use super::emulated::{Emulated, STATUS};
use super::look::last_row;
use super::modes::is_cooked;
use super::picture::{SceneFile, once};
use super::session::{Session, command, size};
use super::viewer::{COLUMNS, PICTURE_ROWS, ROWS, STOPPED, VIEW, Viewer, shows_a_frame};
use portable_pty::native_pty_system;
use rustix::process::Signal;
use spherule_tests::binary::spherule;
use std::io::Read;
use std::thread;
use std::time::{Duration, Instant};

/// Asserts that after a stop the terminal is the shell's, and the program's when it goes on.
fn assert_is_left_and_taken_again(mut viewer: Viewer, go_on: impl FnOnce(&mut Session)) {
    assert!(is_cooked(&viewer.session.modes()), "the shell gets no lines");
    viewer.session.wait_for("the normal screen", |output| {
        (!output.screen().alternate_screen()).then_some(())
    });
    assert_eq!(viewer.session.left_behind(), [""; 0]);
    let sent = viewer.session.output().sent.len();
    go_on(&mut viewer.session);
    viewer.wait_for_picture("the picture again", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    assert!(!is_cooked(&viewer.session.modes()));
    let redrawn = viewer.session.output().sent[sent..].windows(4).any(|bytes| bytes == b"\x1b[2J");
    assert!(redrawn, "not drawn in full");
    viewer.quit();
}

#[test]
fn ctrl_z_stops_a_job_and_fg_draws_again() {
    let mut viewer = Viewer::start_as_job();
    viewer.session.type_in("\x1a");
    viewer
        .session
        .wait_for("the shell", |output| output.sent.ends_with(STOPPED.as_bytes()).then_some(()));
    assert_is_left_and_taken_again(viewer, |session| session.type_in("\n"));
}

/// What leads its session is all that runs in its terminal: no one would be told of a stop.
#[test]
fn ctrl_z_without_a_shell_stops_nothing_and_says_so() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1a");
    viewer.session.wait_for("a word about it", |output| {
        output.screen().contents().contains("no shell to continue it").then_some(())
    });
    assert!(!is_cooked(&viewer.session.modes()));
    viewer.session.type_in("3");
    viewer.wait_for_picture("the picture", &once(&VIEW, COLUMNS, PICTURE_ROWS));
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
    viewer.session.wait_for("a full frame", |output| {
        let redrawn = output.sent[sent..].windows(4).any(|bytes| bytes == b"\x1b[2J");
        (redrawn && shows_a_frame(output)).then_some(())
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
    let mut viewer = Viewer::start_in(late(DELAY), &[], &[], (COLUMNS, ROWS));
    viewer.wait_for_look("the picture", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.session.wait_for_peace();
    viewer.session.type_in("1");
    viewer
        .session
        .wait_for("a frame", |output| last_row(output.screen()).contains(" fast ").then_some(()));
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
                viewer.session.wait_for("frames", |output| {
                    let sent = String::from_utf8_lossy(&output.sent);
                    (sent.matches(STATUS).count() > 6).then_some(())
                });
                end(&mut viewer.session);
                viewer.session.wait_for("the normal screen", |output| {
                    (!output.screen().alternate_screen()).then_some(())
                });
                thread::sleep(Duration::from_secs(1));
                assert!(is_cooked(&viewer.session.modes()), "{what}");
                let sent = String::from_utf8_lossy(&viewer.session.output().sent).into_owned();
                assert!(!sent.contains("^[["), "{what}: {sent:?}");
            });
        }
    });
}

#[test]
fn every_key_that_quits_does() {
    for key in ["q", "\x03", "\x1b"] {
        let mut viewer = Viewer::start();
        viewer.session.type_in(key);
        let status = viewer.session.wait_for_end();
        assert!(status.success(), "{key:?}: {status}");
        assert_eq!(viewer.session.left_behind(), [""; 0], "{key:?}");
    }
}

/// As GNU screen and Linux's console, which have no alternate screen, show it.
#[test]
fn without_an_alternate_screen_the_prompt_comes_below_the_picture() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("q");
    assert!(viewer.session.wait_for_end().success());
    let output = viewer.session.output();
    let sent = String::from_utf8_lossy(&output.sent);
    let sent = sent.replace("\x1b[?1049h", "").replace("\x1b[?1049l", "");
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
    let shown = viewer.session.output().screen().contents();
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
        let status = viewer.session.wait_for_end();
        assert_eq!(status.signal(), Some(name), "{status}");
        assert_eq!(viewer.session.left_behind(), [""; 0], "{name}");
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
    let status = viewer.session.wait_for_end();
    assert_eq!(status.signal(), Some("Terminated"), "{status}");
    assert_eq!(viewer.session.left_behind(), [""; 0]);
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

#[test]
fn it_ends_with_its_terminal() {
    let scene = SceneFile::new(&VIEW);
    let pair = native_pty_system().openpty(size(COLUMNS, ROWS)).expect("a pseudo-terminal");
    let mut child = pair
        .slave
        .spawn_command(command(spherule(), &[scene.path()], &[]))
        .expect("the program starts");
    let mut reader = pair.master.try_clone_reader().expect("output can be read");
    let mut sent = Vec::new();
    let mut bytes = [0; 4096];
    // Waits for the end of the status line: a terminal that answers nothing gets no brackets.
    while !sent.windows(6).any(|bytes| bytes == b"q quit") {
        let count = reader.read(&mut bytes).expect("the program writes");
        sent.extend_from_slice(&bytes[..count]);
    }
    drop((pair, reader));
    let status = child.wait().expect("it is our child");
    assert_eq!(status.signal(), Some("Hangup"), "{status}");
}

/// The checks above can fail: they find everything that a careless program leaves behind, one by
/// one.
#[test]
fn what_is_left_behind_is_found() {
    let left_behind = |script: &str| {
        let mut session = Session::start("sh", &["-c", script], &[], (COLUMNS, ROWS));
        assert!(session.wait_for_end().success());
        session.left_behind()
    };
    assert_eq!(left_behind("printf 'hello\\n'"), [""; 0]);
    assert_eq!(left_behind("printf '\\033[?1049h'"), ["alternate screen", "mode 1049"]);
    assert_eq!(left_behind("printf '\\033[?25l'"), ["hidden cursor", "mode 25"]);
    assert_eq!(left_behind("printf '\\033[?1002h'"), ["mouse", "mode 1002"]);
    assert_eq!(left_behind("printf '\\033[?7l\\033[?2026h'"), ["mode 7", "mode 2026"]);
    assert_eq!(left_behind("printf '\\033[31m'"), ["foreground colour"]);
    assert_eq!(left_behind("stty raw"), ["line discipline"]);
    assert_eq!(left_behind("stty -echo"), ["line discipline"]);
    assert_eq!(left_behind("saved=$(stty -g); stty raw; stty \"$saved\""), [""; 0]);
}
