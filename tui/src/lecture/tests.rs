//! Every station at every size, and its numbers against the kernel's.

mod light;
mod names;
mod orders;
mod room;

use super::canvas::Canvas;
use super::frame::{LEAST, page};
use super::station::{Numbers, Station, Turn, decimals};
use super::stations::{STATIONS, station};
use crate::style::{ColorDepth, Style};
use spherule_kernel::{
    Accuracy, Exact, Fast, Geometric, Intersect, Ray, Sphere, SphereList, Tier, Vec3, roots,
};
use std::collections::HashSet;

const TURNS: [Turn; 4] = [Turn::Left, Turn::Right, Turn::Up, Turn::Down];

/// Arrows, and those that lead back.
pub(super) const BACK: [(Turn, Turn); 4] = [
    (Turn::Left, Turn::Right),
    (Turn::Right, Turn::Left),
    (Turn::Up, Turn::Down),
    (Turn::Down, Turn::Up),
];

fn named(name: &str) -> &'static Station {
    &STATIONS[station(name).expect("a station")]
}

fn text(station: &Station, numbers: Numbers) -> String {
    let mut canvas = Canvas::new(LEAST.0 - 2, LEAST.1 - 6, Style::PLAIN);
    station.show(numbers, &mut canvas);
    canvas.into_cells().lines().join("\n")
}

#[test]
fn every_station_draws_at_every_size() {
    for (index, station) in STATIONS.iter().enumerate() {
        let mut numbers = station.first();
        for turns in 0..4 {
            for size in [(80, 24), (200, 60), (20, 5), (1, 1), (81, 25), (300, 24), (80, 200)] {
                let depth = if turns % 2 == 0 { ColorDepth::Never } else { ColorDepth::Ansi256 };
                let page = page(index, numbers, turns == 3, size, Style { depth, ..Style::PLAIN });
                assert_eq!((page.columns(), page.rows()), size);
                if size.0 >= LEAST.0 && size.1 >= LEAST.1 {
                    let drawn = page.cells().iter().filter(|cell| cell.glyph != ' ').count();
                    assert!(drawn > 300, "{}: {drawn}", station.name);
                }
            }
            for turn in TURNS.iter().cycle().skip(turns).take(turns % 3 + 1) {
                numbers = station.turned(numbers, *turn);
            }
        }
    }
}

#[test]
fn without_colour_there_is_none_and_every_character_is_ascii() {
    for (index, station) in STATIONS.iter().enumerate() {
        let page = page(index, station.first(), true, LEAST, Style::PLAIN);
        for cell in page.cells() {
            assert!(cell.glyph == ' ' || cell.glyph.is_ascii_graphic(), "{}", station.name);
            let colors = [cell.foreground, cell.background];
            assert_eq!(colors, [crate::cells::Color::Default; 2], "{}", station.name);
        }
    }
}

#[test]
fn every_arrow_changes_what_is_shown() {
    for station in &STATIONS {
        let first = text(station, station.first());
        assert_eq!(first, text(station, station.first()), "{}", station.name);
        for (turn, back) in BACK {
            // Some arrows have nowhere to go at first.
            let numbers = station.turned(station.first(), back);
            let after = station.turned(numbers, turn);
            assert_ne!(text(station, numbers), text(station, after), "{} {turn:?}", station.name);
        }
    }
}

/// Nothing that a person types takes a station out of its bounds.
#[test]
fn arrows_held_down_end_somewhere() {
    for station in &STATIONS {
        for turn in TURNS {
            let mut numbers = station.first();
            for _ in 0..5000 {
                numbers = station.turned(numbers, turn);
            }
            assert!(text(station, numbers).len() > 300, "{} {turn:?}", station.name);
        }
    }
}

#[test]
fn a_row_up_or_down_stays_in_its_column() {
    let station = named("image-order");
    for turn in [Turn::Up, Turn::Down] {
        let held = (0..50).fold(station.first(), |numbers, _| station.turned(numbers, turn));
        assert_eq!((held[0] - station.first()[0]) % 20, 0, "{turn:?}: {held:?}");
    }
}

#[test]
fn what_is_rounded_to_zero_has_no_sign() {
    for (x, text) in [(-0.0004, "0.000"), (-0.0, "0.000"), (0.0004, "0.000"), (-0.0006, "-0.001")] {
        assert_eq!(decimals(x), text);
    }
}

/// What is shown as arrows are held down, each so many times.
fn many(name: &str, held: &[(Turn, usize)]) -> Vec<String> {
    let station = named(name);
    let mut numbers = station.first();
    let mut texts = vec![text(station, numbers)];
    for &(turn, times) in held {
        for _ in 0..times {
            numbers = station.turned(numbers, turn);
            texts.push(text(station, numbers));
        }
    }
    let distinct: HashSet<_> = texts.iter().collect();
    assert!(distinct.len() > 20, "{name}: {}", distinct.len());
    texts
}

/// Arrows that turn the ray all around, from every origin: outside, inside and behind.
const AROUND: [(Turn, usize); 8] = [
    (Turn::Up, 90),
    (Turn::Right, 5),
    (Turn::Down, 90),
    (Turn::Right, 6),
    (Turn::Up, 90),
    (Turn::Right, 8),
    (Turn::Down, 90),
    (Turn::Left, 20),
];

/// What follows `name` in a text, up to a gap; `None` if it is not there.
fn value<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let rest = &text[text.find(name)? + name.len()..];
    let line = rest.lines().next()?;
    Some(line.split("  ").next()?.trim())
}

fn number(text: &str, name: &str) -> Option<f32> {
    value(text, name)?.parse().ok()
}

fn flat(text: &str, name: &str) -> Vec3 {
    let pair = value(text, name).and_then(|pair| pair.strip_prefix('(')?.strip_suffix(')'));
    let mut axes = pair.expect(name).split(", ").map(|x| x.parse().expect("a number"));
    Vec3::new(axes.next().expect("x"), axes.next().expect("y"), 0.0)
}

/// Ray and sphere of the numbers that are shown, as seen from the centre.
fn shown(text: &str) -> (Ray, Sphere) {
    let radius = number(text, "r = ").expect("a radius");
    let ray = Ray::new(flat(text, "p - c = "), flat(text, "d = "));
    (ray, Sphere { center: Vec3::ZERO, radius })
}

fn shown_roots(text: &str) -> Option<[f32; 2]> {
    Some([number(text, "t1 = ")?, number(text, "t2 = ")?])
}

/// Asserts that a form shows the roots of a tier, whether there are any or not; `check` gets each text with its roots.
fn shows_the_roots_of(tier: impl Accuracy, name: &str, check: impl Fn(&str, Option<[f32; 2]>)) {
    let mut seen = [0; 2];
    for text in many(name, &AROUND) {
        let (ray, sphere) = shown(&text);
        let found = shown_roots(&text);
        assert_eq!(found, roots(tier, &ray, &sphere), "{text}");
        seen[usize::from(found.is_some())] += 1;
        check(&text, found);
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

#[test]
fn the_algebraic_form_shows_the_kernels_numbers() {
    shows_the_roots_of(Fast, "algebraic", |text, found| {
        // The parts are those of the formula: they lead to the same bits.
        let [dd, dp, c] =
            ["d.d = ", "d.p = ", "p.p - r^2 = "].map(|name| number(text, name).expect(name));
        assert_eq!(number(text, "  = "), Some(dp * dp - dd * c), "{text}");
        if let Some(both) = found {
            let root = (dp * dp - dd * c).sqrt();
            assert_eq!(both, [(-dp - root) * (1.0 / dd), (-dp + root) * (1.0 / dd)]);
        }
    });
}

#[test]
fn the_geometric_form_shows_the_kernels_numbers() {
    shows_the_roots_of(Geometric, "geometric", |text, found| {
        let middle = number(text, "t_m = -p.v = ").expect("t_m");
        let length = number(text, "|d| = ").expect("|d|");
        if let Some(both) = found {
            let half = number(text, "dt = sqrt(r^2 - l^2) = ").expect("dt");
            assert_eq!(both, [middle - half, middle + half].map(|t| t * (1.0 / length)));
        }
    });
}

/// Arrows that lead either end past both roots.
const ENDS: [(Turn, usize); 5] =
    [(Turn::Right, 25), (Turn::Down, 40), (Turn::Left, 40), (Turn::Up, 12), (Turn::Right, 20)];

#[test]
fn the_interval_shows_the_kernels_answer() {
    let mut answers = HashSet::new();
    for text in many("interval", &ENDS) {
        let [t_min, t_max] = ["t_min = ", "t_max = "].map(|name| number(&text, name).expect(name));
        let ray = Ray { t_min, t_max, ..Ray::new(flat(&text, "p = "), flat(&text, "d = ")) };
        let radius = number(&text, "r = ").expect("a radius");
        let sphere = Sphere { center: flat(&text, "c = "), radius };
        assert_eq!(shown_roots(&text), roots(Exact, &ray, &sphere), "{text}");
        let answer = number(&text, "= a hit at t = ");
        let expected = SphereList::from([sphere]).closest_hit(Exact, &ray).map(|hit| hit.t);
        assert_eq!(answer, expected, "{text}");
        assert_eq!(answer.is_some(), !text.contains("= no hit"), "{text}");
        assert_eq!(answer.is_some(), text.contains("does it hit at all? yes"), "{text}");
        answers.insert(answer.map(f32::to_bits));
    }
    assert_eq!(answers.len(), 3, "near, far and none");
}

#[test]
fn a_power_of_two_keeps_every_bit_of_the_picture() {
    let station = named("scaling");
    for turn in [Turn::Left, Turn::Right] {
        let mut numbers = station.first();
        for _ in 0..30 {
            let text = text(station, numbers);
            assert!(text.contains("0 of 162 bytes differ, 0 of 162 pixels"), "{text}");
            numbers = station.turned(numbers, turn);
        }
    }
}

#[test]
fn the_tiers_are_wrong_where_they_are() {
    let station = named("precision");
    let text = text(station, station.first());
    let table = &text[text.find("decided wrongly:").expect("the table")..];
    let wrong = Tier::ALL.map(|tier| {
        let row = table.lines().find_map(|line| line.split_once(tier.as_str())).expect("a row").1;
        let counts =
            row.split_whitespace().take(3).map(|count| count.parse::<u64>().expect("a count"));
        counts.sum::<u64>()
    });
    let [fast, geometric, stable, exact] = wrong;
    assert!(fast > 10 && geometric > 10 && stable == 0 && exact == 0, "{wrong:?}\n{text}");
}

#[test]
fn stations_have_numbers_and_names() {
    for (index, station) in STATIONS.iter().enumerate() {
        assert_eq!(super::stations::station(station.name), Ok(index));
        assert_eq!(super::stations::station(&(index + 1).to_string()), Ok(index));
    }
    for none in ["0", "15", "-1", "", "triangles"] {
        assert!(station(none).is_err(), "{none}");
    }
}
