//! Image order and object order: the same pictures, byte for byte, and the counts of both.

use crate::run::{file, json, prints};
use spherule::scene::builtin::BUILTINS;

/// A picture in both orders; object order on several numbers of threads.
fn the_same_picture(words: &str) {
    let picture = |more: &str| prints(&format!("{words} --once {more}"));
    let expected = picture("--threads 1");
    assert!(expected.lines().count() > 5, "{words}");
    assert!(picture("--order image --structure brute") == expected, "{words}");
    for threads in [1, 2, 7] {
        let more = format!("--order object --threads {threads}");
        assert!(picture(&more) == expected, "{words} {more}");
    }
}

#[test]
fn every_scene_has_one_picture() {
    for scene in BUILTINS {
        for tier in ["exact", "stable"] {
            for charset in ["half --color truecolor", "ascii"] {
                let name = scene.name;
                the_same_picture(&format!(
                    "{name} --accuracy {tier} --charset {charset} --size 50x19"
                ));
            }
        }
    }
}

#[test]
fn so_in_parallel() {
    for scene in BUILTINS {
        let words = format!("{} --projection parallel --charset ascii --size 50x19", scene.name);
        the_same_picture(&words);
    }
}

#[test]
fn so_with_spheres_around_the_eye_behind_it_huge_and_tiny() {
    let mut text = String::from(
        "background = \"#203040\"\nshadows = true\n\
         [camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n\
         [[light]]\ndirection = [1, 2, 3]\n",
    );
    for ([x, y, z], radius) in [
        ([0.0, 0.0, 5.0], 40.0),
        ([0.0, 0.0, 5.0], 40.0),
        ([0.0, 0.0, 9.0], 3.9),
        ([0.0, 0.0, 9.0], 4.0),
        ([0.5, 0.0, 0.0], 1.0),
        ([1.5, 0.0, 0.5], 1.0),
        ([4.0, 0.0, 5.0], 3.5),
        ([0.0, -1e6, 0.0], 999_999.0),
        ([0.0, 1e30, 0.0], 1e30),
        ([-1.0, 0.5, 1.0], 1e-3),
        ([-1.0, 0.4, 1.0], 0.0),
        ([-1.0, 0.3, 1.0], 1e-40),
    ] {
        text += &format!("[[sphere]]\ncenter = [{x:?}, {y:?}, {z:?}]\nradius = {radius:?}\n");
        text += &format!("color = \"#{:02x}80c0\"\n", (20.0 * (x + 5.0)) as u8);
    }
    let path = file("orders.toml", text);
    for more in ["", "--projection parallel", "--accuracy stable", "--samples 16"] {
        the_same_picture(&format!("{path} --size 30x11 --charset half --color truecolor {more}"));
    }
}

/// The counts of the `tradeoff` of some words: tests, writes and overwritten writes of both orders.
fn counts(words: &str) -> [[u64; 3]; 2] {
    let report = json(&format!("tradeoff --json {words}"));
    ["image", "object"].map(|order| {
        let counts = &report["orders"][order];
        assert_eq!(counts.as_object().map(serde_json::Map::len), Some(3));
        ["tests", "writes", "overwritten"].map(|key| counts[key].as_u64().expect(key))
    })
}

/// 8 x 4 cells are 16 x 8 rays, 8 packets of 16. All rays meet a shell around the eye, twice, since the first is
/// farther; none meets what is behind the eye. A point that no ray meets is tested by the packet that it lies in.
#[test]
fn counts_by_hand() {
    let text = "[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\nfov = 90.0\n\
                [[sphere]]\ncenter = [0, 0, 0]\nradius = 2.0\n\
                [[sphere]]\ncenter = [0, 0, 9]\nradius = 1.0\n\
                [[sphere]]\ncenter = [0, 0, 0]\nradius = 1.0\n\
                [[sphere]]\ncenter = [0.25, 0.25, -1]\nradius = 0.001\n";
    let path = file("counts.toml", text);
    for more in ["--threads 1", "--threads 2 --order object", "--threads 7 --structure bvh"] {
        let [image, object] = counts(&format!("{path} --size 8x4 {more}"));
        assert_eq!(image, [4 * 128, 128, 0], "{more}");
        assert_eq!(object, [2 * 128 + 16, 256, 128], "{more}");
    }
    let table = prints(&format!("tradeoff {path} --size 8x4 --order object"));
    let rows: Vec<Vec<&str>> =
        table.lines().map(|line| line.split_whitespace().collect()).collect();
    for row in [["image", "512", "128", "0"], ["object", "272", "256", "128"]] {
        assert!(rows.contains(&row.to_vec()), "{table}");
    }
    assert!(table.starts_with(&format!("{path}: 4 spheres, object order, ")), "{table}");
}

#[test]
fn counts_do_not_depend_on_threads_or_order() {
    let expected = counts("flake --size 30x12 --threads 1");
    let [image, object] = expected;
    assert_eq!(image, [7381 * 30 * 12 * 4, 30 * 12 * 4, 0]);
    assert!(object[0] < image[0] / 20 && object[1] - object[2] <= image[1], "{object:?}");
    for more in ["--threads 2", "--threads 7", "--order object"] {
        assert_eq!(counts(&format!("flake --size 30x12 {more}")), expected, "{more}");
    }
}
