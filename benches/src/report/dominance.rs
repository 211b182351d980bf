//! Which tier nobody needs: another one is faster on every workload in every engine, and no less
//! right in any figure of any regime.

use crate::report::contender::{Contender, Engine};
use crate::report::error::NamedErrors;
use crate::report::speed::{Speed, Workload};
use crate::rounds::Median;

/// One contender held against a tier that might replace it.
#[derive(Clone, Debug)]
pub struct Rivalry {
    /// Who might not be needed.
    pub name: &'static str,
    /// The tier that might replace it.
    pub by: &'static str,
    /// Of how many regimes.
    pub regimes: usize,
    /// Regimes in which the rival is no less right, in any figure.
    pub no_less_right: usize,
    /// The rival's time by the contender's own: on every workload, in every engine that both have,
    /// or else in the quickest of each.
    pub ratios: Vec<(Engine, Workload, Median)>,
}

impl Rivalry {
    /// How often the rival is faster, by the median.
    #[must_use]
    pub fn faster(&self) -> usize {
        self.ratios.iter().filter(|(_, _, ratio)| ratio.middle < 1.0).count()
    }

    /// How often the rival is slower, and not by noise: in three rounds of four.
    #[must_use]
    pub fn clearly_slower(&self) -> usize {
        self.ratios.iter().filter(|(_, _, ratio)| ratio.low > 1.0).count()
    }

    /// Least and largest ratio.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        let middles = self.ratios.iter().map(|(_, _, ratio)| ratio.middle);
        middles.fold((f64::INFINITY, 0.0), |(low, high), x| (low.min(x), high.max(x)))
    }

    /// Whether nobody needs the contender.
    #[must_use]
    pub fn dominates(&self) -> bool {
        self.no_less_right == self.regimes && self.faster() == self.ratios.len()
    }
}

/// Every contender against every tier but itself.
#[must_use]
pub fn rivalries(contenders: &[Contender], errors: &[NamedErrors], speed: &Speed) -> Vec<Rivalry> {
    let is_tier = |name| contenders.iter().any(|other| other.name == name && other.is_tier);
    let mut all = Vec::new();
    for own in errors {
        for rival in errors.iter().filter(|rival| rival.name != own.name && is_tier(rival.name)) {
            let pairs = rival.regimes.iter().zip(&own.regimes);
            all.push(Rivalry {
                name: own.name,
                by: rival.name,
                regimes: own.regimes.len(),
                no_less_right: pairs.filter(|(rival, own)| rival.no_worse_than(own)).count(),
                ratios: ratios(contenders, speed, rival.name, own.name),
            });
        }
    }
    all
}

fn ratios(
    contenders: &[Contender],
    speed: &Speed,
    rival: &str,
    own: &str,
) -> Vec<(Engine, Workload, Median)> {
    let engines = |name: &str| {
        let named = contenders.iter().filter(move |contender| contender.name == name);
        named.map(|contender| contender.engine).collect::<Vec<_>>()
    };
    let own_engines = engines(own);
    let is_tier = contenders.iter().any(|other| other.name == own && other.is_tier);
    let mut all = Vec::new();
    for workload in Workload::ALL {
        if is_tier {
            for engine in engines(rival).into_iter().filter(|engine| own_engines.contains(engine)) {
                let ratio = speed.ratio((rival, engine), (own, engine), workload);
                all.push((engine, workload, ratio));
            }
        } else {
            // The reference forms have the build's instructions alone.
            let quickest = |name| {
                speed.quickest(contenders, name, workload, |engine| engine.level == Engine::BUILD)
            };
            if let (Some(rivals), Some(owns)) = (quickest(rival), quickest(own)) {
                all.push((rivals, workload, speed.ratio((rival, rivals), (own, owns), workload)));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rivalry(no_less_right: usize, ratios: &[f64]) -> Rivalry {
        let engine = Engine { level: Engine::BUILD, lanes: "f32", count: 1 };
        let ratio = |&x: &f64| {
            (engine, Workload::ALL[0], Median { low: x - 0.05, middle: x, high: x + 0.05 })
        };
        let ratios = ratios.iter().map(ratio).collect();
        Rivalry { name: "a", by: "b", regimes: 2, no_less_right, ratios }
    }

    #[test]
    fn one_workload_or_one_regime_is_enough_to_be_needed() {
        assert!(rivalry(2, &[0.9, 0.99]).dominates());
        assert!(!rivalry(2, &[0.9, 1.01]).dominates());
        assert!(!rivalry(1, &[0.9, 0.99]).dominates());
        let close = rivalry(2, &[0.5, 1.01, 1.2]);
        assert_eq!((close.faster(), close.clearly_slower(), close.range()), (1, 1, (0.5, 1.2)));
    }
}
