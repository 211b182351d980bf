//! Keys come from the terminal, wherever standard input comes from.

use super::look::last_row;
use super::picture::SceneFile;
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, VIEW, shows_a_frame};
use spherule_tests::binary::spherule;
use std::path::Path;

/// The terminal is opened by a name that every poll knows, which `/dev/tty` is not.
#[test]
fn a_scene_on_standard_input_leaves_the_keys_to_the_terminal() {
    let (scene, program) = (SceneFile::new(&VIEW), spherule());
    let program = program.to_str().expect("a path that is text");
    let arguments = ["-c", "exec \"$0\" - --format toml <\"$1\"", program, scene.path()];
    let mut session = Session::start("sh", &arguments, &[], (COLUMNS, ROWS));
    session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
    session.type_in("1");
    session.wait_for("a tier", |output| last_row(output.screen()).contains(" fast ").then_some(()));
    session.wait_for_peace();
    let open_files = session.open_files();
    if cfg!(target_os = "linux") {
        let count = |name: &Path| open_files.iter().filter(|&file| file == name).count();
        // Standard output and standard error are the same terminal.
        assert_eq!(count(&session.terminal_name()), 3, "{open_files:?}");
        assert_eq!(count(Path::new("/dev/tty")), 0, "{open_files:?}");
    }
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
}
