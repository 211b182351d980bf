//! Other people's files, on the command line: frames, notes, pipes.

use crate::run::{
    file, printed, prints, refusal, refuses, run, run_with_input, spherule, split, stderr, writes,
};
use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::process::{Output, Stdio};
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

const TWO: &str = "1\none\nC 0 0 0\n2\ntwo\nC 0 0 0\nO 3 0 0\n";

/// Whatever bytes the file's name has.
fn with(path: impl AsRef<OsStr>, words: &str) -> Output {
    spherule().arg(path).args(split(words)).output().expect("the program runs")
}

#[test]
fn a_frame_is_named_and_further_frames_are_said() {
    let path = file("two.xyz", TWO);
    let first = with(&path, "--size 20x5");
    let said = "two.xyz: frame 0 is shown; there are more: --frame N, --frames A..B\n";
    assert!(stderr(&first).ends_with(said));
    let first = String::from_utf8_lossy(&first.stdout);
    let of = |frames: &str| prints(&format!("{path} --size 20x5 {frames}"));
    let (second, both) = (of("--frame 1"), of("--frames 0..2"));
    assert_ne!(first, second);
    assert_eq!(both.lines().count(), 10);
    assert!(both.starts_with(&*first));
    assert_eq!(of("--frames 0.."), both);
    assert_eq!(of("--frames 1..9"), second);
}

/// A simulation may begin without particles.
#[test]
fn frames_without_atoms_are_passed_over() {
    let frame = |rows: &str| {
        let (head, count) = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS", rows.lines().count());
        format!("{head}\n{count}\nITEM: ATOMS id type x y z\n{rows}")
    };
    let (one, two) = (frame("1 1 0 0 0\n"), frame("1 1 0 0 0\n2 1 3 0 0\n"));
    let empty = frame("");
    let path = file("empty.dump", [&*empty, &empty, &one, &empty, &two].concat());
    let first = with(&path, "--size 20x5");
    assert!(first.status.success());
    let said = stderr(&first);
    assert!(said.contains("frame 0 has no atoms; frame 2 is the next with any\n"), "{said}");
    assert!(said.ends_with("frame 2 is shown; there are more: --frame N, --frames A..B\n"));
    assert_eq!(first.stdout, with(&path, "--size 20x5 --frame 2").stdout);
    let all = with(&path, "--size 20x5 --frames 0..");
    assert_eq!(String::from_utf8_lossy(&all.stdout).lines().count(), 10);
    assert!(stderr(&all).contains("frame 3 has no atoms: such frames are left out\n"));
    for named in ["--frame 0", "--frames 0..2"] {
        let message = refuses(&format!("{path} {named}"));
        assert!(message.ends_with(": a frame without atoms"), "{named}: {message}");
    }
    // The frames of a turn are not the file's.
    let turn = with(&path, "--size 20x5 --cast - --frames 2");
    assert!(turn.status.success(), "{}", stderr(&turn));
    assert!(stderr(&turn).contains("frame 0 has no atoms; frame 2 is the next with any\n"));
    let none = file("none.dump", empty.repeat(2));
    assert!(refuses(&none).ends_with("none.dump:4:1: a frame without atoms"));
}

#[test]
fn whatever_shows_one_frame_says_that_there_are_more() {
    let path = file("more.xyz", TWO);
    let says = |words: &str, more: &str| {
        let output = with(&path, &format!("--size 20x5 {words}"));
        assert!(output.status.success() && !output.stdout.is_empty(), "{words}");
        assert!(stderr(&output).ends_with(more), "{words}: {}", stderr(&output));
    };
    let turn = "more.xyz: a turn around frame 0 is recorded; R in the viewer records frames\n";
    says("--cast - --frames 2", turn);
    for words in
        ["--pick 10,2", "--png -", "--output kitty", "--show error", "--show split:fast,exact"]
    {
        says(words, "more.xyz: frame 0 is shown; there are more: --frame N\n");
        writes(&format!("{path} --size 20x5 {words} --frame 1"));
    }
    let output = run(split(&format!("tradeoff {path} --size 4x4")));
    let more = "more.xyz: frame 0 is measured; there are more: --frame N\n";
    assert!(output.status.success() && stderr(&output).ends_with(more), "{}", stderr(&output));
    prints(&format!("tradeoff {path} --size 4x4 --frame 1"));
}

/// A frame without what is asked for, between frames that have it.
#[test]
fn a_frame_without_the_colours_or_radii_that_are_asked_for_is_said() {
    let with_charge = "1\nProperties=species:S:1:pos:R:3:charge:R:1\nC 0 0 0 1\n";
    let without = "1\nno charge\nC 0 0 0\n";
    let path = file("charges.xyz", [with_charge, without, without, with_charge].concat());
    let output = with(&path, "--size 20x5 --frames 0.. --color-by charge --radius charge");
    assert_eq!(String::from_utf8_lossy(&output.stdout).lines().count(), 20);
    let said = stderr(&output);
    let keeps = |what: &str| {
        said.lines()
            .filter(|line| {
                line.contains(&format!("frame 1 keeps its {what}: this scene has no charge"))
            })
            .count()
    };
    assert_eq!((keeps("colours"), keeps("radii"), said.lines().count()), (1, 1, 2), "{said}");
}

/// At once, since a file that is followed has no end.
#[test]
fn a_frame_that_is_followed_and_lacks_the_colours_is_said() {
    let frames = "1\nProperties=species:S:1:pos:R:3:charge:R:1\nC 0 0 0 1\n1\nno charge\nC 0 0 0\n";
    let path = file("followed.xyz", frames);
    let words = "--size 20x5 --frames 0.. --follow --color-by charge";
    let mut command = spherule();
    command.arg(path).args(words.split(' ')).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program runs");
    let mut stderr = BufReader::new(child.stderr.take().expect("piped"));
    let (sender, lines) = channel();
    thread::spawn(move || {
        let mut line = String::new();
        let _ = stderr.read_line(&mut line);
        let _ = sender.send(line);
    });
    let said = lines.recv_timeout(Duration::from_secs(60));
    child.kill().expect("it runs");
    child.wait().expect("it ends");
    let said = said.expect("a line");
    assert!(
        said.contains("followed.xyz: frame 1 keeps its colours: this scene has no charge"),
        "{said}"
    );
}

/// It is shown as near to text as can be.
#[test]
fn a_name_need_not_be_text() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(OsStr::from_bytes(b"no\xfftext.xyz"));
    if std::fs::write(&path, TWO).is_err() {
        println!("skipped: names are text in this file system");
        return;
    }
    let expected = printed(with(file("text.xyz", TWO), "--size 20x5 --frame 1"));
    assert_eq!(printed(with(&path, "--size 20x5 --frame 1")), expected);
    let said = stderr(&with(&path, "--size 20x5"));
    assert!(said.contains("/no\u{fffd}text.xyz: frame 0 is shown"), "{said}");
    std::fs::remove_file(&path).expect("it was there");
    assert!(refusal(&with(&path, "")).ends_with("/no\u{fffd}text.xyz: no such file"));
    assert!(refusal(&run([OsStr::from_bytes(b"\xff")])).starts_with("\u{fffd}: no built-in scene"));
}

/// From a pipe, compressed, each frame as from the file.
#[test]
fn a_pipe_is_unpacked_and_has_frames() {
    let mut gz = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gz.write_all(TWO.as_bytes()).expect("memory");
    let gz = gz.finish().expect("memory");
    let expected = prints(&format!("{} --size 20x5 --frames 0..2", file("pipe.xyz", TWO)));
    // The last as a tape has it.
    let padded = [&*gz, &[0; 512][..]].concat();
    for bytes in [&*gz, TWO.as_bytes(), &*padded] {
        assert_eq!(printed(run_with_input("- --size 20x5 --frames 0..2", bytes)), expected);
    }
    // What has come is drawn.
    let cut = run_with_input("- --size 20x5 --frames 0..", &gz[..gz.len() - 5]);
    assert_eq!(cut.status.code(), Some(2));
    assert_eq!(String::from_utf8_lossy(&cut.stdout), expected);
    assert!(stderr(&cut).contains("the compressed data ends early"), "{}", stderr(&cut));
}

#[test]
fn what_is_unknown_or_ignored_is_said_once() {
    let atoms: String = (0..1000).map(|index| format!("Xx {index} 0 0 7\n")).collect();
    let path = file("unknown.xyz", format!("1000\n\n{atoms}"));
    let output = with(&path, "--size 20x5");
    assert!(output.status.success());
    let said = stderr(&output);
    assert_eq!(said.lines().count(), 2, "{said}");
    assert!(said.contains("unknown.xyz: 1000 particles are of an unknown type (Xx): drawn grey\n"));
    assert!(said.contains("columns behind x, y and z are ignored"));
    let strict = refuses(&format!("{path} --strict"));
    let what = "unknown.xyz:3:1: \"Xx\" is not an element; without --strict it is drawn grey";
    assert!(strict.ends_with(what), "{strict}");
}

/// Nothing is to be seen then, which is no error, so the program says it.
#[test]
fn spheres_without_a_size_are_said() {
    for (name, text) in [
        ("sizeless.csv", "x,y,z,radius\n1,2,3,0\n4,5,6,0\n"),
        ("sizeless.toml", "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0.0\n"),
    ] {
        let path = file(name, text);
        let output = with(&path, "--size 20x5");
        let what = ": every radius is 0, so no sphere is seen; --radius sets another\n";
        assert!(output.status.success() && stderr(&output).ends_with(what), "{output:?}");
        prints(&format!("{path} --size 20x5 --radius 0.5"));
    }
    prints(&format!("{} --size 20x5", file("sized.csv", "x,y,z,radius\n1,2,3,0\n4,5,6,1\n")));
}

#[test]
fn columns_can_be_chosen() {
    let path = file("units.csv", "x (m),y (m),z (m),radius (mm)\n1,2,3,4\n");
    assert!(with(path, "--columns x,y,z").status.success());
    let table = file("options.csv", "a,b,c\n1,2,3\n");
    assert!(prints(&format!("{table} --columns a,b,c --size 9x3")).lines().count() == 3);
}

const TOPOLOGY: &str = "t\n 3\n    1SOL     OW    1   0.126   1.624   1.679\n    1SOL    HW1    2   0.190   1.661   1.747\n    \
    1SOL     MW    3   0.177   1.568   1.613\n   1.8 1.8 1.8\n";

/// A trajectory of as many atoms.
fn trajectory(name: &str) -> String {
    // Magic, atoms, what says when and in which box, atoms again; few atoms are not compressed.
    let mut xtc = [1995_u32.to_be_bytes(), 3_u32.to_be_bytes()].concat();
    xtc.extend([0; 44]);
    xtc.extend(3_u32.to_be_bytes());
    xtc.extend((0..9_u8).flat_map(|value| f32::from(value).to_be_bytes()));
    file(name, xtc)
}

#[test]
fn a_topology_s_name_need_not_be_text() {
    let path = trajectory("named.xtc");
    let named = Path::new(env!("CARGO_TARGET_TMPDIR")).join(OsStr::from_bytes(b"topo\xfflogy.gro"));
    if std::fs::write(&named, TOPOLOGY).is_err() {
        println!("skipped: names are text in this file system");
        return;
    }
    let drawn = |topology: &Path| {
        let words = [&*path, "--size", "20x5", "--topology"].map(OsStr::new);
        run(words.into_iter().chain([topology.as_os_str()]))
    };
    let output = drawn(&named);
    assert_eq!(output.stdout, drawn(file("named.gro", TOPOLOGY).as_ref()).stdout);
    let said = stderr(&output);
    assert!(said.contains("/topo\u{fffd}logy.gro: 1 particle is of an unknown type"), "{said}");
    std::fs::remove_file(&named).expect("it was there");
    assert!(refusal(&drawn(&named)).ends_with("/topo\u{fffd}logy.gro: no such file or directory"));
}

/// The notes about it are its own.
#[test]
fn types_that_a_topology_does_not_know_are_said_or_refused() {
    let topology = format!("--topology {}", file("topology.gro", TOPOLOGY));
    let path = trajectory("topology.xtc");
    let drawn = with(&path, &format!("{topology} --size 20x5"));
    assert!(drawn.status.success());
    let said = stderr(&drawn);
    assert!(said.ends_with("topology.gro: 1 particle is of an unknown type (MW): drawn grey\n"));
    assert_eq!(said.lines().count(), 1, "{said}");
    let strict = refuses(&format!("{path} {topology} --strict"));
    let expected = "topology.gro:5:1: \"MW\" is not an element; without --strict it is drawn grey";
    assert!(strict.ends_with(expected), "{strict}");
}
