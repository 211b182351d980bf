//! Where more samples are asked for, on pictures whose edges are known.

use super::*;
use proptest::prelude::*;

const COLUMNS: usize = 6;
const ROWS: usize = 5;

/// A picture by how the sample at `(x, y)` of the 12 x 10 looks.
fn picture(look: impl Fn(usize, usize) -> Vec3) -> Vec<Vec3> {
    let samples = (0..4 * COLUMNS * ROWS).map(|index| {
        let (cell, sample) = (index / 4, index % 4);
        (cell % COLUMNS * 2 + sample % 2, cell / COLUMNS * 2 + sample / 2)
    });
    samples.map(|(x, y)| look(x, y)).collect()
}

fn need(looks: &[Vec3], column: usize, row: usize) -> f32 {
    Looks { looks, columns: COLUMNS, rows: ROWS }.need(column, row)
}

fn cells() -> impl Iterator<Item = (usize, usize)> {
    (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row)))
}

proptest! {
    #[test]
    fn a_plane_needs_nothing(
        right in (-0.2..0.2_f32, -0.2..0.2_f32, -0.2..0.2_f32),
        down in (-0.2..0.2_f32, -0.2..0.2_f32, -0.2..0.2_f32),
    ) {
        let slope = |(l, a, b): (f32, f32, f32)| Vec3::new(l, a, b);
        let (right, down) = (slope(right), slope(down));
        let looks = picture(|x, y| x as f32 * right + y as f32 * down);
        // At the picture's edges the last samples count twice, and the plane has a bend.
        for (column, row) in cells() {
            if (1..COLUMNS - 1).contains(&column) && (1..ROWS - 1).contains(&row) {
                let need = need(&looks, column, row);
                prop_assert!(need < 1e-5, "{column} {row}: {need}");
            }
        }
    }

    #[test]
    fn an_edge_is_seen_from_both_sides(
        angle in 0.0..std::f32::consts::TAU,
        offset in -3.0..3.0_f32,
        step in (2.5 * ENOUGH)..1.0,
    ) {
        // Left of a line through the picture it is light, right of it dark.
        let (sin, cos) = angle.sin_cos();
        let light = |x: usize, y: usize| (x as f32 - 5.5) * cos + (y as f32 - 4.5) * sin > offset;
        let looks = picture(|x, y| if light(x, y) { Vec3::splat(step) } else { Vec3::ZERO });
        for (column, row) in cells() {
            let xs = (2 * column).saturating_sub(1)..(2 * column + 3).min(2 * COLUMNS);
            let ys = (2 * row).saturating_sub(1)..(2 * row + 3).min(2 * ROWS);
            let count = ys.clone().flat_map(|y| xs.clone().map(move |x| light(x, y)));
            let count = count.filter(|&light| light).count();
            let edge = count > 0 && count < xs.len() * ys.len();
            let need = need(&looks, column, row);
            prop_assert_eq!(need > ENOUGH, edge, "{} {}: {} of a step of {}", column, row, need, step);
        }
    }
}

#[test]
fn a_lone_sample_is_seen_by_every_cell_that_it_touches() {
    // A small sphere, at each of the places in and around the cell in the middle.
    for (at_x, at_y) in (2..8).flat_map(|y| (2..8).map(move |x| (x, y))) {
        for step in [Vec3::X, Vec3::Y, -Vec3::Z] {
            let looks =
                picture(|x, y| if (x, y) == (at_x, at_y) { 0.1 * step } else { Vec3::ZERO });
            for (column, row) in cells() {
                let near = |at: usize, cell: usize| (2 * cell..2 * cell + 4).contains(&(at + 1));
                let need = need(&looks, column, row);
                if near(at_x, column) && near(at_y, row) {
                    assert!(need > ENOUGH, "{at_x} {at_y} from {column} {row}: {need}");
                } else {
                    assert_eq!(need.to_bits(), 0, "{at_x} {at_y} from {column} {row}");
                }
            }
        }
    }
}

#[test]
fn what_hardly_differs_needs_nothing() {
    // The least that is seen, in any one direction, is above what counts as flat.
    let looks =
        picture(|x, y| if (x + y) % 2 == 0 { Vec3::splat(0.9 * ENOUGH) } else { Vec3::ZERO });
    assert!(cells().all(|(column, row)| need(&looks, column, row).to_bits() == 0));
}
