//! A scene in metres of atoms' nuclei, or of galaxies, looks as it does in any other unit.

use crate::run::{file, printed, prints, run_with_input};
use spherule_referee::random::Random;

/// Spheres as rows of a table, times 2^`exponent`.
fn table(exponent: i32) -> String {
    let (mut random, unit) = (Random::seeded(20), 2.0_f32.powi(exponent));
    let mut rows = String::from("x,y,z,radius\n");
    for _ in 0..60 {
        let center = random.in_cube(1.0).to_array().map(|number| number * unit);
        let radius = (0.15 + 0.1 * random.between(-1.0, 1.0)) * unit;
        rows += &format!("{:e},{:e},{:e},{radius:e}\n", center[0], center[1], center[2]);
    }
    rows
}

#[test]
fn powers_of_two_change_no_byte_of_a_picture() {
    for words in [
        "- --size 40x14",
        "- --size 40x14 --charset block --color truecolor --orbit 20,70",
        "- --size 40x14 --projection parallel",
    ] {
        let picture = |exponent| printed(run_with_input(words, table(exponent).as_bytes()));
        let usual = picture(0);
        assert!(usual.chars().filter(|glyph| !glyph.is_whitespace()).count() > 100, "{usual}");
        for exponent in [-90, -65, -45, 30, 55, 70, 90] {
            assert!(picture(exponent) == usual, "{words}, 2^{exponent}");
        }
    }
}

/// By a light at a place, too, whose squared distance leaves the range of numbers.
#[test]
fn so_it_is_when_lit_from_a_place() {
    let picture = |exponent: i32| {
        let number = |x: f32| format!("{:e}", x * 2.0_f32.powi(exponent));
        let place = |[x, y, z]: [f32; 3]| format!("[{}, {}, {}]", number(x), number(y), number(z));
        let sphere = |center, radius| {
            format!("[[sphere]]\ncenter = {}\nradius = {}\n", place(center), number(radius))
        };
        let scene = sphere([0.0, 0.0, 0.0], 1.0)
            + &sphere([1.5, 0.5, 0.75], 0.5)
            + &format!("[[light]]\nposition = {}\n", place([3.0, 4.0, 5.0]));
        let path = file(&format!("lit{exponent}.toml"), scene);
        prints(&format!("{path} --size 40x14"))
    };
    let usual = picture(0);
    assert!(usual.chars().filter(|glyph| !glyph.is_whitespace()).count() > 100, "{usual}");
    for exponent in [-75, 66, 80] {
        assert!(picture(exponent) == usual, "2^{exponent}: {}", picture(exponent));
    }
}
