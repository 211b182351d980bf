//! Keys while a picture is drawn that takes far longer than anyone waits.

use super::file::TestFile;
use super::look::{Look, inverse, look};
use super::output::Output;
use super::viewer::{COLUMNS, PICTURE_ROWS, Viewer};
use std::sync::OnceLock;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Spheres along each edge of a cube: so many tests of a ray against a sphere that a picture takes three seconds at least.
const SIDE: u16 = 64;
/// The same of a table, where its pictures take a second.
const SIDE_OF_TABLE: u16 = 27;
/// From the first word about a picture to its end a test must have seen that word and typed.
const SLOW_ENOUGH: Duration = Duration::from_secs(1);
const SLOW: [&str; 6] = ["--structure", "brute", "--samples", "64", "--threads", "1"];
/// The longest time from a key to its answer on a loaded machine.
const AT_ONCE: Duration = Duration::from_secs(1);
/// The longest time of a picture on a loaded machine.
const AT_LAST: Duration = Duration::from_secs(30);
/// From a key that is held down to the same again.
const REPETITION: Duration = Duration::from_millis(30);

/// Where the spheres are.
fn lattice(side: u16) -> impl Iterator<Item = [u16; 3]> {
    (0..side).flat_map(move |x| (0..side).flat_map(move |y| (0..side).map(move |z| [x, y, z])))
}

/// Writes the cube as an array.
fn cube() -> TestFile {
    let shape = format!("({}, 4)", u32::from(SIDE).pow(3));
    let head = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    let head = format!("{head:<117}\n");
    let spheres =
        lattice(SIDE).flat_map(|[x, y, z]| [f32::from(x), f32::from(y), f32::from(z), 0.3]);
    let magic = b"\x93NUMPY\x01\x00\x76\x00".iter().copied();
    let bytes = magic.chain(head.bytes()).chain(spheres.flat_map(f32::to_le_bytes));
    TestFile::new("npy", bytes.collect::<Vec<u8>>())
}

/// A table of so many spheres along each edge that has a column `q`.
fn table(side: u16) -> TestFile {
    let lines = lattice(side).map(|[x, y, z]| format!("{x},{y},{z},0.3,{x}\n"));
    TestFile::new("csv", format!("x,y,z,r,q\n{}", lines.collect::<String>()))
}

/// The viewer on the least [`table`] from [`SIDE_OF_TABLE`] on whose first picture is [`SLOW_ENOUGH`] on this machine.
fn on_slow_table(more: &[&str]) -> Viewer {
    static SIDE: OnceLock<u16> = OnceLock::new();
    let is_slow = |&side: &u16| {
        let began = Instant::now();
        let viewer = Viewer::start_with_file(table(side), &SLOW);
        viewer.wait_for_frame();
        let time = began.elapsed();
        viewer.quit();
        time >= SLOW_ENOUGH
    };
    let first = || (SIDE_OF_TABLE..).step_by(3).find(is_slow).expect("a table that takes long");
    let file = table(*SIDE.get_or_init(first));
    Viewer::start_with_file(file, &[SLOW.as_slice(), more].concat())
}

/// Types a key again and again until something is seen.
fn hold(viewer: &mut Viewer, key: &str, is_seen: impl Fn(&Output) -> bool) {
    let began = Instant::now();
    while !is_seen(&viewer.session.output()) {
        assert!(began.elapsed() < AT_LAST, "nothing is seen while {key} is held down");
        viewer.session.type_in(key);
        sleep(REPETITION);
    }
}

fn says_that_it_draws(output: &Output) -> bool {
    output.is_whole() && output.status().contains("drawing ...")
}

/// Help opens, another structure takes over, and `q` quits.
#[test]
fn keys_are_answered_while_a_picture_is_drawn() {
    let mut viewer = Viewer::start_with_file(cube(), &SLOW);
    let session = &mut viewer.session;
    session.wait_until("a word about it", says_that_it_draws);

    let asked = Instant::now();
    session.type_in("?");
    session.wait_until("the help", |output| {
        output.contents().contains("wheel") && says_that_it_draws(output)
    });
    assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());

    session.type_in("?ss");
    session.wait_until("the picture by a tree", |output| {
        output.shows_a_frame() && output.status().contains(" bvh ")
    });

    session.type_in("ss");
    session.wait_until("a word about it", says_that_it_draws);
    let asked = Instant::now();
    session.quit("q");
    assert!(asked.elapsed() < AT_ONCE, "{:?}", asked.elapsed());
}

/// From the start on, when it is not known yet how long a picture takes, and later.
#[test]
fn a_key_that_is_held_down_leaves_pictures_to_be_seen() {
    let mut viewer = Viewer::start_with_file(table(SIDE_OF_TABLE), &SLOW);
    let mut before = Vec::<Vec<Look>>::new();
    for key in ["l", "l", "l", "f"] {
        let picture = |output: &Output| look(output.screen(), PICTURE_ROWS);
        hold(&mut viewer, key, |output| output.shows_a_frame() && picture(output) != before);
        before = picture(&viewer.session.output());
    }
    viewer.quit();
}

/// So does Enter, which needs what draws.
#[test]
fn enter_that_is_held_down_leaves_a_picture_to_be_seen() {
    let mut viewer = Viewer::start_with_file(table(SIDE_OF_TABLE), &SLOW);
    let picked = |viewer: &Viewer, before: &[(u16, u16)]| {
        viewer.session.wait_for("another cell that is picked", |output| {
            let cells = inverse(output.screen());
            let is_other = cells.len() == 1 && cells != before;
            let is_sphere = output.contents().contains("sphere ");
            (output.shows_a_frame() && is_other).then_some((cells, is_sphere))
        })
    };
    viewer.wait_for_frame();
    viewer.session.type_in("p");
    let (mut cell, mut is_sphere) = picked(&viewer, &[]);
    while !is_sphere {
        viewer.session.type_in("\x1b[C");
        (cell, is_sphere) = picked(&viewer, &cell);
    }
    let picture = |output: &Output| look(output.screen(), PICTURE_ROWS);
    let before = picture(&viewer.session.output());
    hold(&mut viewer, "\r", |output| output.shows_a_frame() && picture(output) != before);
    viewer.quit();
}

/// What is told of a cell is of the picture under it, also where keys have moved the next one.
#[test]
fn a_cell_is_picked_in_the_picture_that_is_seen() {
    let view = ["--eye", "13,13,80", "--target", "13,13,13"];
    let mut viewer = on_slow_table(&view);
    viewer.session.wait_until("a word about it", says_that_it_draws);
    // The first picture is drawn to its end. The next one is so far to the side that it is empty.
    viewer.session.type_in(&format!("p{}", "H".repeat(60)));
    viewer.session.wait_until("an empty cell", |output| {
        output.shows_a_frame() && output.contents().contains("no sphere is hit")
    });
    let is_told = viewer.session.output().text().contains("(13.0,");
    assert!(is_told, "only of the next picture");
    viewer.quit();
}

/// The last picture stays while the next is drawn, without a legend as before.
#[test]
fn a_legend_comes_with_its_picture() {
    let mut viewer = on_slow_table(&["--legend"]);
    let has_legend = |output: &Output| {
        output.screen().contents_between(0, 0, 0, COLUMNS).trim_end().ends_with(" q")
    };
    let waits_for = |viewer: &Viewer, what: &str, legend: bool| {
        viewer
            .session
            .wait_until(what, |output| output.shows_a_frame() && has_legend(output) == legend);
    };
    waits_for(&viewer, "the first picture", false);
    viewer.session.type_in("C");
    let is_early = viewer.session.wait_for("a word about it", |output| {
        says_that_it_draws(output).then(|| has_legend(output))
    });
    assert!(!is_early);
    viewer.session.type_in("C");
    waits_for(&viewer, "the picture without it", false);
    viewer.session.type_in("C");
    waits_for(&viewer, "the picture with it", true);
    viewer.quit();
}
