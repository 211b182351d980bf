//! The ratios of times that `Exact` was asked to reach, and whether it does.

use crate::report::contender::{Contender, Engine};
use crate::report::reference::DOUBLE;
use crate::report::speed::{List, Speed, Workload};
use crate::rounds::Median;
use crate::workload::Kind;
use spherule_kernel::{Accuracy, Exact, Fast};

/// A ratio that was asked for.
#[derive(Clone, Debug)]
pub struct Target {
    /// What is divided by what.
    pub what: String,
    /// Where.
    pub workload: Workload,
    /// What was measured.
    pub measured: Median,
    /// What was asked for.
    pub limit: f64,
    /// Whether the ratio shall be at least the limit; else at most.
    pub at_least: bool,
}

impl Target {
    /// By the median.
    #[must_use]
    pub fn is_met(&self) -> bool {
        let ratio = self.measured.middle;
        if self.at_least { ratio >= self.limit } else { ratio <= self.limit }
    }
}

/// Time of `Exact` / time of `Fast`, at most.
const fn limit(workload: Workload) -> f64 {
    match (workload.list, workload.kind) {
        (List::Cube, Kind::Camera) => 1.3,
        (List::Cube, Kind::Incoherent) => 1.5,
        (List::Ground, Kind::Camera) => 1.7,
        (List::Ground, Kind::Incoherent) => 2.0,
        (List::EveryLine, _) => 2.5,
    }
}

/// Time of plain double precision / time of `Exact`, at least, on camera rays and small spheres.
const OVER_DOUBLE: f64 = 2.5;

/// In 16 lanes of every level; plain double precision in its quickest lanes.
#[must_use]
pub fn targets(contenders: &[Contender], speed: &Speed) -> Vec<Target> {
    let mut all = Vec::new();
    let exact = contenders.iter().filter(|contender| contender.name == Exact::NAME);
    for engine in exact.map(|contender| contender.engine).filter(|engine| engine.count == 16) {
        for workload in Workload::ALL {
            all.push(Target {
                what: format!("exact / fast, {engine}"),
                workload,
                measured: speed.ratio((Exact::NAME, engine), (Fast::NAME, engine), workload),
                limit: limit(workload),
                at_least: false,
            });
        }
        let camera = |w: &Workload| w.kind == Kind::Camera && w.list == List::Cube;
        for workload in Workload::ALL.into_iter().filter(camera) {
            // Lanes that have the build's instructions alone would be no match for others.
            if engine.level != Engine::BUILD {
                continue;
            }
            let double = speed.quickest(contenders, DOUBLE, workload, |_| true);
            all.extend(double.map(|double| Target {
                what: format!("{DOUBLE} in {double} / exact, {engine}"),
                workload,
                measured: speed.ratio((DOUBLE, double), (Exact::NAME, engine), workload),
                limit: OVER_DOUBLE,
                at_least: true,
            }));
        }
    }
    all
}
