//! `R` in the viewer: what it shows becomes a file.

use super::output::Output;
use super::session::Session;
use super::viewer::{COLUMNS, ROWS};
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
    let arguments = ["marbles", "--color", "truecolor"];
    let mut session = Session::start_script(script, &arguments, (COLUMNS, ROWS));
    session.wait_for_status("? help");
    session.type_in("R");
    session
}

fn records(output: &Output) -> bool {
    output.status().contains(" rec")
}

/// A recording, which ends after `meanwhile`.
fn record(script: &str, meanwhile: impl FnOnce()) -> Session {
    let mut session = start(script);
    session.wait_until("a recording", records);
    for _ in 0..2 {
        session.type_in("l");
        session.wait_for_peace();
    }
    meanwhile();
    session.type_in("R");
    session.wait_for_words("marbles-1.cast: ");
    session
}

/// `R` begins a recording, and ends it with a file that plays. If no file can be written, the program prints one line
/// and exits with 1.
#[test]
fn r_records() {
    let folder = folder("cast");
    let script = format!("cd {} && exec \"$0\" \"$@\"", folder.display());
    let mut session = record(&script, || {});
    session.quit("q");
    let file = folder.join("marbles-1.cast");
    let text = fs::read_to_string(&file).expect("a recording");
    assert!(text.starts_with("{") && text.lines().count() > 3, "{text}");
    fs::remove_file(&file).expect("it can be removed");
    // The working folder is removed while it records.
    let mut session = record(&script, || fs::remove_dir(&folder).expect("nothing else is in it"));
    session.type_in("q");
    assert_eq!(session.wait_for_end().exit_code(), 1);
    let shown = session.output().contents();
    assert_eq!(shown, "spherule: marbles-1.cast: no such file or directory");
    assert_eq!(session.left_behind(), [""; 0]);
}

/// Else all would be lost at the end.
#[test]
fn where_no_file_can_be_made_nothing_is_recorded() {
    let folder = folder("no-cast");
    let script = format!("cd {0} && rmdir {0} && exec \"$0\" \"$@\"", folder.display());
    let mut session = start(&script);
    session.wait_for_words("no recording here: no such file or directory");
    assert!(!records(&session.output()));
    session.quit("q");
}
