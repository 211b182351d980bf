//! `--png`: a file that is whole, of the right size, and always the same; or none.

use crate::run::{folder, is_heard, names, printed, refusal, run, spherule};
use png::{BitDepth, ColorType, Decoder, SrgbRenderingIntent};
use rustix::process::{Pid, Signal, kill_process};
use std::fs::{self, OpenOptions, Permissions};
use std::io::Cursor;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// What the program makes of these words in a file.
fn png(words: &str) -> Vec<u8> {
    let output = run(words.split(' ').chain(["--png", "-"]));
    assert_eq!((output.status.code(), &*output.stderr), (Some(0), b"".as_slice()), "{words}");
    output.stdout
}

/// Width, height, and all pixels.
fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = Decoder::new(Cursor::new(bytes)).read_info().expect("a PNG");
    let info = reader.info();
    assert_eq!((info.color_type, info.bit_depth), (ColorType::Rgb, BitDepth::Eight));
    assert_eq!(info.srgb, Some(SrgbRenderingIntent::Perceptual));
    let (width, height) = info.size();
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("all of it");
    reader.finish().expect("its end");
    (width, height, pixels)
}

/// The one line of a failure.
fn failure(output: &Output) -> String {
    let stderr = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!((output.status.code(), &*output.stdout), (Some(1), b"".as_slice()), "{stderr}");
    assert_eq!(stderr.lines().count(), 1, "{stderr}");
    stderr.trim_end().to_owned()
}

#[test]
fn a_cell_is_eight_pixels_by_sixteen() {
    let size = |words| {
        let (width, height, _) = decoded(&png(words));
        (width, height)
    };
    assert_eq!(size("unit"), (640, 384));
    assert_eq!(size("unit --size 7x3"), (56, 48));
    assert_eq!(size("unit --size 7x3 --cell-aspect 1:1"), (56, 24));
    assert_eq!(size("unit --size 1x1 --cell-aspect 20:1"), (8, 1));
}

/// Whatever whole pixels make of the shape of a cell.
#[test]
fn a_sphere_is_round_in_cells_of_every_shape() {
    for (shape, size) in [
        ("9:20", "40x12"),
        ("11:24", "40x12"),
        ("1:2", "40x12"),
        ("3:5", "40x12"),
        ("3:1", "20x40"),
        ("20:1", "20x120"),
    ] {
        let words = format!("unit --size {size} --cell-aspect {shape}");
        let (width, _, pixels) = decoded(&png(&words));
        let lines: Vec<&[u8]> = pixels.chunks(3 * width as usize).collect();
        let rows = lines.iter().filter(|line| line.iter().any(|&byte| byte > 0)).count();
        let is_lit = |x: &usize| lines.iter().any(|line| line[3 * x] > 0);
        let columns = (0..width as usize).filter(is_lit).count();
        assert!(rows > 50 && rows.abs_diff(columns) <= 2, "{words}: {columns} x {rows}");
    }
}

#[test]
fn a_disc_is_white_in_its_middle_and_grey_on_its_edge() {
    let (width, height, pixels) = decoded(&png("unit --size 40x20"));
    let at = |x: u32, y: u32| &pixels[3 * (y * width + x) as usize..][..3];
    assert_eq!(at(width / 2, height / 2), [255; 3]);
    assert_eq!(at(0, 0), [0; 3]);
    let grey = pixels.iter().filter(|&&byte| byte > 0 && byte < 255).count();
    assert!(grey > 100, "{grey} bytes of the edge");
}

#[test]
fn threads_structures_and_levels_do_not_show() {
    for scene in ["marbles", "caffeine"] {
        let words = format!("{scene} --size 50x11");
        let expected = png(&format!("{words} --threads 1"));
        for more in ["--threads 2", "--threads 7", "--structure bvh", "--level baseline"] {
            assert!(png(&format!("{words} {more}")) == expected, "{scene} {more}");
        }
    }
}

/// Options of characters, colours and samples change nothing; nor is anything printed beside a file.
#[test]
fn what_is_asked_of_cells_does_not_matter() {
    let folder = folder("png-quiet");
    let expected = png("marbles --size 20x6");
    for more in ["--once", "--charset half --color 16 --samples 1"] {
        let file = folder.join("a.png");
        let words = format!("marbles --size 20x6 {more}");
        let output = run(words.split(' ').map(Path::new).chain(["--png".as_ref(), file.as_path()]));
        assert_eq!(printed(&output), "");
        assert!(fs::read(file).expect("a file") == expected, "{more}");
    }
    assert_eq!(names(&folder), ["a.png"]);
}

#[test]
fn an_option_of_scenes_matters() {
    let plain = png("caffeine --size 20x6");
    assert!(png("caffeine --size 20x6 --background #ffffff") != plain);
    assert!(png("caffeine --size 20x6 --projection parallel") != plain);
    assert!(refusal(&run(["nonesuch", "--png", "-"])).contains("no such scene"));
}

#[test]
fn a_file_is_replaced_by_a_whole_one_and_a_link_is_followed() {
    let folder = folder("png-replaced");
    let (file, link) = (folder.join("a.png"), folder.join("link.png"));
    fs::write(&file, "before").expect("a writable folder");
    std::os::unix::fs::symlink("a.png", &link).expect("a link");
    let output = run(["unit".as_ref(), "--png".as_ref(), link.as_os_str()]);
    assert_eq!(printed(&output), "");
    assert!(link.is_symlink());
    assert!(fs::read(file).expect("a file") == png("unit"));
    assert_eq!(names(&folder).len(), 2);
}

/// Who may not read the old file may not read the new one; nor does the user's mask count again.
#[test]
fn a_file_that_is_replaced_keeps_its_mode() {
    let file = folder("png-mode").join("a.png");
    let mode = || fs::metadata(&file).expect("a file").permissions().mode() & 0o777;
    for old in [0o600, 0o666] {
        fs::write(&file, "before").expect("a writable folder");
        fs::set_permissions(&file, Permissions::from_mode(old)).expect("the owner's file");
        let output = run(["unit".as_ref(), "--png".as_ref(), file.as_os_str()]);
        assert_eq!((&*printed(&output), mode()), ("", old), "{old:o}");
    }
}

/// Who owns the folder could put another in its place.
#[test]
fn a_file_that_is_write_protected_stays() {
    let folder = folder("png-protected");
    let file = folder.join("a.png");
    fs::write(&file, "before").expect("a writable folder");
    fs::set_permissions(&file, Permissions::from_mode(0o444)).expect("the owner's file");
    if OpenOptions::new().write(true).open(&file).is_ok() {
        println!("skipped: root may write to any file");
        return;
    }
    let found = failure(&run(["unit".as_ref(), "--png".as_ref(), file.as_os_str()]));
    assert_eq!(found, format!("spherule: {}: permission denied", file.display()));
    assert_eq!(fs::read(&file).expect("a file"), b"before");
    assert_eq!(names(&folder), ["a.png"]);
}

#[test]
fn a_folder_that_is_not_there() {
    let message = "spherule: no/such/a.png: no such file or directory";
    assert_eq!(failure(&run(["unit", "--png", "no/such/a.png"])), message);
    let folder = folder("png-folder");
    let name = folder.to_str().expect("UTF-8");
    let found = failure(&run(["unit", "--png", name]));
    assert_eq!(found, format!("spherule: {name}: is a directory"));
}

#[test]
fn a_device_that_is_full() {
    if !Path::new("/dev/full").exists() {
        println!("skipped: no /dev/full");
        return;
    }
    let found = failure(&run(["unit", "--png", "/dev/full"]));
    assert_eq!(found, "spherule: /dev/full: no space left on device");
}

/// A disk that takes no more than some kilobytes, as the shell's limit has it.
#[test]
fn a_disk_that_is_full_keeps_no_half_file() {
    let folder = folder("png-full");
    let file = folder.join("a.png");
    let picture = |limit: u32| {
        let script = format!("ulimit -f {limit}; exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script, env!("CARGO_BIN_EXE_spherule"), "marbles"]);
        command.args(["--size", "40x12", "--png"]).arg(&file).output().expect("a shell")
    };
    let found = failure(&picture(8));
    assert!(found.ends_with("a.png: file too large"), "{found}");
    assert_eq!(names(&folder), [""; 0]);
    // What was there before stays.
    fs::write(&file, "before").expect("a writable folder");
    failure(&picture(8));
    assert_eq!(fs::read(&file).expect("a file"), b"before");
    // The control.
    assert!(picture(1 << 20).status.success());
    assert!(fs::read(&file).expect("a file") == png("marbles --size 40x12"));
}

/// Until there is a file with something in it, under whatever name.
fn wait_until_begun(folder: &Path) {
    let deadline = Instant::now() + Duration::from_secs(60);
    let begun = || {
        let mut entries = fs::read_dir(folder).expect("a folder").flatten();
        entries.any(|entry| entry.metadata().is_ok_and(|data| data.len() > 0))
    };
    while !begun() {
        assert!(Instant::now() < deadline, "no file");
        thread::sleep(Duration::from_millis(2));
    }
}

/// As `nohup` starts it, or a script in the background.
#[test]
fn a_signal_that_is_ignored_stays_so() {
    for (name, signal) in [("HUP", Signal::HUP), ("INT", Signal::INT), ("QUIT", Signal::QUIT)] {
        let folder = folder("png-nohup");
        let file = folder.join("a.png");
        let mut child = Command::new("sh")
            .args(["-c", &format!("trap '' {name}; exec \"$0\" \"$@\"")])
            .arg(spherule().get_program())
            .args(["marbles", "--size", "100x60", "--png"])
            .arg(&file)
            .stdout(Stdio::null())
            .spawn()
            .expect("a shell");
        wait_until_begun(&folder);
        assert!(!file.exists(), "it was done too soon");
        kill_process(Pid::from_child(&child), signal).expect("it runs");
        assert!(child.wait().expect("it ends").success(), "{name}");
        assert_eq!(names(&folder), ["a.png"], "{name}");
    }
}

#[test]
fn a_signal_leaves_no_half_file() {
    for signal in [Signal::TERM, Signal::INT, Signal::HUP].into_iter().filter(is_heard) {
        let folder = folder("png-signal");
        let file = folder.join("a.png");
        let mut child = spherule()
            .args(["marbles", "--size", "2000x2000", "--png"])
            .arg(&file)
            .stdout(Stdio::null())
            .spawn()
            .expect("the program runs");
        wait_until_begun(&folder);
        assert!(!file.exists());
        kill_process(Pid::from_child(&child), signal).expect("it runs");
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(signal.as_raw()), "{status}");
        assert_eq!(names(&folder), [""; 0]);
    }
}

#[test]
fn a_reader_that_goes_away_is_a_success() {
    let mut child = spherule()
        .args(["unit", "--size", "200x60", "--png", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!((output.status.code(), &*output.stderr), (Some(0), b"".as_slice()));
}
