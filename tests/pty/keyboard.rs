//! Keys come from the terminal, wherever standard input comes from.

use super::output::Output;
use super::picture::scene_file;
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, VIEW};
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
