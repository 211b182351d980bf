//! What a budget, threads, strips and parts may change of a picture: nothing.

mod motion;

use super::*;
use crate::cells::Cell;
use crate::scene::builtin::builtin;
use crate::structure::scene::SceneStructures;
use crate::style::{Aids, Charset, ColorDepth};
use clap::ValueEnum;
use std::convert::Infallible;

const SIZE: (u16, u16) = (60, 21);

/// Marbles in blocks and truecolor, where cells need the most.
const STYLE: Style =
    Style { charset: Charset::Block, depth: ColorDepth::Truecolor, ..Style::PLAIN };

/// What moves, with all the time that it may take.
const MOVING: Spending = Spending::AtMost(u64::MAX);

/// What `draw` makes of marbles by so many threads, in strips of no more than so many cells.
fn marbles<T>(
    style: &Style,
    threads: u16,
    most_cells: usize,
    draw: impl FnOnce(&mut Renderer<'_>, &Scene, &PictureSearch<'_>, &View) -> T,
) -> T {
    let scene = builtin("marbles").expect("marbles");
    let threads = Threads::new(Some(threads)).expect("threads");
    let view = scene.first_view(style.picture_aspect(SIZE.0, SIZE.1) as f32);
    let mut structures = SceneStructures::new(scene.list(), &threads);
    let workload = picture_workload(scene.list().len(), style, SIZE.0, SIZE.1, 1.0);
    let search = structures.picture(None, &workload, &view, &scene).expect("memory");
    let mut renderer = Renderer { most_cells, ..Renderer::new(Level::best(), &threads) };
    draw(&mut renderer, &scene, &search, &view)
}

/// Marbles drawn by one thread, in strips of the usual size.
fn drawn(style: &Style, spending: Spending) -> Drawn {
    drawn_by(1, STRIP, style, spending)
}

fn drawn_by(threads: u16, most_cells: usize, style: &Style, spending: Spending) -> Drawn {
    marbles(style, threads, most_cells, |renderer, scene, search, view| {
        renderer.draw(scene, search, view, style, SIZE, spending)
    })
}

#[test]
fn a_budget_that_suffices_is_not_seen() {
    for charset in Charset::value_variants() {
        let style = Style { charset: *charset, ..STYLE };
        let steady = drawn(&style, Spending::ByNeed);
        assert!(steady.effort.is_full);
        let most = steady.effort.samples;
        assert!(most > 4 * 60 * 21, "nothing is in need");
        // What moves takes as many samples or finer grids, and is for another eye.
        let expected = drawn(&style, MOVING);
        assert!(!expected.effort.is_full && expected.effort.samples >= most, "{charset:?}");
        let most = expected.effort.samples;
        let found = drawn(&style, Spending::AtMost(most));
        assert_eq!(found.effort, expected.effort, "{charset:?}");
        assert!(found.cells == expected.cells, "{charset:?}");
        let less = drawn(&style, Spending::AtMost(most - 1));
        assert!(!less.effort.is_full && less.effort.samples < most, "{charset:?}");
        assert!(less.cells != expected.cells, "{charset:?}");
    }
}

#[test]
fn a_budget_is_kept_to_whatever_it_is() {
    let few = 4 * 60 * 21;
    let need = drawn(&STYLE, Spending::ByNeed).effort.samples;
    let mut spent = Vec::new();
    for budget in (0..need).step_by(997) {
        let effort = drawn(&STYLE, Spending::AtMost(budget)).effort;
        assert!(effort.samples <= budget.max(few), "{effort:?} of {budget}");
        assert!(!effort.is_full && effort.rays > effort.samples, "{effort:?} of {budget}");
        spent.push(effort.samples);
    }
    // From nothing but the few to nearly all, by some steps.
    assert_eq!(spent.first(), Some(&few));
    spent.dedup();
    assert!(spent.len() > 5, "{spent:?}");
}

#[test]
fn threads_do_not_show_whatever_the_budget() {
    for spending in [0, 6000, 9000, 12_000, 20_000].map(Spending::AtMost) {
        let expected = drawn(&STYLE, spending);
        for threads in [2, 7] {
            let found = drawn_by(threads, STRIP, &STYLE, spending);
            assert_eq!(found.effort, expected.effort, "{spending:?}, {threads} threads");
            assert!(found.cells == expected.cells, "{spending:?}, {threads} threads");
        }
    }
}

#[test]
fn strips_do_not_show() {
    for depth in [ColorDepth::Truecolor, ColorDepth::Ansi256, ColorDepth::Ansi16, ColorDepth::Never]
    {
        let style = Style { depth, ..STYLE };
        let expected = drawn(&style, Spending::ByNeed).cells;
        // Strips of a row, of rows that bands do not divide, of less than a row, and one that ends with the picture.
        for (most_cells, height) in [(60, 1), (7 * 60 + 59, 7), (59, 1), (5 * 60, 5), (3 * 60, 3)] {
            let found = drawn_by(1, most_cells, &style, Spending::ByNeed).cells;
            assert!(found == expected, "{height}");
            let mut cells: Vec<Cell> = Vec::new();
            let mut heights = Vec::new();
            let Ok(()) = marbles(&style, 2, most_cells, |renderer, scene, search, view| {
                renderer.draw_strips(scene, search, view, &style, SIZE, |strip| {
                    heights.push(strip.rows());
                    cells.extend_from_slice(strip.cells());
                    Ok::<(), Infallible>(())
                })
            });
            assert_eq!((heights[0], heights.iter().sum()), (height, 21_u16));
            assert!(cells == expected.cells(), "{height} rows, {depth:?}");
        }
    }
}

/// With edges, cells depend on rows and columns that are farther away.
const EDGES: Style = Style { aids: Aids { edges: true, ..Aids::NONE }, ..STYLE };

#[test]
fn strips_with_edges_do_not_show() {
    for samples in [None, Some(16)] {
        let style = Style { samples, ..EDGES };
        let expected = drawn(&style, Spending::ByNeed).cells;
        for rows in [1, 7] {
            let found = drawn_by(1, rows * 60, &style, Spending::ByNeed).cells;
            assert!(found == expected, "{samples:?}, {rows} rows");
        }
    }
}

/// Asserts that the columns on both sides of each seam are those of the whole picture.
fn assert_parts_are_the_whole(style: &Style, size: (u16, u16), seams: &[u16]) {
    marbles(style, 1, STRIP, |renderer, scene, search, view| {
        let whole = renderer.draw(scene, search, view, style, size, Spending::ByNeed).cells;
        for part in seams.iter().flat_map(|&seam| [0..seam, seam..size.0]) {
            let columns = usize::from(part.start)..usize::from(part.end);
            let (scene, spending) = ((scene, search), Spending::ByNeed);
            let found = renderer.draw_columns(scene, view, style, size, part, spending).cells;
            let is_same = |row| found.row(row) == &whole.row(row)[columns.clone()];
            assert!((0..size.1).all(is_same), "{style:?}, columns {columns:?}");
        }
    });
}

#[test]
fn parts_are_the_whole_with_edges_in_cells_of_every_shape() {
    for cell_aspect in [0.5, 0.2, 0.05] {
        assert_parts_are_the_whole(&Style { cell_aspect, ..EDGES }, SIZE, &[12, 24, 40, 50]);
    }
}

/// Many samples are few cells at a time, and a wide row is traced in parts.
#[test]
fn many_samples_are_drawn_a_part_at_a_time() {
    let threads = Threads::default();
    let renderer = Renderer::new(Level::best(), &threads);
    for (columns, samples, rows) in [
        (4096, 1, 32),
        (4096, 4, 32),
        (4096, 64, 32),
        (4096, 256, 8),
        (200, 256, 163),
        (1, 4, 65_535),
    ] {
        assert_eq!(renderer.strip_rows(columns, samples), rows, "{columns} columns, {samples}");
    }
    assert_parts_are_the_whole(&Style { samples: Some(256), ..STYLE }, (90, 8), &[45]);
}

#[test]
fn strips_share_a_budget() {
    let whole = drawn(&STYLE, Spending::AtMost(12_000)).effort;
    let strips = drawn_by(1, 7 * 60, &STYLE, Spending::AtMost(12_000)).effort;
    assert!(!whole.is_full && !strips.is_full);
    assert!(strips.samples <= 12_000 && strips.samples > whole.samples / 2, "{strips:?}");
}

#[test]
fn an_error_ends_it() {
    let mut taken = 0;
    let result = marbles(&STYLE, 1, 5 * 60, |renderer, scene, search, view| {
        renderer.draw_strips(scene, search, view, &STYLE, SIZE, |_| {
            taken += 1;
            if taken == 3 { Err("full") } else { Ok(()) }
        })
    });
    assert_eq!((result, taken), (Err("full"), 3));
}
