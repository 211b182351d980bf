//! The picture follows a terminal whose size changes.

use super::look::look;
use super::picture::{first, once};
use super::viewer::{COLUMNS, ROWS, VIEW, Viewer};

#[test]
fn it_follows_the_size() {
    let viewer = Viewer::start();
    for (columns, rows) in [(100, 30), (30, 10), (72, 21)] {
        viewer.session.resize(columns, rows);
        viewer.wait_for_picture("the new size", &once(&VIEW, columns, rows - 1));
    }
    viewer.quit();
}

#[test]
fn an_early_resize_is_not_lost() {
    let viewer = Viewer::start_at_size(40, 12);
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the new size", first());
    viewer.quit();
}

#[test]
fn a_storm_of_sizes_ends_in_the_last() {
    let viewer = Viewer::start();
    for step in 0..200 {
        viewer.session.resize(20 + step % 70, 3 + step % 17);
    }
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the last size", first());
    viewer.quit();
}

#[test]
fn a_key_and_a_resize_at_once_both_count() {
    let mut viewer = Viewer::start();
    for round in 0..50 {
        let (key, tier) = if round % 2 == 0 { ("1", " fast ") } else { ("2", " stable ") };
        let (columns, rows) = (40 + round, 8 + round % 5);
        viewer.session.resize(columns, rows);
        viewer.session.type_in(key);
        viewer
            .session
            .wait_until("both", |output| output.shows_a_frame() && output.status().contains(tier));
    }
    viewer.session.resize(COLUMNS, ROWS);
    viewer.quit();
}

#[test]
fn a_terminal_without_a_cell_is_waited_for() {
    let viewer = Viewer::start_at_size(0, 7);
    viewer.session.wait_until("the start", |output| output.screen().hide_cursor());
    viewer.session.resize(COLUMNS, ROWS);
    viewer.wait_for_picture("the picture", first());
    viewer.session.resize(1, 1);
    viewer.session.resize(0, 7);
    viewer.quit();
}

/// As on a serial line. Until it tells a size it has the usual one, or that of the variables.
#[test]
fn a_terminal_of_unknown_size_is_drawn_on() {
    let variables = [("COLUMNS", "50"), ("LINES", "12")];
    for (variables, columns, rows) in [(&variables[..0], 80, 24), (&variables[..], 50, 12)] {
        let viewer = Viewer::start_with(variables, 100, 30);
        viewer.wait_for_picture("the told size", &once(&VIEW, 100, 29));
        viewer.session.forget_size();
        let expected = once(&VIEW, columns, rows - 1);
        viewer.session.wait_until("a picture of the size that is supposed", |output| {
            let shown = look(output.screen(), rows - 1);
            let shown = shown.iter().map(|row| &row[..usize::from(columns)]);
            shown.eq(expected.iter().map(Vec::as_slice))
        });
        viewer.session.resize(COLUMNS, ROWS);
        viewer.wait_for_picture("the told size", first());
        viewer.quit();
    }
}
