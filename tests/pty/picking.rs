//! Picking cells, and moving and framing pictures.

use super::look::inverse;
use super::output::Output;
use super::picture::{first, once};
use super::viewer::{COLUMNS, PICTURE_ROWS, VIEW, Viewer};
use spherule::scene::framing::reframed;
use spherule::view::{View, panned};
use spherule::viewer::PAN_STEP;
use spherule_kernel::{Sphere, Vec3};

const ASPECT: f32 = 0.5 * COLUMNS as f32 / PICTURE_ROWS as f32;

/// Waits until this cell alone is marked, and `text` stands over the picture.
fn wait_for_pick(viewer: &Viewer, cell: (u16, u16), text: &str) {
    viewer.session.wait_until(text, |output| {
        let picked = inverse(output.screen()) == [cell];
        output.shows_a_frame() && picked && output.contents().contains(text)
    });
}

/// The word that follows `before` on the screen, up to the next blank.
fn word_after(output: &Output, before: &str) -> String {
    let contents = output.contents();
    let (_, rest) = contents.split_once(before).expect(before);
    rest.split_whitespace().next().expect("a word").to_owned()
}

#[test]
fn p_picks_arrows_lead_on_and_escape_ends_it_alone() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("p");
    let (column, row) = (COLUMNS / 2, PICTURE_ROWS / 2);
    // The camera looks at the middle of the first sphere.
    wait_for_pick(&viewer, (column, row), "sphere 0: centre (0.0, 0.0, 0.0), radius 1.0");
    {
        let output = viewer.session.output();
        for part in ["decided by f64", "fast", "geometric", "stable", "exact", "0x"] {
            assert!(output.contents().contains(part), "{part}");
        }
        let d: f64 = word_after(&output, "D = ").parse().expect("a number");
        assert!(d > 0.0, "{d}");
    }
    viewer.session.type_in("\x1b[C\x1b[A\x1b[Cl");
    wait_for_pick(&viewer, (column + 3, row - 1), "ray (0.5, 1.0, 5.0) + t (");
    viewer.session.type_in(&"h".repeat(100));
    viewer.session.type_in(&"k".repeat(100));
    wait_for_pick(&viewer, (0, 0), "no sphere is hit, by fast, geometric, stable or exact");
    viewer.session.type_in("\x1b");
    viewer.wait_for_picture("the picture under it", first());
    assert!(inverse(viewer.session.output().screen()).is_empty());
    viewer.quit();
}

#[test]
fn a_click_picks_and_a_drag_does_not() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("\x1b[<0;41;10M\x1b[<0;41;10m");
    wait_for_pick(&viewer, (40, 9), "sphere 0: ");
    viewer.session.type_in("\x1b[<0;1;1M\x1b[<0;1;1m");
    wait_for_pick(&viewer, (0, 0), "no sphere is hit");
    // Dragged away and back: the picture and the cell are as before.
    viewer.session.type_in("\x1b[<0;11;6M\x1b[<32;12;6M\x1b[<32;11;6M\x1b[<0;11;6m");
    viewer.session.wait_for_peace();
    wait_for_pick(&viewer, (0, 0), "no sphere is hit");
    // The status line has no cells to pick.
    viewer.session.type_in("\x1b[<0;5;20M\x1b[<0;5;20m");
    viewer.session.wait_for_peace();
    wait_for_pick(&viewer, (0, 0), "no sphere is hit");
    viewer.quit();
}

#[test]
fn without_colour_the_cell_is_marked_too() {
    let mut viewer = Viewer::start_with_options(&["--color", "never", "--charset", "ascii"]);
    viewer.wait_for_frame();
    viewer.session.type_in("p");
    wait_for_pick(&viewer, (COLUMNS / 2, PICTURE_ROWS / 2), "sphere 0: ");
    {
        let output = viewer.session.output();
        assert!(output.contents().is_ascii() && !output.has_colors());
    }
    viewer.quit();
}

#[test]
fn in_a_terminal_that_is_small_it_is_cut() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("p");
    for (columns, rows) in [(20, 6), (1, 1), (3, 2), (200, 60), (1, 9)] {
        viewer.session.resize(columns, rows);
        viewer.session.wait_until("the cell", |output| {
            let (cells_high, cells_wide) = output.screen().size();
            let sized = (cells_wide.get(), cells_high.get()) == (columns, rows);
            sized && inverse(output.screen()).len() == 1
        });
    }
    viewer.quit();
}

#[test]
fn shifted_letters_and_the_right_button_move_the_picture() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("HHJ");
    let step = |view: &View| PAN_STEP * f64::from(view.height_at_target());
    let moved = [(-1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)]
        .into_iter()
        .fold(VIEW, |view, (x, y)| panned(&view, x * step(&view), y * step(&view)));
    viewer.wait_for_picture("the pan", &once(&moved, COLUMNS, PICTURE_ROWS));
    // Dragged by 8 columns and 3 rows in one step, then released.
    viewer.session.type_in("r\x1b[<2;11;6M\x1b[<34;19;9M\x1b[<2;19;9m");
    let a_row = f64::from(VIEW.height_at_target()) / f64::from(PICTURE_ROWS);
    let pulled = panned(&VIEW, -8.0 * 0.5 * a_row, 3.0 * a_row);
    viewer.wait_for_picture("the pull", &once(&pulled, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}

#[test]
fn f_frames_the_scene_and_enter_the_sphere_that_is_picked() {
    let mut viewer = Viewer::start();
    viewer.session.type_in("p\r");
    let one = Sphere { center: Vec3::ZERO, radius: 1.0 };
    wait_for_pick(&viewer, (COLUMNS / 2, PICTURE_ROWS / 2), "sphere 0: ");
    viewer.session.type_in("\x1b");
    let framed = reframed(&VIEW, one, ASPECT);
    viewer.wait_for_picture("the sphere", &once(&framed, COLUMNS, PICTURE_ROWS));
    viewer.session.type_in("f");
    // The box around the three spheres.
    let center = Vec3::new(0.25, 0.125, -0.125);
    let spheres =
        [(Vec3::ZERO, 1.0), (Vec3::new(1.5, 0.5, -0.5), 0.75), (Vec3::new(-1.25, -0.5, 0.5), 0.5)];
    let reach = |(at, radius): (Vec3, f32)| at.distance(center) + radius;
    let radius = spheres.map(reach).into_iter().fold(0.0, f32::max);
    let all = reframed(&framed, Sphere { center, radius }, ASPECT);
    viewer.wait_for_picture("all of it", &once(&all, COLUMNS, PICTURE_ROWS));
    viewer.quit();
}
