//! Where single precision ends, and what `Exact` does about it.

use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::station::{Entry, Source, Station, Turn, number};
use crate::scene::Scene;
use crate::scene::builtin::builtin;
use crate::tally::{Summary, Tally};
use spherule_kernel::{Hit, Intersect, Ray, Tier};

pub(super) const ENTRY: Entry = Entry {
    name: "precision",
    title: "where f32 ends, and what exact does",
    topic: "forms in floats",
    words: [
        "From 1000 radii away, p.p - r^2 loses r in rounding: both forms of the lecture",
        "decide wrongly. Stable rearranges; exact goes on until the decision is proven.",
    ],
    arrows: "left, right: a ray that is wrong   up, down: tier",
    sources: &[
        Source { file: "tui/scenes/edge.toml", symbols: &["sphere"] },
        Source { file: "kernel/src/accuracy/exact.rs", symbols: &["Exact"] },
        Source { file: "kernel/src/accuracy/stable.rs", symbols: &["Stable"] },
        Source { file: "tui/src/tally.rs", symbols: &["Tally", "ulp_between"] },
    ],
    start: || {
        let scene = builtin("edge").unwrap_or_default();
        Box::new(Precision { scene, index: 0, tier: 0 })
    },
};

/// Columns of the text.
const TEXT: i32 = 37;

struct Precision {
    scene: Scene,
    /// Which of the rays that fast or geometric gets wrong.
    index: i32,
    /// Whose picture it is.
    tier: usize,
}

impl Station for Precision {
    fn turn(&mut self, turn: Turn) {
        let (right, up) = turn.steps();
        self.index = self.index.wrapping_add(right);
        let count = Tier::ALL.len() as i32;
        self.tier = (self.tier as i32 - up).rem_euclid(count) as usize;
    }

    fn draw(&self, canvas: &mut Canvas) {
        let (width, height) = (canvas.columns() - TEXT, canvas.rows() - 1);
        let rays = self.rays(canvas, width as u32, height as u32);
        let hits = Tier::ALL.map(|tier| {
            let mut hits = vec![None; rays.len()];
            self.scene.list().closest_hits(tier, &rays, &mut hits);
            hits
        });
        let [fast, geometric, _, exact] = &hits;
        let wrong: Vec<usize> = (0..rays.len())
            .filter(|&ray| [fast, geometric].iter().any(|hits| is_wrong(hits[ray], exact[ray])))
            .collect();
        let chosen = match wrong.len() {
            0 => 0,
            count => wrong[self.index.rem_euclid(count as i32) as usize],
        };

        let shown = &hits[self.tier];
        for ray in 0..rays.len() {
            let (column, row) = (ray as i32 % width, ray as i32 / width);
            let (glyph, role) = sign(shown[ray], exact[ray]);
            canvas.put(column, row, glyph, role);
        }
        let (column, row) = (chosen as i32 % width, chosen as i32 / width);
        canvas.put(column - 1, row, '[', Role::Plain);
        canvas.put(column + 1, row, ']', Role::Plain);
        let name = Tier::ALL[self.tier].as_str();
        let legend = format!("{name}: # hit  wrong: + hit, - miss, x sphere");
        canvas.write(0, height, &legend, Role::Faint);

        let mut lines = vec![
            format!("[ ] ray {chosen} by every tier"),
            "tier      sphere t         as bits".to_owned(),
        ];
        lines.extend(Tier::ALL.iter().zip(&hits).map(|(tier, hits)| of_ray(*tier, hits[chosen])));
        lines.extend([
            String::new(),
            format!("of all {} rays, decided wrongly:", rays.len()),
            "tier       hit miss sphere max ulp".to_owned(),
        ]);
        lines.extend(Tier::ALL.iter().zip(&hits).map(|(tier, hits)| {
            of_all(*tier, &Tally::of(hits.iter().copied(), exact.iter().copied()).summary())
        }));
        lines.extend([
            String::new(),
            "hit: a hit that is a miss in truth.".to_owned(),
            "ulp: steps of f32 between its t".to_owned(),
            "and the right one, where it hits.".to_owned(),
        ]);
        canvas.write_lines(canvas.columns() - TEXT + 1, 0, lines);
    }
}

impl Precision {
    /// One ray a cell.
    fn rays(&self, canvas: &Canvas, width: u32, height: u32) -> Vec<Ray> {
        let aspect = canvas.style().picture_aspect(width as u16, height as u16);
        let camera = self.scene.first_view(aspect as f32).camera(width, height, aspect);
        (0..width * height).map(|ray| camera.get_ray(ray % width, ray / width)).collect()
    }
}

fn is_wrong(answer: Option<Hit>, truth: Option<Hit>) -> bool {
    answer.map(|hit| hit.sphere) != truth.map(|hit| hit.sphere)
}

/// A right decision or a wrong one.
fn sign(answer: Option<Hit>, truth: Option<Hit>) -> (char, Role) {
    match (answer, truth) {
        (None, None) => (' ', Role::Plain),
        (Some(_), None) => ('+', Role::Wrong),
        (None, Some(_)) => ('-', Role::Wrong),
        _ if is_wrong(answer, truth) => ('x', Role::Wrong),
        _ => ('#', Role::Sphere),
    }
}

fn of_ray(tier: Tier, hit: Option<Hit>) -> String {
    match hit {
        Some(Hit { t, sphere }) => {
            format!("{:<9} {sphere:>6} {:<9} {:08x}", tier.as_str(), number(t), t.to_bits())
        }
        None => format!("{:<9}      - miss", tier.as_str()),
    }
}

fn of_all(tier: Tier, summary: &Summary) -> String {
    let Summary { wrong_hits, wrong_misses, wrong_places, .. } = summary;
    let ulp = summary.ulp.map_or(0, |ulp| ulp.max);
    format!("{:<9} {wrong_hits:>4} {wrong_misses:>4} {wrong_places:>6} {ulp:>7}", tier.as_str())
}
