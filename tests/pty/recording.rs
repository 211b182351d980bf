//! `R` in the viewer: what it shows becomes a file.

use super::output::Output;
use super::session::{Session, command};
use super::viewer::{COLUMNS, ROWS};
use super::window::Window;
use rustix::process::Signal;
use spherule_tests::binary::spherule;
use std::fs;
use std::path::{Path, PathBuf};

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
    let script = format!("cd '{}' && exec \"$0\" \"$@\"", folder.display());
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
    let script = format!("cd '{0}' && rmdir '{0}' && exec \"$0\" \"$@\"", folder.display());
    let mut session = start(&script);
    session.wait_for_words("cannot record here: no such file or directory");
    assert!(!records(&session.output()));
    session.quit("q");
}

/// The recording that is all there is in `folder`, which is removed; it goes on to its end.
fn kept(folder: &Path) -> String {
    let files = fs::read_dir(folder).expect("it is there");
    let names = files.map(|file| file.expect("a file").file_name().to_string_lossy().into_owned());
    assert_eq!(names.collect::<Vec<String>>(), ["marbles-1.cast"]);
    let text = fs::read_to_string(folder.join("marbles-1.cast")).expect("a recording");
    assert!(text.ends_with("\\u001b[?7h\\u001b[?25h\"]\n"), "{text}");
    fs::remove_dir_all(folder).expect("it can be removed");
    text
}

#[test]
fn a_signal_that_ends_the_program_ends_a_recording() {
    for (signal, name) in [(Signal::TERM, "Terminated"), (Signal::HUP, "Hangup")] {
        let folder = folder(name);
        let mut session = start(&format!("cd '{}' && exec \"$0\" \"$@\"", folder.display()));
        session.wait_until("a recording", records);
        session.type_in("l");
        session.wait_for_peace();
        session.signal(signal);
        session.ends_by(name);
        let text = kept(&folder);
        assert!(text.starts_with('{') && text.lines().count() > 2, "{text}");
    }
}

/// A window that is closed, and a link that breaks.
#[test]
fn a_recording_ends_with_its_terminal() {
    let folder = folder("gone-cast");
    let mut program = command(spherule(), &["marbles", "--no-probe"], &[]);
    program.cwd(&folder);
    let mut window = Window::open(program, (COLUMNS, ROWS));
    let has = |word: &'static [u8]| {
        move |sent: &[u8]| sent.windows(word.len()).any(|bytes| bytes == word)
    };
    window.read_until(has(b"q quit"));
    window.type_in(b"R");
    window.read_until(has(b"recording:"));
    window.close();
    kept(&folder);
}
