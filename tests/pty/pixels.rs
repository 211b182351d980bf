//! Pixels in the viewer: it sends what `--png` writes, and leaves nothing behind.

use super::emulated::{
    ATTRIBUTES, CELL_PIXELS, Emulated, IMAGE, Manner, Rule, STATUS, SYNCHRONIZED,
};
use super::file::TestFile;
use super::look::look;
use super::output::Output;
use super::picture::{first, once_by, scene_file};
use super::session::Session;
use super::viewer::{COLUMNS, PICTURE_ROWS, ROWS, VIEW, Viewer};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use rustix::process::Signal;
use spherule_tests::binary::spherule;
use std::io::{Cursor, Read};
use std::process::Command;
use std::thread;
use std::time::Duration;

/// A kitty whose cells have 8x16 pixels.
const KITTY: [Rule; 6] = [
    (SYNCHRONIZED, "\x1b[?2026;2$y"),
    (CELL_PIXELS, "\x1b[6;16;8t"),
    (IMAGE, "\x1b_Gi=31;OK\x1b\\"),
    (STATUS, "\x1b[0n"),
    (ATTRIBUTES, "\x1b[?62;c"),
    // Only the first image asks for an answer.
    (",q=0,m=1;", "\x1b_Gi=5460040;OK\x1b\\"),
];
const REMOVED: [&str; 2] =
    ["\x1b_Ga=d,d=I,i=5460040,q=2\x1b\\", "\x1b_Ga=d,d=I,i=5460041,q=2\x1b\\"];

/// Width, height and pixels of the last complete image.
fn last_image(sent: &[u8]) -> Option<(u32, u32, Vec<u8>)> {
    let text = String::from_utf8_lossy(sent);
    let start = text.rfind("\x1b_Ga=T")?;
    let (mut payload, mut keys, mut is_whole) = (String::new(), "", false);
    for piece in text[start..].split("\x1b_G").skip(1) {
        let (control, data) = piece.split("\x1b\\").next()?.split_once(';').unwrap_or_default();
        if keys.is_empty() {
            keys = control;
        }
        payload += data;
        if control.ends_with("m=0") {
            is_whole = true;
            break;
        }
    }
    let number = |name: &str| keys.split(',').find_map(|key| key.strip_prefix(name))?.parse().ok();
    let mut rgb = Vec::new();
    ZlibDecoder::new(&*STANDARD.decode(payload).ok()?).read_to_end(&mut rgb).ok()?;
    is_whole.then_some((number("s=")?, number("v=")?, rgb))
}

/// Width, height and pixels of `--png`, of a file's picture.
fn png(path: &str) -> (u32, u32, Vec<u8>) {
    let size = format!("{COLUMNS}x{PICTURE_ROWS}");
    let output = Command::new(spherule())
        .args([path, "--size", &size, "--png", "-"])
        .output()
        .expect("spherule runs");
    let mut reader = png::Decoder::new(Cursor::new(output.stdout)).read_info().expect("a PNG");
    let (width, height) = reader.info().size();
    let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut rgb).expect("all of it");
    (width, height, rgb)
}

#[test]
fn kitty_shows_the_pixels_of_the_png_and_nothing_is_left() {
    let expected = png(scene_file(&VIEW).path());
    let mut viewer = Viewer::start_on(Emulated::with(&KITTY), &["--output", "kitty"]);
    let wait = |viewer: &Viewer, what: &str| {
        viewer.session.wait_until(what, |output| {
            last_image(&output.sent).as_ref() == Some(&expected)
                && output.status().contains("? help")
        });
    };
    wait(&viewer, "the pixels of the PNG");
    // Moved away and back, the picture at rest is the same; text appears over it, and goes.
    viewer.session.type_in("lr?");
    viewer.session.wait_for_words("wheel");
    viewer.session.type_in("?");
    wait(&viewer, "the same pixels");
    viewer.session.wait_until("no help", |output| !output.contents().contains("wheel"));
    viewer.session.wait_for_peace();
    // Views made of cells are shown in cells, without an image behind them.
    viewer.session.type_in("e");
    let is_gone = |output: &Output, removed: &str| {
        let text = output.text();
        text.rfind(removed) > text.rfind("\x1b_Ga=T")
    };
    viewer.session.wait_until("the errors", |output| {
        output.contents().contains("exact: all right") && is_gone(output, REMOVED[0])
    });
    viewer.session.type_in("e");
    wait(&viewer, "the pixels again");
    // The program is suspended.
    viewer.session.signal(Signal::TSTP);
    viewer.session.wait_until_stopped();
    let is_removed = |output: &Output| REMOVED.iter().all(|removed| is_gone(output, removed));
    viewer.session.wait_until("the removal", is_removed);
    viewer.session.signal(Signal::CONT);
    wait(&viewer, "the pixels after a stop");
    viewer.session.quit("q");
    assert!(is_removed(&viewer.session.output()));
}

/// A file has no cells: the terminal from which the program was started has no part in what is written.
#[test]
fn a_file_gets_the_pixels_of_the_png_from_whatever_terminal() {
    let file = TestFile::not_yet("kitty");
    let options = format!("--size {COLUMNS}x{PICTURE_ROWS} --output kitty");
    let script = format!("read -r line; \"$0\" unit {options} >'{}'", file.path());
    let mut session = Session::start_script(&script, &[], (COLUMNS, ROWS));
    session.resize_cells(12, 20);
    session.type_in("\n");
    assert!(session.wait_for_end().success());
    let sent = std::fs::read(file.path()).expect("a file");
    assert!(last_image(&sent) == Some(png("unit")), "other pixels");
}

/// A molecule of two chains is coloured by chain, as in a PNG, and by the next choice at a key.
#[test]
fn pixels_have_the_colours_that_are_chosen() {
    let atom = |number: i32, chain: char| {
        let x = f64::from(3 * number);
        format!(
            "ATOM  {number:5}  CA  ALA {chain}{number:4}    {x:8.3}   0.000   0.000  1.00  0.00           C\n"
        )
    };
    let atoms = [atom(1, 'A'), atom(2, 'A'), atom(3, 'B'), atom(4, 'B')].concat();
    let molecule = TestFile::new("pdb", atoms);
    let expected = png(molecule.path());
    let (kitty, options) = (Emulated::with(&KITTY), ["--output", "kitty"]);
    let mut viewer = Viewer::start_by(molecule, kitty, &options, &[], (COLUMNS, ROWS));
    let shows = |output: &Output| last_image(&output.sent).map(|image| image == expected);
    viewer.session.wait_until("the pixels of the PNG", |output| shows(output) == Some(true));
    viewer.session.type_in("C");
    viewer.session.wait_until("other colours", |output| shows(output) == Some(false));
    viewer.quit();
}

/// The terminal claims to have kitty's images, but has none: the first image gets no answer.
#[test]
fn a_terminal_that_lies_gets_cells() {
    let mut viewer = Viewer::start_on(Emulated::with(&KITTY[..5]), &["--output", "kitty"]);
    viewer.session.wait_for_words("--output kitty: the terminal cannot show");
    viewer.session.type_in("13");
    viewer.wait_for_picture("cells", first());
    viewer.quit();
}

/// Over a slow link, the frames before the first image are answered after it was sent: that is no silence about it.
#[test]
fn answers_to_earlier_frames_deny_no_image() {
    let delay = Duration::from_millis(300);
    let answers = Manner { rules: KITTY.to_vec(), delay, is_torn: false };
    let emulated = Emulated { answers, link: None };
    let options = ["--show", "error", "--output", "kitty"];
    let mut viewer = Viewer::start_on(emulated, &options);
    viewer.session.wait_for_peace();
    // It spins, in cells, with two frames under way.
    viewer.session.type_in(" ");
    viewer.session.wait_until("frames", |output| output.text().matches(STATUS).count() > 4);
    viewer.session.type_in("e ");
    viewer.session.wait_until("an image", |output| last_image(&output.sent).is_some());
    thread::sleep(3 * delay);
    assert!(!viewer.session.output().contents().contains("the terminal cannot show"));
    viewer.quit();
}

/// A terminal that says that it has no pixels gets none.
#[test]
fn a_terminal_that_has_no_pixels_gets_cells() {
    for (output, begins) in [("kitty", "\x1b_Ga=T"), ("sixel", "\x1bP0;1"), ("auto", "\x1b_Ga=T")] {
        let mut viewer = Viewer::start_as(&["--output", output]);
        viewer.session.type_in("13");
        viewer.wait_for_picture("cells", first());
        assert!(!viewer.session.output().text().contains(begins), "{output}");
        viewer.quit();
    }
}

#[test]
fn auto_takes_the_pixels_that_there_are() {
    let sixel =
        [(CELL_PIXELS, "\x1b[6;16;8t"), (STATUS, "\x1b[0n"), (ATTRIBUTES, "\x1b[?62;4;22c")];
    for (rules, begins) in [(&KITTY[..], "\x1b_Ga=T"), (&sixel[..], "\x1bP0;1;0q\"1;1;640;304")] {
        let viewer = Viewer::start_on(Emulated::with(rules), &["--output", "auto"]);
        viewer.session.wait_for_text(begins);
        viewer.quit();
    }
}

/// Another font may leave columns and rows as they are.
#[test]
fn cells_of_another_size_have_as_many_pixels() {
    let viewer = Viewer::start_on(Emulated::with(&KITTY), &["--output", "kitty"]);
    for (width, height) in [(8, 16), (12, 24), (7, 14)] {
        viewer.session.resize_cells(width, height);
        let expected = (u32::from(COLUMNS * width), u32::from(PICTURE_ROWS * height));
        viewer.session.wait_until("pixels of the new size", |output| {
            last_image(&output.sent).is_some_and(|(across, down, _)| (across, down) == expected)
        });
    }
    viewer.quit();
}

/// `y` shows the command line of the view, which is also printed at the end: it draws what was seen.
#[test]
fn the_command_line_that_y_tells_draws_what_is_seen() {
    for (more, keys) in [
        ("", "lllk"),
        ("", "o+l"),
        ("", "-HK"),
        ("", "2Ed"),
        ("--accuracy fast --samples 4 --occlusion --edges", "lE"),
        ("--background 203040 --depth-cue=on", "k1"),
    ] {
        let more: Vec<&str> = more.split_whitespace().collect();
        let mut viewer = Viewer::start_as(&more);
        viewer.wait_for_frame();
        viewer.session.type_in(keys);
        viewer.session.wait_for_peace();
        let seen = look(viewer.session.output().screen(), PICTURE_ROWS);
        viewer.session.type_in("y");
        viewer.session.wait_for_words(" --eye ");
        viewer.session.quit("yq");
        let text = viewer.session.output().text();
        let line = text.rsplit("\x1b[?1049l").next().expect("the normal screen");
        let line = line.lines().next().expect("a line").trim();
        let line = &line[line.find("spherule ").expect("the program")..];
        assert_eq!(once_by(line, COLUMNS, PICTURE_ROWS), seen, "{line}");
    }
}
