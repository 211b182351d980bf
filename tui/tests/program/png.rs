//! `--png`: a file that is whole, of the right size, and always the same; or none.

use crate::run::{by_script, failure, folder, is_heard, names, printed, run, spherule, writes};
use png::{BitDepth, ColorType, Decoder, SrgbRenderingIntent};
use rustix::process::{Pid, Signal, kill_process};
use spherule::picture::Image;
use std::fs::{self, OpenOptions, Permissions};
use std::io::Cursor;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// What the program makes of these words in a file.
pub(crate) fn png(words: &str) -> Vec<u8> {
    writes(&format!("{words} --png -"))
}

/// All pixels.
pub(crate) fn decoded(bytes: &[u8]) -> Image {
    let mut reader = Decoder::new(Cursor::new(bytes)).read_info().expect("a PNG");
    let info = reader.info();
    assert_eq!((info.color_type, info.bit_depth), (ColorType::Rgb, BitDepth::Eight));
    assert_eq!(info.srgb, Some(SrgbRenderingIntent::Perceptual));
    let (width, height) = info.size();
    let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut rgb).expect("all of it");
    reader.finish().expect("its end");
    Image { width, height, rgb }
}

/// A picture of the unit sphere in this file.
fn unit(file: &Path) -> Output {
    run(["unit".as_ref(), "--png".as_ref(), file.as_os_str()])
}

#[test]
fn a_cell_is_eight_pixels_by_sixteen() {
    for (words, size) in [
        ("unit", (640, 384)),
        ("unit --size 7x3", (56, 48)),
        ("unit --size 7x3 --cell-aspect 1:1", (56, 24)),
        ("unit --size 1x1 --cell-aspect 20:1", (8, 1)),
    ] {
        let Image { width, height, .. } = decoded(&png(words));
        assert_eq!((width, height), size, "{words}");
    }
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
        let Image { width, rgb, .. } = decoded(&png(&words));
        let lines: Vec<&[u8]> = rgb.chunks(3 * width as usize).collect();
        let rows = lines.iter().filter(|line| line.iter().any(|&byte| byte > 0)).count();
        let is_lit = |x: &usize| lines.iter().any(|line| line[3 * x] > 0);
        let columns = (0..width as usize).filter(is_lit).count();
        assert!(rows > 50 && rows.abs_diff(columns) <= 2, "{words}: {columns} x {rows}");
    }
}

#[test]
fn a_disc_is_white_in_its_middle_and_grey_on_its_edge() {
    let Image { width, height, rgb } = decoded(&png("unit --size 40x20"));
    let at = |x: u32, y: u32| &rgb[3 * (y * width + x) as usize..][..3];
    assert_eq!(at(width / 2, height / 2), [255; 3]);
    assert_eq!(at(0, 0), [0; 3]);
    let grey = rgb.iter().filter(|&&byte| byte > 0 && byte < 255).count();
    assert!(grey > 100, "{grey} bytes of the edge");
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
        assert_eq!(printed(output), "");
        assert!(fs::read(file).expect("a file") == expected, "{more}");
    }
    assert_eq!(names(&folder), ["a.png"]);
}

#[test]
fn a_file_is_replaced_by_a_whole_one_and_a_link_is_followed() {
    let folder = folder("png-replaced");
    let (file, link) = (folder.join("a.png"), folder.join("link.png"));
    fs::write(&file, "before").expect("a writable folder");
    std::os::unix::fs::symlink("a.png", &link).expect("a link");
    assert_eq!(printed(unit(&link)), "");
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
        assert_eq!((&*printed(unit(&file)), mode()), ("", old), "{old:o}");
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
    assert_eq!(failure(&unit(&file)), format!("{}: permission denied", file.display()));
    assert_eq!(fs::read(&file).expect("a file"), b"before");
    assert_eq!(names(&folder), ["a.png"]);
}

#[test]
fn a_folder_that_is_not_there() {
    let message = "no/such/a.png: no such file or directory";
    assert_eq!(failure(&unit(Path::new("no/such/a.png"))), message);
    let folder = folder("png-folder");
    assert_eq!(failure(&unit(&folder)), format!("{}: is a directory", folder.display()));
}

#[test]
fn a_device_that_is_full() {
    if !Path::new("/dev/full").exists() {
        println!("skipped: no /dev/full");
        return;
    }
    let found = failure(&unit(Path::new("/dev/full")));
    assert_eq!(found, "/dev/full: no space left on device");
}

/// A disk that takes no more than some kilobytes, as the shell's limit has it.
#[test]
fn a_disk_that_is_full_keeps_no_half_file() {
    let folder = folder("png-full");
    let file = folder.join("a.png");
    let picture = |limit: u32| {
        let mut command = by_script(&format!("ulimit -f {limit}; exec \"$0\" \"$@\""));
        command.args(["marbles", "--size", "40x12", "--png"]).arg(&file);
        command.output().expect("a shell")
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
        let mut command = by_script(&format!("trap '' {name}; exec \"$0\" \"$@\""));
        command.args(["marbles", "--size", "100x60", "--png"]).arg(&file).stdout(Stdio::null());
        let mut child = command.spawn().expect("a shell");
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
        let mut command = spherule();
        command.args(["marbles", "--size", "2000x2000", "--png"]).arg(&file).stdout(Stdio::null());
        let mut child = command.spawn().expect("the program runs");
        wait_until_begun(&folder);
        assert!(!file.exists());
        kill_process(Pid::from_child(&child), signal).expect("it runs");
        let status = child.wait().expect("it ends");
        assert_eq!(status.signal(), Some(signal.as_raw()), "{status}");
        assert_eq!(names(&folder), [""; 0]);
    }
}
