//! A pick in words: lines for people, one JSON object for scripts.

use super::{Pick, PickedSphere};
use crate::harmless;
use glam::DVec3;
use serde_json::{Value, json};
use spherule_kernel::{Tier, Vec3};

/// A pick, and the cell of the picture that it is of.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// The name of the scene.
    pub scene: &'a str,
    /// Columns and rows of the picture.
    pub size: (u16, u16),
    /// Column and row, from 0.
    pub cell: (u16, u16),
    /// What is there.
    pub pick: Pick<'a>,
}

impl Report<'_> {
    /// Lines for people.
    #[must_use]
    pub fn text(&self) -> String {
        let Self { scene, size: (columns, rows), cell: (column, row), pick } = self;
        // A scene is the name of a file, and a label is any text; neither need be one line.
        let scene = scene.escape_debug();
        let head = format!("{scene}, cell {column},{row} of {columns}x{rows}");
        let lines = lines(pick, |label| label.escape_debug().to_string());
        [head].into_iter().chain(lines).map(|line| line + "\n").collect()
    }

    /// One JSON object.
    #[must_use]
    pub fn json(&self) -> String {
        let Self { scene, size: (columns, rows), cell: (column, row), pick } = self;
        let sphere = pick.sphere.as_ref();
        let report = json!({
            "scene": scene,
            "size": [columns, rows],
            "cell": [column, row],
            "zero": pick.origin.to_array(),
            "ray": {
                "origin": numbers(pick.ray.origin.to_array()),
                "direction": numbers(pick.ray.direction.to_array()),
            },
            "sphere": sphere.map(|picked| json!({
                "index": picked.index,
                "label": picked.label,
                "center": numbers(picked.sphere.center.to_array()),
                "radius": number(picked.sphere.radius),
            })),
            "discriminant": sphere.map(|picked| json!({
                "value": picked.discriminant.0,
                "bound": picked.discriminant.1,
                "decided_by": picked.decided_by.as_str(),
            })),
            "tiers": tiers(pick).map(|(tier, hit, roots)| json!({
                "accuracy": tier.as_str(),
                "sphere": hit.map(|hit| hit.sphere),
                "t": hit.map(|hit| number(hit.t)),
                "t_bits": hit.map(|hit| bits(hit.t)),
                "roots": roots.map(numbers),
            })).collect::<Vec<Value>>(),
        });
        harmless::json(&report) + "\n"
    }
}

/// Writes `x` in the fewest digits that are read back to the same `f32`, as people get it; null if it is not finite. A [`Value`] has an
/// `f64`, whose own digits go on where those of the `f32` end.
fn number(x: f32) -> Value {
    Value::from(format!("{x:?}").parse::<f64>().unwrap_or(f64::NAN))
}

fn numbers<const N: usize>(x: [f32; N]) -> [Value; N] {
    x.map(number)
}

/// Every tier, its closest hit, and its roots of the sphere that was picked.
fn tiers<'a>(
    pick: &'a Pick<'_>,
) -> impl Iterator<Item = (Tier, Option<spherule_kernel::Hit>, Option<[f32; 2]>)> + 'a {
    let roots = pick.sphere.as_ref().map_or([None; Tier::ALL.len()], |sphere| sphere.roots);
    let tiers = Tier::ALL.into_iter().zip(pick.hits).zip(roots);
    tiers.map(|((tier, hit), roots)| (tier, hit, roots))
}

/// The lines that the viewer shows, too. `printable` turns a label into text that can stand in a line.
#[must_use]
pub fn lines(pick: &Pick<'_>, printable: impl Fn(&str) -> String) -> Vec<String> {
    let mut ray = format!("ray {} + t {}", point(pick.ray.origin), point(pick.ray.direction));
    if pick.origin != DVec3::ZERO {
        let DVec3 { x, y, z } = pick.origin;
        ray += &format!(", from ({x:?}, {y:?}, {z:?}) of the file");
    }
    let Some(picked) = &pick.sphere else {
        let [others @ .., last] = Tier::ALL.map(Tier::as_str);
        return vec![ray, format!("no sphere is hit, by {} or {last}", others.join(", "))];
    };
    let PickedSphere { index, label, sphere, discriminant: (d, bound), decided_by, .. } = picked;
    let label =
        label.as_ref().map_or_else(String::new, |label| format!(" \"{}\"", printable(label)));
    let mut lines = vec![
        ray,
        format!(
            "sphere {index}{label}: centre {}, radius {:?}",
            point(sphere.center),
            sphere.radius
        ),
        format!("D = {d:?} +- {bound:?}, decided by {}", decided_by.as_str()),
    ];
    lines.extend(table(pick));
    lines
}

fn point(v: Vec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

fn bits(t: f32) -> String {
    format!("0x{:08x}", t.to_bits())
}

/// A head, and one row a tier; columns are as wide as they must be.
fn table(pick: &Pick<'_>) -> Vec<String> {
    let mut rows = vec![["tier", "sphere", "t", "bits of t", "roots", ""].map(str::to_owned)];
    let none = || "-".to_owned();
    for (tier, hit, roots) in tiers(pick) {
        let of_hit = |text: fn(spherule_kernel::Hit) -> String| hit.map_or_else(none, text);
        let of_root = |root: usize| roots.map_or_else(none, |roots| format!("{:?}", roots[root]));
        rows.push([
            tier.as_str().to_owned(),
            of_hit(|hit| hit.sphere.to_string()),
            of_hit(|hit| format!("{:?}", hit.t)),
            of_hit(|hit| bits(hit.t)),
            of_root(0),
            of_root(1),
        ]);
    }
    let mut widths = [0; 6];
    for row in &rows {
        for (width, word) in widths.iter_mut().zip(row) {
            *width = word.len().max(*width);
        }
    }
    let line = |row: &[String; 6]| {
        let words = row.iter().zip(widths).map(|(word, width)| format!("{word:<width$}"));
        words.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}
