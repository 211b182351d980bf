//! The wedges against the names of the characters, which say where their edges run.

use super::*;

/// Points of a bin, side by side.
const POINTS: usize = 16;

/// A place on the border, in halves of the width and sixths of the height.
fn place(name: &str) -> [f32; 2] {
    let x = match name.rsplit(' ').next() {
        Some("LEFT") => 0.0,
        Some("CENTRE") => 1.0,
        Some("RIGHT") => 2.0,
        other => panic!("no column: {other:?} of {name}"),
    };
    let y = match name {
        _ if name.starts_with("UPPER MIDDLE") => 2.0,
        _ if name.starts_with("LOWER MIDDLE") => 4.0,
        _ if name.starts_with("UPPER") => 0.0,
        _ if name.starts_with("LOWER") => 6.0,
        _ => panic!("no row: {name}"),
    };
    [x, y]
}

/// Whether a wedge of this name fills a place.
fn fills(name: &str, [x, y]: [f32; 2]) -> bool {
    if let Some(side) = name.strip_suffix(" TRIANGULAR ONE QUARTER BLOCK") {
        // Nearer to that side than to the others, as shares of the cell.
        let distances = [
            ("LEFT", x / 2.0),
            ("RIGHT", 1.0 - x / 2.0),
            ("UPPER", y / 6.0),
            ("LOWER", 1.0 - y / 6.0),
        ];
        let nearest = distances.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        return nearest.is_some_and(|(nearest, _)| nearest == side);
    }
    let (corner, edge) = name.split_once(" BLOCK DIAGONAL ").expect("a diagonal");
    let (from, to) = edge.split_once(" TO ").expect("two places");
    let ([x0, y0], [x1, y1]) = (place(from), place(to));
    let side = |[x, y]: [f32; 2]| (x - x0) * (y1 - y0) > (y - y0) * (x1 - x0);
    side([x, y]) == side(place(corner))
}

#[test]
fn every_wedge_is_what_its_name_says() {
    let names = include_str!("../masks/names.txt").lines();
    let names: Vec<(&str, &str)> = names.filter_map(|line| line.split_once(';')).collect();
    assert_eq!(WEDGES.len(), 26);
    for wedge in &*WEDGES {
        let code = format!("{:04X}", u32::from(wedge.glyph));
        let (_, name) = names.iter().find(|(known, _)| *known == code).expect("a name");
        for (bin, share) in wedge.bins.iter().enumerate() {
            let filled = (0..POINTS * POINTS).filter(|point| {
                let x = (bin % ACROSS) as f32 + ((point % POINTS) as f32 + 0.5) / POINTS as f32;
                let y = (bin / ACROSS) as f32 + ((point / POINTS) as f32 + 0.5) / POINTS as f32;
                fills(name, [x / 4.0, 0.75 * y])
            });
            let expected = filled.count() as f32 / (POINTS * POINTS) as f32;
            assert!((share - expected).abs() < 0.06, "{name}, bin {bin}: {share}, {expected}");
        }
    }
}

#[test]
fn parts_and_shapes_are_of_the_same_bins() {
    for wedge in &*WEDGES {
        let mean = wedge.bins.iter().sum::<f32>() / BINS as f32;
        assert!((wedge.cover.iter().sum::<f32>() / 8.0 - mean).abs() < 1e-5);
        assert!((wedge.mean - mean).abs() < 1e-6);
        let covered: f32 = wedge.lines.iter().map(|(_, line)| line.reduce_add()).sum();
        assert!((covered / BINS as f32 - mean).abs() < 1e-5);
        let energy: f32 = wedge.bins.iter().map(|share| (share - mean).powi(2)).sum();
        assert!((energy - wedge.energy).abs() < 1e-4 && energy > 1.0);
    }
}
