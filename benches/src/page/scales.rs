//! Other units.

use super::{Table, build};
use crate::engine::Query;
use crate::scales::{SCALES, Scales, WAYS};

/// The report.
pub(crate) fn page(origin: &str, scales: &Scales) -> String {
    let ways = WAYS.map(|(kind, way)| format!("{}: {}", kind.as_str(), way.as_str()));
    let mut table = Table::new(0, &format!("scene | \\|d\\| | {}", ways.join(" | ")));
    let mut worst = 0.0_f64;
    for scale in &SCALES[1..] {
        let cells = WAYS.map(|way| {
            let ratios = Query::ALL.map(|query| {
                let ratio = scales.ratio(*scale, way, query).map_or(f64::NAN, |ratio| ratio.middle);
                worst = worst.max(ratio);
                format!("{ratio:.2}")
            });
            ratios.join(" / ")
        });
        table.row(scale.map(|exponent| format!("2^{exponent}")).into_iter().chain(cells));
    }
    format!(
        "# Other units, {} build\n\n{origin}\n\nTimes of `exact` in a scene of 2,000 uniform spheres that is multiplied by a \
         power of two, with directions multiplied by another, over those of the scene as it is: closest hit / any hit. One \
         thread; medians of {} interleaved rounds of ratios. Before anything is timed, every way answers as brute force \
         does, and brute force as the oracle. At most {worst:.2}.\n\n{}",
        build(),
        scales.rounds(),
        table.0
    )
}
