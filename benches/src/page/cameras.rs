//! Rays that a camera makes.

use super::{Table, build, cell, number};
use crate::cameras::{OfScene, Way};
use crate::engine::BLOCK;

/// The report.
pub(crate) fn page(origin: &str, all: &[OfScene]) -> String {
    let mut table = Table::new(
        2,
        "scene | level | made one by one, then traced | made in lanes, then traced | there before | \
         made by the tree | times one by one | times there before | times Embree, there before",
    );
    for scene in all {
        for level in scene.levels() {
            let rates = Way::ALL.map(|way| number(scene.rate(way, level)));
            let by_tree = Way::ByTree;
            let ratios = [
                cell(scene.ratio(by_tree, Way::OneByOne, level)),
                cell(scene.ratio(by_tree, Way::Before, level)),
                cell(scene.times_embree(by_tree, level)),
            ];
            let names = [scene.scene, level.as_str()].map(str::to_owned);
            table.row(names.into_iter().chain(rates).chain(ratios));
        }
    }
    let [timed, whole] = all.first().map_or([0, 0], |scene| scene.rays);
    format!(
        "# Rays that a camera makes, {} build\n\n{origin}\n\nClosest hits of `stable` by the tree; a million rays a second, \
         from the camera to the hits, on one thread, in blocks of {BLOCK} rays; {timed} of {whole} rays of each picture, in blocks \
         from all of it; medians of {} interleaved rounds [quartiles]. Four tiles that follow each other are a square of 8 x 8 \
         pixels. (On the pages of structures tiles lie row by row: rates do not compare.) *Made by the tree*: \
         `closest_hit_tiles`. *There before*: packets of the same rays, in the cache, made with the clock stopped; so does \
         Embree get them, 3.13 or 4.4, in its quickest call with the same instructions (for the baseline, SSE4.2), said to be \
         coherent or not. Before anything is timed, the ways agree bit for bit, and with brute force on a sample.\n\n{}",
        build(),
        all.iter().map(OfScene::rounds).min().unwrap_or(0),
        table.0
    )
}
