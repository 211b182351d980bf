//! The picture that a screen should show, made in another way: by `spherule --once` with its camera
//! at the same place.

use super::file::TestFile;
use super::look::{Look, look};
use super::viewer::{COLUMNS, PICTURE_ROWS, VIEW};
use spherule::view::{Lens, View};
use spherule_tests::binary::spherule;
use std::num::NonZeroU16;
use std::process::{Command, Stdio};
use std::sync::LazyLock;

/// A scene of three lit spheres and a shadow, seen from `view`.
pub(crate) fn scene_file(view: &View) -> TestFile {
    TestFile::new("toml", text(view))
}

/// Options under which viewer and `--once` draw the same; both get them.
pub(crate) const OPTIONS: [&str; 6] =
    ["--color", "truecolor", "--charset", "half", "--cell-aspect", "1:2"];

fn text(view: &View) -> String {
    // As f64, whose shortest decimal reads back as the same f32.
    let vector = |v: [f32; 3]| v.map(|x| format!("{:?}", f64::from(x))).join(", ");
    let lens = match view.lens {
        Lens::Perspective { fov } => {
            format!("projection = \"perspective\"\nfov = {:?}", f64::from(fov))
        }
        Lens::Parallel { height } => {
            format!("projection = \"parallel\"\nheight = {:?}", f64::from(height))
        }
    };
    format!(
        "shadows = true\n\
         background = \"#102030\"\n\
         [camera]\n\
         eye = [{}]\n\
         target = [{}]\n\
         up = [{}]\n\
         {lens}\n\
         [[sphere]]\n\
         center = [0, 0, 0]\n\
         radius = 1.0\n\
         color = \"#d04020\"\n\
         [[sphere]]\n\
         center = [1.5, 0.5, -0.5]\n\
         radius = 0.75\n\
         color = \"#2060e0\"\n\
         [[sphere]]\n\
         center = [-1.25, -0.5, 0.5]\n\
         radius = 0.5\n\
         color = \"#f0e040\"\n\
         [[light]]\n\
         direction = [1, 2, 1]\n",
        vector(view.eye.to_array()),
        vector(view.target.to_array()),
        vector(view.up.to_array()),
    )
}

/// What `spherule --once` prints of the scene seen from `view`, as a terminal shows it.
pub(crate) fn once(view: &View, columns: u16, rows: u16) -> Vec<Vec<Look>> {
    once_with(&[], view, columns, rows)
}

/// The same of the first view, in the viewer's size.
pub(crate) fn first() -> &'static [Vec<Look>] {
    static FIRST: LazyLock<Vec<Vec<Look>>> = LazyLock::new(|| once(&VIEW, COLUMNS, PICTURE_ROWS));
    &FIRST
}

/// What [`once`] has with more options.
pub(crate) fn once_with(options: &[&str], view: &View, columns: u16, rows: u16) -> Vec<Vec<Look>> {
    let scene = scene_file(view);
    let mut command = Command::new(spherule());
    drawn(command.arg(scene.path()).args(OPTIONS).args(options), columns, rows)
}

/// What a command line, as a shell reads it, prints with `--once`: its first word is `spherule`.
pub(crate) fn once_by(line: &str, columns: u16, rows: u16) -> Vec<Vec<Look>> {
    let script = line.replacen("spherule", "\"$0\"", 1) + " \"$@\"";
    drawn(Command::new("sh").args(["-c", &script]).arg(spherule()), columns, rows)
}

fn drawn(command: &mut Command, columns: u16, rows: u16) -> Vec<Vec<Look>> {
    let output = command
        .args(["--once", "--size", &format!("{columns}x{rows}")])
        .env_remove("NO_COLOR")
        .stdin(Stdio::null())
        .output()
        .expect("spherule runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // A row more, so that the last newline does not scroll.
    let cells = |count| NonZeroU16::new(count).expect("not 0");
    let mut terminal = vt100::Parser::new(cells(rows + 1), cells(columns), 0);
    for line in output.stdout.split_inclusive(|byte| *byte == b'\n') {
        terminal.process(line);
        terminal.process(b"\r");
    }
    look(terminal.screen(), rows)
}
