//! The frames of a file in the viewer: keys step and play, the status line counts.

use super::picture::OPTIONS;
use super::session::{Output, Session};
use super::viewer::{COLUMNS, ROWS, shows_a_frame};
use spherule_tests::binary::spherule;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::PathBuf;

fn contents(output: &Output) -> String {
    output.screen().contents()
}

/// The viewer on a file of frames.
struct Film {
    session: Session,
    path: PathBuf,
}

impl Film {
    fn of(name: &str, bytes: &[u8]) -> Self {
        Self::with(&[], name, bytes)
    }

    fn with(options: &[&str], name: &str, bytes: &[u8]) -> Self {
        let path = std::env::temp_dir().join(format!("spherule-{}-{name}", std::process::id()));
        fs::write(&path, bytes).expect("a temporary file");
        let name = path.to_str().expect("a path that is text");
        let arguments = [&[name], options, OPTIONS.as_slice()].concat();
        let session = Session::start(spherule(), &arguments, &[], (COLUMNS, ROWS));
        session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
        Self { session, path }
    }

    fn wait_for(&self, words: &str) {
        self.session.wait_for(words, |output| contents(output).contains(words).then_some(()));
    }

    /// Plays to the end and from the beginning, stops, and quits.
    fn plays_and_quits(mut self) {
        self.session.type_in(" ");
        self.wait_for(">11/12");
        self.wait_for(">3/12");
        self.session.type_in(" ");
        self.session.wait_for_peace();
        fs::remove_file(&self.path).expect("it can be removed");
        self.session.type_in("q");
        assert!(self.session.wait_for_end().success());
        assert_eq!(self.session.left_behind(), [""; 0]);
    }
}

/// Steps on and back, plays to the end, and goes on from the beginning.
#[test]
fn keys_step_and_play() {
    let text: String =
        (0..12).map(|index| format!("2\n\nC {index} 0 0\nO 0 {index} 0\n")).collect();
    let mut film = Film::of("frames.xyz", text.as_bytes());
    film.wait_for(" 0/");
    film.session.type_in("..");
    film.wait_for(" 2/");
    film.session.type_in(",");
    film.wait_for(" 1/");
    film.plays_and_quits();
}

/// Without a key, too.
#[test]
fn frames_that_are_written_meanwhile_are_counted() {
    let frame = "1\n\nC 0 0 0\n";
    let mut film = Film::with(&["--follow"], "written.xyz", frame.as_bytes());
    film.wait_for(" 0/1+");
    let file = OpenOptions::new().append(true).open(&film.path);
    file.and_then(|mut file| file.write_all(frame.repeat(2).as_bytes())).expect("it is written");
    film.wait_for(" 0/3+");
    film.session.type_in("q");
    assert!(film.session.wait_for_end().success());
    fs::remove_file(&film.path).expect("it can be removed");
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
    let mut film = Film::of("damaged.xtc", &damaged_xtc(12));
    film.wait_for(" 0/");
    film.session.type_in(" ");
    film.wait_for(">11/12!");
    film.wait_for(" frame 12: ");
    film.session.type_in(" ");
    film.plays_and_quits();
}

/// What is typed behind the end of a scene are keys, and no frame.
#[test]
fn a_scene_that_is_typed_leaves_the_keys_to_the_viewer() {
    let format = ["--format", "xyz"];
    for format in [&format[..0], &format[..]] {
        let arguments = [&["-"], OPTIONS.as_slice(), format].concat();
        let mut session = Session::start(spherule(), &arguments, &[], (COLUMNS, ROWS));
        // Ctrl-D ends it.
        session.type_in("1\n\nC 0 0 0\n\x04");
        session.wait_for("a frame", |output| shows_a_frame(output).then_some(()));
        session.type_in("1");
        session.wait_for("a tier", |output| contents(output).contains(" fast ").then_some(()));
        session.type_in("q");
        assert!(session.wait_for_end().success());
    }
}

/// The table is of the frame that is shown.
#[test]
fn another_frame_is_measured_anew() {
    let mut film =
        Film::of("table.xyz", b"2\n\nC 0 0 0\nO 0 1 0\n3\n\nC 0 0 0\nO 0 1 0\nO 1 0 0\n");
    film.session.type_in("t");
    film.wait_for("2 spheres");
    film.session.type_in(".");
    film.wait_for("3 spheres");
    fs::remove_file(&film.path).expect("it can be removed");
    film.session.type_in("q");
    assert!(film.session.wait_for_end().success());
}
