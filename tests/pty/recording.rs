//! `R` in the viewer: what it shows becomes a file.

use super::look::last_row;
use super::session::{Output, Session};
use super::viewer::{COLUMNS, ROWS};
use spherule_tests::binary::spherule;
use std::fs;
use std::path::PathBuf;

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("spherule-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The viewer, started by this script of a shell; `R` has been typed.
fn start(script: &str) -> Session {
    let program = spherule();
    let program = program.to_str().expect("text");
    let arguments = ["-c", script, program, "marbles", "--color", "truecolor"];
    let mut session = Session::start("sh", &arguments, &[], (COLUMNS, ROWS));
    session
        .wait_for("a frame", |output| last_row(output.screen()).contains("? help").then_some(()));
    session.type_in("R");
    session
}

fn records(output: &Output) -> bool {
    last_row(output.screen()).contains(" rec")
}

/// A recording, which ends after `meanwhile`.
fn record(script: &str, meanwhile: impl FnOnce()) -> Session {
    let mut session = start(script);
    session.wait_for("a recording", |output| records(output).then_some(()));
    session.type_in("l");
    session.wait_for_peace();
    session.type_in("l");
    session.wait_for_peace();
    meanwhile();
    session.type_in("R");
    session.wait_for("its end", |output| {
        output.screen().contents().contains("marbles-1.cast: ").then_some(())
    });
    session
}

/// `R` begins a recording, and ends it with a file that plays. If no file can be written, the program prints one line
/// and exits with 1.
#[test]
fn r_records() {
    let folder = folder("cast");
    let script = format!("cd {} && exec \"$0\" \"$@\"", folder.display());
    let mut session = record(&script, || {});
    session.type_in("q");
    assert!(session.wait_for_end().success());
    let file = folder.join("marbles-1.cast");
    let text = fs::read_to_string(&file).expect("a recording");
    assert!(text.starts_with("{") && text.lines().count() > 3, "{text}");
    fs::remove_file(&file).expect("it can be removed");
    // The working folder is removed while it records.
    let mut session = record(&script, || fs::remove_dir(&folder).expect("nothing else is in it"));
    session.type_in("q");
    assert_eq!(session.wait_for_end().exit_code(), 1);
    let shown = session.output().screen().contents();
    assert_eq!(shown, "spherule: marbles-1.cast: no such file or directory");
    assert_eq!(session.left_behind(), [""; 0]);
}

/// Else all would be lost at the end.
#[test]
fn where_no_file_can_be_made_nothing_is_recorded() {
    let folder = folder("no-cast");
    let script = format!("cd {0} && rmdir {0} && exec \"$0\" \"$@\"", folder.display());
    let mut session = start(&script);
    let what = "no recording here: no such file or directory";
    session.wait_for(what, |output| output.screen().contents().contains(what).then_some(()));
    assert!(!records(&session.output()));
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
}
