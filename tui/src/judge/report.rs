//! What `spherule judge` prints.

use crate::counted::counted;
use serde_json::{Value, json};
use spherule_kernel::Sphere;
use spherule_referee::counts::Counts;
use spherule_referee::failure::Failure;
use spherule_referee::families::FAMILIES;
use spherule_referee::judge::{Judge, Score};
use spherule_referee::snippet::{c, hex, python, rust, sentence};
use spherule_referee::table::{write_chart, write_counts};
use spherule_referee::verdict::Kind;
use std::fmt::Write;

/// What was judged.
pub(super) struct Report<'a> {
    pub(super) judge: &'a Judge,
    /// The simplest failure of each kind that occurred.
    pub(super) smallest: &'a [Failure],
    pub(super) rays: u64,
    pub(super) spheres: u64,
    pub(super) pairs: bool,
}

impl Report<'_> {
    /// A table, the picture if it is asked for, and of each kind of failure the worst and the simplest.
    pub(super) fn text(&self, chart: bool) -> String {
        let (rays, spheres) = (counted(self.rays, "ray"), counted(self.spheres, "sphere"));
        let mut text = format!("{rays}, {spheres}\n");
        // Writing to memory cannot fail.
        let _ = write_counts(self.judge, &mut text);
        if chart {
            text.push('\n');
            let _ = write_chart(self.judge, &mut text);
        }
        let row_of =
            |failure: &Failure| failure.row.map_or(String::new(), |row| format!(", row {row}"));
        for kind in Kind::ALL {
            if let Some(failure) = self.judge.worst(kind) {
                let (row, what) = (row_of(failure), sentence(failure));
                let _ = write!(text, "\nworst{row}: {what}\n{}", python(failure));
            }
            if let Some(failure) = self.smallest(kind) {
                let (row, what) = (row_of(failure), sentence(failure));
                let _ = write!(text, "\nsmallest{row}: {what}\n");
                let _ = write!(text, "{}\n{}\n{}", c(failure), python(failure), rust(failure));
            }
        }
        text
    }

    fn smallest(&self, kind: Kind) -> Option<&Failure> {
        self.smallest.iter().find(|failure| failure.kind == kind)
    }

    /// One JSON object.
    pub(super) fn json(&self) -> String {
        let family = |(number, score): (Option<u8>, &Score)| {
            let mut value = score_value(score);
            value["family"] = name_of(number);
            value
        };
        let families: Vec<Value> = self.judge.scores().map(family).collect();
        let of_kind = |kind: Kind| {
            let failures = [self.judge.worst(kind), self.smallest(kind)];
            let [worst, smallest] = failures.map(|failure| failure.map(failure_value));
            json!({"kind": kind.name(), "worst": worst, "smallest": smallest})
        };
        let report = json!({
            "rays": self.rays,
            "spheres": self.spheres,
            "pairs": self.pairs,
            "families": families,
            "all": score_value(&self.judge.total()),
            "failures": Kind::ALL.map(of_kind),
        });
        report.to_string() + "\n"
    }
}

fn name_of(number: Option<u8>) -> Value {
    let family = number.and_then(|number| FAMILIES.get(usize::from(number)));
    family.map_or(Value::Null, |family| json!(family.name))
}

fn score_value(score: &Score) -> Value {
    json!({
        "by_rules": counts_value(&score.by_rules),
        "by_contract": counts_value(&score.by_contract),
        "places": score.places,
    })
}

fn counts_value(counts: &Counts) -> Value {
    let mut value = json!({
        "judged": counts.judged,
        "unpromised": counts.unpromised,
        "open": counts.open,
        "hits": counts.hits,
        "ulp_median": counts.ulp.quantile(500),
        "ulp_p999": counts.ulp.quantile(999),
        "ulp_max": counts.ulp.max(),
    });
    for kind in Kind::ALL {
        value[kind.name().replace(' ', "_")] = json!(counts.of(kind));
    }
    value
}

/// A failure with its numbers in decimals, `null` for those that are none, and as hexadecimal floats.
fn failure_value(failure: &Failure) -> Value {
    let (numbers, spheres) = (ray_numbers(failure), &failure.spheres);
    let row = |Sphere { center, radius }: &Sphere| [center.x, center.y, center.z, *radius];
    let hexes = |numbers: &[f32]| numbers.iter().map(|&x| hex(x)).collect::<Vec<_>>();
    json!({
        "severity": failure.severity,
        "family": name_of(failure.family),
        "row": failure.row,
        "ray": numbers,
        "ray_hex": hexes(&numbers),
        "spheres": spheres.iter().map(row).collect::<Vec<_>>(),
        "spheres_hex": spheres.iter().map(|sphere| hexes(&row(sphere))).collect::<Vec<_>>(),
        "truth": failure.truth.map(|hit| json!({"t": hit.t, "t_hex": hex(hit.t), "sphere": hit.sphere})),
        "answer": failure.answer.map(|answer| json!({"t": answer.t, "sphere": answer.sphere})),
        "c": c(failure),
        "python": python(failure),
        "rust": rust(failure),
    })
}

fn ray_numbers(failure: &Failure) -> [f32; 8] {
    let ray = &failure.ray;
    let ([x, y, z], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
    [x, y, z, dx, dy, dz, ray.t_min, ray.t_max]
}
