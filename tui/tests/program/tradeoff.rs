//! `spherule tradeoff`: its keys and its counts. `show.rs` has them against a map's.

use crate::run::{file, json, prints};
use serde_json::Value;
use spherule::scene::open;
use std::sync::LazyLock;

fn measured(words: &str) -> Value {
    json(&format!("tradeoff --json {words}"))
}

const TIERS: [&str; 4] = ["fast", "geometric", "stable", "exact"];

/// `edge` in 60 x 24 cells.
static EDGE: LazyLock<Value> = LazyLock::new(|| measured("edge --size 60x24"));

fn tier<'a>(report: &'a Value, accuracy: &str, kind: &str) -> &'a Value {
    let tiers = report["tiers"].as_array().expect("a list");
    let is = |tier: &&Value| tier["accuracy"] == accuracy && tier["rays_kind"] == kind;
    tiers.iter().find(is).expect("the tier")
}

/// How many hits, misses and spheres of a tier are wrong.
fn wrong(tier: &Value) -> [u64; 3] {
    ["wrong_hits", "wrong_misses", "wrong_sphere"].map(|key| tier[key].as_u64().expect(key))
}

#[test]
fn the_keys_and_their_types() {
    let report = measured("marbles --size 20x8");
    let keys: Vec<&str> =
        report.as_object().expect("an object").keys().map(String::as_str).collect();
    let expected =
        "cpu lanes level lighting order orders rustc scene spheres structure threads tiers";
    assert_eq!(keys.join(" "), expected);
    assert_eq!(report["spheres"], 10);
    assert_eq!((&report["scene"], &report["lanes"]), (&"marbles".into(), &16.into()));
    assert_eq!(report["order"], "image");
    assert!(report["cpu"].is_string() && report["level"].is_string());
    assert!(report["rustc"].as_str().expect("text").starts_with("rustc 1."));
    assert_eq!(report["tiers"].as_array().map(Vec::len), Some(8));
    for kind in ["camera", "shadow"] {
        for accuracy in TIERS {
            let tier = tier(&report, accuracy, kind);
            assert_eq!(tier.as_object().map(serde_json::Map::len), Some(14));
            let rays = tier["rays"].as_u64().expect("a count");
            assert!(if kind == "camera" { rays == 640 } else { rays > 0 }, "{tier}");
            for key in ["ns_per_ray", "ns_per_test", "mrays_per_s"] {
                assert!(tier[key].as_f64().expect(key) > 0.0, "{tier}");
            }
            // These are counts.
            wrong(tier);
            for key in ["ulp_median", "ulp_p999", "ulp_max"] {
                assert!(tier[key].is_u64() || kind == "shadow" && tier[key].is_null(), "{tier}");
            }
            for key in ["f64_share", "expansion_share"] {
                let share = tier[key].as_f64().expect(key);
                assert!((0.0..=1.0).contains(&share) && (share == 0.0 || accuracy == "exact"));
            }
        }
        let exact = tier(&report, "exact", kind);
        assert!(exact["f64_share"].as_f64() > exact["expansion_share"].as_f64());
    }
}

/// Points, wrong normals and wrong shadows of every tier.
fn lighting(report: &Value) -> [[u64; 3]; 4] {
    let tiers = report["lighting"].as_array().expect("a list");
    TIERS.map(|accuracy| {
        let tier = tiers.iter().find(|tier| tier["accuracy"] == accuracy).expect("the tier");
        ["points", "wrong_normals", "wrong_shadows"].map(|key| tier[key].as_u64().expect(key))
    })
}

#[test]
fn far_is_where_the_others_light_the_wrong_spheres() {
    let [fast, geometric, stable, exact] = lighting(&measured("far --size 60x24"));
    for textbook in [fast, geometric] {
        assert!(textbook[1] > 1000 && textbook[2] > 1000, "{textbook:?}");
    }
    assert!(stable[1] > 5 && stable[2] > 5, "{stable:?}");
    assert!(exact[0] > 1000 && exact[1..] == [0, 0], "{exact:?}");
    let tiers = lighting(&measured("marbles --size 60x24"));
    assert!(tiers.iter().all(|tier| tier[0] > 1000 && tier[1..] == [0, 0]), "{tiers:?}");
    assert!(measured("unit --size 9x4")["lighting"].is_null());
}

#[test]
fn edge_is_where_the_lecture_s_forms_are_wrong_and_exact_is_right() {
    let [fast, geometric] =
        ["fast", "geometric"].map(|accuracy| wrong(tier(&EDGE, accuracy, "camera")));
    for [hits, misses, spheres] in [fast, geometric] {
        assert!(hits > 100 && misses > 100, "{hits} hits, {misses} misses, {spheres} spheres");
    }
    assert_ne!(fast, geometric, "each fails in its own way");
    let exact = tier(&EDGE, "exact", "camera");
    assert_eq!((wrong(exact), exact["ulp_max"].as_u64()), ([0; 3], Some(0)));
}

/// A hit at the other root has another normal.
#[test]
fn wrong_normals_of_edge_are_wrong_spheres() {
    let [_, _, spheres] = wrong(tier(&EDGE, "fast", "camera"));
    let [[_, normals, _], ..] = lighting(&EDGE);
    assert!(spheres > 0 && spheres >= normals, "{spheres} wrong spheres, {normals} wrong normals");
}

#[test]
fn one_ray_is_counted_as_one() {
    let table = prints("tradeoff unit --size 1x1 --samples 1");
    assert!(table.contains("\n1 camera ray\n"), "{table}");
}

#[test]
fn a_scene_without_light_has_camera_rays_alone() {
    let path = file("dark.toml", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1.0\n");
    assert!(open::scene(&path).expect("a scene").lighting.is_plain());
    let report = measured(&format!("{path} --size 10x5"));
    assert_eq!(report["tiers"].as_array().map(Vec::len), Some(4));
    // Nothing to see: rays that miss, and no ulp.
    let text = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n\
                [[sphere]]\ncenter = [0, 0, 0]\nradius = 1.0\n\
                [[light]]\ndirection = [0, 1, 0]\n";
    let report = measured(&format!("{} --size 10x5", file("behind.toml", text)));
    assert_eq!(report["tiers"].as_array().map(Vec::len), Some(4));
    assert!(tier(&report, "fast", "camera")["ulp_max"].is_null());
}

#[test]
fn a_table_for_people() {
    let text = prints("tradeoff marbles --size 20x8");
    for part in
        ["marbles: 10 spheres", "rustc 1.", "640 camera rays", " shadow rays", "\ngeometric "]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains('\x1b') && !text.contains('\r'));
    assert!(text.lines().all(|line| line.len() <= 110), "{text}");
    for words in ["measured even if the scene's pictures cast", "only some of them have points"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    let head = prints("tradeoff unit --size 4x4 --level baseline --threads 1 --structure bvh");
    assert!(head.starts_with("unit: 1 sphere, bvh\n"), "{head}");
    assert!(head.contains(" baseline, 16 lanes, 1 thread;"), "{head}");
}

/// Tiers that lose hits of `edge` light fewer points than exact; every row of the table says how many.
#[test]
fn the_table_has_every_tier_s_points() {
    let text = prints("tradeoff edge --size 60x24");
    let table = text.split_once("\npoints that ").expect("the table of lights").1;
    let expected = lighting(&EDGE);
    for (accuracy, expected) in TIERS.into_iter().zip(expected) {
        let row = table.lines().find_map(|line| line.strip_prefix(accuracy)).expect("a row");
        let words = row.split_whitespace();
        let said: Vec<u64> = words.map(|word| word.parse().expect("a number")).collect();
        assert_eq!(said, expected, "{accuracy}: {text}");
    }
    let [fast, .., exact] = expected;
    assert!(fast[0] < exact[0], "{fast:?} {exact:?}");
}
