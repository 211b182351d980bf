//! Every kind of bad input: exit code 2, one line on stderr that says where, nothing on stdout.

mod program;

use program::{file, refusal, run, run_with_input};
use spherule_kernel::dispatch::{Level, LevelName};

/// What the program says about a scene in a file.
fn scene(name: &str, text: &str) -> String {
    let path = file(name, text.as_bytes());
    let message = refusal(&run([path.as_os_str()]));
    let place = message.strip_prefix(&path.display().to_string()).expect("the file's name");
    place.to_owned()
}

#[test]
fn a_missing_file() {
    assert_eq!(refusal(&run(["no/such.toml"])), "no/such.toml: no such file");
}

#[test]
fn an_unreadable_file() {
    let folder = env!("CARGO_TARGET_TMPDIR");
    assert_eq!(refusal(&run([folder])), format!("{folder}: is a directory"));
}

#[test]
fn an_unknown_scene() {
    assert_eq!(refusal(&run(["marble"])), "marble: no such scene, built in or in a file");
}

#[test]
fn an_unknown_option() {
    refusal(&run(["--frobnicate"]));
    assert!(refusal(&run(["--accuracy", "real"])).contains("fast, stable or exact"));
}

#[test]
fn threads_and_structures_that_are_none() {
    for before in ["", "tradeoff ", "trace --spheres s.npy --rays r.npy "] {
        for count in ["0", "-1", "1025", "many", "1.5", "99999999999999999999"] {
            let message = refusal(&run(format!("{before}--threads={count}").split(' ')));
            assert!(message.ends_with("1 to 1024"), "{message}");
        }
        let message = refusal(&run(format!("{before}--structure octree").split(' ')));
        assert!(message.ends_with("auto, brute, tiles or bvh"), "{message}");
    }
}

#[test]
fn a_level_that_is_none_or_not_the_cpu_s() {
    for before in ["", "trace --spheres s.npy --rays r.npy "] {
        let words = format!("{before}--level sse2");
        assert!(refusal(&run(words.split(' '))).contains("baseline, avx2 or avx512"));
        for name in LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_none()) {
            let words = format!("{before}--level {}", name.as_str());
            let message = refusal(&run(words.split(' ')));
            assert!(message.ends_with(&format!("this CPU has no {}", name.as_str())), "{message}");
        }
    }
}

#[test]
fn a_name_that_is_no_line() {
    assert_eq!(refusal(&run(["a\nb.toml"])), "a\\nb.toml: no such file");
}

#[test]
fn toml_of_a_wrong_type() {
    assert!(scene("type.toml", "\nshadows = 3\n").starts_with(":2:11: invalid type"));
}

#[test]
fn toml_with_an_unknown_key() {
    assert!(scene("key.toml", "[[sphere]]\nsize = 3\n").starts_with(":2:1: unknown field `size`"));
}

#[test]
fn toml_that_is_none() {
    assert!(scene("none.toml", "[[sphere\n").starts_with(":1:"));
}

#[test]
fn an_xyz_whose_count_lies() {
    assert!(scene("few.xyz", "3\n\nH 0 0 0\n").starts_with(":4:1: the file ends after 1 of"));
    assert!(scene("many.xyz", "1\n\nH 0 0 0\nH 0 0 1\n").starts_with(":4:1: one atom more"));
    let lie = scene("lie.xyz", "9223372036854775807\n\nH 0 0 0\n");
    assert!(lie.starts_with(":4:1: the file ends after 1 of"), "{lie}");
}

#[test]
fn an_unknown_element() {
    assert_eq!(scene("element.xyz", "1\n\nQq 0 0 0\n"), ":3:1: \"Qq\" is no element");
}

#[test]
fn a_coordinate_that_is_not_finite() {
    assert!(scene("nan.xyz", "1\n\nH 0 NaN 0\n").starts_with(":3:5: y is \"NaN\": not finite"));
    assert!(scene("inf.xyz", "1\n\nH 0 0 -inf\n").starts_with(":3:7: z is"));
}

#[test]
fn a_radius_that_is_negative_or_not_finite() {
    for (index, value) in ["-1.0", "nan", "inf", "-inf", "1e39"].iter().enumerate() {
        let text = format!("[[sphere]]\ncenter = [0, 0, 0]\nradius = {value}\n");
        let message = scene(&format!("radius{index}.toml"), &text);
        assert!(message.starts_with(":3:10: radius is "), "{message}");
    }
}

#[test]
fn an_empty_scene() {
    assert_eq!(scene("empty.toml", ""), ": an empty scene: at least one [[sphere]]");
    assert_eq!(scene("empty.xyz", ""), ": the file is empty");
    assert_eq!(scene("zero.xyz", "0\nnothing\n"), ":1:1: a molecule without atoms");
    assert!(refusal(&run_with_input("-", b"")).starts_with("-: an empty scene"));
}

#[test]
fn a_size_out_of_range() {
    for size in ["0x0", "1000000x1000000", "80x0", "4097x1", "80", "-1x5", "80x24x2", ""] {
        let message = refusal(&run([format!("--size={size}")]));
        assert!(message.contains("COLSxROWS"), "{message}");
    }
}

#[test]
fn standard_input_that_is_no_scene() {
    let message = refusal(&run_with_input("-", b"2\n\nH 0 0 0\n"));
    assert!(message.starts_with("-:4:1: the file ends"), "{message}");
    assert!(refusal(&run_with_input("- --format toml", b"2\n")).starts_with("-:1:"));
    assert!(refusal(&run_with_input("-", b"\xff\xfe\n")).starts_with("-:1: no UTF-8"));
}

#[test]
fn a_file_of_no_known_format() {
    let path = file("scene.txt", b"1\n\nH 0 0 0\n");
    assert!(refusal(&run([path.as_os_str()])).contains("no known format"));
    assert!(run([path.as_os_str(), "--format".as_ref(), "xyz".as_ref()]).status.success());
}
