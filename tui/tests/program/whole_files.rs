//! Files that are written whole or not at all: several at once, and one in place of another.

use crate::run::{
    folder, is_heard, names, prints, refusal, refuses, run, spherule, split, stderr, writes,
};
use rustix::process::{
    Gid, Pid, Resource, Rlimit, Signal, getgroups, getrlimit, kill_process, setrlimit,
};
use std::fs::{self, File, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

/// Whichever of them is removed first, by whatever signal.
#[test]
fn a_signal_leaves_none_of_several_files() {
    // Else two of these signals would leave their `core` in the package.
    let limit = getrlimit(Resource::Core);
    setrlimit(Resource::Core, Rlimit { current: Some(0), ..limit }).expect("a lower limit");
    let signals = [Signal::TERM, Signal::HUP, Signal::INT, Signal::QUIT, Signal::XCPU];
    let signals = signals.into_iter().chain([Signal::USR1, Signal::USR2, Signal::ALARM]);
    for signal in signals.filter(is_heard) {
        let folder = folder("whole-several");
        let mut command = spherule();
        command.args(["cases", "--count", "1000000000"]);
        for (option, name) in [("--out-spheres", "s"), ("--out-rays", "r"), ("--out-family", "f")] {
            command.arg(option).arg(folder.join(name));
        }
        let mut child = command.stdout(Stdio::null()).spawn().expect("the program runs");
        let deadline = Instant::now() + Duration::from_secs(60);
        while names(&folder).len() < 3 {
            assert!(Instant::now() < deadline, "no files");
            thread::sleep(Duration::from_millis(1));
        }
        kill_process(Pid::from_child(&child), signal).expect("it runs");
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(signal.as_raw()), "{status}");
        assert_eq!(names(&folder), [""; 0], "{signal:?}");
    }
}

/// Whoever reads the old file as one of its group reads the new one.
#[test]
fn a_file_that_is_replaced_keeps_its_group() {
    let file = folder("whole-group").join("a.png");
    fs::write(&file, "before").expect("a writable folder");
    let group = || fs::metadata(&file).expect("a file").gid();
    let own = group();
    // Root may give a file any group, others one that they are in.
    let mut others = getgroups().unwrap_or_default().into_iter().map(Gid::as_raw).chain([own + 1]);
    let is_given = |&other: &u32| other != own && chown(&file, None, Some(other)).is_ok();
    let Some(other) = others.find(is_given) else {
        println!("skipped: this user is in one group");
        return;
    };
    fs::set_permissions(&file, Permissions::from_mode(0o660)).expect("the owner's file");
    assert_eq!(prints(&format!("unit --png {}", file.display())), "");
    assert_eq!(group(), other);
    assert_eq!(fs::metadata(&file).expect("a file").permissions().mode() & 0o777, 0o660);
}

/// There is no other copy of it. A recording is none, though it has commas.
#[test]
fn a_scene_is_not_replaced_by_its_picture() {
    let folder = folder("whole-scene");
    let [scene, points, link] =
        ["s.toml", "p.txt", "link.png"].map(|name| folder.join(name).display().to_string());
    let files = [
        (&scene, "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n"),
        (&points, "0.5,1.5,2.5\n3,4,5\n"),
    ];
    for (file, text) in files {
        fs::write(file, text).expect("a writable folder");
    }
    symlink("s.toml", &link).expect("a link");
    for option in ["--png", "--cast"] {
        for (shown, file, what) in [
            (&*scene, &*scene, "the scene is read from that file"),
            (&*scene, &*link, "the scene is read from that file"),
            ("unit", &*scene, "it is a scene (toml)"),
            ("unit", &*link, "it is a scene (toml)"),
            ("unit", &*points, "it is a scene (csv)"),
        ] {
            let message = refuses(&format!("{shown} --size 8x4 {option} {file}"));
            assert!(message.starts_with(&format!("{option} {file}: {what}")), "{message}");
        }
    }
    for (file, text) in files {
        assert_eq!(fs::read_to_string(file).expect("a file"), text);
    }
    let recording = folder.join("a.cast").display().to_string();
    for _ in 0..2 {
        assert_eq!(prints(&format!("unit --size 8x4 --frames 2 --cast {recording}")), "");
    }
}

/// Neither a new one nor a scene.
#[test]
fn the_name_of_a_folder_is_no_file() {
    let folder = folder("whole-folder");
    let text = "1\n\nH 0 0 0\n";
    fs::write(folder.join("other.xyz"), text).expect("a writable folder");
    for name in ["pictures/", "pictures/.", "other.xyz/"] {
        let output = run(split(&format!("unit --png {}/{name}", folder.display())));
        let message = stderr(&output);
        assert!(!output.status.success() && message.contains("not a directory"), "{message}");
        assert_eq!(names(&folder), ["other.xyz"], "{name}");
    }
    assert_eq!(fs::read_to_string(folder.join("other.xyz")).expect("a file"), text);
}

/// It has a name, but no place.
#[test]
fn a_pipe_by_its_name_takes_a_picture() {
    assert!(writes("unit --size 8x4 --png /dev/stdout").starts_with(b"\x89PNG"));
    let rays = folder("whole-pipe").join("r.npy");
    let words = format!("cases --count 2 --out-spheres /dev/stdout --out-rays {}", rays.display());
    assert!(writes(&words).starts_with(b"\x93NUMPY") && rays.is_file());
}

#[test]
fn two_outputs_are_not_one() {
    let folder = folder("whole-twice");
    let [file, link, taken] =
        ["a.npy", "link.npy", "stdout"].map(|name| folder.join(name).display().to_string());
    symlink("a.npy", &link).expect("a link");
    let words = |spheres: &str, rays: &str| {
        format!("cases --count 10 --out-spheres {spheres} --out-rays {rays}")
    };
    for (spheres, rays) in [(&*file, &*file), (&*file, &*link), (&*link, &*file), ("-", "-")] {
        let what = "--out-spheres has that file; name another";
        assert_eq!(refuses(&words(spheres, rays)), format!("--out-rays {rays}: {what}"));
    }
    assert_eq!(names(&folder), ["link.npy"]);
    prints(&words("/dev/null", "/dev/null"));
    // Nor is standard output by its name, or by the name of its file, another one.
    let into_taken = |words: &str| {
        let mut command = spherule();
        command.args(split(words)).stdout(File::create(&taken).expect("a writable folder"));
        refusal(&command.output().expect("the program runs"))
    };
    for output in ["/dev/stdout", &*taken] {
        let message = into_taken(&format!("cases --count 2 --out-rays - --out-spheres {output}"));
        assert!(message.ends_with("has that file; name another"), "{message}");
        let trace = format!("trace --spheres no.npy --rays no.npy --out-t {output}");
        let what = "standard output has the report; name a file";
        assert_eq!(into_taken(&trace), format!("--out-t {output}: {what}"));
    }
    // A link to no file leads to the new one.
    prints(&words(&link, "/dev/null"));
    assert!(Path::new(&link).is_symlink() && Path::new(&file).is_file());
}
