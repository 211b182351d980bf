//! Where single precision ends, and what `Exact` does about it.

use crate::compare::verdict::{Verdict, tally};
use crate::lecture::canvas::{Canvas, Role};
use crate::lecture::station::{Knob, Numbers, Source, Station, number};
use crate::scene::Scene;
use crate::scene::builtin::builtin;
use crate::tally::{Class, Summary};
use spherule_kernel::{Hit, Intersect, Ray, Tier};

pub(super) const STATION: Station = Station {
    name: "precision",
    title: "where f32 ends, and what exact does",
    topic: "forms in floats",
    words: [
        "At 1000 radii, p.p - r^2 keeps four bits of r^2: both forms of the lecture",
        "decide wrongly. Stable rearranges; exact goes on until the decision is proven.",
    ],
    arrows: "left, right: a ray that is wrong   up, down: tier",
    sources: &[
        Source { file: "tui/scenes/edge.toml", symbols: &["sphere"] },
        Source { file: "kernel/src/accuracy/exact.rs", symbols: &["Exact"] },
        Source { file: "kernel/src/accuracy/stable.rs", symbols: &["Stable"] },
        Source { file: "tui/src/compare/verdict.rs", symbols: &["Verdict", "tally"] },
        Source { file: "tui/src/tally.rs", symbols: &["Tally", "ulp_between"] },
    ],
    knobs: [
        Knob::within(0, [1, 0], [i32::MIN, i32::MAX]),
        Knob::around(0, [0, -1], Tier::ALL.len() as i32),
    ],
    text: 37,
    draw,
};

/// Which of the rays that fast or geometric gets wrong is chosen, and which tier's picture is
/// shown.
fn draw([index, tier]: Numbers, canvas: &mut Canvas) -> String {
    let scene = builtin("edge").unwrap_or_default();
    let tier = tier as usize;
    let (width, height) = (canvas.columns() - STATION.text, canvas.rows() - 1);
    let rays = rays(&scene, canvas, width as u32, height as u32);
    let hits = Tier::ALL.map(|tier| {
        let mut hits = vec![None; rays.len()];
        scene.list().closest_hits(tier, &rays, &mut hits);
        hits
    });
    let [fast, geometric, _, exact] = &hits;
    let class = |hits: &[Option<Hit>], ray: usize| {
        Verdict::of(&rays[ray], scene.spheres(), hits[ray], exact[ray]).class
    };
    let wrong: Vec<usize> = (0..rays.len())
        .filter(|&ray| {
            [fast, geometric].into_iter().any(|hits| class(hits, ray) >= Class::OtherRoot)
        })
        .collect();
    let chosen = match wrong.len() {
        0 => 0,
        count => wrong[index.rem_euclid(count as i32) as usize],
    };

    let shown = &hits[tier];
    for ray in 0..rays.len() {
        let (column, row) = (ray as i32 % width, ray as i32 / width);
        let (glyph, role) = sign(class(shown, ray));
        canvas.put(column, row, glyph, role);
    }
    let (column, row) = (chosen as i32 % width, chosen as i32 / width);
    canvas.put(column - 1, row, '[', Role::Plain);
    canvas.put(column + 1, row, ']', Role::Plain);
    let name = Tier::ALL[tier].as_str();
    let legend = format!("{name}: # hit  wrong: + hit, - miss, x sphere");
    canvas.write(0, height, &legend, Role::Faint);

    let of_rays = Tier::ALL.iter().zip(&hits).map(|(tier, hits)| of_ray(*tier, hits[chosen]));
    let of_all = Tier::ALL.iter().zip(&hits).map(|(tier, hits)| {
        let [answers, truths] = [hits, exact].map(|hits| hits.iter().copied());
        let judged = tally(rays.iter().copied(), scene.spheres(), answers, truths);
        of_all(*tier, &judged.summary())
    });
    format!(
        "\
[ ] ray {chosen} by every tier
tier      sphere t         as bits
{}
of all {} rays, decided wrongly:
tier       hit miss sphere max ulp
{}
hit: a hit that is a miss in truth.
sphere: another, or its other root.
ulp: steps of f32 from the right t.",
        of_rays.collect::<String>(),
        rays.len(),
        of_all.collect::<String>()
    )
}

/// One ray a cell.
fn rays(scene: &Scene, canvas: &Canvas, width: u32, height: u32) -> Vec<Ray> {
    let aspect = canvas.style().picture_aspect(width as u16, height as u16);
    let camera = scene.first_view(aspect as f32).camera(width, height, aspect);
    (0..width * height).map(|ray| camera.get_ray(ray % width, ray / width)).collect()
}

/// A right decision or a wrong one.
fn sign(class: Class) -> (char, Role) {
    match class {
        Class::Miss => (' ', Role::Plain),
        Class::FalseHit => ('+', Role::Wrong),
        Class::LostHit => ('-', Role::Wrong),
        Class::OtherSphere | Class::OtherRoot => ('x', Role::Wrong),
        Class::Right | Class::Off(_) => ('#', Role::Sphere),
    }
}

fn of_ray(tier: Tier, hit: Option<Hit>) -> String {
    match hit {
        Some(Hit { t, sphere }) => {
            format!("{:<9} {sphere:>6} {:<9} {:08x}\n", tier.as_str(), number(t), t.to_bits())
        }
        None => format!("{:<9}      - miss\n", tier.as_str()),
    }
}

fn of_all(tier: Tier, summary: &Summary) -> String {
    let Summary { wrong_hits, wrong_misses, wrong_places, .. } = summary;
    let ulp = summary.ulp.map_or(0, |ulp| ulp.max);
    format!("{:<9} {wrong_hits:>4} {wrong_misses:>4} {wrong_places:>6} {ulp:>7}\n", tier.as_str())
}
