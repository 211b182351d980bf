//! A plane of the scene on a canvas: x to the right, y upwards, with lines and circles of characters.

use super::canvas::{Canvas, Role};
use spherule_kernel::{Sphere, Vec3};
use std::f32::consts::TAU;

/// How many places of a line are looked at for every cell that it crosses.
const STEPS_A_CELL: f32 = 6.0;
/// Columns that are as wide as a row is high.
const COLUMNS_A_ROW: f32 = 2.0;

/// A part of a canvas, and the part of the plane that it shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    left: i32,
    top: i32,
    width: i32,
    height: i32,
    middle: [f32; 2],
    /// Rows a unit.
    unit: f32,
}

impl Chart {
    /// Shows all of `x` and `y` in `width` x `height` cells from `(left, top)` on; circles look round.
    pub(super) fn new(
        (left, top): (i32, i32),
        (width, height): (i32, i32),
        x: [f32; 2],
        y: [f32; 2],
    ) -> Self {
        let unit =
            (width as f32 / COLUMNS_A_ROW / (x[1] - x[0])).min(height as f32 / (y[1] - y[0]));
        Self { left, top, width, height, middle: [x, y].map(|[a, b]| (a + b) / 2.0), unit }
    }

    /// Column and row of a point, with their fractions.
    fn place(&self, point: Vec3) -> [f32; 2] {
        let [right, up] = [point.x - self.middle[0], point.y - self.middle[1]];
        let column = self.left as f32 + self.width as f32 / 2.0 + COLUMNS_A_ROW * self.unit * right;
        let row = self.top as f32 + self.height as f32 / 2.0 - self.unit * up;
        [column, row]
    }

    fn put(&self, canvas: &mut Canvas, column: i32, row: i32, glyph: char, role: Role) {
        let across = self.left..self.left + self.width;
        let down = self.top..self.top + self.height;
        if across.contains(&column) && down.contains(&row) {
            canvas.put(column, row, glyph, role);
        }
    }

    /// A chart in all cells to the left of `text` columns of text.
    pub(super) fn beside(canvas: &Canvas, text: i32, x: [f32; 2], y: [f32; 2]) -> Self {
        Self::new((0, 0), (canvas.columns() - text, canvas.rows()), x, y)
    }

    /// A mark at a point, and a name beside it.
    pub(super) fn mark(&self, canvas: &mut Canvas, point: Vec3, text: &str, role: Role) {
        self.mark_beside(canvas, (point, Vec3::ZERO), text, role);
    }

    /// A name a row away from a point, towards `side`, so that it covers nothing there.
    pub(super) fn mark_beside(
        &self,
        canvas: &mut Canvas,
        (point, side): (Vec3, Vec3),
        text: &str,
        role: Role,
    ) {
        let [column, row] = self.place(point).map(|x| x.floor() as i32);
        let side = side.normalize_or_zero();
        let [right, up] = [COLUMNS_A_ROW * side.x, side.y].map(|x| x.round() as i32);
        for (column, glyph) in (column + right..).zip(text.chars()) {
            self.put(canvas, column, row - up, glyph, role);
        }
    }

    /// A line from point to point.
    pub(super) fn line(&self, canvas: &mut Canvas, ends: [Vec3; 2], role: Role) {
        let [a, b] = ends.map(|end| self.place(end));
        self.curve(canvas, role, length(a, b), |share| mix(a, b, share));
    }

    /// A line of dots with gaps, for what is no part of a ray.
    pub(super) fn dots(&self, canvas: &mut Canvas, ends: [Vec3; 2], role: Role) {
        let [a, b] = ends.map(|end| self.place(end));
        let count = (length(a, b) / 2.0).round().clamp(1.0, 1e3) as u16;
        for step in 0..=count {
            let [column, row] = mix(a, b, f32::from(step) / f32::from(count));
            self.put(canvas, column.floor() as i32, row.floor() as i32, '.', role);
        }
    }

    /// The half-line from `origin` on, as far as the chart goes.
    pub(super) fn half_line(&self, canvas: &mut Canvas, origin: Vec3, direction: Vec3, role: Role) {
        self.line(canvas, [origin, origin + self.beyond(origin, direction)], role);
    }

    /// Draws what lies behind `origin`, as dots.
    pub(super) fn behind(&self, canvas: &mut Canvas, origin: Vec3, direction: Vec3) {
        self.dots(canvas, [origin, origin - self.beyond(origin, direction)], Role::Faint);
    }

    /// A vector along `direction` that reaches beyond the chart.
    fn beyond(&self, origin: Vec3, direction: Vec3) -> Vec3 {
        let middle = Vec3::new(self.middle[0], self.middle[1], 0.0);
        let reach = (self.width + self.height) as f32 / self.unit + origin.distance(middle);
        reach * direction.normalize_or_zero()
    }

    /// The circle in which the plane cuts a sphere whose centre lies in it.
    pub(super) fn circle(&self, canvas: &mut Canvas, sphere: &Sphere, role: Role) {
        let at = |share: f32| {
            // The circle starts at a slanting place, so that its ends meet in one cell.
            let (sin, cos) = ((share + 0.125) * TAU).sin_cos();
            self.place(sphere.center + sphere.radius * Vec3::new(cos, sin, 0.0))
        };
        let around = TAU * COLUMNS_A_ROW * self.unit * sphere.radius;
        self.curve(canvas, role, around, at);
    }

    /// Draws what `at` goes through from 0 to 1, some `length` cells long. Where the curve is flat it gets one glyph a
    /// column, else one a row: the glyph of the place nearest to the middle.
    fn curve(&self, canvas: &mut Canvas, role: Role, length: f32, at: impl Fn(f32) -> [f32; 2]) {
        let count = (STEPS_A_CELL * length).round().clamp(1.0, 1e5);
        let place = |step: u32| {
            let [column, row] = at(step as f32 / count);
            let [next_column, next_row] = at((step as f32 + 0.5) / count);
            let glyph = stroke([next_column - column, next_row - row], row - row.floor());
            let along = usize::from(!is_flat(glyph));
            let off = ([column, row][along].fract().abs() - 0.5).abs();
            Place { cell: [column, row].map(|x| x.floor() as i32), along, off, glyph }
        };
        let places: Vec<_> = (0..=count as u32).map(place).collect();
        // The same column, or the same row.
        let line = |place: &Place| (place.along, place.cell[place.along]);
        for same in places.chunk_by(|a, b| line(a) == line(b)) {
            let nearest = same.iter().min_by(|a, b| a.off.total_cmp(&b.off));
            if let Some(&Place { cell: [column, row], glyph, .. }) = nearest {
                self.put(canvas, column, row, glyph, role);
            }
        }
    }
}

/// A place of a line.
struct Place {
    cell: [i32; 2],
    /// 0 if it goes from column to column, 1 if from row to row.
    along: usize,
    /// How far the place is from the middle of its column or its row.
    off: f32,
    glyph: char,
}

/// Whether a line with this glyph goes from column to column.
fn is_flat(glyph: char) -> bool {
    matches!(glyph, '\'' | '-' | '.')
}

/// The character for a line of this direction, in cells, at this share of the cell's height from its top.
fn stroke([right, down]: [f32; 2], height: f32) -> char {
    // What does not move at all is flat: a line from a point to itself.
    if down.abs() <= 0.55 * right.abs() {
        return match height {
            0.0..0.33 => '\'',
            0.33..0.67 => '-',
            _ => '.',
        };
    }
    if right.abs() < 0.4 * down.abs() {
        return '|';
    }
    if (right > 0.0) == (down > 0.0) { '\\' } else { '/' }
}

fn length([a, b]: [f32; 2], [c, d]: [f32; 2]) -> f32 {
    (c - a).abs().max((d - b).abs())
}

fn mix([a, b]: [f32; 2], [c, d]: [f32; 2], share: f32) -> [f32; 2] {
    [a + share * (c - a), b + share * (d - b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Style;

    fn drawn(draw: impl Fn(&Chart, &mut Canvas)) -> Vec<String> {
        let mut canvas = Canvas::new(20, 10, Style::PLAIN);
        draw(&Chart::new((0, 0), (20, 10), [-5.0, 5.0], [-5.0, 5.0]), &mut canvas);
        canvas.into_cells().lines()
    }

    #[test]
    fn lines_go_where_they_should() {
        let diagonal = drawn(|chart, canvas| {
            chart.line(canvas, [Vec3::new(-2.5, -5.0, 0.0), Vec3::new(2.5, 5.0, 0.0)], Role::Ray);
        });
        assert!(diagonal.iter().rev().zip(5..).all(|(row, column)| row.find('/') == Some(column)));
        let level = drawn(|chart, canvas| {
            chart.half_line(canvas, Vec3::new(-2.0, 0.5, 0.0), Vec3::X, Role::Ray);
        });
        assert_eq!(level[4], format!("{}{}", " ".repeat(6), "-".repeat(14)));
        assert!((0..10).all(|row| row == 4 || level[row].trim().is_empty()));
    }

    /// An interval may be a single point.
    #[test]
    fn a_line_from_a_point_to_itself_does_not_slant() {
        for y in [-0.2, 0.0, 0.5] {
            let point = Vec3::new(0.0, y, 0.0);
            let rows = drawn(|chart, canvas| chart.line(canvas, [point; 2], Role::Ray));
            let ink: Vec<char> = rows.concat().chars().filter(|&glyph| glyph != ' ').collect();
            assert!(ink.len() == 1 && is_flat(ink[0]), "{ink:?}");
        }
    }

    #[test]
    fn a_circle_is_round_and_what_lies_beside_is_left_out() {
        let circle = drawn(|chart, canvas| {
            chart.circle(canvas, &Sphere::from([0.0, 0.0, 0.0, 3.0]), Role::Sphere);
            chart.mark(canvas, Vec3::new(4.0, 0.0, 0.0), "far too long", Role::Plain);
            chart.circle(canvas, &Sphere::from([0.0, 0.0, 0.0, 900.0]), Role::Sphere);
        });
        let inked: Vec<_> =
            (0..10).filter(|&row| circle[row].contains(['-', '\'', '.', '|'])).collect();
        assert_eq!((inked.first(), inked.last()), (Some(&2), Some(&7)), "{circle:#?}");
        let ends = |row: &str| (row.find(['|', '/', '\\']), row.rfind(['|', '/', '\\']));
        let (Some(left), Some(right)) = ends(&circle[4]) else { panic!("{circle:#?}") };
        assert!(left == 4 && (15..=16).contains(&right), "{circle:#?}");
    }
}
