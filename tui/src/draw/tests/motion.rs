//! What moves keeps its glyphs, and begins with what was there.

use super::*;
use crate::view::orbited;

const HALVES: Style = Style { charset: Charset::Half, depth: ColorDepth::Ansi256, ..STYLE };
const LETTERS: Style = Style::PLAIN;

fn glyphs_that_differ(then: &[Cell], now: &[Cell]) -> usize {
    then.iter().zip(now).filter(|(then, now)| then.glyph != now.glyph).count()
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
            let mut cells = Vec::new();
            for &(from, to) in parts {
                let (scene, part) = ((scene, search), from..to);
                let drawn = renderer.draw_columns(scene, &view, style, SIZE, part, MOVING);
                cells.extend_from_slice(drawn.cells.cells());
            }
            if let Some(last) = last.replace(cells.clone()) {
                changes += glyphs_that_differ(&last, &cells);
            }
        }
        changes
    })
}

#[test]
fn what_moves_keeps_its_glyphs() {
    for (style, most) in [(STYLE, 0.9), (LETTERS, 0.6)] {
        for parts in [&[(0, 60)][..], &[(0, 29), (30, 60)]] {
            let [kept, anew] = [true, false].map(|keeps| changes_of_glyphs(&style, parts, keeps));
            let is_calm = (kept as f64) < most * anew as f64;
            assert!(kept > 0 && is_calm, "{style:?} {parts:?}: {kept} changes, {anew} anew");
        }
    }
}

/// A picture at rest, and the same by the same renderer as a movement begins.
fn at_rest_and_begun(style: &Style) -> [CellGrid; 2] {
    marbles(style, 1, STRIP, |renderer, scene, search, view| {
        [Spending::ByNeed, MOVING]
            .map(|spending| renderer.draw(scene, search, view, style, SIZE, spending).cells)
    })
}

#[test]
fn a_movement_begins_with_what_was_there_at_rest() {
    for (style, most) in [(HALVES, 0.8), (LETTERS, 0.6)] {
        let [at_rest, begun] = at_rest_and_begun(&style);
        let changes = |cells: &CellGrid| {
            let pairs = at_rest.cells().iter().zip(cells.cells());
            pairs.filter(|(then, now)| then != now).count()
        };
        let [begun, anew] = [&begun, &drawn(&style, MOVING).cells].map(changes);
        assert!((begun as f64) < most * anew as f64, "{style:?}: {begun} changes, {anew} anew");
    }
}

/// For a picture at rest no error of change is known: without `change::at_rest` 10 and 15 of these glyphs change, with it 3 and 2.
#[test]
fn when_a_movement_begins_glyphs_stay() {
    for charset in [Charset::Block, Charset::Sextant] {
        let [at_rest, begun] = at_rest_and_begun(&Style { charset, ..STYLE });
        let changes = glyphs_that_differ(at_rest.cells(), begun.cells());
        assert!(changes <= 5, "{charset:?}: {changes}");
    }
}

#[test]
fn of_another_picture_nothing_is_kept() {
    let expected = drawn(&STYLE, MOVING).cells;
    let sextants = Style { charset: Charset::Sextant, ..STYLE };
    for (style, size) in [(&sextants, SIZE), (&STYLE, (59, 21)), (&STYLE, (60, 22))] {
        let found = marbles(&STYLE, 1, STRIP, |renderer, scene, search, view| {
            let _ = renderer.draw(scene, search, view, style, size, MOVING);
            renderer.draw(scene, search, view, &STYLE, SIZE, MOVING).cells
        });
        assert!(found == expected, "{size:?}");
    }
    // What stays does not depend on what was there at all.
    let expected = drawn(&STYLE, Spending::ByNeed).cells;
    let found = marbles(&STYLE, 1, STRIP, |renderer, scene, search, view| {
        let other = orbited(view, 0.3, 0.1);
        let _ = renderer.draw(scene, search, &other, &STYLE, SIZE, MOVING);
        renderer.draw(scene, search, view, &STYLE, SIZE, Spending::ByNeed).cells
    });
    assert!(found == expected);
}

#[test]
fn a_picture_that_no_one_waits_for_leaves_nothing_to_the_next() {
    for threads in [1, 2] {
        let expected = drawn_by(threads, STRIP, &STYLE, MOVING).cells;
        let found = marbles(&STYLE, threads, STRIP, |renderer, scene, search, view| {
            let aside = orbited(view, 0.007, 0.0);
            let _ = renderer.draw(scene, search, &aside, &STYLE, SIZE, MOVING);
            renderer.threads.stop();
            let stopped = renderer.draw(scene, search, view, &STYLE, SIZE, MOVING);
            assert_eq!(stopped.effort.samples, 0);
            renderer.threads.go_on();
            renderer.draw(scene, search, view, &STYLE, SIZE, MOVING).cells
        });
        assert!(found == expected, "{threads} threads");
    }
}

#[test]
fn what_moves_is_not_mixed_of_256_colours() {
    let steady = drawn(&HALVES, Spending::ByNeed);
    let moving = drawn(&HALVES, MOVING);
    assert!(steady.effort.is_full && !moving.effort.is_full);
    assert!(moving.effort.samples >= steady.effort.samples);
    let changes = |drawn: &Drawn| {
        let pairs = drawn.cells.cells().windows(2);
        pairs.filter(|pair| pair[0].background != pair[1].background).count()
    };
    let (mixed, plain) = (changes(&steady), changes(&moving));
    assert!(plain * 4 < mixed * 3, "{plain} changes of colour in place of {mixed}");
}
