//! What `spherule tradeoff` prints: a table for people, or the keys that scripts rely on.

use super::orders::Orders;
use crate::choice::name;
use crate::counted::counted;
use crate::harmless;
use crate::machine::RUSTC;
use crate::structure::object_order::Counts;
use crate::structure::{Order, Structure};
use crate::tally::{Summary, Ulp};
use serde_json::{Value, json};
use spherule_kernel::{LevelName, Stages, Tier};

/// Everything that was measured.
#[derive(Clone, Debug)]
pub struct Report {
    pub(super) spheres: usize,
    pub(super) cpu: String,
    /// Of the camera's rays and the spheres.
    pub(super) order: Order,
    pub(super) structure: Structure,
    pub(super) level: LevelName,
    pub(super) lanes: usize,
    pub(super) threads: usize,
    pub(super) orders: Orders,
    pub(super) tiers: Vec<TierReport>,
    /// Of every tier; `None` if the scene has no light.
    pub(super) lighting: Option<Vec<LightingErrors>>,
}

/// One tier on one kind of rays.
#[derive(Clone, Debug)]
pub(super) struct TierReport {
    pub(super) tier: Tier,
    pub(super) rays_kind: &'static str,
    pub(super) rays: usize,
    /// Of a pass over all rays.
    pub(super) seconds: f64,
    pub(super) errors: Summary,
    pub(super) stages: Stages,
}

impl TierReport {
    pub(super) fn ns_per_ray(&self) -> f64 {
        1e9 * self.seconds / self.rays as f64
    }

    /// Rays in a million whose closest hit differs from that of `Exact` by more than rounding; rounded up, so that none
    /// is lost.
    pub(super) fn wrong_in_a_million(&self) -> u64 {
        let Summary { wrong_hits, wrong_misses, wrong_places, .. } = self.errors;
        let wrong = wrong_hits + wrong_misses + wrong_places;
        (1_000_000 * wrong).div_ceil((self.rays as u64).max(1))
    }

    /// Rays a microsecond; 0 if a pass took no time that can be measured.
    fn mrays_per_s(&self) -> f64 {
        if self.seconds > 0.0 { self.rays as f64 / self.seconds / 1e6 } else { 0.0 }
    }

    /// `tests` as a share of all tests.
    fn share(&self, tests: u64) -> f64 {
        if self.stages.tests == 0 { 0.0 } else { tests as f64 / self.stages.tests as f64 }
    }
}

/// What is wrong with how a tier lights the points that rays hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LightingErrors {
    /// Rays that hit in truth as well as by the tier.
    pub(super) points: usize,
    /// Normals that differ by more than can be seen.
    pub(super) normals: usize,
    /// Pairs of a point and a light, lit by the tier or in truth, but not by both.
    pub(super) shadows: usize,
}

/// The number rounded to four significant digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}

impl Report {
    /// Spheres, and how they are searched.
    fn search(&self) -> String {
        let order = if self.order == Order::Object { "object order, " } else { "" };
        format!("{}, {order}{}", counted(self.spheres as u64, "sphere"), name(&self.structure))
    }

    fn thread_count(&self) -> String {
        counted(self.threads as u64, "thread")
    }

    /// What was searched, and by what, in a line.
    pub(super) fn search_and_machine(&self) -> String {
        format!("{}; {}, {}", self.search(), self.level.as_str(), self.thread_count())
    }

    /// One JSON object, of the `scene` of this name.
    #[must_use]
    pub fn json(&self, scene: &str) -> String {
        let tier = |tier: &TierReport| {
            json!({
                "accuracy": tier.tier.as_str(),
                "rays_kind": tier.rays_kind,
                "rays": tier.rays,
                "ns_per_ray": rounded(tier.ns_per_ray()),
                "ns_per_test": rounded(tier.ns_per_ray() / self.spheres as f64),
                "mrays_per_s": rounded(tier.mrays_per_s()),
                "wrong_hits": tier.errors.wrong_hits,
                "wrong_misses": tier.errors.wrong_misses,
                "wrong_sphere": tier.errors.wrong_places,
                "ulp_median": tier.errors.ulp.map(|ulp| ulp.median),
                "ulp_p999": tier.errors.ulp.map(|ulp| ulp.p999),
                "ulp_max": tier.errors.ulp.map(|ulp| ulp.max),
                "f64_share": tier.share(tier.stages.double),
                "expansion_share": tier.share(tier.stages.expansions),
            })
        };
        let report = json!({
            "scene": scene,
            "spheres": self.spheres,
            "cpu": self.cpu,
            "rustc": RUSTC,
            "level": self.level.as_str(),
            "lanes": self.lanes,
            "threads": self.threads,
            "order": name(&self.order),
            "structure": self.structure.in_reports(),
            "orders": {
                "image": counts(self.orders.image),
                "object": counts(self.orders.object),
            },
            "tiers": self.tiers.iter().map(tier).collect::<Vec<Value>>(),
            "lighting": self.lighting.as_ref().map(|errors| {
                let tiers = Tier::ALL.into_iter().zip(errors);
                tiers.map(|(tier, errors)| lighting(tier, *errors)).collect::<Vec<Value>>()
            }),
        });
        harmless::json(&report) + "\n"
    }

    /// A table, of the `scene` of this name.
    #[must_use]
    pub fn table(&self, scene: &str) -> String {
        let Self { cpu, lanes, .. } = self;
        let (search, level, threads) = (self.search(), self.level.as_str(), self.thread_count());
        // The name of a scene may be a file's, which may hold ends of lines.
        let scene = scene.escape_debug();
        let mut text =
            format!("{scene}: {search}\n{cpu}, {level}, {lanes} lanes, {threads}; {RUSTC}\n");
        let mut kind = "";
        for tier in &self.tiers {
            if tier.rays_kind != kind {
                kind = tier.rays_kind;
                text += &format!("\n{}\n", counted(tier.rays as u64, &format!("{kind} ray")));
                for words in HEAD {
                    text += &row(&words.map(str::to_owned));
                }
            }
            let ulp = |of: fn(Ulp) -> u64| {
                tier.errors.ulp.map_or_else(|| "-".to_owned(), |ulp| of(ulp).to_string())
            };
            text += &row(&[
                tier.tier.as_str().to_owned(),
                format!("{:.3}", tier.ns_per_ray()),
                format!("{:.4}", tier.ns_per_ray() / self.spheres as f64),
                format!("{:.1}", tier.mrays_per_s()),
                tier.errors.wrong_hits.to_string(),
                tier.errors.wrong_misses.to_string(),
                tier.errors.wrong_places.to_string(),
                ulp(|ulp| ulp.median),
                ulp(|ulp| ulp.p999),
                ulp(|ulp| ulp.max),
                format!("{:.4}", 100.0 * tier.share(tier.stages.double)),
                format!("{:.5}", 100.0 * tier.share(tier.stages.expansions)),
            ]);
        }
        let Orders { image, object } = self.orders;
        text += "\ncamera rays in both orders, by exact\n";
        text += "order               tests       writes  overwritten\n";
        for (order, Counts { tests, writes }) in [(Order::Image, image), (Order::Object, object)] {
            let (order, stored) = (name(&order), writes.stored);
            text += &format!("{order:<7}{tests:>18}{stored:>13}{:>13}\n", writes.overwritten);
        }
        if let Some(errors) = &self.lighting {
            text += "\npoints that tier and exact hit, and their lights\n";
            text += "                       wrong    wrong\n";
            text += "tier         points  normals  shadows\n";
            for (tier, LightingErrors { points, normals, shadows }) in
                Tier::ALL.into_iter().zip(errors)
            {
                text += &format!("{:<10}{points:>9}{normals:>9}{shadows:>9}\n", tier.as_str());
            }
        }
        text + FOOT
    }
}

fn counts(Counts { tests, writes }: Counts) -> Value {
    json!({ "tests": tests, "writes": writes.stored, "overwritten": writes.overwritten })
}

fn lighting(tier: Tier, errors: LightingErrors) -> Value {
    let LightingErrors { points, normals, shadows } = errors;
    let accuracy = tier.as_str();
    json!({ "accuracy": accuracy, "points": points, "wrong_normals": normals, "wrong_shadows": shadows })
}

/// A row of the table: the first column from the left, the others from the right.
fn row(words: &[String; 12]) -> String {
    let mut line = String::new();
    for (index, (word, width)) in words.iter().zip(WIDTHS).enumerate() {
        line += &if index == 0 { format!("{word:<width$}") } else { format!("{word:>width$}") };
    }
    line.trim_end().to_owned() + "\n"
}

/// The columns of the table, in two rows of words.
const HEAD: [[&str; 12]; 2] = [
    ["", "ns", "ns", "million", "wrong", "wrong", "wrong", "ulp of t", "", "", "% in", "% in"],
    [
        "tier", "a ray", "a test", "rays/s", "hits", "misses", "sphere", "median", "99.9%",
        "largest", "f64", "expans.",
    ],
];
/// How wide they are.
const WIDTHS: [usize; 12] = [10, 9, 9, 9, 10, 8, 8, 9, 9, 11, 9, 9];
const FOOT: &str = "
Wrong: the closest hit differs from that of exact, counted in rays; wrong sphere: another is met, or
the same at its other root. ulp: of t, where both meet the same sphere at the same root. Times are
medians of passes in turns, without the building of a structure, for shadow rays those of any hit. A
test is a ray and a sphere, whether a structure makes it or not. Shadow rays are those of exact; the
other tiers' own start farther from the surface. They are measured even if the scene's pictures cast
none. If there are many rays, only some of them have points. A normal is wrong if it differs by
1/256; a shadow if a point receives a light by one of both tiers alone. In image order every ray is
tested against every sphere, and writes its pixel once. In object order a sphere is tested against
the packets of rays in its bounds on the screen; a write is a hit that is stored.
";
