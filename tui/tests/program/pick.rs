//! `--pick`: worked by hand, and against the kernel's own door.

use crate::run::{self, file, printed, prints, run_with_input};
use serde_json::{Value, json};
use spherule::pick::cell_ray;
use spherule::scene::builtin::builtin;
use spherule::style::Style;
use spherule_kernel::{Intersect, Tier, discriminant, roots};

/// The unit sphere from (0, 0, 3), in parallel projection, in a picture of this height.
fn unit(name: &str, height: u8) -> String {
    let text = format!(
        "[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\nprojection = \"parallel\"\nheight = {height}\n\
         [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nlabel = \"the \\\"one\\\"\\n\"\n"
    );
    file(name, text)
}

fn picked(words: &str) -> Value {
    run::json(&format!("{words} --json"))
}

/// Three rows of a unit each: through the middle a = 1, D = 1, t = 3 -+ 1.
#[test]
fn the_unit_sphere_by_hand() {
    let path = unit("pick.toml", 3);
    let middle = picked(&format!("{path} --size 1x3 --pick 0,1"));
    assert_eq!(middle["scene"], json!(path));
    assert_eq!((&middle["size"], &middle["cell"]), (&json!([1, 3]), &json!([0, 1])));
    let ray = json!({ "origin": [0.0, 0.0, 3.0], "direction": [0.0, 0.0, -1.0] });
    assert_eq!(middle["ray"], ray);
    let sphere = json!({
        "index": 0, "label": "the \"one\"\n", "center": [0.0, 0.0, 0.0], "radius": 1.0,
    });
    assert_eq!(middle["sphere"], sphere);
    assert_eq!(middle["discriminant"]["value"], json!(1.0));
    let bound = middle["discriminant"]["bound"].as_f64().expect("a number");
    assert!(bound > 0.0 && bound < 1e-14, "{bound}");
    assert_eq!(middle["discriminant"]["decided_by"], json!("f64"));
    let tiers: Vec<Value> = ["fast", "geometric", "stable", "exact"]
        .map(|tier| {
            json!({
                "accuracy": tier, "sphere": 0, "t": 2.0, "t_bits": "0x40000000", "roots": [2.0, 4.0],
            })
        })
        .into();
    assert_eq!(middle["tiers"], Value::Array(tiers));
    assert_eq!(middle.as_object().map(serde_json::Map::len), Some(8));
}

/// The row above touches it, D = 0 and t = 3, which exact sums alone can tell.
#[test]
fn a_tangent_by_hand_for_people() {
    let path = unit("tangent.toml", 3);
    let text = prints(&format!("{path} --size 1x3 --pick 0,0"));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], format!("{path}, cell 0,0 of 1x3"));
    assert_eq!(lines[1], "ray (0.0, 1.0, 3.0) + t (0.0, 0.0, -1.0)");
    let sphere = "sphere 0 \"the \\\"one\\\"\\n\": centre (0.0, 0.0, 0.0), radius 1.0";
    assert_eq!(lines[2], sphere);
    assert!(lines[3].starts_with("D = 0.0 +- "), "{}", lines[3]);
    assert!(lines[3].ends_with("e-15, decided by expansion"), "{}", lines[3]);
    assert_eq!(
        lines[4..],
        [
            "tier       sphere  t    bits of t   roots",
            "fast       0       3.0  0x40400000  3.0    3.0",
            "geometric  0       3.0  0x40400000  3.0    3.0",
            "stable     0       3.0  0x40400000  3.0    3.0",
            "exact      0       3.0  0x40400000  3.0    3.0",
        ]
    );
}

/// Names are any text, of which a terminal may obey none.
#[test]
fn no_control_character_of_a_name_is_printed() {
    let text = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nlabel = \"\\u007f\\u009b31m\\u061c\\u202e\u{e9}\"\n";
    let path = file("turned\u{202e}\u{9b}.toml", text);
    let words = format!("{path} --size 1x1 --pick 0,0");
    for json in ["", "--json"] {
        let text = prints(&format!("{words} {json}"));
        assert!(text.contains('\u{e9}'), "{text:?}");
        for letter in ['\u{7f}', '\u{9b}', '\u{61c}', '\u{202e}'] {
            assert!(!text.contains(letter), "{letter:?} in {text:?}");
        }
    }
    let pick = picked(&words);
    assert_eq!(pick["scene"], json!(path));
    assert_eq!(pick["sphere"]["label"], json!("\u{7f}\u{9b}31m\u{61c}\u{202e}\u{e9}"));
}

#[test]
fn what_hits_nothing_says_so() {
    let path = unit("past.toml", 6);
    let text = prints(&format!("{path} --size 1x3 --pick 0,0"));
    let (head, nothing) = text.split_once('\n').expect("lines");
    assert!(head.ends_with("cell 0,0 of 1x3"), "{head}");
    assert_eq!(
        nothing,
        "ray (0.0, 2.0, 3.0) + t (0.0, 0.0, -1.0)\n\
         no sphere is hit, by fast, geometric, stable or exact\n"
    );
    let none = picked(&format!("{path} --size 1x3 --pick 0,0"));
    assert!(none["sphere"].is_null() && none["discriminant"].is_null(), "{none}");
    let tiers = none["tiers"].as_array().expect("a list");
    for tier in tiers {
        for key in ["sphere", "t", "t_bits", "roots"] {
            assert!(tier[key].is_null(), "{key}: {tier}");
        }
    }
    assert_eq!(tiers.len(), 4);
}

#[test]
fn a_picture_of_one_cell_and_both_projections() {
    let path = unit("cell.toml", 3);
    for projection in ["parallel", "perspective"] {
        for middle in ["--size 1x1 --pick 0,0", "--size 4095x4095 --pick 2047,2047"] {
            let pick = picked(&format!("{path} --projection {projection} {middle}"));
            assert_eq!(pick["tiers"][3]["t"], json!(2.0), "{projection} {middle}");
        }
    }
}

/// Scripts get the digits that people get.
#[test]
fn numbers_have_as_many_digits_as_they_need() {
    for words in ["edge --pick 9,6", "far --pick 40,12", "caffeine --pick 35,11"] {
        let text = prints(words);
        let json = prints(&format!("{words} --json"));
        let mut seen = 0;
        // Coordinates, a radius, and of every tier t and two roots; D and its bound are of double precision.
        for line in text.lines().filter(|line| !line.starts_with("D = ")) {
            let is_end = |c: char| !(c.is_ascii_digit() || "+-.e".contains(c));
            for number in line.split(is_end).filter(|word| word.contains('.')) {
                assert!(number.parse::<f32>().is_ok(), "{number} in {line}");
                let is_there = json.split([',', '[', ']', ':', '}']).any(|word| word == number);
                assert!(is_there, "{number} of {line:?} in {json}");
                seen += 1;
            }
        }
        assert!(seen > 15, "{text}");
    }
}

/// A number that was an `f32`.
fn single(number: &Value) -> Option<f32> {
    number.as_f64().map(|number| number as f32)
}

/// Cells of the scene against the kernel's list; in how many of them tiers differ.
fn against_the_kernel(name: &str, cells: &[(u16, u16)]) -> usize {
    let size = (80, 24);
    let scene = builtin(name).expect("a scene");
    let view = scene.first_view(Style::PLAIN.picture_aspect(80, 24) as f32);
    let mut differ = 0;
    for &cell in cells {
        let ray = cell_ray(&view, &Style::PLAIN, size, cell).expect("a cell");
        let words = format!("{name} --pick {},{} --structure", cell.0, cell.1);
        let pick = picked(&format!("{words} brute"));
        // The structure decides which false hits the lecture's forms owe; it does not change what `Exact` says.
        for structure in ["auto", "depth-list", "bvh"] {
            let by_it = picked(&format!("{words} {structure}"));
            assert_eq!(by_it["tiers"][3], pick["tiers"][3], "{structure}");
        }
        let picked = pick["sphere"]["index"].as_u64().map(|index| index as usize);
        let sphere = picked.and_then(|index| scene.spheres().get(index));
        let hits = Tier::ALL.map(|tier| scene.spheres().closest_hit(tier, &ray));
        for ((tier, hit), found) in
            Tier::ALL.into_iter().zip(hits).zip(pick["tiers"].as_array().expect("a list"))
        {
            assert_eq!(found["accuracy"], json!(tier.as_str()));
            assert_eq!(found["sphere"], json!(hit.map(|hit| hit.sphere)), "{cell:?} {tier:?}");
            assert_eq!(single(&found["t"]), hit.map(|hit| hit.t));
            let bits = hit.map(|hit| format!("0x{:08x}", hit.t.to_bits()));
            assert_eq!(found["t_bits"], json!(bits));
            let both = sphere.and_then(|sphere| roots(tier, &ray, &sphere));
            assert_eq!(
                [0, 1].map(|root| single(&found["roots"][root])),
                [0, 1].map(|root| Some(both?[root]))
            );
        }
        let d = sphere.and_then(|sphere| discriminant(&ray, &sphere));
        let said = pick["discriminant"]["value"].as_f64();
        assert_eq!(said.is_some(), d.is_some());
        if let (Some(said), Some((value, _))) = (said, d) {
            assert!((said - value).abs() <= 4e-16 * value.abs(), "{said}, not {value}");
        }
        if let Some(hit) = hits[3] {
            assert_eq!(picked, Some(hit.sphere as usize), "{cell:?}");
        }
        differ += usize::from(hits.iter().any(|hit| *hit != hits[3]));
    }
    differ
}

#[test]
fn marbles_and_edge_are_as_the_kernel_says() {
    let some = [(40, 12), (0, 0), (79, 23), (20, 8), (61, 15)];
    against_the_kernel("marbles", &some);
    let differ = against_the_kernel("edge", &[(40, 12), (9, 6), (20, 15), (30, 7), (70, 20)]);
    assert!(differ > 0, "edge is where tiers differ");
}

#[test]
fn a_file_of_xyz_from_standard_input() {
    let output = run_with_input("- --pick 0,0 --size 1x1 --json", b"1\n\nH 1 2 3\n");
    let pick: Value = serde_json::from_str(&printed(output)).expect("JSON");
    assert_eq!(pick["sphere"]["center"], json!([1.0, 2.0, 3.0]));
}
