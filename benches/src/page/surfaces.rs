//! Surfaces, and shadow rays from them.

use super::{Table, build, cell, number};
use crate::surfaces::{OfRays, Pass};
use spherule_kernel::Tier;

/// The report.
pub(crate) fn page(origin: &str, all: &[OfRays]) -> String {
    let mut table = Table::new(
        2,
        "scene | rays | that hit | ns a ray, `exact` | with surfaces | with shadow rays made | \
         surfaces: times `exact` without | times `stable` without | shadow rays: times `exact` with surfaces",
    );
    for rays in all {
        let time = |pass| number(rays.time(Tier::Exact, pass).map(|time| time.middle));
        table.row([
            rays.scene.to_owned(),
            rays.kind.as_str().to_owned(),
            format!("{:.0} %", 100.0 * rays.hit),
            time(Pass::Hits),
            time(Pass::Surfaces),
            time(Pass::ShadowRays),
            cell(rays.ratio(Tier::Exact, Pass::Surfaces, Pass::Hits)),
            cell(rays.ratio(Tier::Stable, Pass::Surfaces, Pass::Hits)),
            cell(rays.ratio(Tier::Exact, Pass::ShadowRays, Pass::Surfaces)),
        ]);
    }
    format!(
        "# Surfaces and shadow rays, {} build\n\n{origin}\n\nClosest hits by the tree, primary rays in coherent packets, \
         diffuse ones ray by ray; then normals and points of what is hit; then shadow rays from there to a light, made, not traced. \
         One thread; medians of {} interleaved rounds [quartiles]. Before anything is timed, surfaces and shadow rays are those \
         of one ray at a time.\n\n{}",
        build(),
        all.iter().map(OfRays::rounds).min().unwrap_or(0),
        table.0
    )
}
