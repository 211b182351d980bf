//! The frames of a file in the viewer: keys step and play, the status line counts.

use super::file::TestFile;
use super::output::Output;
use super::picture::OPTIONS;
use super::session::Session;
use super::viewer::{COLUMNS, ROWS, Viewer};
use std::fs::OpenOptions;
use std::io::Write;

/// The viewer on a file of frames.
fn film(options: &[&str], ending: &str, bytes: impl AsRef<[u8]>) -> Viewer {
    let viewer = Viewer::start_with_file(TestFile::new(ending, bytes), options);
    viewer.wait_for_frame();
    viewer
}

/// Plays to the end and from the beginning, stops, and quits.
fn plays_and_quits(mut film: Viewer) {
    film.session.type_in(" ");
    film.session.wait_for_words(">11/12");
    film.session.wait_for_words(">3/12");
    film.session.type_in(" ");
    film.session.wait_for_peace();
    film.quit();
}

/// Steps on and back, plays to the end, and goes on from the beginning.
#[test]
fn keys_step_and_play() {
    let text: String =
        (0..12).map(|index| format!("2\n\nC {index} 0 0\nO 0 {index} 0\n")).collect();
    let mut film = film(&[], "xyz", text);
    film.session.wait_for_words(" 0/");
    film.session.type_in("..");
    film.session.wait_for_words(" 2/");
    film.session.type_in(",");
    film.session.wait_for_words(" 1/");
    plays_and_quits(film);
}

/// Without a key, too.
#[test]
fn frames_that_are_written_meanwhile_are_counted() {
    let frame = "1\n\nC 0 0 0\n";
    let film = film(&["--follow"], "xyz", frame);
    film.session.wait_for_words(" 0/1+");
    let file = OpenOptions::new().append(true).open(film.file.path());
    file.and_then(|mut file| file.write_all(frame.repeat(2).as_bytes())).expect("it is written");
    film.session.wait_for_words(" 0/3+");
    film.quit();
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

/// The library that unpacks frames panics at a damaged one, which is read ahead of those that are shown. The panic is caught, so
/// the viewer keeps the terminal. Whoever plays the film is told that there is more.
#[test]
fn a_damaged_frame_does_not_end_the_film() {
    let mut film = film(&[], "xtc", damaged_xtc(12));
    film.session.wait_for_words(" 0/");
    film.session.type_in(" ");
    film.session.wait_for_words(">11/12!");
    film.session.wait_for_words(" frame 12: ");
    film.session.type_in(" ");
    plays_and_quits(film);
}

/// What is typed behind the end of a scene are keys, and no frame.
#[test]
fn a_scene_that_is_typed_leaves_the_keys_to_the_viewer() {
    let format = ["--format", "xyz"];
    for format in [&format[..0], &format[..]] {
        let arguments = [&["-"], OPTIONS.as_slice(), format].concat();
        let mut session = Session::start(&arguments, &[], (COLUMNS, ROWS));
        // Ctrl-D ends it.
        session.type_in("1\n\nC 0 0 0\n\x04");
        session.wait_until("a frame", Output::shows_a_frame);
        session.type_in("1");
        session.wait_for_words(" fast ");
        session.quit("q");
    }
}

/// The table is of the frame that is shown.
#[test]
fn another_frame_is_measured_anew() {
    let mut film = film(&[], "xyz", "2\n\nC 0 0 0\nO 0 1 0\n3\n\nC 0 0 0\nO 0 1 0\nO 1 0 0\n");
    film.session.type_in("t");
    film.session.wait_for_words("2 spheres");
    film.session.type_in(".");
    film.session.wait_for_words("3 spheres");
    film.quit();
}
