//! Bad input that no row of a file can be: exit code 2, one line on stderr that says where, nothing on stdout.

use crate::run::{file, refusal, refuses, run, run_with_input, stderr};
use spherule_kernel::{Level, LevelName};

#[test]
fn a_level_that_is_not_the_cpu_s() {
    for before in ["", "trace --spheres s.npy --rays r.npy "] {
        for name in LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_none()) {
            let message = refuses(&format!("{before}--level {}", name.as_str()));
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
    let output = run([file(name, text)]);
    assert!(output.status.success(), "{output:?}");
    let said = stderr(&output);
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
    let path = file("long.toml", format!("{long} = 1\n"));
    let message = refuses(&path).replace(&path, "");
    assert!(message.starts_with(":1:1: unknown field `xxx"), "{message}");
    assert!(message.contains("xxx...xxx") && message.ends_with(", `light`"), "{message}");
    assert!(message.len() < 1100, "{message}");
    let atoms: String = (0..7).map(|index| format!("{long}{index} 0 0 {index}\n")).collect();
    let said = note("long.xyz", &format!("7\n\n{atoms}"));
    assert!(said.contains("xxx...xxx") && said.ends_with("x5, ...): drawn grey\n"), "{said}");
    assert!(said.len() < 800, "{said}");
}

#[test]
fn standard_input_that_is_no_text() {
    let refused = |words: &str, bytes: &[u8]| refusal(&run_with_input(words, bytes));
    assert!(refused("-", b"\xfd\xfe\n").contains("unknown format"));
    assert!(refused("-", b"\xff\xfe\n\0").contains("UTF-16 text"));
    assert!(refused("- --format toml", b"\xff\xfe\n").starts_with("-:1: not valid UTF-8"));
    let marked = b"\xef\xbb\xbf\n\n\xff\n";
    assert!(refused("- --format toml", marked).starts_with("-:3: not valid UTF-8"));
    let robot = b"<robot>\n\xff</robot>\n";
    assert!(refused("- --format urdf", robot).starts_with("-:2: not valid UTF-8"));
}

/// The content tells, not the name.
#[test]
fn a_file_of_another_name() {
    assert!(run([file("scene.txt", "1\n\nH 0 0 0\n")]).status.success());
}

/// Where there is less memory than they would take, too.
#[cfg(target_os = "linux")]
#[test]
fn an_array_that_claims_a_thousand_million_rows() {
    use crate::run::{by_script, header, npy};
    let path = file("claims.npy", npy(&header("'<f4'", "False", "(1000000000, 4)"), b""));
    let mut command = by_script("ulimit -v 500000; exec \"$0\" \"$@\"");
    let message = refusal(&command.arg(path).output().expect("a shell"));
    assert!(message.contains("fewer bytes than"), "{message}");
}
