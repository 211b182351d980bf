//! A scene on a map, millions of its own sizes from zero, looks as it does near zero: files have double precision, the
//! kernel single.

use crate::run::{self, printed, run_with_input};
use spherule_referee::random::Random;

/// On a map in metres, and farther away; all are numbers of single precision.
const PLACES: [[f64; 3]; 2] = [[500_000.0, 5_400_000.0, 310.0], [-3e9, 0.0, 4096.0]];

/// The first is in the middle, so that all are as they were once it is subtracted; the numbers have 20 bits.
fn spheres() -> Vec<[f64; 4]> {
    let mut random = Random::seeded(21);
    let mut number = || f64::from(random.between(-1.0, 1.0) * 1024.0).round() / 1024.0;
    let first = [0.0, 0.0, 0.0, 0.25];
    let others = (0..60).map(|_| [number(), number(), number(), 0.2 + 0.1 * number()]);
    [first].into_iter().chain(others).collect()
}

fn moved(place: [f64; 3]) -> Vec<[f64; 4]> {
    spheres().iter().map(|s| [s[0] + place[0], s[1] + place[1], s[2] + place[2], s[3]]).collect()
}

fn table(place: [f64; 3]) -> Vec<u8> {
    let rows = moved(place).into_iter().map(|[x, y, z, r]| format!("{x},{y},{z},{r}\n"));
    format!("x,y,z,radius\n{}", rows.collect::<String>()).into()
}

fn xyz(place: [f64; 3]) -> Vec<u8> {
    let frame = |turn: f64| {
        let atoms = moved(place).into_iter().enumerate();
        let atoms = atoms.map(|(index, [x, y, z, _])| {
            // In the second frame even the first atom is elsewhere.
            let up = if index % 2 == 0 { turn } else { 0.0 };
            format!("C {x} {} {z}\n", y + up)
        });
        format!("61\n\n{}", atoms.collect::<String>())
    };
    (frame(0.0) + &frame(0.5)).into()
}

fn dump(place: [f64; 3]) -> Vec<u8> {
    let head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n61\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n\
        ITEM: ATOMS id x y z radius\n";
    let rows = moved(place).into_iter().enumerate();
    // Downwards: the first that is read is the last in the scene.
    let rows = rows.map(|(index, [x, y, z, r])| format!("{} {x} {y} {z} {r}\n", 99 - index));
    format!("{head}{}", rows.collect::<String>()).into()
}

fn npy(place: [f64; 3]) -> Vec<u8> {
    let head = run::header("'<f8'", "False", "(61, 4)");
    let spheres = moved(place);
    let bytes = spheres.as_flattened().iter().flat_map(|number| number.to_le_bytes());
    run::npy(&head, &bytes.collect::<Vec<u8>>())
}

fn ply(place: [f64; 3]) -> Vec<u8> {
    let head = "ply\nformat binary_big_endian 1.0\nelement vertex 61\nproperty double x\nproperty double y\n\
        property double z\nproperty double radius\nend_header\n";
    let numbers = moved(place);
    let numbers = numbers.as_flattened().iter().flat_map(|number| number.to_be_bytes());
    head.bytes().chain(numbers).collect()
}

fn toml(place: [f64; 3]) -> Vec<u8> {
    let at = |x: f64, y: f64, z: f64| {
        format!("[{:?}, {:?}, {:?}]", x + place[0], y + place[1], z + place[2])
    };
    let spheres = moved(place).into_iter().map(|[x, y, z, r]| {
        format!("[[sphere]]\ncenter = [{x:?}, {y:?}, {z:?}]\nradius = {r:?}\n")
    });
    format!(
        "shadows = true\n[camera]\neye = {}\ntarget = {}\n[[light]]\nposition = {}\n[[light]]\ndirection = [-1, 2, 3]\n{}",
        at(2.0, 1.0, 4.0),
        at(0.0, 0.0, 0.0),
        at(3.0, 5.0, 4.0),
        spheres.collect::<String>()
    )
    .into()
}

#[test]
fn a_file_that_is_far_from_zero_is_drawn_as_near_zero() {
    type Written = fn([f64; 3]) -> Vec<u8>;
    let formats: [(&str, Written); 6] = [
        ("csv", table),
        ("xyz --frames 0..2", xyz),
        ("lammps-dump", dump),
        ("npy", npy),
        ("ply", ply),
        ("toml", toml),
    ];
    for (format, written) in formats {
        let words = format!("- --size 40x14 --charset block --color truecolor --format {format}");
        let picture = |place| printed(run_with_input(&words, &written(place)));
        let usual = picture([0.0; 3]);
        assert!(usual.chars().filter(|glyph| !glyph.is_whitespace()).count() > 100, "{usual}");
        for place in PLACES {
            assert!(picture(place) == usual, "{format} at {place:?}");
        }
    }
}

#[test]
fn the_eye_is_where_the_file_has_it() {
    let picture = |place: [f64; 3]| {
        let at =
            |x: f64, y: f64, z: f64| format!("{},{},{}", x + place[0], y + place[1], z + place[2]);
        let words =
            format!("- --size 40x14 --eye {} --target {}", at(2.0, 1.0, 4.5), at(0.25, 0.0, 0.0));
        printed(run_with_input(&words, &table(place)))
    };
    let usual = picture([0.0; 3]);
    assert!(usual.chars().filter(|glyph| !glyph.is_whitespace()).count() > 100, "{usual}");
    assert!(picture(PLACES[0]) == usual);
}

#[test]
fn a_pick_says_where_its_zero_is() {
    let pick = |place, words: &str| {
        printed(run_with_input(&format!("- --size 40x14 --pick 20,7{words}"), &table(place)))
    };
    let [near, far] = [[0.0; 3], PLACES[0]].map(|place| pick(place, ""));
    assert_eq!(
        far,
        near.replacen("\nsphere", ", from (500000.0, 5400000.0, 310.0) of the file\nsphere", 1)
    );
    let [near, far] = [[0.0; 3], PLACES[0]].map(|place| pick(place, " --json"));
    assert_eq!(far, near.replace("\"zero\":[0.0,0.0,0.0]", "\"zero\":[500000.0,5400000.0,310.0]"));
    assert_ne!(far, near);
}
