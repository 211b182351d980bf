//! The real program in a pseudo-terminal: what it shows, and how it leaves the terminal.
//!
//! Needs no controlling terminal: `setsid -w cargo test -p spherule-tests pty </dev/null` passes, too.

mod busy;
mod container;
mod emulated;
mod file;
mod frames;
mod keyboard;
mod leaving;
mod lecture;
mod link;
mod look;
mod modes;
mod multiplexer;
mod once;
mod output;
mod picking;
mod picture;
mod pixels;
mod probe;
mod recording;
mod replies;
mod session;
mod sixels;
mod sizes;
mod table;
mod viewer;
mod window;

use modes::is_cooked;
use output::{BEGIN, Output};
use picture::{OPTIONS, first, once, once_with};
use session::Session;
use spherule::view::{LensKind, orbited, with_projection, zoomed};
use spherule::viewer::{ORBIT_STEP, ZOOM_STEP};
use std::f32::consts::PI;
use viewer::{COLUMNS, PICTURE_ROWS, ROWS, VIEW, Viewer};

#[test]
fn it_starts_and_draws_what_once_draws() {
    let viewer = Viewer::start();
    assert!(first().iter().flatten().any(|(glyph, ..)| glyph != " "), "a blank picture");
    viewer.wait_for_picture("the first picture", first());
    {
        let output = viewer.session.output();
        assert!(output.screen().hide_cursor());
        assert!(output.status().contains("exact perspective half"));
        assert!(!is_cooked(&viewer.session.modes()));
    }
    viewer.quit();
}

#[test]
fn a_background_that_is_asked_for_is_behind_a_scene_that_names_none() {
    let arguments = [&["unit", "--background", "#ffeedd"], OPTIONS.as_slice()].concat();
    let mut session = Session::start(&arguments, &[], (COLUMNS, ROWS));
    let color = vt100::Color::Rgb(0xff, 0xee, 0xdd);
    session.wait_until("the background", |output| output.corner() == Some(color));
    session.quit("q");
}

#[test]
fn s_goes_through_the_structures_and_the_picture_stays() {
    let mut viewer = Viewer::start();
    for structure in ["brute", "depth-list", "bvh"] {
        viewer.session.type_in("s");
        viewer.session.wait_until(structure, |output| {
            output.shows_a_frame() && output.status().contains(structure)
        });
        viewer.wait_for_picture("the same picture", first());
        let line = viewer.session.output().status();
        assert!(line.trim_end().ends_with("? help  q quit"), "{line}");
    }
    viewer.quit();
}

#[test]
fn object_order_draws_the_same_and_says_so() {
    let viewer = Viewer::start_as(&["--order", "object"]);
    viewer.wait_for_picture("the same picture", first());
    assert!(viewer.session.output().status().contains("exact perspective half object"));
    viewer.quit();
}

#[test]
fn keys_orbit_and_zoom() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("lll\x1b[C\x1b[A-");
    let mut view = VIEW;
    for _ in 0..4 {
        view = orbited(&view, ORBIT_STEP, 0.0);
    }
    view = zoomed(&orbited(&view, 0.0, ORBIT_STEP), ZOOM_STEP.powi(-1));
    viewer.wait_for_picture("the orbit", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.session.type_in("o");
    let parallel = with_projection(&view, LensKind::Parallel);
    viewer.wait_for_picture("the projection", &once(&parallel, COLUMNS, PICTURE_ROWS));
    viewer.session.type_in("r");
    viewer.wait_for_picture("the way back", first());
    viewer.quit();
}

#[test]
fn the_mouse_drags_and_zooms() {
    let mut viewer = Viewer::start();
    // Pressed at column 10, row 5, dragged by 10 columns and 2 rows, released; then the wheel.
    viewer.session.type_in("\x1b[<0;11;6M\x1b[<32;21;8M\x1b[<0;21;8m\x1b[<64;21;8M");
    let a_row = PI / f32::from(PICTURE_ROWS);
    let view = zoomed(&orbited(&VIEW, -5.0 * a_row, 2.0 * a_row), ZOOM_STEP);
    viewer.wait_for_picture("the drag", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn the_status_line_tells_the_tier() {
    let mut viewer = Viewer::start();
    for (key, text) in [("1", " fast "), ("2", " stable "), ("3", " exact "), ("4", " geometric ")]
    {
        viewer.session.type_in(key);
        viewer.session.wait_for_status(text);
    }
    viewer.quit();
}

#[test]
fn c_goes_around_the_charsets() {
    let mut viewer = Viewer::start();
    // A terminal may draw a glyph wider than its cell, over cells that stay as they are.
    viewer.session.output().terminal.process(b"\x1b7\x1b[Hwide\x1b8");
    for charset in ["quadrant", "sextant", "octant", "braille", "block", "ascii", "half"] {
        viewer.session.type_in("c");
        viewer.session.wait_for_status(&format!(" perspective {charset} "));
    }
    viewer.wait_for_picture("the first charset", first());
    viewer.quit();
}

/// A picture so large that frames are coarse during a movement.
#[test]
fn after_a_movement_the_picture_becomes_full_and_then_there_is_peace() {
    let (columns, rows) = (200, 60);
    let mut viewer = Viewer::start_at_size(columns, rows);
    viewer.wait_for_frame();
    viewer.session.type_in("l");
    let view = orbited(&VIEW, ORBIT_STEP, 0.0);
    let expected = once(&view, columns, rows - 1);
    viewer.wait_for_picture("the full picture", &expected);
    viewer.session.wait_for_peace();
    viewer.wait_for_picture("the full picture still", &expected);

    // Peace is not the normal state of every viewer.
    viewer.session.type_in(" ");
    assert!(viewer.session.stirs(), "it spins, and nothing happens");
    viewer.session.type_in(" ");
    viewer.session.wait_for_peace();
    viewer.quit();
}

fn row_text(output: &Output, row: u16) -> String {
    output.screen().contents_between(row, 0, row, COLUMNS)
}

/// `e` shows the tier's errors, for the current tier; `e` again shows the picture.
#[test]
fn e_shows_the_errors_and_the_picture_again() {
    let mut viewer = Viewer::start();
    let legend = |output: &Output| row_text(output, PICTURE_ROWS - 2);
    viewer.session.type_in("e");
    viewer.session.wait_until("the legend", |output| {
        output.shows_a_frame() && legend(output).contains(" exact: all right")
    });
    viewer.session.type_in("1");
    viewer.session.wait_until("the errors of fast", |output| {
        output.shows_a_frame() && legend(output).contains(" worst: sphere ")
    });
    let expected =
        once_with(&["--show", "error", "--accuracy", "fast"], &VIEW, COLUMNS, PICTURE_ROWS);
    viewer.wait_for_picture("what --once shows", &expected);
    viewer.session.wait_for_peace();
    viewer.session.type_in("3e");
    viewer.wait_for_picture("the picture again", first());
    viewer.quit();
}

/// Its colours mean something else than those of the picture.
#[test]
fn a_map_of_errors_is_without_the_legend_of_the_picture() {
    let arguments =
        [&["caffeine", "--color-by", "element", "--legend"], OPTIONS.as_slice()].concat();
    let mut session = Session::start(&arguments, &[], (COLUMNS, ROWS));
    let has_legend = |output: &Output| row_text(output, 0).contains(" element");
    session.wait_until("it", |output| output.shows_a_frame() && has_legend(output));
    session.type_in("e");
    session.wait_until("the map alone", |output| {
        let is_map = output.contents().contains(" exact: all right");
        output.shows_a_frame() && is_map && !has_legend(output)
    });
    session.type_in("e");
    session.wait_until("it again", |output| output.shows_a_frame() && has_legend(output));
    session.quit("q");
}

/// `v` cuts the picture in two. Keys, and a drag that begins on the seam, move the seam; any other drag orbits.
#[test]
fn v_shows_two_tiers_and_the_seam_moves() {
    let mut viewer = Viewer::start();
    let wait_for_seam = |viewer: &Viewer, column: u16| {
        viewer.session.wait_until("the seam", |output| {
            let is_seam =
                |row| output.screen().cell(row, column).is_some_and(|cell| cell.contents() == "│");
            let figures = row_text(output, PICTURE_ROWS - 1);
            let is_there = output.shows_a_frame() && (0..PICTURE_ROWS).all(is_seam);
            is_there && figures.matches(" wrong ").count() == 2 && figures.contains(" of ")
        });
    };
    viewer.session.type_in("v");
    wait_for_seam(&viewer, 40);
    let tiers = row_text(&viewer.session.output(), PICTURE_ROWS - 2);
    assert!(tiers.starts_with(" fast  ") && tiers.contains("│ exact  "), "{tiers}");
    assert!(!tiers.contains("ns"), "{tiers}");
    viewer.session.type_in("]]]");
    wait_for_seam(&viewer, 43);
    viewer.session.type_in("[");
    wait_for_seam(&viewer, 42);
    // Pressed at column 42, dragged to column 60 and one row down, released.
    viewer.session.type_in("\x1b[<0;43;6M\x1b[<32;61;7M\x1b[<0;61;7m");
    wait_for_seam(&viewer, 60);
    viewer.session.wait_for_peace();
    viewer.session.type_in("v");
    viewer.wait_for_picture("the first view still", first());
    // A drag that begins elsewhere moves the scene.
    viewer.session.type_in("v\x1b[<0;11;6M\x1b[<32;21;6M\x1b[<0;21;6mv");
    let a_row = PI / f32::from(PICTURE_ROWS);
    let view = orbited(&VIEW, -5.0 * a_row, 0.0);
    viewer.wait_for_picture("the drag", &once(&view, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn help_opens_and_closes() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("?");
    viewer.session.wait_for_words("wheel");
    viewer.session.type_in("?");
    viewer.wait_for_picture("the picture under it", first());
    viewer.quit();
}

#[test]
fn it_spins_until_told_not_to() {
    let mut viewer = Viewer::start();
    viewer.session.type_in(" ");
    viewer.session.wait_until("a rate", Output::tells_a_rate);
    viewer.session.type_in(" r");
    viewer.wait_for_picture("the first view", first());
    viewer.quit();
}

#[test]
fn where_nothing_changes_nothing_is_sent() {
    let mut viewer = Viewer::start();
    // On a busy machine the first frame is refined by a second.
    viewer.wait_for_picture("the first picture", first());
    let sent = viewer.session.output().sent.len();
    // Keys without a meaning (Enter has none while nothing is picked), and a choice that is already made.
    viewer.session.type_in("xyz3\r");
    viewer.session.quit("q");
    let text = viewer.session.output().text_after(sent);
    assert!(!text.contains(BEGIN), "{text:?}");
}
