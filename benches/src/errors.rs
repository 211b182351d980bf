//! How wrong tiers and marks are, regime by regime, against the oracle of big integers: one ray, one sphere. Lanes do
//! not matter: the tests hold every width and level to the same bits.

use crate::engine::marks::{DOUBLE, GEOMETRIC, marks};
use crate::engine::{Query, Rays};
use crate::measure::Effort;
use spherule_kernel::{Intersect, SphereList, Tier};
use spherule_referee::case::Case;
use spherule_referee::measured::{MEASURED, Measured};
use spherule_tests::scenes::Scene;
use spherule_tests::tally::{Summary, Ulp, measure as tally};

/// The tiers and the marks, in the order of the tables.
pub(crate) const NAMES: [&str; 6] = [
    Tier::Fast.as_str(),
    Tier::Geometric.as_str(),
    Tier::Stable.as_str(),
    Tier::Exact.as_str(),
    GEOMETRIC,
    DOUBLE,
];

/// What each of [`NAMES`] gets wrong in a regime.
pub(crate) struct Errors {
    pub(crate) regime: &'static str,
    pub(crate) of: [Summary; NAMES.len()],
}

/// Cases of every regime.
pub(crate) fn measure(effort: Effort) -> Vec<Errors> {
    let cases = if effort == Effort::Test { 300 } else { 50_000 };
    eprintln!("error: {cases} cases a regime");
    let regime = |measured: &Measured| {
        let engines = NAMES.map(|name| move |case: &Case| answer(name, case));
        let engines = engines.each_ref().map(|engine| engine as &dyn Fn(&Case) -> Option<f32>);
        let errors = tally(measured.cases(cases), &engines);
        Errors { regime: measured.name, of: std::array::from_fn(|index| errors[index].summary()) }
    };
    MEASURED.iter().map(regime).collect()
}

/// The t of one ray and one sphere.
fn answer(name: &str, case: &Case) -> Option<f32> {
    if let Ok(tier) = name.parse::<Tier>() {
        return SphereList::from([case.sphere]).closest_hit(tier, &case.ray).map(|hit| hit.t);
    }
    let scene = Scene::of_case(case.sphere);
    let mark = marks(&scene).into_iter().find(|mark| mark.label.name == name)?;
    let mut run = (mark.ready)(&Rays::new(&[case.ray]));
    run.run(Query::ClosestHit);
    run.hits()[0].map(|hit| hit.t)
}

/// Wrong decisions in a million rays, by kind: hits that are misses, misses that are hits, and hits at the other root.
pub(crate) fn wrong_in_a_million(summary: &Summary) -> [f64; 3] {
    let Summary { wrong_hits, wrong_misses, wrong_places, rays, .. } = *summary;
    [wrong_hits, wrong_misses, wrong_places].map(|count| count as f64 * 1e6 / rays as f64)
}

/// `median / p99.9 / max`.
pub(crate) fn ulp(Ulp { median, p999, max }: Ulp) -> String {
    let short = |ulp: u64| {
        if ulp < 100_000 { ulp.to_string() } else { format!("{:.0e}", ulp as f64) }
    };
    format!("{} / {} / {}", short(median), short(p999), short(max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_is_right_double_nearly_and_the_lecture_s_forms_are_not() {
        let errors = measure(Effort::Test);
        let wrong = |summary: &Summary| wrong_in_a_million(summary).iter().sum::<f64>();
        for Errors { regime, of: [_, _, _, exact, ..] } in &errors {
            assert_eq!((wrong(exact), exact.ulp.map(|ulp| ulp.max)), (0.0, Some(0)), "{regime}");
            assert_eq!(exact.rounded, exact.hits, "{regime}");
        }
        let [fast, geometric, _, _, plain, double] = errors[0].of;
        assert!(double.rounded == double.hits);
        assert_eq!(errors[2].regime, "dist/r 1e4");
        for (index, form) in [(0, fast), (1, geometric), (4, plain)] {
            assert!(form.ulp.is_some_and(|ulp| ulp.p999 < 2000), "{}", NAMES[index]);
            assert!(wrong(&errors[2].of[index]) > 1e5, "{}", NAMES[index]);
        }
        assert_eq!(ulp(Ulp { median: 7, p999: 99_999, max: 888_586_229 }), "7 / 99999 / 9e8");
    }
}
