//! Sixels in the viewer: as many as the terminal shows.

use super::emulated::{ATTRIBUTES, CELL_PIXELS, Emulated, STATUS};
use super::picture::once;
use super::viewer::{COLUMNS, ROWS, VIEW, Viewer};

/// xterm as a VT340: what is more than its registers and its largest image would be wrong, or missing.
#[test]
fn sixels_are_as_few_as_the_terminal_shows() {
    let emulated = Emulated::with(&[
        (CELL_PIXELS, "\x1b[6;16;8t"),
        ("\x1b[?1;1;0S", "\x1b[?1;0;16S"),
        ("\x1b[?2;4;0S", "\x1b[?2;0;800;400S"),
        (STATUS, "\x1b[0n"),
        (ATTRIBUTES, "\x1b[?63;1;2;4;6;9;15;22c"),
    ]);
    let mut viewer = Viewer::start_on(emulated, &["--output", "sixel"]);
    viewer.session.wait_for_text("\x1bP0;1;0q\"1;1;640;304");
    viewer.session.wait_for_peace();
    let sent = viewer.session.output().text();
    assert!(sent.contains("#15;2;") && !sent.contains("#16;2;"));
    viewer.session.resize(COLUMNS, 30);
    viewer.session.wait_for_words("shows 800x400 pixels at most");
    viewer.session.type_in("3");
    viewer.wait_for_look("cells", &once(&VIEW, COLUMNS, 29));
    let sent = viewer.session.output().sent.len();
    viewer.session.resize(COLUMNS, ROWS);
    viewer
        .session
        .wait_until("pixels again", |output| output.text_after(sent).contains("\x1bP0;1;0q"));
    viewer.quit();
}

/// `WezTerm` tells the window's size of the moment: that is no limit for a larger window.
#[test]
fn a_limit_that_is_the_window_grows_with_it() {
    let emulated = Emulated::with(&[
        (CELL_PIXELS, "\x1b[6;16;8t"),
        ("\x1b[?2;4;0S", "\x1b[?2;0;640;384S"),
        (STATUS, "\x1b[0n"),
        (ATTRIBUTES, "\x1b[?62;4;22c"),
    ]);
    let viewer = Viewer::start_in(emulated, &["--output", "sixel"], &[], (80, 24));
    viewer.session.wait_for_text("\x1bP0;1;0q\"1;1;640;368");
    viewer.session.resize(100, 30);
    viewer.session.wait_for_text("\x1bP0;1;0q\"1;1;800;464");
    viewer.quit();
}
