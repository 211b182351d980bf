//! Every kind of bad input: exit code 2, one line on stderr that says where, nothing on stdout.

use crate::run::{file, refusal, run, run_with_input};
use spherule_kernel::{Level, LevelName};

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
    assert!(refusal(&run(["--accuracy", "real"])).contains("fast, geometric, stable, exact"));
}

#[test]
fn a_distance_that_is_none() {
    for distance in ["-1", "nan", "inf", "near", ""] {
        let message = refusal(&run([format!("--distance={distance}")]));
        assert!(message.contains("widths of a cell, 0 or more"), "{message}");
    }
}

#[test]
fn threads_and_structures_that_are_none() {
    for before in ["", "tradeoff ", "trace --spheres s.npy --rays r.npy "] {
        for (count, part) in [
            ("0", "1..=1024"),
            ("-1", "1..=1024"),
            ("1025", "1..=1024"),
            ("many", "invalid digit"),
            ("1.5", "invalid digit"),
            ("99999999999999999999", "too large"),
        ] {
            let message = refusal(&run(format!("{before}--threads={count}").split(' ')));
            assert!(message.contains("--threads <N>") && message.contains(part), "{message}");
        }
        let message = refusal(&run(format!("{before}--structure octree").split(' ')));
        assert!(message.ends_with("auto, brute, depth-list, bvh]"), "{message}");
    }
}

#[test]
fn a_level_that_is_none_or_not_the_cpu_s() {
    for before in ["", "trace --spheres s.npy --rays r.npy "] {
        let words = format!("{before}--level sse2");
        assert!(refusal(&run(words.split(' '))).contains("baseline, avx2, avx512"));
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
    let turned = refusal(&run(["a\u{202e}b\u{2028}\u{9b}.toml"]));
    assert_eq!(turned, "a\\u{202e}b\\u{2028}\\u{9b}.toml: no such file");
}

/// What a run that succeeds says on stderr, in one line.
fn note(name: &str, text: &str) -> String {
    let output = run([file(name, text.as_bytes()).as_os_str()]);
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(said.lines().count(), 1, "{said}");
    said
}

#[test]
fn a_note_that_is_no_line() {
    let said = note("turned.xyz", "1\n\nX\u{202e}\u{9b}y 0 0 0\n");
    assert!(said.ends_with(" of an unknown type (X\\u{202e}\\u{9b}y): drawn grey\n"), "{said}");
}

/// The ends of what is long are kept.
#[test]
fn messages_of_long_names_are_short() {
    let long = "x".repeat(2000);
    let message = scene("long.toml", &format!("{long} = 1\n"));
    assert!(message.starts_with(":1:1: unknown field `xxx"), "{message}");
    assert!(message.contains("xxx...xxx") && message.ends_with(", `light`"), "{message}");
    assert!(message.len() < 1100, "{message}");
    let atoms: String = (0..7).map(|index| format!("{long}{index} 0 0 {index}\n")).collect();
    let said = note("long.xyz", &format!("7\n\n{atoms}"));
    assert!(said.contains("xxx...xxx") && said.ends_with("x5, ...): drawn grey\n"), "{said}");
    assert!(said.len() < 800, "{said}");
}

#[test]
fn scenes_with_a_wrong_place() {
    for (name, text, message) in [
        ("type.toml", "\nshadows = 3\n", ":2:11: invalid type"),
        ("key.toml", "[[sphere]]\nsize = 3\n", ":2:1: unknown field `size`"),
        ("none.toml", "[[sphere\n", ":1:"),
        ("few.xyz", "3\n\nH 0 0 0\n", ":4:1: the file ends after 1 of"),
        ("many.xyz", "1\n\nH 0 0 0\nH 0 0 1\n", ":4:1: one atom more"),
        ("lie.xyz", "9223372036854775807\n\nH 0 0 0\n", ":4:1: the file ends after 1 of"),
        ("nan.xyz", "1\n\nH 0 NaN 0\n", ":3:5: y is \"NaN\": not finite"),
        ("inf.xyz", "1\n\nH 0 0 -inf\n", ":3:7: z is"),
        ("empty.toml", "", ": the file is empty"),
        ("none.toml", "shadows = true\n", ": an empty scene: at least one [[sphere]]"),
        ("empty.xyz", "", ": the file is empty"),
        ("zero.xyz", "0\nnothing\n", ":1:1: a molecule without atoms"),
    ] {
        let found = scene(name, text);
        assert!(found.starts_with(message), "{name}: {found}");
    }
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
fn a_size_out_of_range() {
    for size in ["0x0", "1000000x1000000", "80x0", "4097x1", "80", "-1x5", "80x24x2", ""] {
        let message = refusal(&run([format!("--size={size}")]));
        assert!(message.contains("COLSxROWS"), "{message}");
    }
}

/// They are held whole, unlike a file of pixels.
#[test]
fn more_pixels_than_a_terminal_shows() {
    for how in ["kitty", "sixel", "iterm2"] {
        let words = format!("unit --size 4096x4096 --output {how}");
        let message = refusal(&run(words.split(' ')));
        assert!(message.contains("pixels are too many for --output"), "{message}");
    }
    let message = refusal(&run("unit --png a.png --output kitty".split(' ')));
    assert!(message.contains("--png writes a file"), "{message}");
}

#[test]
fn standard_input_that_is_no_scene() {
    assert!(refusal(&run_with_input("-", b"")).starts_with("-: the file is empty"));
    let message = refusal(&run_with_input("-", b"2\n\nH 0 0 0\n"));
    assert!(message.starts_with("-:4:1: the file ends"), "{message}");
    assert!(refusal(&run_with_input("- --format toml", b"2\n")).starts_with("-:1:"));
    assert!(refusal(&run_with_input("-", b"\xfd\xfe\n")).contains("unknown format"));
    assert!(refusal(&run_with_input("-", b"\xff\xfe\n\0")).contains("UTF-16 text"));
    assert!(
        refusal(&run_with_input("- --format toml", b"\xff\xfe\n"))
            .starts_with("-:1: not valid UTF-8")
    );
}

/// The content tells, not the name.
#[test]
fn a_file_of_an_unknown_format() {
    let path = file("scene.txt", b"1\n\nH 0 0 0\n");
    assert!(run([path.as_os_str()]).status.success());
    let path = file("text.txt", b"Some text.\n");
    assert!(refusal(&run([path.as_os_str()])).ends_with("unknown format; --format names one of toml, xyz, pdb, mmcif, gro, lammps-dump, lammps-data, mercury, csv, ply, npy, xtc, urdf"));
}

/// Where there is less memory than they would take, too.
#[cfg(target_os = "linux")]
#[test]
fn an_array_that_claims_a_thousand_million_rows() {
    use crate::run::{npy, spherule};
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000, 4), }\n";
    let path = file("claims.npy", &npy(header, b""));
    let script = "ulimit -v 500000; exec \"$0\" \"$@\"";
    let mut command = std::process::Command::new("sh");
    command.args(["-c", script]).arg(spherule().get_program()).arg(path);
    let message = refusal(&command.output().expect("a shell"));
    assert!(message.contains("fewer bytes than"), "{message}");
}
