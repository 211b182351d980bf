//! The viewer on a scene of the tests' own.

use super::emulated::Emulated;
use super::file::TestFile;
use super::look::{Look, look};
use super::output::Output;
use super::picture::{OPTIONS, scene_file};
use super::session::Session;
use spherule::view::{Lens, View};
use spherule_kernel::Vec3;

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

/// The viewer, and the file of its scene, which must outlive its reading.
pub(crate) struct Viewer {
    pub(crate) session: Session,
    pub(crate) file: TestFile,
}

impl Viewer {
    /// Started, and the first picture is there.
    pub(crate) fn start() -> Self {
        let viewer = Self::start_as(&[]);
        viewer.wait_for_frame();
        viewer
    }

    pub(crate) fn start_at_size(columns: u16, rows: u16) -> Self {
        Self::start_with(&[], columns, rows)
    }

    pub(crate) fn start_with(variables: &[(&str, &str)], columns: u16, rows: u16) -> Self {
        Self::start_in(Emulated::good(), &[], variables, (columns, rows))
    }

    /// Starts with more options.
    pub(crate) fn start_as(more: &[&str]) -> Self {
        Self::start_on(Emulated::good(), more)
    }

    /// In place of [`OPTIONS`]: then it does not draw what [`once`](super::picture::once) does.
    pub(crate) fn start_with_options(options: &[&str]) -> Self {
        let file = scene_file(&VIEW);
        let session = Session::start(&[&[file.path()], options].concat(), &[], (COLUMNS, ROWS));
        Self { session, file }
    }

    /// Starts on another file.
    pub(crate) fn start_with_file(file: TestFile, more: &[&str]) -> Self {
        Self::start_by(file, Emulated::good(), more, &[], (COLUMNS, ROWS))
    }

    /// Starts in another kind of terminal.
    pub(crate) fn start_on(emulated: Emulated, more: &[&str]) -> Self {
        Self::start_in(emulated, more, &[], (COLUMNS, ROWS))
    }

    pub(crate) fn start_in(
        emulated: Emulated,
        more: &[&str],
        variables: &[(&str, &str)],
        size: (u16, u16),
    ) -> Self {
        Self::start_by(scene_file(&VIEW), emulated, more, variables, size)
    }

    pub(crate) fn start_by(
        file: TestFile,
        emulated: Emulated,
        more: &[&str],
        variables: &[(&str, &str)],
        size: (u16, u16),
    ) -> Self {
        let arguments = [&[file.path()], OPTIONS.as_slice(), more].concat();
        let session = Session::start_in(emulated, &arguments, variables, size);
        Self { session, file }
    }

    /// Started as a job of a shell, which sends [`STOPPED`] when it is stopped, and continues it after a line of input.
    /// The first picture is there.
    pub(crate) fn start_as_job() -> Self {
        let file = scene_file(&VIEW);
        let script =
            format!("set -m; \"$0\" \"$@\"; printf '{STOPPED}'; read -r line; fg >/dev/null");
        let arguments = [&[file.path()], OPTIONS.as_slice()].concat();
        let session = Session::start_script(&script, &arguments, (COLUMNS, ROWS));
        let viewer = Self { session, file };
        viewer.wait_for_frame();
        viewer
    }

    pub(crate) fn wait_for_frame(&self) {
        self.session.wait_until("a frame", Output::shows_a_frame);
    }

    pub(crate) fn wait_for_picture(&self, what: &str, expected: &[Vec<Look>]) {
        let rows = expected.len() as u16;
        self.session.wait_until(what, |output| {
            output.shows_a_frame() && look(output.screen(), rows) == expected
        });
    }

    /// The same for a terminal that is not known to draw between brackets.
    pub(crate) fn wait_for_look(&self, what: &str, expected: &[Vec<Look>]) {
        let rows = expected.len() as u16;
        self.session.wait_until(what, |output| look(output.screen(), rows) == expected);
    }

    pub(crate) fn quit(mut self) {
        self.session.quit("q");
    }
}
