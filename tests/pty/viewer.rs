//! The viewer on a scene of the tests' own.

use super::emulated::Emulated;
use super::look::{Look, last_row, look};
use super::picture::{OPTIONS, SceneFile};
use super::session::{Output, Session};
use spherule::view::{Lens, View};
use spherule_kernel::Vec3;
use spherule_tests::binary::spherule;

pub(crate) const COLUMNS: u16 = 80;
pub(crate) const ROWS: u16 = 20;
/// The last row holds the status line.
pub(crate) const PICTURE_ROWS: u16 = ROWS - 1;

pub(crate) const VIEW: View = View {
    eye: Vec3::new(0.5, 1.0, 5.0),
    target: Vec3::ZERO,
    up: Vec3::Y,
    lens: Lens::Perspective { fov: 40.0 },
};

/// A shell sends this when its job has been stopped. No terminal shows it.
pub(crate) const STOPPED: &str = "\x1b]7777;stopped\x07";

/// The viewer on the test's scene, and the scene's file, which must outlive its reading.
pub(crate) struct Viewer {
    pub(crate) session: Session,
    _scene: SceneFile,
}

impl Viewer {
    pub(crate) fn start_at_size(columns: u16, rows: u16) -> Self {
        Self::start_with(&[], columns, rows)
    }

    pub(crate) fn start_with(variables: &[(&str, &str)], columns: u16, rows: u16) -> Self {
        Self::start_as(&[], variables, columns, rows)
    }

    pub(crate) fn start_as(
        more: &[&str],
        variables: &[(&str, &str)],
        columns: u16,
        rows: u16,
    ) -> Self {
        Self::start_by(&[OPTIONS.as_slice(), more].concat(), variables, columns, rows)
    }

    /// In place of [`OPTIONS`]: then it does not draw what [`once`](super::picture::once) does.
    pub(crate) fn start_with_options(options: &[&str]) -> Self {
        Self::start_by(options, &[], COLUMNS, ROWS)
    }

    /// Starts in another kind of terminal.
    pub(crate) fn start_in(
        emulated: Emulated,
        more: &[&str],
        variables: &[(&str, &str)],
        size: (u16, u16),
    ) -> Self {
        let scene = SceneFile::new(&VIEW);
        let arguments = [&[scene.path()], OPTIONS.as_slice(), more].concat();
        let session = Session::start_in(emulated, spherule(), &arguments, variables, size);
        Self { session, _scene: scene }
    }

    /// Started as a job of a shell, which sends [`STOPPED`] when it is stopped, and continues it after a line of input.
    /// The first picture is there.
    pub(crate) fn start_as_job() -> Self {
        let scene = SceneFile::new(&VIEW);
        let script =
            format!("set -m; \"$0\" \"$@\"; printf '{STOPPED}'; read -r line; fg >/dev/null");
        let program = spherule();
        let program = program.to_str().expect("a path that is text");
        let arguments =
            [&["-c", script.as_str(), program, scene.path()], OPTIONS.as_slice()].concat();
        let session = Session::start("sh", &arguments, &[], (COLUMNS, ROWS));
        let viewer = Self { session, _scene: scene };
        viewer.wait_for_frame();
        viewer
    }

    fn start_by(options: &[&str], variables: &[(&str, &str)], columns: u16, rows: u16) -> Self {
        let scene = SceneFile::new(&VIEW);
        let mut arguments = vec![scene.path()];
        arguments.extend(options);
        let session = Session::start(spherule(), &arguments, variables, (columns, rows));
        Self { session, _scene: scene }
    }

    /// Started, and the first picture is there.
    pub(crate) fn start() -> Self {
        let viewer = Self::start_at_size(COLUMNS, ROWS);
        viewer.wait_for_frame();
        viewer
    }

    pub(crate) fn wait_for_frame(&self) {
        self.session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
    }

    pub(crate) fn wait_for_picture(&self, what: &str, expected: &[Vec<Look>]) {
        let rows = expected.len() as u16;
        self.session.wait_for(what, |output| {
            (shows_a_frame(output) && look(output.screen(), rows) == expected).then_some(())
        });
    }

    /// The same for a terminal that is not known to draw between brackets.
    pub(crate) fn wait_for_look(&self, what: &str, expected: &[Vec<Look>]) {
        let rows = expected.len() as u16;
        self.session
            .wait_for(what, |output| (look(output.screen(), rows) == expected).then_some(()));
    }

    pub(crate) fn quit(mut self) {
        self.session.type_in("q");
        let status = self.session.wait_for_end();
        assert!(status.success(), "{status}");
        assert_eq!(self.session.left_behind(), [""; 0]);
    }
}

/// Whether the screen shows a whole frame: all its bytes, including the status line, which does not say that the next
/// picture is being drawn.
pub(crate) fn shows_a_frame(output: &Output) -> bool {
    output.screen().alternate_screen()
        && (output.sent.ends_with(b"\x1b[?2026l") || output.sent.ends_with(b"\x1b[?2026l\x1b[5n"))
        && !last_row(output.screen()).trim().is_empty()
        && !last_row(output.screen()).contains("drawing ...")
}
