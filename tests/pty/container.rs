//! The program as all that runs in a container.

use super::emulated::Emulated;
use super::file::TestFile;
use super::output::Output;
use super::picture::{OPTIONS, scene_file};
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, VIEW};
use spherule_tests::binary::spherule;
use std::fs;
use std::process::{Command, Stdio};

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
    let go = TestFile::not_yet("go");
    let wait = format!("while ! [ -e '{}' ]; do sleep 0.05; done", go.path());
    let script = format!("({wait}; kill -TERM 1) & exec \"$0\" \"$@\"");
    let scene = scene_file(&VIEW);
    let program = spherule();
    let program = program.to_str().expect("a path that is text");
    let command = ["sh", "-c", script.as_str(), program, scene.path()];
    let arguments = [OWN_IDS.as_slice(), command.as_slice(), OPTIONS.as_slice()].concat();
    let (good, size) = (Emulated::good(), (COLUMNS, ROWS));
    let mut session = Session::start_program(good, "unshare", &arguments, &[], size);
    session.wait_until("a frame", Output::shows_a_frame);
    fs::write(go.path(), "").expect("a temporary file");
    let status = session.wait_for_end();
    assert_eq!((status.exit_code(), status.signal()), (128 + 15, None), "{status}");
    assert_eq!(session.left_behind(), [""; 0]);
}
