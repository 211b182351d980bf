//! `--show error`: letters where a tier is wrong, and counts against the kernel's answers, ray by ray. `--show split`:
//! halves against whole pictures.

use crate::run::{is_of_size, json, prints};
use spherule::draw::sample_grid;
use spherule::scene::builtin::builtin;
use spherule::style::Style;
use spherule::tally::ulp_between;
use spherule_kernel::{Exact, Intersect, Tier, roots};

fn shown(words: &str) -> String {
    prints(&format!("--show error --once {words}"))
}

/// The number behind `name` in the legend; 0 if it is not there.
fn count(text: &str, name: &str) -> u64 {
    // The most rows that it takes at this width.
    let legend: Vec<&str> = text.lines().rev().take(4).collect();
    let found = legend.iter().find_map(|line| line.split_once(&format!("{name} ")));
    found.map_or(0, |(_, rest)| {
        let number = rest.split_whitespace().next().expect("a number").replace(',', "");
        number.parse().unwrap_or_else(|_| panic!("{name}: {legend:?}"))
    })
}

/// The large spheres have rims of wrong decisions, and within them digits. After an intended change,
/// `cargo run -- --once edge --show error --accuracy fast --size 80x24 >tui/tests/golden/edge-fast-errors.txt` writes the
/// file anew; read the diff before committing it.
#[test]
fn fast_is_wrong_at_the_rims_of_edge_and_letters_say_so() {
    assert_eq!(shown("edge --accuracy fast"), include_str!("../golden/edge-fast-errors.txt"));
    for lens in ["perspective", "parallel"] {
        let text = shown(&format!("edge --accuracy fast --size 100x23 --projection {lens}"));
        assert!(text.contains(" worst: sphere "), "{text}");
    }
}

#[test]
fn exact_is_all_right() {
    for scene in ["edge", "marbles", "flake"] {
        let text = shown(scene);
        let cells = text.lines().take(22).collect::<String>();
        assert!(cells.chars().all(|letter| " .".contains(letter)) && cells.contains('.'), "{text}");
        assert!(text.contains(" exact: all right, it is the truth "));
    }
}

/// Legend against a loop over the same rays: the list's answers, one ray at a time.
#[test]
fn the_counts_are_those_of_a_loop() {
    let (columns, rows) = (200, 24);
    for (scene, tier, options) in [
        ("edge", Tier::Fast, ""),
        ("edge", Tier::Geometric, "--samples 3"),
        ("far", Tier::Stable, ""),
        ("marbles", Tier::Fast, "--projection parallel"),
    ] {
        let words = format!(
            "{scene} --accuracy {} --size {columns}x{rows} --structure brute {options}",
            tier.as_str()
        );
        let text = shown(&words);
        let samples = options.strip_prefix("--samples ").and_then(|number| number.parse().ok());
        let style = Style { samples, ..Style::PLAIN };
        let scene = builtin(scene).expect("a scene");
        let mut view = scene.first_view(style.picture_aspect(columns, rows) as f32);
        if options.contains("parallel") {
            view = spherule::view::with_projection(&view, spherule::view::LensKind::Parallel);
        }
        let (camera, width, height) = sample_grid(&view, &style, columns, rows);
        let spheres = scene.spheres();
        let [mut right, mut other, mut wrong, mut lost, mut root, mut off] = [0_u64; 6];
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let ray = camera.get_ray(x, y);
            match (spheres.closest_hit(tier, &ray), spheres.closest_hit(Exact, &ray)) {
                (None, None) => {}
                (Some(_), None) => wrong += 1,
                (None, Some(_)) => lost += 1,
                (Some(found), Some(truth)) if found.sphere != truth.sphere => other += 1,
                (Some(found), Some(truth)) if ulp_between(found.t, truth.t) == 0 => right += 1,
                (Some(found), Some(truth)) => {
                    let sphere = spheres.get(truth.sphere as usize).expect("it was hit");
                    let [near, far] = roots(Exact, &ray, &sphere).expect("it was hit");
                    let (center, direction) = (sphere.center.as_dvec3(), ray.direction.as_dvec3());
                    let middle = (center - ray.origin.as_dvec3()).dot(direction);
                    let past = f64::from(found.t) * direction.length_squared() - middle;
                    let past = if truth.t == near { past } else { -past };
                    *(if near < far && past > 0.0 { &mut root } else { &mut off }) += 1;
                }
            }
        }
        let rounded: u64 =
            ["1+", "2+", "4+", "16+", "256+", "65536+"].map(|from| count(&text, from)).iter().sum();
        let long = ["another sphere", "false hit", "lost hit", "other root", "right"];
        let said = long.map(|name| count(&text, name));
        assert_eq!((said, rounded), ([other, wrong, lost, root, right], off), "{words}\n{text}");
        assert!(rounded + other + wrong > 0, "{words}");
    }
}

/// The three columns of `tradeoff` are the kinds that a map of the same rays counts: a hit at the other root is at a wrong place.
#[test]
fn tradeoff_counts_as_wrong_what_a_map_does() {
    for samples in ["--samples 64", ""] {
        let rays = format!("edge {samples} --size 80x24 --structure brute");
        let map = shown(&format!("{rays} --accuracy fast"));
        let [spheres, hits, misses, roots] =
            ["S sphere", "F false", "L lost", "R root"].map(|name| count(&map, name));
        assert!(roots > 0, "{map}");
        let report = json(&format!("tradeoff --json {rays}"));
        let fast = &report["tiers"][0];
        assert_eq!((&fast["accuracy"], &fast["rays_kind"]), (&"fast".into(), &"camera".into()));
        let wrong = ["wrong_hits", "wrong_misses", "wrong_sphere"];
        let wrong = wrong.map(|key| fast[key].as_u64().expect(key));
        assert_eq!(wrong, [hits, misses, spheres + roots], "{map}");
    }
}

#[test]
fn every_size_and_depth() {
    for size in ["1x1", "2x3", "3x4", "1x9", "80x24", "301x70"] {
        for color in ["never", "16", "256", "truecolor"] {
            for charset in ["ascii", "half", "braille"] {
                let words = format!("edge --accuracy fast --size {size}");
                let text = shown(&format!("{words} --color {color} --charset {charset}"));
                let rows = text.lines().count();
                assert!(size.ends_with(&format!("x{rows}")), "{size} {color} {charset}");
                assert_eq!(text.contains('\x1b'), color != "never", "{size} {color} {charset}");
            }
        }
    }
}

/// Left of the seam the picture of one tier, right of it that of the other; the last two rows are figures.
#[test]
fn a_split_is_two_halves_of_two_pictures() {
    for more in
        ["--charset half --color truecolor", "--charset octant --color 256", "--charset ascii"]
    {
        for scene in ["edge", "marbles"] {
            let words = format!("{scene} --once --size 61x20 {more}");
            let cells = |options: &str| {
                let text = prints(&format!("{words} {options}"));
                let [rows, columns] = [21_u16, 61].map(|count| count.try_into().expect("not 0"));
                let mut terminal = vt100::Parser::new(rows, columns, 0);
                terminal.process(text.replace('\n', "\r\n").as_bytes());
                let cell = |row, column| {
                    let cell = terminal.screen().cell(row, column).expect("a cell");
                    let glyph = cell.contents().to_owned();
                    // The ink of a space cannot be seen.
                    let ink = if glyph == " " { vt100::Color::Default } else { cell.fgcolor() };
                    (glyph, ink, cell.bgcolor())
                };
                (0..18).map(|row| (0..61).map(|column| cell(row, column)).collect()).collect()
            };
            let split: Vec<Vec<_>> = cells("--show split:fast,exact");
            let [fast, exact]: [Vec<Vec<_>>; 2] =
                ["--accuracy fast", "--accuracy exact"].map(cells);
            let mut differ = 0;
            for row in 0..18 {
                assert!(["│", "|"].contains(&&*split[row][30].0), "{:?}", split[row][30]);
                let left = (0..30).filter(|&column| split[row][column] != fast[row][column]);
                let right = (31..61).filter(|&column| split[row][column] != exact[row][column]);
                differ += left.count() + right.count();
            }
            // Letters are chosen beside each other, and so beside the seam.
            let least = if more.contains("ascii") { 40 } else { 0 };
            assert!(differ <= least, "{words}: {differ}");
            if scene == "edge" {
                let other = (0..18).flat_map(|row| (0..30).map(move |column| (row, column)));
                assert!(other.filter(|&(r, c)| split[r][c] != exact[r][c]).count() > 20);
            }
        }
    }
}

/// Counts of both halves are those of an error map of the whole, less the seam; nothing is timed.
#[test]
fn the_figures_of_a_split() {
    let split = |words: &str| {
        prints(&format!("edge --once --size 120x24 --structure brute --show {words}"))
    };
    let text = split("split:fast,fast");
    assert_eq!(text, split("split:algebraic,fast --threads 1"));
    assert_eq!(text, split("split:fast,fast --threads 7"));
    let figures = text.lines().last().expect("figures");
    let (left, right) = (&figures[..60], &figures[61..]);
    let number = |half: &str| -> u64 {
        let word = half.trim_start().strip_prefix("wrong ").expect("a count");
        let number = word.split(' ').next().expect("a number").replace(',', "");
        number.parse().expect("a number")
    };
    let whole = split("error --accuracy fast");
    let whole =
        ["another sphere", "false hit", "lost hit", "other root"].map(|name| count(&whole, name));
    let (sum, whole) = (number(left) + number(right), whole.iter().sum::<u64>());
    assert!(
        number(left) > 100 && number(right) > 100 && sum <= whole && sum + 96 >= whole,
        "{text}"
    );
    assert!(!text.contains("f64") && !text.contains("sums"), "{text}");
    let exact = split("split:fast,exact");
    let right = &exact.lines().last().expect("figures")[61..];
    assert!(right.starts_with(" wrong 0 of ") && right.contains(" f64 "), "{exact}");
    assert!(right.trim_end().ends_with('%') && !right.contains("f64 0.0%"), "{exact}");
}

#[test]
fn a_split_of_every_size() {
    for size in ["1x1", "2x1", "1x9", "2x5", "3x4", "301x40"] {
        let text = prints(&format!("edge --show split:stable,exact --once --size {size}"));
        assert!(is_of_size(&text, size), "{size}");
    }
}
