use super::*;
use crate::scene::builtin::builtin;
use crate::structure::scene::SceneStructures;
use crate::structure::search::Tracing;
use crate::style::Aids;
use crate::threads::Threads;
use crate::view::Lens;
use spherule_kernel::{Level, Sphere, Vec3};
use std::convert::Infallible;
use std::f64::consts::PI;

const VIEW: View = View { lens: Lens::Parallel { height: 4.0 }, ..View::FRONT };

/// The rows of a picture.
fn rows(
    scene: &Scene,
    view: &View,
    style: &Style,
    (columns, rows): (u16, u16),
    threads: u16,
) -> Vec<Vec<u8>> {
    rows_of(&PixelGrid::new(view, style, columns, rows), scene, threads)
}

fn rows_of(grid: &PixelGrid, scene: &Scene, threads: u16) -> Vec<Vec<u8>> {
    let threads = Threads::new(Some(threads)).expect("threads");
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = grid.workload(scene.list().len());
    let search = structures.picture(None, &workload, &grid.view, scene).expect("memory");
    let mut rows = Vec::new();
    let renderer = Renderer::new(Level::best(), &threads);
    let Ok(()) = renderer.draw_pixels(scene, &search, grid.style.accuracy, grid, |row| {
        rows.push(row.to_vec());
        Ok::<(), Infallible>(())
    });
    assert_eq!(rows.len(), grid.size().1 as usize);
    assert!(rows.iter().all(|row| row.len() == 3 * grid.size().0 as usize));
    rows
}

#[test]
fn pixels_are_as_square_as_whole_numbers_are() {
    let size =
        |cell_aspect| PixelGrid::new(&VIEW, &Style { cell_aspect, ..Style::PLAIN }, 10, 3).size();
    assert_eq!(size(0.5), (80, 48));
    assert_eq!(size(1.0), (80, 24));
    assert_eq!(size(0.75), (80, 33));
    assert_eq!(size(0.05), (80, 480));
    assert_eq!(size(20.0), (80, 3));
}

/// White on black, in whatever cells: as much light as the disc has area, as wide as it is high.
#[test]
fn a_disc_is_round_and_has_its_area() {
    let mut scene = Scene::new();
    scene.push(Sphere { center: Vec3::ZERO, radius: 1.0 }, Srgb::WHITE, None);
    for (cell_aspect, columns, count) in [
        (0.45, 20, 10),
        (11.0 / 24.0, 20, 10),
        (0.5, 20, 10),
        (0.6, 20, 10),
        (0.75, 9, 11),
        (1.0, 13, 9),
        (3.0, 20, 40),
        (20.0, 20, 120),
    ] {
        let style = PixelGrid::square(&Style { cell_aspect, ..Style::PLAIN });
        assert_eq!(PixelGrid::square(&style), style);
        let rows = rows(&scene, &VIEW, &style, (columns, count), 1);
        let width = rows[0].len() / 3;
        let light = |pixel: &[u8]| f64::from(Srgb([pixel[0], pixel[1], pixel[2]]).to_linear().x);
        let sum: f64 = rows.iter().flat_map(|row| row.chunks(3)).map(light).sum();
        let picture = 4.0 * 4.0 * style.picture_aspect(columns, count);
        let area = sum / (rows.len() * width) as f64 * picture;
        assert!((area - PI).abs() < 0.01, "{cell_aspect}: {area}");

        // From the first row, or column, with light to the last, in units of the scene.
        let lit_rows = rows.iter().filter(|row| row.iter().any(|&byte| byte > 0)).count();
        let is_lit = |x: &usize| rows.iter().any(|row| row[3 * x] > 0);
        let lit_columns = (0..width).filter(is_lit).count();
        let a_row = 4.0 / rows.len() as f64;
        let a_column = 4.0 * style.picture_aspect(columns, count) / width as f64;
        assert!((lit_rows as f64 * a_row - 2.0).abs() < 2.1 * a_row, "{cell_aspect}");
        assert!((lit_columns as f64 * a_column - 2.0).abs() < 2.1 * a_column, "{cell_aspect}");
        assert!(lit_columns.abs_diff(lit_rows) <= 2, "{cell_aspect}: {lit_columns} x {lit_rows}");
    }
}

/// More than a strip, and tiles that the right and lower edges cut.
#[test]
fn strips_tiles_and_threads_do_not_show() {
    let scene = builtin("marbles").expect("marbles");
    let style = Style { cell_aspect: 0.75, ..Style::PLAIN };
    let view = scene.first_view(style.picture_aspect(90, 39) as f32);
    let expected = rows(&scene, &view, &style, (90, 39), 1);
    assert!(expected.len() * expected[0].len() / 3 > STRIP as usize);
    for threads in [2, 7] {
        assert!(rows(&scene, &view, &style, (90, 39), threads) == expected, "{threads} threads");
    }
    // Each pixel alone.
    let (grid, threads) = (PixelGrid::new(&view, &style, 90, 39), Threads::default());
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = grid.workload(scene.list().len());
    let search = structures.picture(None, &workload, &view, &scene).expect("memory");
    let level = Level::best();
    let tracing = Tracing { tier: Tier::Exact, level, coherence: search.coherence };
    let traced = Traced { tracing, scene: &scene, search: &search, threads: &threads };
    let mut tracer = Tracer::default();
    for (x, y) in [(0, 0), (31, 15), (32, 16), (719, 428), (100, 370), (359, 200)] {
        let corner = std::iter::once((x * SAMPLES, y * SAMPLES));
        let how = (&traced, None);
        let light = tracer.trace(how, &grid.samples, corner, (1, 1.0 / 16.0), |corner| {
            Places::new(corner, |_| 0, |_| 0)
        });
        let found = &expected[y as usize][3 * x as usize..][..3];
        assert_eq!(found, Srgb::from_linear(light.pixels[0]).0, "at {x}, {y}");
    }
}

const EDGES: Aids = Aids { edges: true, ..Aids::NONE };

/// White discs on black, the larger far behind the smaller; the first has no edge that is dark, since nothing is behind it.
fn discs(count: usize) -> Scene {
    let mut scene = Scene::new();
    for (z, radius) in [(0.0, 0.5), (-20.0, 1.5)].into_iter().take(count) {
        let center = Vec3::new(0.0, 0.0, z);
        scene.push(Sphere { center, radius }, Srgb::WHITE, None);
    }
    scene
}

/// The right and lower edges cut tiles. Light of one strength has the same sum, however it is shared.
#[test]
fn where_nothing_is_darkened_edges_change_nothing() {
    let scene = discs(1);
    let of = |aids| {
        let style = Style { cell_aspect: 0.75, aids, ..Style::PLAIN };
        rows(&scene, &VIEW, &style, (9, 11), 2)
    };
    let plain = of(Aids::NONE);
    assert!(plain.iter().flatten().any(|&byte| byte == 255));
    assert!(of(EDGES) == plain);
}

/// In a strip and a part, one sample a pixel, and in one strip. No sample lies on the border of a disc.
#[test]
fn edges_are_as_symmetric_as_the_scene() {
    let scene = discs(2);
    for (cells, across) in [((80, 40), 1), ((20, 10), SAMPLES)] {
        let of = |aids| {
            let style = Style { aids, ..Style::PLAIN };
            rows_of(&PixelGrid::in_cells(&VIEW, &style, cells, (8, 16), across), &scene, 2)
        };
        let (plain, dark) = (of(Aids::NONE), of(EDGES));
        let mut darkened = 0;
        for ((row, below), plain) in dark.iter().zip(dark.iter().rev()).zip(&plain) {
            for x in (0..row.len()).step_by(3) {
                // Darkness is off by its rounding.
                let mirrored = [row[row.len() - 3 - x], below[x]];
                assert!(mirrored.iter().all(|other| row[x].abs_diff(*other) <= 1), "{cells:?}");
                darkened += u32::from(row[x] < plain[x]);
            }
        }
        assert!(darkened > 1000, "{cells:?}: {darkened}");
    }
}

#[test]
fn an_error_ends_it() {
    let scene = Scene::new();
    let threads = Threads::default();
    let grid = PixelGrid::new(&VIEW, &Style::PLAIN, 4, 4);
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let search = structures.picture(None, &grid.workload(0), &VIEW, &scene);
    let (search, mut taken) = (search.expect("memory"), 0);
    let renderer = Renderer::new(Level::best(), &threads);
    let result = renderer.draw_pixels(&scene, &search, Tier::Exact, &grid, |_| {
        taken += 1;
        if taken == 3 { Err("full") } else { Ok(()) }
    });
    assert_eq!((result, taken), (Err("full"), 3));
}
