use super::*;
use crate::cells::Cell;
use crate::scene::builtin::builtin;
use crate::structure::scene::SceneStructures;
use crate::style::{Aids, Charset, ColorDepth};
use crate::view::orbited;
use clap::ValueEnum;
use std::convert::Infallible;

const SIZE: (u16, u16) = (60, 21);

/// Marbles in blocks and truecolor, where cells need the most.
const STYLE: Style =
    Style { charset: Charset::Block, depth: ColorDepth::Truecolor, ..Style::PLAIN };

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

fn drawn(style: &Style, threads: u16, most_cells: usize, spending: Spending) -> Drawn {
    marbles(style, threads, most_cells, |renderer, scene, search, view| {
        renderer.draw(scene, search, view, style, SIZE, spending)
    })
}

#[test]
fn a_budget_that_suffices_is_not_seen() {
    for charset in Charset::value_variants() {
        let style = Style { charset: *charset, ..STYLE };
        let steady = drawn(&style, 1, STRIP, Spending::ByNeed);
        assert!(steady.effort.is_full);
        let most = steady.effort.samples;
        assert!(most > 4 * 60 * 21, "nothing is in need");
        // What moves takes as many samples or finer grids, and is for another eye.
        let expected = drawn(&style, 1, STRIP, Spending::AtMost(u64::MAX));
        assert!(!expected.effort.is_full && expected.effort.samples >= most, "{charset:?}");
        let most = expected.effort.samples;
        let found = drawn(&style, 1, STRIP, Spending::AtMost(most));
        assert_eq!(found.effort, expected.effort, "{charset:?}");
        assert!(found.cells == expected.cells, "{charset:?}");
        let less = drawn(&style, 1, STRIP, Spending::AtMost(most - 1));
        assert!(!less.effort.is_full && less.effort.samples < most, "{charset:?}");
        assert!(less.cells != expected.cells, "{charset:?}");
    }
}

/// Counts glyphs that differ from the picture before, in pictures of marbles, each from a little farther to the right, and drawn part
/// by part.
fn changes_of_glyphs(style: &Style, parts: &[(u16, u16)], keeps: bool) -> usize {
    marbles(style, 1, STRIP, |renderer, scene, search, view| {
        let mut changes = 0;
        let mut last: Option<Vec<Cell>> = None;
        for step in 0..6_u8 {
            let view = orbited(view, f32::from(step) * 0.007, 0.0);
            if !keeps {
                renderer.strip = Strip::default();
            }
            let spending = Spending::AtMost(u64::MAX);
            let mut cells = Vec::new();
            for &(from, to) in parts {
                let (scene, part) = ((scene, search), from..to);
                let drawn = renderer.draw_columns(scene, &view, style, SIZE, part, spending);
                cells.extend_from_slice(drawn.cells.cells());
            }
            if let Some(last) = last.replace(cells.clone()) {
                let pairs = last.iter().zip(&cells);
                changes += pairs.filter(|(last, cell)| last.glyph != cell.glyph).count();
            }
        }
        changes
    })
}

#[test]
fn what_moves_keeps_its_glyphs() {
    let letters = Style { charset: Charset::Ascii, depth: ColorDepth::Never, ..STYLE };
    for (style, most) in [(STYLE, 0.9), (letters, 0.6)] {
        for parts in [&[(0, 60)][..], &[(0, 29), (30, 60)]] {
            let [kept, anew] = [true, false].map(|keeps| changes_of_glyphs(&style, parts, keeps));
            let is_calm = (kept as f64) < most * anew as f64;
            assert!(kept > 0 && is_calm, "{style:?} {parts:?}: {kept} changes, {anew} anew");
        }
    }
}

#[test]
fn a_movement_begins_with_what_was_there_at_rest() {
    let of_256 = Style { charset: Charset::Half, depth: ColorDepth::Ansi256, ..STYLE };
    let letters = Style { charset: Charset::Ascii, depth: ColorDepth::Never, ..STYLE };
    for (style, most) in [(of_256, 0.8), (letters, 0.6)] {
        let moving = Spending::AtMost(u64::MAX);
        let [at_rest, anew] =
            [Spending::ByNeed, moving].map(|spending| drawn(&style, 1, STRIP, spending).cells);
        let begun = marbles(&style, 1, STRIP, |renderer, scene, search, view| {
            let _ = renderer.draw(scene, search, view, &style, SIZE, Spending::ByNeed);
            renderer.draw(scene, search, view, &style, SIZE, moving).cells
        });
        let changes = |cells: &CellGrid| {
            let pairs = at_rest.cells().iter().zip(cells.cells());
            pairs.filter(|(then, now)| then != now).count()
        };
        let [begun, anew] = [&begun, &anew].map(changes);
        assert!((begun as f64) < most * anew as f64, "{style:?}: {begun} changes, {anew} anew");
    }
}

/// For a picture at rest no error of change is known: without `change::at_rest` 10 and 15 of these glyphs change, with it 3 and 2.
#[test]
fn when_a_movement_begins_glyphs_stay() {
    for charset in [Charset::Block, Charset::Sextant] {
        let style = Style { charset, depth: ColorDepth::Truecolor, ..STYLE };
        let [at_rest, begun] = marbles(&style, 1, STRIP, |renderer, scene, search, view| {
            [Spending::ByNeed, Spending::AtMost(u64::MAX)]
                .map(|spending| renderer.draw(scene, search, view, &style, SIZE, spending).cells)
        });
        let pairs = at_rest.cells().iter().zip(begun.cells());
        let changes = pairs.filter(|(then, now)| then.glyph != now.glyph).count();
        assert!(changes <= 5, "{charset:?}: {changes}");
    }
}

#[test]
fn of_another_picture_nothing_is_kept() {
    let moving = Spending::AtMost(u64::MAX);
    let expected = drawn(&STYLE, 1, STRIP, moving).cells;
    let sextants = Style { charset: Charset::Sextant, ..STYLE };
    for (style, (columns, rows), spending) in
        [(&sextants, SIZE, moving), (&STYLE, (59, 21), moving), (&STYLE, (60, 22), moving)]
    {
        let found = marbles(&STYLE, 1, STRIP, |renderer, scene, search, view| {
            let _ = renderer.draw(scene, search, view, style, (columns, rows), spending);
            renderer.draw(scene, search, view, &STYLE, SIZE, moving).cells
        });
        assert!(found == expected, "{columns}x{rows}");
    }
    // What stays does not depend on what was there at all.
    let expected = drawn(&STYLE, 1, STRIP, Spending::ByNeed).cells;
    let found = marbles(&STYLE, 1, STRIP, |renderer, scene, search, view| {
        let other = orbited(view, 0.3, 0.1);
        let _ = renderer.draw(scene, search, &other, &STYLE, SIZE, moving);
        renderer.draw(scene, search, view, &STYLE, SIZE, Spending::ByNeed).cells
    });
    assert!(found == expected);
}

#[test]
fn a_budget_is_kept_to_whatever_it_is() {
    let few = 4 * 60 * 21;
    let need = drawn(&STYLE, 1, STRIP, Spending::ByNeed).effort.samples;
    let mut spent = Vec::new();
    for budget in (0..need).step_by(997) {
        let effort = drawn(&STYLE, 1, STRIP, Spending::AtMost(budget)).effort;
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
        let expected = drawn(&STYLE, 1, STRIP, spending);
        for threads in [2, 7] {
            let found = drawn(&STYLE, threads, STRIP, spending);
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
        let expected = drawn(&style, 1, STRIP, Spending::ByNeed).cells;
        // Strips of a row, of rows that bands do not divide, of less than a row, and one that ends with the picture.
        for (most_cells, height) in [(60, 1), (7 * 60 + 59, 7), (59, 1), (5 * 60, 5), (3 * 60, 3)] {
            assert!(drawn(&style, 1, most_cells, Spending::ByNeed).cells == expected, "{height}");
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
        let expected = drawn(&style, 1, STRIP, Spending::ByNeed).cells;
        for rows in [1, 7] {
            let found = drawn(&style, 1, rows * 60, Spending::ByNeed).cells;
            assert!(found == expected, "{samples:?}, {rows} rows");
        }
    }
}

#[test]
fn parts_are_the_whole_with_edges_in_cells_of_every_shape() {
    for cell_aspect in [0.5, 0.2, 0.05] {
        let style = Style { cell_aspect, ..EDGES };
        marbles(&style, 1, STRIP, |renderer, scene, search, view| {
            let whole = renderer.draw(scene, search, view, &style, SIZE, Spending::ByNeed).cells;
            for seam in [12_u16, 24, 40, 50] {
                for part in [0..seam, seam..60] {
                    let columns = usize::from(part.start)..usize::from(part.end);
                    let (scene, spending) = ((scene, search), Spending::ByNeed);
                    let found = renderer.draw_columns(scene, view, &style, SIZE, part, spending);
                    let is_same = |row| found.cells.row(row) == &whole.row(row)[columns.clone()];
                    assert!((0..SIZE.1).all(is_same), "{cell_aspect}, columns {columns:?}");
                }
            }
        });
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
    let style = Style { samples: Some(256), ..STYLE };
    let size = (90, 8);
    marbles(&style, 1, STRIP, |renderer, scene, search, view| {
        let whole = renderer.draw(scene, search, view, &style, size, Spending::ByNeed).cells;
        for part in [0..45, 45..90_u16] {
            let columns = usize::from(part.start)..usize::from(part.end);
            let (scene, spending) = ((scene, search), Spending::ByNeed);
            let found = renderer.draw_columns(scene, view, &style, size, part, spending).cells;
            let is_same = |row| found.row(row) == &whole.row(row)[columns.clone()];
            assert!((0..size.1).all(is_same), "{columns:?}");
        }
    });
}

#[test]
fn a_picture_that_no_one_waits_for_leaves_nothing_to_the_next() {
    let moving = Spending::AtMost(u64::MAX);
    for threads in [1, 2] {
        let expected = drawn(&STYLE, threads, STRIP, moving).cells;
        let found = marbles(&STYLE, threads, STRIP, |renderer, scene, search, view| {
            let aside = orbited(view, 0.007, 0.0);
            let _ = renderer.draw(scene, search, &aside, &STYLE, SIZE, moving);
            renderer.threads.stop();
            let stopped = renderer.draw(scene, search, view, &STYLE, SIZE, moving);
            assert_eq!(stopped.effort.samples, 0);
            renderer.threads.go_on();
            renderer.draw(scene, search, view, &STYLE, SIZE, moving).cells
        });
        assert!(found == expected, "{threads} threads");
    }
}

#[test]
fn strips_share_a_budget() {
    let whole = drawn(&STYLE, 1, STRIP, Spending::AtMost(12_000)).effort;
    let strips = drawn(&STYLE, 1, 7 * 60, Spending::AtMost(12_000)).effort;
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

#[test]
fn what_moves_is_not_mixed_of_256_colours() {
    let style = Style { charset: Charset::Half, depth: ColorDepth::Ansi256, ..STYLE };
    let steady = drawn(&style, 1, STRIP, Spending::ByNeed);
    let moving = drawn(&style, 1, STRIP, Spending::AtMost(u64::MAX));
    assert!(steady.effort.is_full && !moving.effort.is_full);
    assert!(moving.effort.samples >= steady.effort.samples);
    let changes = |drawn: &Drawn| {
        let pairs = drawn.cells.cells().windows(2);
        pairs.filter(|pair| pair[0].background != pair[1].background).count()
    };
    let (mixed, plain) = (changes(&steady), changes(&moving));
    assert!(plain * 4 < mixed * 3, "{plain} changes of colour in place of {mixed}");
}
