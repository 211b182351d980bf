//! Rays in every order.

use super::{Table, build, cell, number, query_name};
use crate::engine::Query;
use crate::orders::{Row, Way};
use crate::rounds::Median;
use spherule_kernel::LevelName;

type Ratio = fn(&Row) -> Option<Median>;

/// Ratios of speeds, and their limits: the plain call by the best way, and by ray by ray; rays said to be coherent by ray by ray; the plain
/// call by Embree.
const RATIOS: [(Ratio, f64); 4] = [
    (Row::by_best, 0.85),
    (Row::by_ray_by_ray, 0.7),
    (Row::coherent_by_ray_by_ray, 0.7),
    (Row::by_embree, 1.2),
];

/// The middles of a ratio, of the rows of which it was measured.
fn middles<'a>(rows: impl Iterator<Item = &'a Row>, ratio: Ratio) -> impl Iterator<Item = f64> {
    rows.filter_map(ratio).map(|it| it.middle)
}

/// In how many rows each of the ratios is below its limit.
fn below<'a>(rows: &(impl Iterator<Item = &'a Row> + Clone)) -> [String; 4] {
    RATIOS.map(|(ratio, limit)| {
        middles(rows.clone(), ratio).filter(|it| *it < limit).count().to_string()
    })
}

/// The report.
pub(crate) fn page(origin: &str, all: &[Row]) -> String {
    let mut rows: Vec<_> = all.iter().collect();
    let worst = |row: &Row| row.by_best().map_or(f64::INFINITY, |it| it.middle);
    rows.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    let mut table = Table::new(
        4,
        "scene | order | query | level | rays | plain | the best way | plain by it | by ray by ray | \
         said coherent, by ray by ray | times Embree",
    );
    for row in &rows {
        let ratio =
            |(ratio, _): (Ratio, f64)| cell(ratio(row).map(|it| format!("{:.2}", it.middle)));
        let slow = if row.is_cut_short { "~" } else { "" };
        let cells = [
            row.scene.to_owned(),
            row.order.as_str().to_owned(),
            query_name(row.query).to_owned(),
            row.level.as_str().to_owned(),
            row.rays.to_string(),
            slow.to_owned() + &number(row.rate()),
            cell(row.best().map(Way::as_str)),
        ];
        table.row(cells.into_iter().chain(RATIOS.map(ratio)));
    }
    format!(
        "# Rays in every order, {} build\n\n{origin}\n\n*Plain*: `closest_hits` or `any_hits` of a tree, `exact`, one call for all \
         rays, of which nothing is said; a million a second, on one thread. Against it: the best of ray by ray (slices said to be \
         incoherent), slices said to be coherent, packets, incoherent packets, streams (8,192 rays together, 64 places in queues for each), \
         and, where rays have a viewpoint and spheres are fewer than 20,000, a depth list made for them; \
         and Embree, 3.13 or 4.4, in its quickest call with the same instructions (for the baseline, SSE4.2), rays said to be coherent or \
         not, in blocks that are in the cache. \
         Medians of {} to {} interleaved rounds of the thread's own time, ratios round by round. ~: on a part of the rays far slower than \
         the best, so timed there alone: the rate is ray by ray's on all, by the quotient of both on that part (rays said to be \
         coherent are treated alike). {}\
         Before anything is timed, every way answers as ray by ray does, bit for bit, which answers as brute force does on a sample. \
         The orders: [orders.rs](../../tests/src/orders.rs).\n\n{}\n{}\n{}\n{}\nEvery row, the worst first:\n\n{}",
        build(),
        all.iter().map(Row::rounds).min().unwrap_or(0),
        all.iter().map(Row::rounds).max().unwrap_or(0),
        noise(all),
        summary(all),
        leads(all),
        worst_of(all, "order", |row| row.order.as_str()),
        worst_of(all, "scene", |row| row.scene),
        table.0
    )
}

/// How far quartiles are from medians.
fn noise(all: &[Row]) -> String {
    let ratios = all.iter().filter(|row| !row.is_cut_short).filter_map(Row::by_ray_by_ray);
    let mut halves: Vec<_> = ratios.map(|it| 50.0 * (it.high - it.low) / it.middle).collect();
    halves.sort_by(f64::total_cmp);
    let at = |share: f64| halves.get((halves.len() as f64 * share) as usize).copied();
    let [Some(half), Some(most)] = [0.5, 0.9].map(at) else { return String::new() };
    format!(
        "The quartiles of half of the ratios are within {half:.1} % of the median, of nine in ten within {most:.1} %. "
    )
}

/// How many rows are below the limits, level by level.
fn summary(all: &[Row]) -> String {
    let [best, alone, said, embree] = RATIOS.map(|(_, limit)| limit);
    let mut table = Table::new(
        1,
        &format!(
            "level | rows | below {best} of the best | below {alone} of ray by ray | \
             said coherent: below {said} of ray by ray | below {embree} times Embree"
        ),
    );
    let of = |name: &str, is_it: &dyn Fn(&Row) -> bool| {
        let rows = all.iter().filter(|row| is_it(row));
        [name.to_owned(), rows.clone().count().to_string()].into_iter().chain(below(&rows))
    };
    for level in LevelName::ALL.into_iter().rev() {
        if all.iter().any(|row| row.level == level) {
            table.row(of(level.as_str(), &|row| row.level == level));
        }
    }
    table.row(of("all", &|_| true));
    table.0
}

/// Where each traversal is furthest ahead of the others.
fn leads(all: &[Row]) -> String {
    let mut table = Table::new(3, "traversal | query | level | where | times as fast | as");
    for way in Way::TRAVERSALS {
        for query in Query::ALL {
            for level in LevelName::ALL.into_iter().rev() {
                let rows = all.iter().filter(|row| row.query == query && row.level == level);
                let leads = rows.filter_map(|row| Some((row, row.lead(way)?)));
                let furthest = leads
                    .max_by(|(_, (one, _)), (_, (other, _))| one.middle.total_cmp(&other.middle));
                let Some((row, (lead, next))) = furthest else { continue };
                table.row([
                    way.as_str().to_owned(),
                    query_name(query).to_owned(),
                    level.as_str().to_owned(),
                    format!("{}, {}", row.scene, row.order.as_str()),
                    format!("{lead}"),
                    next.as_str().to_owned(),
                ]);
            }
        }
    }
    format!("Where each traversal is furthest ahead of the best of the others:\n\n{}", table.0)
}

/// The worst row of each name.
fn worst_of(all: &[Row], what: &str, name: impl Fn(&Row) -> &'static str) -> String {
    let mut names = Vec::new();
    for row in all {
        if !names.contains(&name(row)) {
            names.push(name(row));
        }
    }
    let mut table = Table::new(
        1,
        &format!(
            "{what} | worst by the best way | by ray by ray | said coherent, by ray by ray | times Embree | \
             rows below {} | {} | {} | {}",
            RATIOS[0].1, RATIOS[1].1, RATIOS[2].1, RATIOS[3].1
        ),
    );
    for of in names {
        let rows = all.iter().filter(|row| name(row) == of);
        let worst = RATIOS.map(|(ratio, _)| {
            let worst = middles(rows.clone(), ratio).fold(f64::INFINITY, f64::min);
            cell(worst.is_finite().then(|| format!("{worst:.3}")))
        });
        table.row([of.to_owned()].into_iter().chain(worst).chain(below(&rows)));
    }
    format!("The worst of every {what}:\n\n{}", table.0)
}
