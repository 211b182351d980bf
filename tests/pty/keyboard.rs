//! Keys come from the terminal, wherever standard input comes from, and mean what they mean elsewhere.

use super::look::look;
use super::output::Output;
use super::picture::{first, once, scene_file};
use super::session::Session;
use super::viewer::{COLUMNS, PICTURE_ROWS, ROWS, VIEW, Viewer};
use spherule::view::orbited;
use spherule::viewer::ORBIT_STEP;
use std::path::Path;

/// The terminal is opened by a name that every poll knows, which `/dev/tty` is not.
#[test]
fn a_scene_on_standard_input_leaves_the_keys_to_the_terminal() {
    let scene = scene_file(&VIEW);
    let script = "exec \"$0\" - --format toml <\"$1\"";
    let mut session = Session::start_script(script, &[scene.path()], (COLUMNS, ROWS));
    session.wait_until("a frame", Output::shows_a_frame);
    session.type_in("1");
    session.wait_for_status(" fast ");
    session.wait_for_peace();
    let open_files = session.open_files();
    let count = |name: &Path| open_files.iter().filter(|&file| file == name).count();
    // Standard output and standard error are the same terminal.
    assert_eq!(count(&session.terminal_name()), 3, "{open_files:?}");
    assert_eq!(count(Path::new("/dev/tty")), 0, "{open_files:?}");
    session.quit("q");
}

/// Some terminals send an escape before the key.
#[test]
fn an_arrow_with_alt_is_the_arrow() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1b\x1b[C");
    let view = orbited(&VIEW, ORBIT_STEP, 0.0);
    viewer.wait_for_picture("the orbit", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn ctrl_l_draws_over_what_others_have_written() {
    let mut viewer = Viewer::start();
    viewer.session.wait_for_peace();
    viewer.session.output().terminal.process(b"\x1b7\x1b[Hnoise\x1b8");
    viewer.session.type_in("\x0c");
    viewer.wait_for_picture("the picture", first());
    viewer.quit();
}

#[test]
fn escape_takes_a_word_of_the_program_away_before_it_quits() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("y");
    viewer.session.wait_until("the command line", |output| {
        output.shows_a_frame() && look(output.screen(), PICTURE_ROWS) != first()
    });
    viewer.session.type_in("\x1b");
    viewer.wait_for_picture("the picture under it", first());
    viewer.session.quit("\x1b");
}
