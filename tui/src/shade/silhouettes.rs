//! Dark edges where a surface ends before something far behind it, or before another part of the scene.
//!
//! # Method
//!
//! A few samples in every cell tell how far away everything is. A sample is darkened by samples around it that are nearer to the eye by
//! more than a limit. The limit is how far a surface of touching spheres goes back from one sample to the next: three radii of the smaller
//! sphere (so that neither is as thick), or twice the way from sample to sample, where spheres are smaller than that. From the limit on it
//! gets darker, until twice as far. What belongs to another part, a chain or a molecule, is told apart at every distance. The nearer a
//! sample is to the edge, the darker it gets: the shade lies on what is behind, nearly a cell wide, and the edge itself stays sharp. What
//! no sphere covers has no shade.
//!
//! Nothing here has a length of its own: a scene of another size, or from farther away, has the same edges.

use crate::length::length;
use spherule_kernel::{Camera, Projection, Vec3};

/// How much of the light an edge takes.
const DARKNESS: f32 = 0.25;
/// How wide a shade is, in heights of a cell.
const WIDTH: f32 = 0.85;
/// So much of the width is as dark as the edge.
const CORE: f32 = 0.4;
/// How much farther away is far behind: over the smaller radius, and over the way between samples.
const RADII: f32 = 3.0;
const PITCHES: f32 = 2.0;

/// What a sample shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// How far away it is, along the line of sight; infinite where no sphere is.
    pub depth: f32,
    /// The radius of the sphere.
    pub radius: f32,
    /// The part of the scene that the sphere belongs to.
    pub part: u32,
}

impl Seen {
    /// No sphere.
    pub const NOTHING: Self = Self { depth: f32::INFINITY, radius: 0.0, part: 0 };
}

/// What the few samples of some rows of cells show, cell by cell.
#[derive(Clone, Copy, Debug)]
pub struct SeenGrid<'a> {
    /// The samples of each cell, row by row.
    pub seen: &'a [Seen],
    /// Columns of cells.
    pub columns: usize,
    /// Samples across a cell, and down.
    pub samples: (usize, usize),
    /// Width of a cell over its height.
    pub cell_aspect: f32,
    /// The distance from a sample to the one below: at a depth of one in perspective, everywhere in parallel projection.
    pub pitch: Pitch,
}

/// How far apart samples are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pitch {
    /// The distance over the depth.
    Perspective(f32),
    /// The distance at every depth.
    Parallel(f32),
}

impl Pitch {
    /// The pitch of a camera's samples.
    #[must_use]
    pub fn new(camera: &Camera) -> Self {
        let step = length(camera.step_y);
        match camera.projection {
            Projection::Perspective { .. } => Self::Perspective(step),
            Projection::Parallel { .. } => Self::Parallel(step),
        }
    }

    fn at(self, depth: f32) -> f32 {
        match self {
            Self::Perspective(step) => step * depth,
            Self::Parallel(step) => step,
        }
    }
}

/// How wide a shade is, across and down, in samples of which each cell has so many.
fn widths((across, down): (usize, usize), cell_aspect: f32) -> [f32; 2] {
    [(WIDTH * across as f32 / cell_aspect).max(1.0), (WIDTH * down as f32).max(1.0)]
}

/// How many columns and rows of cells away there may be what darkens a cell.
#[must_use]
pub fn reach(samples: (usize, usize), cell_aspect: f32) -> [usize; 2] {
    let [width_x, width_y] = widths(samples, cell_aspect);
    // Finer samples lie up to half a sample beside these. Casts saturate.
    let cells = |width: f32, samples: usize| {
        (((1.0 + CORE) * width + 0.5) as usize).div_ceil(samples.max(1))
    };
    [cells(width_x, samples.0), cells(width_y, samples.1)]
}

impl SeenGrid<'_> {
    /// Where a sample of a finer grid lies, which has so many samples across a cell, and down. Places are counted in samples of this grid
    /// from the middle of the first.
    #[must_use]
    #[inline]
    pub fn place(&self, (x, y): (u32, u32), (across, down): (u32, u32)) -> (f32, f32) {
        let place = |sample: u32, finer: u32, few: usize| {
            (sample as f32 + 0.5) * few as f32 / finer as f32 - 0.5
        };
        (place(x, across, self.samples.0), place(y, down, self.samples.1))
    }

    /// How dark it is, 0 to 1, at a [place](Self::place) where `seen` is seen.
    #[must_use]
    pub fn darkness(&self, (x, y): (f32, f32), seen: &Seen) -> f32 {
        if !seen.depth.is_finite() {
            return 0.0;
        }
        let (across, down) = self.samples;
        let (width, rows) =
            (self.columns * across, self.seen.len() / (self.columns * across).max(1));
        let [reach_x, reach_y] = widths(self.samples, self.cell_aspect);
        let pitch = PITCHES * self.pitch.at(seen.depth);
        let range = |place: f32, reach: f32, count: usize| {
            let reach = (1.0 + CORE) * reach;
            // Casts saturate.
            let first = (place - reach).ceil().max(0.0) as usize;
            first..((place + reach).floor() + 1.0).max(0.0).min(count as f32) as usize
        };
        let mut darkness = 0.0_f32;
        for row in range(y, reach_y, rows) {
            let away_y = (row as f32 - y) / reach_y;
            let line = row / down * self.columns;
            for column in range(x, reach_x, width) {
                let cell = line + column / across;
                let other = &self.seen[(cell * down + row % down) * across + column % across];
                let behind = seen.depth - other.depth;
                if behind > 0.0 {
                    let far = if other.part == seen.part {
                        let least = pitch.max(RADII * seen.radius.min(other.radius));
                        (behind / least - 1.0).clamp(0.0, 1.0)
                    } else {
                        1.0
                    };
                    let away_x = (column as f32 - x) / reach_x;
                    let away = (away_x * away_x + away_y * away_y).sqrt();
                    darkness = darkness.max(far * (1.0 + CORE - away).clamp(0.0, 1.0));
                }
            }
        }
        darkness
    }
}

/// The light that is seen at an edge so dark; the part `veil` of `light` is not the surface's, and stays.
#[must_use]
#[inline]
pub fn darkened(light: Vec3, veil: Vec3, darkness: f32) -> Vec3 {
    light - DARKNESS * darkness * (light - veil)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two halves of a picture of 8 x 3 cells: what is seen left and right.
    fn grid(left: Seen, right: Seen) -> Vec<Seen> {
        (0..3 * 8 * 4).map(|index| if index / 4 % 8 < 4 { left } else { right }).collect()
    }

    fn darkness_at(left: Seen, right: Seen, scale: f32, x: f32) -> f32 {
        let seen = grid(left, right);
        let grid = SeenGrid {
            seen: &seen,
            columns: 8,
            samples: (2, 2),
            cell_aspect: 0.5,
            pitch: Pitch::Parallel(0.1 * scale),
        };
        grid.darkness((x, 2.0), if x < 7.5 { &left } else { &right })
    }

    fn seen(depth: f32, part: u32) -> Seen {
        Seen { depth, radius: 1.0, part }
    }

    #[test]
    fn finer_samples_lie_beside_those_of_the_grid() {
        let (samples, pitch) = ((2, 4), Pitch::Parallel(1.0));
        let grid = SeenGrid { seen: &[], columns: 1, samples, cell_aspect: 0.5, pitch };
        assert_eq!(grid.place((0, 0), (2, 4)), (0.0, 0.0));
        assert_eq!(grid.place((0, 3), (4, 8)), (-0.25, 1.25));
        assert_eq!(grid.place((7, 8), (4, 8)), (3.25, 3.75));
    }

    #[test]
    fn shades_end_where_they_reach() {
        for (samples, cell_aspect, expected) in [
            ((2, 2), 0.5, [3, 1]),
            ((2, 2), 0.05, [24, 1]),
            ((3, 6), 0.5, [3, 2]),
            ((1, 1), 2.0, [1, 1]),
            ((2, 2), 0.0, [usize::MAX / 2 + 1, 1]),
        ] {
            assert_eq!(reach(samples, cell_aspect), expected, "{samples:?} {cell_aspect}");
        }
    }

    #[test]
    fn what_is_far_behind_is_dark_beside_the_edge_and_what_is_before_it_is_not() {
        for scale in [1e-12, 1.0, 1e12] {
            let at = |depth: f32| Seen { depth: scale * depth, radius: scale, part: 0 };
            let dark = |x| darkness_at(at(10.0), at(20.0), scale, x);
            assert_eq!([0.0, 4.0, 7.0].map(dark), [0.0; 3]);
            let beside = [8.0, 9.0, 10.0, 11.0, 12.0, 14.0].map(dark);
            assert!(beside[0] > 0.9 && beside.is_sorted_by(|a, b| a >= b), "{beside:?}");
            assert_eq!(beside[5], 0.0);
            // Between samples it is between.
            assert!(dark(8.5) < beside[0] && dark(8.5) > beside[1]);
        }
    }

    #[test]
    fn touching_spheres_have_no_edge_unless_they_are_of_two_parts() {
        assert_eq!(darkness_at(seen(10.0, 0), seen(13.0, 0), 1.0, 8.0), 0.0);
        assert!(darkness_at(seen(10.0, 0), seen(13.0, 1), 1.0, 8.0) > 0.9);
        assert_eq!(darkness_at(seen(10.0, 0), seen(13.0, 1), 1.0, 7.0), 0.0);
        // The smaller sphere counts: a ball before a ground.
        let ground = Seen { depth: 20.0, radius: 1000.0, part: 0 };
        assert!(darkness_at(seen(10.0, 0), ground, 1.0, 8.0) > 0.9);
    }

    #[test]
    fn of_spheres_smaller_than_the_way_between_samples_a_slope_is_no_edge() {
        let tiny = |depth| Seen { depth, radius: 1e-3, part: 0 };
        assert_eq!(darkness_at(tiny(10.0), tiny(10.2), 1.0, 8.0), 0.0);
        assert!(darkness_at(tiny(10.0), tiny(10.4), 1.0, 8.0) > 0.9);
    }

    #[test]
    fn nothing_and_what_is_no_number_have_no_shade() {
        assert_eq!(darkness_at(seen(10.0, 0), Seen::NOTHING, 1.0, 8.0), 0.0);
        assert_eq!(darkness_at(Seen::NOTHING, seen(10.0, 0), 1.0, 8.0), 0.0);
        assert_eq!(darkness_at(seen(f32::NAN, 0), seen(10.0, 0), 1.0, 8.0), 0.0);
        assert_eq!(darkness_at(seen(10.0, 0), seen(f32::NAN, 0), 1.0, 8.0), 0.0);
        let empty = SeenGrid {
            seen: &[],
            columns: 0,
            samples: (2, 2),
            cell_aspect: 0.5,
            pitch: Pitch::Perspective(1.0),
        };
        assert_eq!(empty.darkness((0.0, 0.0), &seen(1.0, 0)), 0.0);
    }

    #[test]
    fn an_edge_takes_light_from_the_surface_and_leaves_the_veil() {
        let (light, veil) = (Vec3::splat(0.5), Vec3::splat(0.2));
        assert_eq!(darkened(light, veil, 0.0), light);
        assert!((darkened(light, veil, 1.0) - Vec3::splat(0.425)).abs().max_element() < 1e-6);
    }
}
