//! What `spherule trace` prints: the keys that scripts rely on.

use crate::structure::Structure;
use serde_json::{Map, Value, json};
use spherule_kernel::{LevelName, Tier};
use std::time::Duration;

/// What was traced, and how fast.
pub(super) struct Report {
    pub(super) rays: usize,
    pub(super) spheres: usize,
    pub(super) hits: usize,
    pub(super) structure: Structure,
    pub(super) accuracy: Tier,
    pub(super) level: LevelName,
    pub(super) lanes: usize,
    pub(super) threads: usize,
    pub(super) build: Duration,
    pub(super) passes: Vec<Duration>,
}

impl Report {
    /// The keys and their values, in the order in which they are printed.
    fn entries(&self) -> Vec<(&'static str, Value)> {
        let rounded = |number: f64| json!((number * 1e3).round() / 1e3);
        vec![
            ("rays", json!(self.rays)),
            ("spheres", json!(self.spheres)),
            ("hits", json!(self.hits)),
            ("structure", json!(self.structure.in_reports())),
            ("accuracy", json!(self.accuracy.as_str())),
            ("level", json!(self.level.as_str())),
            ("lanes", json!(self.lanes)),
            ("threads", json!(self.threads)),
            ("build_ms", rounded(self.build.as_secs_f64() * 1e3)),
            ("mrays_per_s", rounded(self.mega_rays_a_second())),
        ]
    }

    /// The speed of the median pass; 0 if it took no time that can be measured.
    fn mega_rays_a_second(&self) -> f64 {
        let mut seconds: Vec<f64> = self.passes.iter().map(Duration::as_secs_f64).collect();
        seconds.sort_by(f64::total_cmp);
        let middle = seconds.len() / 2;
        let median = match seconds.len() {
            0 => 0.0,
            count if count % 2 == 0 => (seconds[middle - 1] + seconds[middle]) / 2.0,
            _ => seconds[middle],
        };
        if median > 0.0 { self.rays as f64 / median / 1e6 } else { 0.0 }
    }

    /// One line of `key=value`.
    pub(super) fn line(&self) -> String {
        let pair = |(key, value): (&str, Value)| match value {
            Value::String(text) => format!("{key}={text}"),
            number => format!("{key}={number}"),
        };
        self.entries().into_iter().map(pair).collect::<Vec<_>>().join(" ") + "\n"
    }

    /// One JSON object.
    pub(super) fn json(&self) -> String {
        let object: Map<_, _> =
            self.entries().into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        Value::Object(object).to_string() + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(rays: usize, passes: &[u64]) -> Report {
        Report {
            rays,
            spheres: 2,
            hits: 3,
            structure: Structure::DepthList,
            accuracy: Tier::Fast,
            level: LevelName::Avx2,
            lanes: 8,
            threads: 2,
            build: Duration::from_micros(1500),
            passes: passes.iter().copied().map(Duration::from_secs).collect(),
        }
    }

    #[test]
    fn the_keys_are_all_there() {
        let report = report(8_000_000, &[3, 1, 2]);
        let line = "rays=8000000 spheres=2 hits=3 structure=tiles accuracy=fast level=avx2 lanes=8 \
                    threads=2 build_ms=1.5 mrays_per_s=4.0\n";
        assert_eq!(report.line(), line);
        let object: Value = serde_json::from_str(&report.json()).expect("JSON");
        assert_eq!(object["mrays_per_s"], json!(4.0));
        assert_eq!(object.as_object().map(Map::len), Some(10));
    }

    #[test]
    fn the_median_of_an_even_number_is_between() {
        assert_eq!(report(3_000_000, &[1, 2]).mega_rays_a_second(), 2.0);
        assert_eq!(report(3_000_000, &[0]).mega_rays_a_second(), 0.0);
        assert_eq!(report(3_000_000, &[]).mega_rays_a_second(), 0.0);
    }
}
