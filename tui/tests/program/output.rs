//! One picture: its lines, its colours, and where it goes.

use crate::run::{
    file, is_of_size, printed, prints, run, run_with_input, spherule, stderr, without_reader,
};
use clap::ValueEnum;
use spherule::choice::name;
use spherule::style::Charset;
use std::fs::OpenOptions;
use std::io::{BufRead, BufReader, Read};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

/// Pictures that leave nothing to choose, in all characters and colours: as many lines as rows, and of one colour lines that
/// are the same.
#[test]
fn pictures_of_a_cell_or_a_colour() {
    // Nothing is behind the eye.
    let scene = b"[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
    let even = file("even.toml", scene);
    let equal = ["808080"; 16].join(",");
    for charset in Charset::value_variants().iter().map(name) {
        for color in ["never", "16", "256", "truecolor"] {
            for (distance, size, rows) in [("0", "1x1", 1), ("273", "1x9", 9), ("1e6", "40x1", 1)] {
                let words = format!(
                    "marbles --charset {charset} --color {color} --distance {distance} --size {size} --palette {equal}"
                );
                let text = prints(&words);
                assert_eq!(text.lines().count(), rows, "{words}");
                assert_eq!(text.contains('\x1b'), color != "never", "{words}: {text:?}");
            }
            for background in ["000000", "ffffff", "7f7f7f"] {
                let words = format!(
                    "{even} --charset {charset} --color {color} --background {background} --size 8x4"
                );
                let text = prints(&words);
                let lines: Vec<&str> = text.lines().collect();
                assert_eq!(lines.len(), 4, "{words}: {text}");
                if color == "truecolor" {
                    assert!(lines.iter().all(|&line| line == lines[0]), "{words}: {text}");
                    assert!(
                        lines[0].contains("        ") || charset == "braille",
                        "{words}: {text}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_picture_is_exactly_its_rows() {
    for size in ["80x24", "1x1", "7x3", "200x1"] {
        for charset in ["ascii", "half"] {
            let text = prints(&format!("--size {size} --charset {charset}"));
            assert!(text.ends_with('\n') && !text.contains('\x1b'), "{size} {charset}");
            assert!(is_of_size(&text, size), "{size} {charset}");
        }
    }
}

#[test]
fn a_picture_of_more_than_a_strip() {
    assert!(is_of_size(&prints("--size 4096x33 --charset half --color never"), "4096x33"));
}

/// Such a picture takes long, and more memory than there is unless it goes out as it is drawn.
#[test]
fn the_largest_picture_begins_at_once_and_ends_with_its_reader() {
    let mut child = spherule()
        .args(["--size", "4096x4096", "--once"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let mut line = String::new();
    BufReader::new(child.stdout.take().expect("piped")).read_line(&mut line).expect("a line");
    assert_eq!(line.chars().count(), 4097);
    let output = child.wait_with_output().expect("the program ends");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

/// Those terminals' variable is there in a pipe, too.
#[test]
fn a_pipe_gets_no_pixels_from_a_terminal_that_has_them() {
    let cells = prints("unit");
    assert!(cells.is_ascii() && is_of_size(&cells, "80x24"));
    for name in ["WezTerm", "iTerm.app"] {
        let auto = ["unit", "--output", "auto"];
        let output = spherule().args(auto).env("TERM_PROGRAM", name).output();
        assert_eq!(printed(output.expect("the program runs")), cells, "{name}");
    }
}

#[test]
fn every_coloured_line_is_closed_by_a_reset() {
    for color in ["16", "256", "truecolor", "always"] {
        for charset in ["ascii", "half"] {
            let text = prints(&format!("--size 40x12 --charset {charset} --color {color}"));
            assert_eq!(text.lines().count(), 12);
            for line in text.lines().filter(|line| line.contains('\x1b')) {
                assert!(line.ends_with("\x1b[0m"), "{color} {charset}: {line:?}");
            }
            assert!(text.contains('\x1b'));
        }
    }
}

#[test]
fn the_flag_then_no_color_then_clicolor_force() {
    for (flag, variables, is_coloured) in [
        ("", "", false),
        ("", "CLICOLOR_FORCE=1", true),
        ("", "CLICOLOR_FORCE=0", false),
        ("", "CLICOLOR_FORCE=", false),
        ("", "CLICOLOR_FORCE=1 NO_COLOR=1", false),
        ("", "CLICOLOR_FORCE=1 NO_COLOR=0", false),
        ("", "CLICOLOR_FORCE=1 NO_COLOR=", true),
        ("--color always", "NO_COLOR=1", true),
        ("--color 256", "NO_COLOR=1", true),
        ("--color never", "CLICOLOR_FORCE=1", false),
    ] {
        let mut command = spherule();
        command.args(["unit", "--size", "20x6"]).args(flag.split_whitespace());
        command.envs(variables.split_whitespace().filter_map(|pair| pair.split_once('=')));
        let text = printed(command.output().expect("the program runs"));
        assert_eq!(text.contains('\x1b'), is_coloured, "{flag} {variables}");
    }
}

#[test]
fn the_depth_is_what_the_environment_says() {
    let text = |term: &str, colorterm: &str| {
        let mut command = spherule();
        command.args(["marbles", "--size", "20x6", "--color", "always"]);
        command.env("TERM", term).env("COLORTERM", colorterm);
        printed(command.output().expect("the program runs"))
    };
    assert!(text("xterm", "truecolor").contains("8;2;"));
    assert!(text("xterm-256color", "24bit").contains("8;2;"));
    assert!(text("xterm-256color", "").contains("8;5;"));
    assert!(text("xterm-256color", "yes").contains("8;5;"));
    let sixteen = text("xterm", "");
    assert!(!sixteen.contains("8;2;") && !sixteen.contains("8;5;"));
}

/// Whoever shares the pipe may have made it non-blocking: then it takes nothing when it is full.
#[test]
fn a_slow_reader_gets_all() {
    for words in [
        // Written at once, then by parts.
        "marbles --size 300x100 --color truecolor --show split:fast,exact",
        "cases --json --count 3000",
        "cases --out-spheres - --count 30000",
    ] {
        let expected = run(words.split(' ')).stdout;
        assert!(expected.len() > 300_000, "{words}: {} bytes fill no pipe", expected.len());
        let (mut reader, stdout) = UnixStream::pair().expect("a socket");
        stdout.set_nonblocking(true).expect("it can be");
        let child = spherule().args(words.split(' ')).stdout(OwnedFd::from(stdout)).spawn();
        let mut child = child.expect("the program runs");
        let mut all = vec![0];
        reader.read_exact(&mut all).expect("a byte");
        // Meanwhile it is full.
        thread::sleep(Duration::from_millis(50));
        reader.read_to_end(&mut all).expect("the rest");
        assert!(child.wait().expect("the program ends").success(), "{words}");
        assert!(all == expected, "{words}: {} bytes of {}", all.len(), expected.len());
    }
}

#[test]
fn a_reader_that_goes_away_is_a_success() {
    for words in [
        "--size 500x500 --color truecolor",
        "unit",
        "scenes",
        "--help",
        "trace --help",
        "unit --size 200x60 --png -",
    ] {
        let output = without_reader(words);
        assert_eq!((output.status.code(), &*stderr(&output)), (Some(0), ""), "{words}");
    }
}

#[test]
fn an_output_that_cannot_be_written_is_a_failure() {
    let Ok(full) = OpenOptions::new().write(true).open("/dev/full") else {
        println!("skipped: no /dev/full");
        return;
    };
    for words in ["unit", "scenes", "--version"] {
        let full = full.try_clone().expect("a handle");
        let output = spherule().args(words.split(' ')).stdout(full).output().expect("it runs");
        assert_eq!(output.status.code(), Some(1), "{words}");
        assert_eq!(stderr(&output), "spherule: standard output: no space left on device\n");
    }
}

/// Built in or not: a scene that names no background gets the one that is asked for.
#[test]
fn a_background_is_for_scenes_that_name_none() {
    let plain = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
    let named = format!("background = \"#102030\"\n{plain}");
    for (scene, without, with) in [
        (&*file("plain.toml", plain), "0;0;0", "255;238;221"),
        ("caffeine", "16;18;26", "255;238;221"),
        (&*file("named.toml", named), "16;32;48", "16;32;48"),
        ("flake", "12;16;28", "12;16;28"),
        ("marbles", "134;172;212", "134;172;212"),
    ] {
        let corner = |more: &str| {
            let words = format!("{scene} --size 40x12 --color truecolor --charset half {more}");
            let text = prints(&words);
            let start = text.strip_prefix("\x1b[").expect("a colour");
            start.split_once('m').expect("its end").0.trim_start_matches("48;2;").to_owned()
        };
        assert_eq!(corner(""), without, "{scene}");
        assert_eq!(corner("--background #ffeedd"), with, "{scene}");
    }
}

#[test]
fn scenes_are_listed_a_line_each() {
    let text = prints("scenes");
    let words = text.lines().map(|line| line.split_whitespace().take(2).collect::<Vec<_>>());
    let words: Vec<String> = words.map(|words| words.join(" ")).collect();
    assert_eq!(words, ["marbles 10", "unit 1", "flake 7381", "edge 19", "far 12", "caffeine 24"]);
}

#[test]
fn a_molecule_from_standard_input() {
    let shipped = prints("caffeine");
    assert_eq!(shipped, printed(run_with_input("-", include_bytes!("../../scenes/caffeine.xyz"))));
    assert!(shipped.contains('@'));
}

#[test]
fn the_lecture_s_forms_show_their_faults_in_edge() {
    let picture = |tier| prints(&format!("edge --size 80x24 --accuracy {tier}"));
    let exact = picture("exact");
    for tier in ["fast", "geometric"] {
        let differing = picture(tier).chars().zip(exact.chars()).filter(|(a, b)| a != b).count();
        assert!(differing > 100, "{tier}: {differing} of 1920 cells");
    }
}
