//! Pictures: the built-in scenes against files that a person can read in a diff. The samples of `unit` are also held
//! against the exact oracle, so that the files are not the program's word alone.
//!
//! After an intended change, `SPHERULE_GOLDEN=write cargo test -p spherule-tests golden` writes the files in
//! `tui/tests/golden` anew, except the one of `tui/tests/program/show.rs`; read the diff before committing it.

use spherule::cells::masks::repertoire;
use spherule::draw::{draw, sample_grid};
use spherule::scene::Scene;
use spherule::style::{Charset, ColorDepth, Style};
use spherule::view::{LensKind, View, orbited, with_projection};
use spherule::{encode, scene};
use spherule_kernel::{Sphere, Tier, Vec3};
use spherule_tests::oracle;
use std::path::PathBuf;

const ASCII: Style = Style::PLAIN;

/// The picture as it would be written to a pipe, with `\e` for escape.
fn picture(name: &str, style: &Style, columns: u16, rows: u16) -> String {
    let scene = scene::builtin::builtin(name).expect("a built-in scene");
    let view = scene.first_view(style.picture_aspect(columns, rows) as f32);
    let mut bytes = Vec::new();
    encode::full(&draw(&scene, &view, style, columns, rows).cells, &mut bytes);
    String::from_utf8(bytes).expect("UTF-8").replace('\x1b', "\\e")
}

/// Compares with the file, or writes it if `SPHERULE_GOLDEN` says so.
fn check(file: &str, actual: &str) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tui/tests/golden");
    let path = folder.join(file);
    if std::env::var_os("SPHERULE_GOLDEN").is_some_and(|value| value == "write") {
        std::fs::write(&path, actual).expect("a writable folder");
        return;
    }
    let expected = std::fs::read_to_string(&path).expect(file);
    assert!(actual == expected, "{file} differs; expected\n{expected}\nfound\n{actual}");
}

#[test]
fn scenes_in_ascii() {
    for name in ["unit", "marbles", "flake", "edge", "far", "caffeine"] {
        check(&format!("{name}.txt"), &picture(name, &ASCII, 60, 24));
    }
}

#[test]
fn edge_as_the_lecture_s_forms_see_it() {
    for (accuracy, file) in [(Tier::Fast, "edge-fast.txt"), (Tier::Geometric, "edge-geometric.txt")]
    {
        check(file, &picture("edge", &Style { accuracy, ..ASCII }, 60, 24));
    }
}

#[test]
fn half_blocks_without_colour() {
    let half = Style { charset: Charset::Half, ..ASCII };
    check("marbles-half.txt", &picture("marbles", &half, 60, 24));
}

#[test]
fn colours() {
    for (depth, name) in [
        (ColorDepth::Ansi16, "16"),
        (ColorDepth::Ansi256, "256"),
        (ColorDepth::Truecolor, "truecolor"),
    ] {
        let half = Style { charset: Charset::Half, depth, ..ASCII };
        check(&format!("marbles-half-{name}.txt"), &picture("marbles", &half, 16, 6));
        let ascii = Style { depth, ..ASCII };
        check(&format!("caffeine-ascii-{name}.txt"), &picture("caffeine", &ascii, 16, 6));
    }
}

/// One sample a bin: each bin is on exactly where the oracle says that its ray hits the sphere.
#[test]
fn every_sample_of_unit_is_what_the_oracle_says() {
    let scene = scene::builtin::builtin("unit").expect("unit");
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let (mut hits, mut misses) = (0, 0);
    for (columns, rows) in [(80, 24), (61, 33), (200, 60)] {
        for (charset, samples) in [(Charset::Half, 2), (Charset::Octant, 8), (Charset::Braille, 8)]
        {
            let (across, down, glyphs) = &repertoire(charset).mosaic;
            for kind in [LensKind::Perspective, LensKind::Parallel] {
                for turn in [0.0, 0.7] {
                    let style = Style { charset, samples: Some(samples), ..ASCII };
                    let aspect = style.picture_aspect(columns, rows) as f32;
                    let view = orbited(&scene.first_view(aspect), turn, turn / 2.0);
                    let view = with_projection(&view, kind);
                    let (camera, width, height) = sample_grid(&view, &style, columns, rows);
                    let (across, down) = (*across as u32, *down as u32);
                    assert_eq!(width, u32::from(columns) * across);
                    assert_eq!(height, u32::from(rows) * down);
                    let cells = draw(&scene, &view, &style, columns, rows).cells;
                    for iy in 0..height {
                        for ix in 0..width {
                            let cell = cells.row((iy / down) as u16)[(ix / across) as usize];
                            let bits = glyphs.iter().position(|&glyph| glyph == cell.glyph);
                            let bits = bits.expect("a glyph of the charset");
                            let on = bits >> (iy % down * across + ix % across) & 1 == 1;
                            let ray = camera.get_ray(ix, iy);
                            let met = oracle::intersect(&ray, &sphere).is_some();
                            assert_eq!(on, met, "{columns}x{rows} {kind:?} {turn} at {ix},{iy}");
                            hits += u32::from(met);
                            misses += u32::from(!met);
                        }
                    }
                }
            }
        }
    }
    assert!(hits > 20_000 && misses > 20_000, "{hits} hits, {misses} misses");
}

/// The spheres of `far` from 10^6 and 10^7 diameters and from a few. Through a parallel lens along an axis the lines
/// are the same from both, and so is every cell, including shadows and colours.
#[test]
fn far_looks_as_from_near() {
    let far = scene::builtin::builtin("far").expect("far");
    let view = far.first_view(1.0);
    for depth in [-2_097_152.0, -20_971_520.0] {
        // Only the spheres at that depth: spheres in front must not hide them from afar.
        let mut group = Scene::new();
        (group.lighting, group.shadows) = (far.lighting.clone(), true);
        for (sphere, &color) in far.spheres().iter().zip(far.colors()) {
            if (sphere.center.z - depth).abs() < 100.0 {
                group.push(sphere, color, None);
            }
        }
        assert_eq!(group.spheres().len(), 6);
        let near =
            View { eye: view.eye.with_z(depth + 64.0), target: view.eye.with_z(depth), ..view };
        for accuracy in [Tier::Exact, Tier::Stable] {
            let style =
                Style { accuracy, charset: Charset::Half, depth: ColorDepth::Truecolor, ..ASCII };
            let cells = |view| draw(&group, view, &style, 120, 40).cells;
            let (near, far) = (cells(&near), cells(&view));
            let differ = (0..40)
                .flat_map(|row| near.row(row).iter().zip(far.row(row)))
                .filter(|(near, far)| near != far)
                .count();
            let lit =
                (0..40).flat_map(|row| near.row(row)).filter(|cell| cell.glyph != ' ').count();
            assert!(lit > 900, "{lit} cells show something");
            match accuracy {
                Tier::Exact => assert_eq!(differ, 0, "of {lit} cells at {depth}"),
                // The control.
                _ => assert!(differ > 5, "Stable tells the spheres apart: {differ}"),
            }
        }
    }
}

/// `edge` through its parallel lens, and from a 64th of the distance, where origins are rounded otherwise: a few
/// samples on outlines differ, and no glyph.
#[test]
fn edge_looks_as_from_near() {
    let edge = scene::builtin::builtin("edge").expect("edge");
    let far = edge.first_view(ASCII.picture_aspect(120, 40) as f32);
    let near = View { eye: far.eye / 64.0, ..far };
    let differ = |accuracy| {
        let style = Style { accuracy, ..ASCII };
        let [near, far] = [&near, &far].map(|view| draw(&edge, view, &style, 120, 40).cells);
        let cells = (0..40).flat_map(|row| near.row(row).iter().zip(far.row(row)));
        cells.filter(|(near, far)| near != far).count()
    };
    assert_eq!(differ(Tier::Exact), 0);
    // The control.
    assert!(differ(Tier::Fast) > 500);
}
