//! Every constant of a bound: where it stands, what its proof needs, and which other values are refused.
//!
//! A row reads the constant from the source. So a change of a constant, even of its last bit, fails here, and so does a formula that needs
//! more. The table of `docs/proofs.md` is this one.

use super::derived::tiers::{fast_row, geometric_row};
use super::derived::{U, boxes, estimate, filter, frustum, leaves, range_limits};
use crate::accuracy::TierFormula;
use crate::accuracy::constants::Constants;
use crate::accuracy::range_limits::{MARGIN as LIMIT, RAISE};
use crate::bvh::build::bounds::PAD;
use crate::bvh::traverse::prepared_ray::{ABSOLUTE_ERROR, PADS};
use crate::bvh::traverse::root_interval::{BORDER, DELTA, SLACK};
use crate::coherent::frustum::{BORDER as BORDER_AT_PLANES, LARGER, MARGIN, TURN};
use crate::coherent::tile_fit::{ERRORS, SMALL};
use crate::coherent::view::DEPTH_MARGIN;
use crate::filter::KAPPA;
use crate::geometry::camera::tiles::POINT_ERROR;
use crate::scale::rays::NEAR;
use crate::scale::scene::{LARGEST, RANGE, SMALLEST};
use crate::{Fast, Geometric};
use std::fs::read_to_string;
use std::path::Path;
use std::string::String;
use std::vec::Vec;
use std::{format, println};

/// A constant and its proof.
struct Row {
    bound: &'static str,
    /// A file of the kernel's source, and the beginning of the line that has the constant.
    source: [&'static str; 2],
    constant: f64,
    /// The unit that it is counted in.
    unit: (&'static str, f64),
    /// In that unit, the constant and the least that the proof holds with.
    published: [f64; 2],
    /// The parts of it that are refused.
    refused: &'static [f64],
    /// Whether the proof holds with a number in place of the constant.
    holds: fn(f64) -> bool,
}

const IN_U: (&str, f64) = ("u", U);
/// u of double precision.
const V: f64 = f64::EPSILON / 2.0;
const IN_V: (&str, f64) = ("v", V);
const AS_IT_IS: (&str, f64) = ("", 1.0);
const HALF: &[f64] = &[0.5];
const ESTIMATE: &str = "accuracy/constants.rs";
const LEAF: &str = "bvh/traverse/root_interval.rs";
const FRUSTUM: &str = "coherent/frustum.rs";
const PROVEN: Constants = Constants::PROVEN;

/// What a t may be at most, and what f is at most where it is zero as computed; with a direction of length 2 √3 at most.
const FARTHEST: f64 = (1_u128 << 127) as f64 * 2.0
    / ((1_u128 << 75) as f64 * (1_u128 << 75) as f64)
    * 3.464_101_615_2;
/// The bounds hold for boxes up to 2^43.
const LARGEST_BOX: f64 = (1_u64 << 43) as f64;
/// From the text, in u of |x| + r: where an answer may lie, |x| or x.n, the difference, the rounding of the centre.
const DEPTH: f64 = 32.0 + 5.0 + 1.0 + 1.0;

macro_rules! rows {
    ($($bound:literal, $file:expr, $line:literal, $constant:expr, $unit:expr, $published:expr, $refused:expr, $holds:expr;)*) => {
        &[$(Row {
            bound: $bound,
            source: [$file, $line],
            constant: $constant as f64,
            unit: $unit,
            published: $published,
            refused: $refused,
            holds: $holds,
        }),*]
    };
}

#[rustfmt::skip]
const ROWS: &[Row] = rows! {
    "E, of A + L", ESTIMATE, "sums: 5", PROVEN.sums, IN_V, [5.0, 4.0], HALF, |x| estimate::holds(|c| c.sums = x);
    "E, of X G", ESTIMATE, "cross: 8", PROVEN.cross, IN_V, [8.0, 6.0], HALF, |x| estimate::holds(|c| c.cross = x);
    "E, of G²", ESTIMATE, "square: 32", PROVEN.square, ("v²", V * V), [32.0, 9.0], &[0.25], |x| estimate::holds(|c| c.square = x);
    "T, of G / a", ESTIMATE, "slope: 5", PROVEN.slope, IN_V, [5.0, 4.0], HALF, |x| estimate::holds(|c| c.slope = x);
    "T, of √D / a", ESTIMATE, "root: 2", PROVEN.root, IN_V, [2.0, 1.0], HALF, |x| estimate::holds(|c| c.root = x);
    "T, of |t|", ESTIMATE, "t: 11", PROVEN.t, IN_V, [11.0, 8.0], HALF, |x| estimate::holds(|c| c.t = x);
    "spread of `Fast`, squared", "accuracy/fast.rs", "const SPREAD", Fast::SPREAD * Fast::SPREAD, IN_U, [64.0, 20.0], &[0.25],
        |x| fast_row().iter().all(|part| part * U <= x);
    "spread of `Geometric`, squared", "accuracy/geometric.rs", "const SPREAD", Geometric::SPREAD * Geometric::SPREAD, IN_U,
        [64.0, 25.0], &[0.25], |x| geometric_row().iter().all(|part| part * U <= x);
    "what D is raised by, of size²", "accuracy/range_limits.rs", "const RAISE", RAISE, IN_U, [64.0, 20.0], &[0.25],
        |x| range_limits::needs()[0] * U <= x;
    "margin of a limit", "accuracy/range_limits.rs", "const MARGIN", LIMIT, IN_U, [16.0, 9.056], HALF,
        |x| range_limits::needs()[1..].iter().all(|part| part * U <= x);
    "κ", "filter.rs", "const KAPPA", KAPPA, IN_U, [114.0, 112.0], &[0.5, 112.0 / 114.0], filter::holds;
    "pad of a box, of C", "bvh/build/bounds.rs", "const PAD", PAD, IN_U, [40.0, 35.0], HALF, |x| boxes::needs()[0] * U <= x;
    "absolute error, of F, by slabs", "bvh/traverse/prepared_ray.rs", "const ABSOLUTE_ERROR", ABSOLUTE_ERROR, AS_IT_IS, [8.0, 6.5],
        HALF, |x| boxes::needs()[1] <= x * f64::from(PADS);
    "pad of a ray, in absolute errors", "bvh/traverse/prepared_ray.rs", "const PADS", PADS, AS_IT_IS, [2.0, 1.625], HALF,
        |x| boxes::needs()[1] <= x * f64::from(ABSOLUTE_ERROR);
    "δ, of S", LEAF, "const DELTA", DELTA as f64 * U, IN_U, [48.0, 41.27], HALF, |x| leaves::holds(DELTA * crate::numeric::rounding::U, x);
    "W, of δ r", LEAF, "const SLACK", SLACK[0], AS_IT_IS, [0.5, 0.5], HALF, |x| leaves::holds(SLACK[0], x);
    "W, of δ²", LEAF, "const SLACK", SLACK[1], AS_IT_IS, [0.3125, 0.1111], &[0.25], |x| leaves::holds(SLACK[1], x);
    "border of a box, of the largest |f|", LEAF, "const BORDER", BORDER as f64 * U, IN_U, [5.0, 4.0], HALF, |x| leaves::border() * U <= x;
    "the same, at planes", FRUSTUM, "const BORDER", BORDER_AT_PLANES, IN_U, [16.0, 9.0], HALF,
        |x| (leaves::border() + f64::from(BORDER)) * U <= x;
    "turn of a slope, of |w|", FRUSTUM, "const TURN", TURN[0], IN_U, [16.0, 12.01], HALF, |x| frustum::needs().turn[0] * U <= x;
    "turn of a slope, besides", FRUSTUM, "const TURN", TURN[1], IN_U, [0.015_625, 0.00806], HALF, |x| frustum::needs().turn[1] * U <= x;
    "margin of a plane, in absolute errors", FRUSTUM, "const MARGIN", MARGIN, AS_IT_IS, [1.0, 0.875], HALF, |x| frustum::needs().margin <= x;
    "what radii are larger by", FRUSTUM, "const LARGER", LARGER - 1.0, IN_U, [64.0, 34.41], HALF, |x| frustum::needs().larger * U <= x;
    "error of a camera's point", "geometry/camera/tiles.rs", "const POINT_ERROR", POINT_ERROR, IN_U, [4.0, 3.0], HALF,
        |x| frustum::point_error() * U <= x;
    "errors of points, in slopes", "coherent/tile_fit.rs", "const ERRORS", ERRORS, AS_IT_IS, [2.5, 1.574], HALF,
        |x| frustum::errors_of_points(SMALL.into()) <= x;
    "depth of a sphere, of |x| + r", "coherent/view.rs", "const DEPTH_MARGIN", DEPTH_MARGIN, IN_U, [64.0, DEPTH], HALF, |x| DEPTH * U <= x;
    "reach where all t are near", "scale/rays.rs", "const NEAR", NEAR, (" · 2⁻²⁰", 1.0 / (1 << 20) as f64), [1.0, 0.866], HALF, |x| FARTHEST <= x;
    "largest size", "scale/scene.rs", "const LARGEST", LARGEST, (" · 2⁴¹", (1_u64 << 41) as f64), [1.0, 1.0], &[0.5, 2.0],
        |x| 2.0 * x * (1.0 + 64.0 * U) <= LARGEST_BOX && f64::from(SMALLEST) * libm::exp2((RANGE + 1) as f64) <= x;
};

/// A number as tables have it.
fn text(number: f64, unit: &str) -> String {
    let shown = if number >= 0.1 { format!("{number:.4}") } else { format!("{number:.6}") };
    format!("{}{unit}", shown.trim_end_matches('0').trim_end_matches('.'))
}

/// The least that a proof holds with, within a millionth of the constant.
fn least(row: &Row) -> f64 {
    let (mut fails, mut holds) = (0.0, row.constant);
    while holds - fails > row.constant * 1e-6 {
        let middle = f64::midpoint(fails, holds);
        *(if (row.holds)(middle) { &mut holds } else { &mut fails }) = middle;
    }
    holds
}

/// What is wrong with a row, if anything, and its line of the table.
fn judge(row: &Row, source: &str) -> (Vec<String>, String) {
    let Row { bound, source: [file, item], constant, unit: (unit, one), published, refused, holds } =
        row;
    let begins = |line: &str| line.trim_start().trim_start_matches("pub(crate) ").starts_with(item);
    let line = source.lines().position(begins).map_or(0, |line| line + 1);
    let (least, parts) = (
        least(row) / one,
        refused.iter().map(|part| text(part * published[0], unit)).collect::<Vec<_>>(),
    );
    println!("{file}:{line}: {bound}: {}{unit}, of which {least}{unit} are needed", constant / one);
    let mut wrong = Vec::new();
    let mut expect = |is_right: bool, what: String| {
        if !is_right {
            wrong.push(format!("{file}:{line}: {bound}: {what}"));
        }
    };
    expect(line > 0, format!("no line begins with `{item}`"));
    expect(constant / one == published[0], format!("{} in the source", constant / one));
    expect(holds(*constant), "the proof needs more".into());
    expect((least / published[1] - 1.0).abs() < 1e-3, format!("the proof needs {least}"));
    for part in refused.iter().filter(|part| holds(constant * **part)) {
        expect(false, format!("{part} of it is not refused"));
    }
    let name = item.trim_start_matches("const ").split(':').next().unwrap_or(item);
    let [constant, least] = published.map(|number| text(number, unit));
    let (bound, parts) = (bound.replace('|', "\\|"), parts.join(", "));
    (wrong, format!("| {bound} | `{file}` `{name}` | {constant} | {least} | {parts} |\n"))
}

#[test]
fn every_constant_is_proven_and_less_is_refused() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read =
        |path: &str| read_to_string(repository.join(path)).expect("a file of the repository");
    let mut table = String::from(
        "| bound | source | constant | the proof needs | refused |\n|---|---|--:|--:|--:|\n",
    );
    let mut wrong = Vec::new();
    for row in ROWS {
        let (of_row, line) = judge(row, &read(&format!("kernel/src/{}", row.source[0])));
        wrong.extend(of_row);
        table += &line;
    }
    let roundings = leaves::roundings();
    for (found, published) in roundings.into_iter().zip([3.5, 12.0, 4.0, 3.0]) {
        if (found - published).abs() > 1e-4 {
            wrong.push(format!("{roundings:?} are the roundings of a leaf, not {published}"));
        }
    }
    if !read("docs/proofs.md").contains(&table) {
        wrong.push(format!("the table of docs/proofs.md is another:\n{table}"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
