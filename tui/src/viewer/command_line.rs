//! The command line that shows what is seen now.

use crate::arguments::SceneArguments;
use crate::choice::name;
use crate::length::length;
use crate::scene::radii::RadiusBy;
use crate::view::{Lens, LensKind, View};
use glam::DVec3;
use spherule_kernel::Vec3;

/// `spherule` with the scene that was `asked` for, whose zero is at `origin` in its file, all that `view` needs, and all
/// that the file must be read by.
pub(super) fn command_line(
    asked: &SceneArguments,
    frame: usize,
    view: &View,
    origin: DVec3,
) -> String {
    let place = |point: Vec3| {
        // The digits of single precision, where they are the file's own.
        if origin == DVec3::ZERO {
            return format!("{},{},{}", point.x, point.y, point.z);
        }
        let DVec3 { x, y, z } = origin + point.as_dvec3();
        format!("{x},{y},{z}")
    };
    let (fov, projection) = match view.lens {
        Lens::Perspective { fov } => (fov.to_string(), LensKind::Perspective),
        // The angle under which the eye sees the height of the picture at the target.
        Lens::Parallel { height } => {
            let distance = f64::from(length(view.eye - view.target));
            let fov = 2.0 * (f64::from(height) / 2.0 / distance).atan().to_degrees();
            // Neither 0 nor 180 is an angle that can be asked for.
            let fov = fov.clamp(f32::MIN_POSITIVE.into(), 180.0_f32.next_down().into());
            (fov.to_string(), LensKind::Parallel)
        }
    };
    let mut line = format!(
        "spherule {} --eye {} --target {} --fov {fov} --projection {}",
        scene_name(&asked.name),
        place(view.eye),
        place(view.target),
        name(&projection)
    );
    for (option, value) in reading(asked, frame) {
        let between = if value.starts_with('-') { '=' } else { ' ' };
        line += &format!(" {option}{between}{}", quoted(&value));
    }
    line
}

/// The options without which the file would be read as another scene.
fn reading(
    asked: &SceneArguments,
    frame: usize,
) -> impl Iterator<Item = (&'static str, String)> + use<> {
    let radius = asked.radius.as_ref().map(|radius| match radius {
        RadiusBy::VanDerWaals => "van-der-waals".to_owned(),
        RadiusBy::Covalent => "covalent".to_owned(),
        RadiusBy::Number(radius) => radius.to_string(),
        RadiusBy::Column(column) => column.to_string(),
    });
    let file = &asked.file;
    [
        ("--frame", (frame > 0).then(|| frame.to_string())),
        ("--format", file.format.map(|format| name(&format))),
        ("--columns", file.columns.clone()),
        ("--topology", file.topology.clone()),
        ("--radius", radius),
    ]
    .into_iter()
    .filter_map(|(option, value)| Some((option, value?)))
}

/// The scene as a word that is no option.
fn scene_name(name: &str) -> String {
    if name.starts_with('-') && name != "-" { quoted(&format!("./{name}")) } else { quoted(name) }
}

/// A word of a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./,".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::Arguments;
    use clap::Parser;

    fn asked(words: &[&str]) -> SceneArguments {
        let words = std::iter::once("spherule").chain(words.iter().copied());
        Arguments::try_parse_from(words).expect("a command line").picture.scene
    }

    /// The command line of the first frame, in coordinates of the file.
    fn line(scene: &str, view: &View) -> String {
        command_line(&asked(&[scene]), 0, view, DVec3::ZERO)
    }

    #[test]
    fn it_has_all_digits() {
        let view = View { eye: Vec3::new(0.1, -2.0, 1e-7), ..View::FRONT };
        assert_eq!(
            line("a b's.toml", &view),
            r"spherule 'a b'\''s.toml' --eye 0.1,-2,0.0000001 --target 0,0,0 --fov 40 --projection perspective"
        );
        let parallel = View { lens: Lens::Parallel { height: 10.0 }, ..View::FRONT };
        assert!(line("unit", &parallel).ends_with(" --fov 90 --projection parallel"));
    }

    #[test]
    fn a_name_that_begins_with_a_dash_is_no_option() {
        let words = ["--topology=-a.gro", "--", "-dash.toml"];
        let line = command_line(&asked(&words), 0, &View::FRONT, DVec3::ZERO);
        assert!(line.starts_with("spherule ./-dash.toml --eye "), "{line}");
        assert!(line.ends_with(" --topology=-a.gro"), "{line}");
        let again = asked(&line.split(' ').skip(1).collect::<Vec<_>>());
        assert_eq!(again.name, "./-dash.toml");
        assert_eq!(again.file.topology.as_deref(), Some("-a.gro"));
        let line = command_line(&asked(&["-"]), 0, &View::FRONT, DVec3::ZERO);
        assert!(line.starts_with("spherule - --eye "), "{line}");
    }

    #[test]
    fn its_angle_can_be_asked_for() {
        for height in [1e30, 1e9, 1.0, 1e-9, 1e-30] {
            let view = View { lens: Lens::Parallel { height }, ..View::FRONT };
            let line = line("unit", &view);
            let again = asked(&line.split(' ').skip(1).collect::<Vec<_>>());
            assert_eq!(again.projection, Some(LensKind::Parallel), "{line}");
        }
    }

    #[test]
    fn it_has_the_frame_and_what_the_file_is_read_by() {
        let words = ["t.dat", "--format", "csv", "--columns", "a,b,c", "--radius", "0.5"];
        let line = command_line(&asked(&words), 0, &View::FRONT, DVec3::ZERO);
        let end = " --projection perspective --format csv --columns a,b,c --radius 0.5";
        assert!(line.ends_with(end), "{line}");
        let words = ["t.xtc", "--topology", "a b.gro", "--frame", "2", "--radius", "vdw"];
        let line = command_line(&asked(&words), 7, &View::FRONT, DVec3::ZERO);
        let end = " --frame 7 --topology 'a b.gro' --radius van-der-waals";
        assert!(line.ends_with(end), "{line}");
    }

    #[test]
    fn it_is_in_the_coordinates_of_the_file() {
        let view = View { eye: Vec3::new(0.5, -2.0, 1e-7), ..View::FRONT };
        let line = command_line(&asked(&["map"]), 0, &view, DVec3::new(5e5, 5.4e6, 0.0));
        assert!(line.starts_with("spherule map --eye 500000.5,5399998,0.0000001"), "{line}");
        assert!(line.contains(" --target 500000,5400000,0 "), "{line}");
    }
}
