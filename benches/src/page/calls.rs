//! What a call costs.

use super::{Table, build, cell, number, query_name};
use crate::calls::{Call, Calls, Row, SHORT};
use crate::rounds::Median;

/// The report.
pub(crate) fn page(origin: &str, all: &Calls) -> String {
    let mut table = Table::new(
        4,
        "scene | rays | query | level | one a call | times Embree's one | \
         slices of 1, 8 by one | packets | slices by packets | \
         columns by packets | 64 a call: slices by packets",
    );
    let ratio = |ratio: Option<Median>| cell(ratio.map(|it| format!("{:.2}", it.middle)));
    for row in &all.rows {
        table.row([
            row.scene.to_owned(),
            row.kind.as_str().to_owned(),
            query_name(row.query).to_owned(),
            row.level.as_str().to_owned(),
            number(row.rate(Call::OneRay)),
            ratio(row.by_embree()),
            [1, 8].map(|count| ratio(row.ratio(Call::SlicesOf(count), Call::OneRay))).join(", "),
            number(row.rate(Call::PACKETS)),
            ratio(row.ratio(Call::SLICES, Call::PACKETS)),
            ratio(row.ratio(Call::Columns, Call::PACKETS)),
            ratio(row.ratio(Call::SlicesOf(SHORT), Call::PacketsOf(SHORT))),
        ]);
    }
    let mut refits = Table::new(1, "scene | spheres | growth | a refit by a build");
    for refit in &all.refits {
        refits.row([
            refit.scene.to_owned(),
            refit.spheres.to_string(),
            format!("{:.2}", refit.growth),
            cell(refit.by_build),
        ]);
    }
    format!(
        "# What a call costs, {} build\n\n{origin}\n\nClosest hits and any hits of `exact` by the tree, nothing said of the rays; \
         a million rays a second, on one thread, medians of at least {} interleaved rounds of the thread's own time, ratios \
         round by round. *One a call*: `closest_hit`, `any_hit`; beside it `rtcIntersect1`, `rtcOccluded1` of Embree 3.13 or 4.4, \
         whichever is the quicker, with the same instructions (for the baseline, SSE4.2). The others get all rays in one call, or 64; slices of 1 \
         and of 8 are held against it. \
         Before anything is timed, all calls agree, bit for bit.\n\n{}\nSpheres that move, each by up to its radius along each axis \
         there and back: a refit's time by that of a build, on one thread [quartiles], and by how much boxes have grown when they are \
         there.\n\n{}",
        build(),
        all.rows.iter().map(Row::rounds).min().unwrap_or(0),
        table.0,
        refits.0
    )
}
