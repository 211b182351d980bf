//! `--cast`: a recording that plays, or none.

use crate::run::{by_script, failure, folder, names, prints, run};
use serde_json::Value;

fn cast(words: &str) -> Vec<Value> {
    let text = prints(&format!("{words} --cast -"));
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// What a player shows after so many frames.
fn shown(lines: &[Value], frames: usize) -> vt100::Parser {
    let size = |name: &str| {
        let size = lines[0][name].as_u64().expect("a size") as u16;
        size.try_into().expect("not 0")
    };
    let mut terminal = vt100::Parser::new(size("height"), size("width"), 0);
    for event in &lines[1..=frames] {
        assert_eq!(event[1], "o");
        terminal.process(event[2].as_str().expect("text").as_bytes());
    }
    terminal
}

#[test]
fn it_is_a_turn_of_as_many_frames_as_asked_for() {
    let lines = cast("marbles --size 40x12 --frames 12 --fps 10");
    assert_eq!((lines[0]["version"].as_u64(), lines[0]["width"].as_u64()), (Some(2), Some(40)));
    // A head, frames, and the end.
    assert_eq!(lines.len(), 14);
    for (frame, event) in lines[1..].iter().enumerate() {
        let seconds = event[0].as_f64().expect("a time");
        assert!((seconds - frame as f64 / 10.0).abs() < 1e-6, "{seconds}");
    }
    let text = lines[1][2].as_str().expect("text");
    assert!(text.contains("\x1b[38;2;") || text.contains("\x1b[48;2;"), "no colours");
    assert!(shown(&lines, 1).screen().contents() != shown(&lines, 7).screen().contents());
    assert!(!shown(&lines, 13).screen().hide_cursor());
}

/// Half a turn on is where `--orbit` leads, frame by frame the same bytes on the screen.
#[test]
fn frames_are_views_of_the_orbit() {
    let words = "marbles --size 40x12 --lossless --color truecolor";
    let turn = cast(&format!("{words} --frames 4"));
    let there = cast(&format!("{words} --frames 1 --orbit 180,0"));
    // Seen by themselves: glyphs that move keep what they are.
    let alone = |lines: &[Value], frames| shown(lines, frames).screen().contents_formatted();
    assert!(alone(&turn, 1) != alone(&turn, 3));
    assert_eq!(alone(&turn, 1), alone(&cast(&format!("{words} --frames 1")), 1));
    assert!(alone(&there, 1) != alone(&turn, 1));
}

#[test]
fn without_a_tolerance_there_are_more_bytes() {
    let size =
        |more: &str| prints(&format!("marbles --size 60x20 --frames 20 --cast - {more}")).len();
    let [lossy, exact] = ["", "--lossless"].map(size);
    assert!(4 * lossy < 3 * exact, "{lossy} and {exact} bytes");
}

#[test]
fn one_that_cannot_be_written_is_a_line_and_no_file() {
    let fails = |file: &str| failure(&run(["unit", "--frames", "2", "--cast", file]));
    assert_eq!(fails("no/such/a.cast"), "no/such/a.cast: no such file or directory");
    if std::path::Path::new("/dev/full").exists() {
        assert_eq!(fails("/dev/full"), "/dev/full: no space left on device");
    }
    let folder = folder("cast-full");
    let file = folder.join("a.cast");
    let recorded = |limit: u32| {
        let mut command =
            by_script(&format!("trap '' XFSZ; ulimit -f {limit}; exec \"$0\" \"$@\""));
        command.args(["marbles", "--size", "40x12", "--frames", "20", "--cast"]).arg(&file);
        command.output().expect("a shell")
    };
    let found = failure(&recorded(8));
    assert!(found.ends_with("a.cast: file too large"), "{found}");
    assert_eq!(names(&folder), [""; 0]);
    // The control.
    assert!(recorded(1 << 20).status.success() && file.is_file());
}
