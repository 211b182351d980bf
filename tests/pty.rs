//! The real program in a pseudo-terminal: what it shows, and how it leaves the terminal.
//!
//! Needs no controlling terminal: `setsid -w cargo test --test pty </dev/null` passes as well.
#![cfg(target_os = "linux")]
#![forbid(unsafe_code)]

mod pty {
    pub(crate) mod binary;
    pub(crate) mod look;
    pub(crate) mod modes;
    pub(crate) mod picture;
    pub(crate) mod session;
}

use portable_pty::native_pty_system;
use pty::binary::spherule;
use pty::look::{Look, last_row, look};
use pty::modes::is_cooked;
use pty::picture::{OPTIONS, SceneFile, once};
use pty::session::{Output, Session, command, size};
use rustix::process::Signal;
use spherule_kernel::Vec3;
use spherule_tui::view::{Lens, LensKind, View, orbited, with_projection, zoomed};
use spherule_tui::viewer::{ORBIT_STEP, ZOOM_STEP};
use std::f32::consts::PI;
use std::io::Read;

const COLUMNS: u16 = 72;
const ROWS: u16 = 20;
/// The last row is the status line's.
const PICTURE_ROWS: u16 = ROWS - 1;

const VIEW: View = View {
    eye: Vec3::new(0.5, 1.0, 5.0),
    target: Vec3::ZERO,
    up: Vec3::Y,
    lens: Lens::Perspective { fov: 40.0 },
};

/// The viewer on the test's scene, and the scene's file, which must outlive its reading.
struct Viewer {
    session: Session,
    _scene: SceneFile,
}

impl Viewer {
    fn start_at_size(columns: u16, rows: u16) -> Self {
        Self::start_with(&[], columns, rows)
    }

    fn start_with(variables: &[(&str, &str)], columns: u16, rows: u16) -> Self {
        let scene = SceneFile::new(&VIEW);
        let mut arguments = vec![scene.path()];
        arguments.extend(OPTIONS);
        let session = Session::start(spherule(), &arguments, variables, (columns, rows));
        Self { session, _scene: scene }
    }

    /// Started, and the first picture is there.
    fn start() -> Self {
        let viewer = Self::start_at_size(COLUMNS, ROWS);
        viewer.wait_for_frame();
        viewer
    }

    fn wait_for_frame(&self) {
        self.session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
    }

    fn wait_for_picture(&self, what: &str, expected: &[Vec<Look>]) {
        let rows = expected.len() as u16;
        self.session.wait_for(what, |output| {
            (shows_a_frame(output) && look(output.screen(), rows) == expected).then_some(())
        });
    }

    fn quit(mut self) {
        self.session.type_in("q");
        let status = self.session.wait_for_end();
        assert!(status.success(), "{status}");
        assert_eq!(self.session.left_behind(), [""; 0]);
    }
}

/// A whole frame: all bytes of it, the status line among them.
fn shows_a_frame(output: &Output) -> bool {
    output.screen().alternate_screen()
        && output.sent.ends_with(b"\x1b[?2026l")
        && !last_row(output.screen()).trim().is_empty()
}

#[test]
fn it_starts_and_draws_what_once_draws() {
    let viewer = Viewer::start();
    let expected = once(&VIEW, COLUMNS, PICTURE_ROWS);
    assert!(expected.iter().flatten().any(|(glyph, ..)| glyph != " "), "a blank picture");
    viewer.wait_for_picture("the first picture", &expected);
    {
        let output = viewer.session.output();
        assert!(output.screen().hide_cursor());
        assert!(last_row(output.screen()).contains("stable perspective half"));
        assert!(!is_cooked(&viewer.session.modes()));
    }
    viewer.quit();
}

#[test]
fn keys_orbit_and_zoom() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("lll\x1b[C\x1b[A-");
    let mut view = VIEW;
    for _ in 0..4 {
        view = orbited(&view, ORBIT_STEP, 0.0);
    }
    view = zoomed(&orbited(&view, 0.0, ORBIT_STEP), ZOOM_STEP.powi(-1));
    viewer.wait_for_picture("the orbit", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.session.type_in("o");
    let parallel = with_projection(&view, LensKind::Parallel);
    viewer.wait_for_picture("the projection", &once(&parallel, COLUMNS, PICTURE_ROWS));
    viewer.session.type_in("r");
    viewer.wait_for_picture("the way back", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn the_mouse_drags_and_zooms() {
    let mut viewer = Viewer::start();
    // Taken at column 10, row 5, pulled by 10 columns and 2 rows, let go; then the wheel.
    viewer.session.type_in("\x1b[<0;11;6M\x1b[<32;21;8M\x1b[<0;21;8m\x1b[<64;21;8M");
    let a_row = PI / f32::from(PICTURE_ROWS);
    let view = zoomed(&orbited(&VIEW, -5.0 * a_row, 2.0 * a_row), ZOOM_STEP);
    viewer.wait_for_picture("the drag", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn the_status_line_tells_the_tier() {
    let mut viewer = Viewer::start();
    for (key, text) in [("1", " fast "), ("2", " stable "), ("3", "not yet"), ("c", " ascii ")] {
        viewer.session.type_in(key);
        viewer
            .session
            .wait_for(text, |output| last_row(output.screen()).contains(text).then_some(()));
    }
    viewer.quit();
}

#[test]
fn help_opens_and_closes() {
    let mut viewer = Viewer::start();
    let before = once(&VIEW, COLUMNS, PICTURE_ROWS);
    viewer.session.type_in("?");
    viewer
        .session
        .wait_for("the help", |output| output.screen().contents().contains("wheel").then_some(()));
    viewer.session.type_in("?");
    viewer.wait_for_picture("the picture under it", &before);
    viewer.quit();
}

#[test]
fn it_spins_until_told_not_to() {
    let mut viewer = Viewer::start();
    viewer.session.type_in(" ");
    viewer.session.wait_for("a rate", |output| {
        let line = last_row(output.screen());
        (line.contains("fps") && !line.contains("-- fps")).then_some(())
    });
    viewer.session.type_in(" r");
    viewer.wait_for_picture("the first view", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn where_nothing_changes_nothing_is_sent() {
    let mut viewer = Viewer::start();
    let sent = viewer.session.output().sent.len();
    // Keys without a meaning, and a choice that is made already.
    viewer.session.type_in("xyz2");
    viewer.session.type_in("q");
    assert!(viewer.session.wait_for_end().success());
    let output = viewer.session.output();
    let frames = output.sent[sent..].windows(8).filter(|bytes| bytes == b"\x1b[?2026h").count();
    assert_eq!(frames, 0, "{:?}", String::from_utf8_lossy(&output.sent[sent..]));
}

#[test]
fn it_follows_the_size() {
    let viewer = Viewer::start();
    for (columns, rows) in [(100, 30), (30, 10), (72, 21)] {
        viewer.session.resize(columns, rows);
        viewer.wait_for_picture("the new size", &once(&VIEW, columns, rows - 1));
    }
    viewer.quit();
}

#[test]
fn an_early_resize_is_not_lost() {
    let viewer = Viewer::start_at_size(40, 12);
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the new size", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn a_storm_of_sizes_ends_in_the_last() {
    let viewer = Viewer::start();
    for step in 0..200 {
        viewer.session.resize(20 + step % 70, 3 + step % 17);
    }
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the last size", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn a_key_and_a_resize_at_once_both_count() {
    let mut viewer = Viewer::start();
    for round in 0..50 {
        let (key, tier) = if round % 2 == 0 { ("1", " fast ") } else { ("2", " stable ") };
        let (columns, rows) = (40 + round, 8 + round % 5);
        viewer.session.resize(columns, rows);
        viewer.session.type_in(key);
        viewer.session.wait_for("both", |output| {
            let line = last_row(output.screen());
            (shows_a_frame(output) && line.contains(tier)).then_some(())
        });
    }
    viewer.session.resize(COLUMNS, ROWS);
    viewer.session.type_in("q");
    assert!(viewer.session.wait_for_end().success());
}

#[test]
fn a_terminal_without_a_cell_is_waited_for() {
    let viewer = Viewer::start_at_size(0, 0);
    viewer.session.wait_for("the start", |output| output.screen().hide_cursor().then_some(()));
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the picture", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    viewer.session.resize(1, 1);
    viewer.session.resize(0, 7);
    viewer.quit();
}

/// After the program was stopped: the terminal is the shell's, and after SIGCONT the program's.
fn assert_stops_and_goes_on(viewer: Viewer) {
    viewer.session.wait_until_stopped();
    assert!(is_cooked(&viewer.session.modes()), "the shell gets no lines");
    viewer.session.wait_for("the normal screen", |output| {
        (!output.screen().alternate_screen()).then_some(())
    });
    assert_eq!(viewer.session.left_behind(), [""; 0]);
    let sent = viewer.session.output().sent.len();
    viewer.session.signal(Signal::CONT);
    viewer.wait_for_picture("the picture again", &once(&VIEW, COLUMNS, PICTURE_ROWS));
    assert!(!is_cooked(&viewer.session.modes()));
    let redrawn = viewer.session.output().sent[sent..].windows(4).any(|bytes| bytes == b"\x1b[2J");
    assert!(redrawn, "not drawn in full");
    viewer.quit();
}

#[test]
fn ctrl_z_stops_and_sigcont_draws_again() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1a");
    assert_stops_and_goes_on(viewer);
}

#[test]
fn sigtstp_stops_and_sigcont_draws_again() {
    let viewer = Viewer::start();
    viewer.session.signal(Signal::TSTP);
    assert_stops_and_goes_on(viewer);
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
    ] {
        let mut viewer = Viewer::start();
        viewer.session.signal(signal);
        let status = viewer.session.wait_for_end();
        assert_eq!(status.signal(), Some(name), "{status}");
        assert_eq!(viewer.session.left_behind(), [""; 0], "{name}");
    }
}

#[test]
fn killed_while_it_is_stopped_it_leaves_the_terminal_alone() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1a");
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
    while !sent.ends_with(b"\x1b[?2026l") {
        let count = reader.read(&mut bytes).expect("the program writes");
        sent.extend_from_slice(&bytes[..count]);
    }
    drop((pair, reader));
    let status = child.wait().expect("it is our child");
    assert_eq!(status.signal(), Some("Hangup"), "{status}");
}

/// The checks above can fail: what a careless program leaves behind is found, thing by thing.
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
