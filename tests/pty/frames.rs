//! The frames of a file in the viewer: keys step and play, the status line counts.

use super::picture::OPTIONS;
use super::session::{Output, Session};
use super::viewer::{COLUMNS, ROWS, shows_a_frame};
use spherule_tests::binary::spherule;
use std::fs;

fn contents(output: &Output) -> String {
    output.screen().contents()
}

/// Steps on and back, plays to the end, and goes on from the beginning. A file of one frame still spins.
#[test]
fn keys_step_and_play() {
    let path = std::env::temp_dir().join(format!("spherule-{}-frames.xyz", std::process::id()));
    let text: String =
        (0..12).map(|index| format!("2\n\nC {index} 0 0\nO 0 {index} 0\n")).collect();
    fs::write(&path, text).expect("a temporary file");
    let name = path.to_str().expect("a path that is text");
    let arguments = [&[name], OPTIONS.as_slice()].concat();
    let mut session = Session::start(spherule(), &arguments, &[], (COLUMNS, ROWS));
    session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
    let wait_for = |session: &Session, words: &str| {
        session.wait_for(words, |output| contents(output).contains(words).then_some(()));
    };
    wait_for(&session, " 0/");
    session.type_in("..");
    wait_for(&session, " 2/");
    session.type_in(",");
    wait_for(&session, " 1/");
    session.type_in(" ");
    wait_for(&session, ">11/12");
    wait_for(&session, ">3/12");
    session.type_in(" ");
    session.wait_for_peace();
    fs::remove_file(&path).expect("it can be removed");
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
}

/// Frames of GROMACS's `.xtc`, each of an atom at some x: so few are not compressed. What follows them has more atoms,
/// and differences that there are none of.
fn damaged_xtc(frames: u32) -> Vec<u8> {
    let header = |atoms: u32| {
        let mut words = [0; 14];
        (words[0], words[1], words[13]) = (1995, atoms, atoms);
        words.map(u32::to_be_bytes).concat()
    };
    let frame = |x: u32| {
        let atom = [x as f32, 0.0, 0.0].map(f32::to_be_bytes).concat();
        [header(1), atom].concat()
    };
    let mut bytes: Vec<u8> = (0..frames).flat_map(frame).collect();
    // Precision, least and most coordinates, the index of the differences, and four bytes.
    let mut words = [0; 10];
    (words[7], words[8]) = (1000, 4);
    bytes.extend(header(10));
    bytes.extend(words.map(u32::to_be_bytes).concat());
    bytes
}

/// The library that unpacks frames panics at a damaged one. That is caught, so the viewer keeps the terminal.
#[test]
fn a_damaged_frame_does_not_end_the_film() {
    let path = std::env::temp_dir().join(format!("spherule-{}-damaged.xtc", std::process::id()));
    fs::write(&path, damaged_xtc(12)).expect("a temporary file");
    let name = path.to_str().expect("a path that is text");
    let arguments = [&[name], OPTIONS.as_slice()].concat();
    let mut session = Session::start(spherule(), &arguments, &[], (COLUMNS, ROWS));
    let wait_for = |session: &Session, words: &str| {
        session.wait_for(words, |output| contents(output).contains(words).then_some(()));
    };
    wait_for(&session, " 0/");
    // The damaged frame is read ahead of those that are shown.
    session.type_in(" ");
    wait_for(&session, ">11/12");
    wait_for(&session, ">3/12");
    session.type_in(" ");
    session.wait_for_peace();
    fs::remove_file(&path).expect("it can be removed");
    session.type_in("q");
    assert!(session.wait_for_end().success());
    assert_eq!(session.left_behind(), [""; 0]);
}
