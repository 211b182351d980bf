//! The table of `t`: measured while keys still move the picture, and closed at once.

use super::file::TestFile;
use super::look::{Look, look};
use super::output::Output;
use super::picture::once_with;
use super::session::Session;
use super::viewer::{COLUMNS, PICTURE_ROWS, ROWS, VIEW, Viewer};
use spherule::view::orbited;
use spherule::viewer::ORBIT_STEP;
use std::fmt::Write;
use std::time::{Duration, Instant};

/// So many samples that measuring the rays takes seconds; and how many rays there are at [`COLUMNS`] x
/// [`PICTURE_ROWS`].
const MANY: [&str; 2] = ["--samples", "64"];
const RAYS: &str = " 109,440 camera rays";
/// The longest time from a key to its answer on a loaded machine; a measurement takes far longer.
const AT_ONCE: Duration = Duration::from_millis(500);

fn start() -> Viewer {
    let viewer = Viewer::start_as(&MANY);
    viewer.wait_for_frame();
    viewer
}

/// Waits until `words` stand over the picture.
fn wait_for_words(session: &Session, words: &str) {
    session.wait_until(words, |output| output.shows_a_frame() && output.contents().contains(words));
}

fn percent(output: &Output) -> Option<u32> {
    let contents = output.contents();
    let (before, _) = contents.split_once(" %  Esc stops")?;
    before.split_whitespace().next_back()?.parse().ok()
}

#[test]
fn t_measures_shows_and_escape_closes() {
    let mut viewer = start();
    viewer.session.type_in("t");
    viewer
        .session
        .wait_for("progress", |output| percent(output).filter(|percent| (5..95).contains(percent)));
    wait_for_words(&viewer.session, "2^24");
    {
        let output = viewer.session.output();
        let text = output.contents();
        for part in ["3 spheres", "1 thread", RAYS, " shadow rays", "ns a ray"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        // The picture is above the table.
        let above = usize::from(PICTURE_ROWS) - 13;
        let picture = once_with(&MANY, &VIEW, COLUMNS, PICTURE_ROWS);
        assert_eq!(look(output.screen(), above as u16), picture[..above]);
    }
    // The results stay until the user asks for something that they do not apply to.
    viewer.session.wait_for_peace();
    viewer.session.type_in("1");
    viewer.session.wait_until("another tier", |output| {
        output.status().contains(" fast ") && output.contents().contains("2^24")
    });
    viewer.session.type_in("3\x1b");
    viewer
        .wait_for_picture("the picture under it", &once_with(&MANY, &VIEW, COLUMNS, PICTURE_ROWS));
    viewer.session.wait_for_peace();
    viewer.quit();
}

#[test]
fn escape_stops_at_once_what_is_measured() {
    let mut viewer = start();
    let picture = once_with(&MANY, &VIEW, COLUMNS, PICTURE_ROWS);
    for _ in 0..3 {
        viewer.session.type_in("t");
        wait_for_words(&viewer.session, "measuring");
        let asked = Instant::now();
        viewer.session.type_in("\x1b");
        viewer.wait_for_picture("the picture", &picture);
        // An escape is a key when no sequence has followed for 50 ms.
        assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());
    }
    // Nothing measures any more.
    viewer.session.wait_for_peace();
    viewer.quit();
}

#[test]
fn q_leaves_at_once_while_it_measures() {
    let mut viewer = start();
    viewer.session.type_in("t");
    wait_for_words(&viewer.session, "measuring");
    let asked = Instant::now();
    viewer.quit();
    assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());
}

/// The table applies to the picture that is seen: another picture is measured anew when it rests.
#[test]
fn another_view_or_size_is_measured_anew() {
    let mut viewer = start();
    viewer.session.type_in("t");
    wait_for_words(&viewer.session, "measuring");
    viewer.session.resize(70, 20);
    wait_for_words(&viewer.session, " 95,760 camera rays");
    viewer.session.type_in("l");
    viewer.session.wait_for("another measurement", percent);
    wait_for_words(&viewer.session, " 95,760 camera rays");
    viewer.session.resize(30, 10);
    wait_for_words(&viewer.session, " table needs ");
    viewer.session.resize(COLUMNS, ROWS);
    wait_for_words(&viewer.session, RAYS);
    viewer.session.type_in("t");
    let view = orbited(&VIEW, ORBIT_STEP, 0.0);
    viewer.wait_for_picture("the orbit", &once_with(&MANY, &view, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn a_picture_that_spins_is_waited_for() {
    let mut viewer = start();
    viewer.session.type_in(" t");
    wait_for_words(&viewer.session, "waits until the picture rests");
    viewer.session.type_in(" ");
    wait_for_words(&viewer.session, "2^24");
    viewer.session.wait_for_peace();
    viewer.quit();
}

/// The table over an error map, in ASCII, without colour.
#[test]
fn without_colour_it_is_ascii() {
    let options = ["--color", "never", "--charset", "ascii", "--show", "table"];
    let mut viewer = Viewer::start_with_options(&options);
    viewer.wait_for_frame();
    viewer.session.type_in("e");
    wait_for_words(&viewer.session, "2^24");
    {
        let output = viewer.session.output();
        assert!(output.contents().is_ascii() && !output.has_colors());
        // Nor is one of the eight shown.
        let look = look(output.screen(), ROWS);
        let is_plain = |(_, ink, paper): &Look| [ink, paper] == [&vt100::Color::Default; 2];
        assert!(look.iter().flatten().all(is_plain), "{look:?}");
    }
    viewer.session.type_in("\x1b");
    viewer.session.wait_until("the map under it", |output| {
        let text = output.contents();
        output.shows_a_frame() && text.contains(" exact: all right") && !text.contains("2^24")
    });
    viewer.quit();
}

/// Keys are answered at once, however many spheres there are.
#[test]
fn a_hundred_thousand_spheres_do_not_hold_up_escape() {
    let mut text = "100000\nmany\n".to_owned();
    for index in 0..100_000_u32 {
        let at = |step: u32| (index.wrapping_mul(step) >> 8) % 1000;
        let (x, y, z) = (at(2_654_435_761), at(2_246_822_519), at(3_266_489_917));
        writeln!(text, "C {x} {y} {z}").expect("memory");
    }
    let mut viewer = Viewer::start_with_file(TestFile::new("xyz", text), &[]);
    viewer.wait_for_frame();
    for _ in 0..3 {
        viewer.session.type_in("t");
        wait_for_words(&viewer.session, "Esc stops");
        let asked = Instant::now();
        viewer.session.type_in("\x1b");
        viewer.session.wait_until("the picture", |output| {
            output.shows_a_frame() && !output.contents().contains("Esc stops")
        });
        assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());
    }
    viewer.quit();
}
