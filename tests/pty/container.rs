//! The program as all that runs in a container.

use super::picture::{OPTIONS, SceneFile};
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, VIEW, shows_a_frame};
use spherule_tests::binary::spherule;
use std::process::{Command, Stdio};
use std::{fs, process};

/// Gives the program that follows process IDs of its own, from 1 on.
const OWN_IDS: [&str; 4] = ["--pid", "--fork", "--kill-child", "--mount-proc"];

/// The system spares an init from signals without a handler, so it cannot end by one.
#[test]
fn an_init_that_a_signal_ends_has_the_exit_code_of_shells() {
    let mut unshare = Command::new("unshare");
    let status = unshare.args(OWN_IDS).arg("true").stderr(Stdio::null()).status();
    if !status.is_ok_and(|status| status.success()) {
        println!("skipped: no process IDs of one's own");
        return;
    }
    // An init is spared only signals from inside, so the signal comes from there.
    let go = std::env::temp_dir().join(format!("spherule-{}-go", process::id()));
    let wait = format!("while ! [ -e '{}' ]; do sleep 0.05; done", go.display());
    let script = format!("({wait}; kill -TERM 1) & exec \"$0\" \"$@\"");
    let scene = SceneFile::new(&VIEW);
    let program = spherule();
    let program = program.to_str().expect("a path that is text");
    let command = ["sh", "-c", script.as_str(), program, scene.path()];
    let arguments = [OWN_IDS.as_slice(), command.as_slice(), OPTIONS.as_slice()].concat();
    let mut session = Session::start("unshare", &arguments, &[], (COLUMNS, ROWS));
    session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
    fs::write(&go, "").expect("a temporary file");
    let status = session.wait_for_end();
    fs::remove_file(&go).expect("it is there");
    assert_eq!((status.exit_code(), status.signal()), (128 + 15, None), "{status}");
    assert_eq!(session.left_behind(), [""; 0]);
}
