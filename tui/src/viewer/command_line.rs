//! The command line that shows what is seen now.

mod drawing;

use super::colors::Colors;
use super::state::State;
use crate::arguments::{Arguments, PictureArguments, SceneArguments};
use crate::choice::name;
use crate::harmless::is_obeyed;
use crate::length::length;
use crate::scene::Scene;
use crate::scene::radii::RadiusBy;
use crate::view::{Lens, LensKind};
use clap::CommandFactory;
use drawing::drawing;
use glam::DVec3;
use spherule_kernel::Vec3;
use std::ffi::OsString;
use std::str::Utf8Chunk;

/// `spherule` with the scene that was `asked` for, all that its view needs, all that the file must be read by, and how it is drawn.
pub(super) fn command_line(
    asked: &PictureArguments,
    frame: usize,
    state: &State,
    scene: &Scene,
    colors: &Colors,
) -> String {
    let view = &state.shown.view;
    let origin = scene.origin;
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
        scene_name(asked.scene.name.path().as_os_str().as_encoded_bytes()),
        place(view.eye),
        place(view.target),
        name(&projection)
    );
    let drawing = drawing(asked, state, scene, colors).into_iter();
    let drawing = drawing.map(|(option, value)| (option, value.map(OsString::from)));
    let reading = reading(&asked.scene, frame, scene);
    let reading = reading.map(|(option, value)| (option, Some(value)));
    for (option, value) in reading.chain(drawing) {
        line += &format!(" {option}");
        if let Some(value) = value {
            let value = value.as_encoded_bytes();
            line.push(if value.starts_with(b"-") { '=' } else { ' ' });
            line += &quoted(value);
        }
    }
    line
}

/// The options without which the file would be read as another scene.
fn reading(
    asked: &SceneArguments,
    frame: usize,
    scene: &Scene,
) -> impl Iterator<Item = (&'static str, OsString)> + use<> {
    // A frame that lacks them has kept its own.
    let radius = asked.radius.as_ref().filter(|radius| has_radii(scene, radius));
    let radius = radius.map(|radius| match radius {
        RadiusBy::VanDerWaals => "van-der-waals".to_owned(),
        RadiusBy::Covalent => "covalent".to_owned(),
        RadiusBy::Number(radius) => radius.to_string(),
        RadiusBy::Column(column) => column.to_string(),
    });
    let radius = radius.or_else(|| radius_of_film(asked, frame, scene));
    let reading = &asked.file.reading;
    [
        ("--frame", (frame > 0).then(|| OsString::from(frame.to_string()))),
        ("--format", reading.format.map(|format| OsString::from(name(&format)))),
        ("--columns", reading.columns.as_ref().map(OsString::from)),
        ("--topology", reading.topology.as_ref().map(|file| OsString::from(file.path()))),
        ("--radius", radius.map(OsString::from)),
    ]
    .into_iter()
    .filter_map(|(option, value)| Some((option, value?)))
}

/// Whether `scene` has what these radii are made of.
fn has_radii(scene: &Scene, radius: &RadiusBy) -> bool {
    let attributes = scene.attributes();
    match radius {
        RadiusBy::VanDerWaals | RadiusBy::Covalent => attributes.elements.is_some(),
        RadiusBy::Number(_) => true,
        RadiusBy::Column(name) => attributes.column(name).is_some(),
    }
}

/// The radius of all spheres, where the file states none: another frame has fixed it, and this one alone would have its own.
fn radius_of_film(asked: &SceneArguments, frame: usize, scene: &Scene) -> Option<String> {
    let is_first = frame == asked.file.frame.unwrap_or(0);
    let radius = scene.unstated_radius.filter(|_| !is_first)?;
    scene.spheres().iter().all(|sphere| sphere.radius == radius).then(|| radius.to_string())
}

/// The scene as a word that is neither an option nor a command.
fn scene_name(name: &[u8]) -> String {
    let is_option = name.starts_with(b"-") && name != b"-";
    let is_command = |name: &str| Arguments::command().find_subcommand(name).is_some();
    if is_option || str::from_utf8(name).is_ok_and(is_command) {
        quoted(&[b"./", name].concat())
    } else {
        quoted(name)
    }
}

/// A word of a shell. What is not seen, or is no text, is written as bash, ksh and zsh read it.
fn quoted(word: &[u8]) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"_-./,:".contains(&byte);
    match str::from_utf8(word) {
        Ok(text) if !text.is_empty() && text.bytes().all(is_plain) => text.to_owned(),
        Ok(text) if !text.chars().any(is_obeyed) => {
            format!("'{}'", text.replace('\'', r"'\''"))
        }
        _ => format!("$'{}'", word.utf8_chunks().map(|chunk| escaped(&chunk)).collect::<String>()),
    }
}

/// Text between `$'` and `'`, and the bytes behind it that are none.
fn escaped(chunk: &Utf8Chunk<'_>) -> String {
    let octal = |bytes: &[u8]| bytes.iter().map(|byte| format!("\\{byte:03o}")).collect::<String>();
    let letter = |letter: char| match letter {
        '\'' | '\\' => format!("\\{letter}"),
        _ if is_obeyed(letter) => octal(letter.encode_utf8(&mut [0; 4]).as_bytes()),
        _ => letter.to_string(),
    };
    chunk.valid().chars().map(letter).collect::<String>() + &octal(chunk.invalid())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::coloring::ColorBy;
    use crate::scene::attributes::Attributes;
    use crate::view::View;
    use crate::viewer::Start;
    use clap::Parser;
    use spherule_kernel::{Sphere, SphereList};
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStringExt;

    fn asked(words: &[impl AsRef<OsStr>]) -> PictureArguments {
        let program = OsStr::new("spherule");
        let words = std::iter::once(program).chain(words.iter().map(AsRef::as_ref));
        Arguments::try_parse_from(words).expect("a command line").picture
    }

    /// The command line of a view, whose style is the usual one.
    fn told(asked: &PictureArguments, frame: usize, view: &View, scene: &Scene) -> String {
        let start = Start { view: *view, ..Start::FRONT };
        let colors = Colors::new(scene, &ColorBy::Scene, None);
        command_line(asked, frame, &State::new(start, colors.start()), scene, &colors)
    }

    /// The command line of a frame, in coordinates of the file.
    fn of_words(line: &[&str], frame: usize) -> String {
        told(&asked(line), frame, &View::FRONT, &Scene::new())
    }

    /// The scene of a command line without quotes.
    fn again(line: &str) -> SceneArguments {
        asked(&line.split(' ').skip(1).collect::<Vec<_>>()).scene
    }

    /// The command line of the first frame, in coordinates of the file.
    fn line(scene: &str, view: &View) -> String {
        told(&asked(&[scene]), 0, view, &Scene::new())
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
    fn a_name_is_neither_an_option_nor_a_command() {
        for command in ["trace", "generate"] {
            let line = of_words(&["--", command], 0);
            assert!(line.starts_with(&format!("spherule ./{command} --eye ")), "{line}");
        }
        let line = of_words(&["--topology=-a.gro", "--", "-dash.toml"], 0);
        assert!(line.starts_with("spherule ./-dash.toml --eye "), "{line}");
        assert!(line.ends_with(" --topology=-a.gro"), "{line}");
        let again = again(&line);
        assert_eq!(again.name, "./-dash.toml");
        assert_eq!(again.file.reading.topology.as_deref(), Some("-a.gro"));
        let line = of_words(&["-"], 0);
        assert!(line.starts_with("spherule - --eye "), "{line}");
    }

    #[test]
    fn a_name_that_cannot_be_printed_is_escaped() {
        let names: [(&[u8], &str); 9] = [
            (b"a:1,b.toml", "a:1,b.toml"),
            (b"", "''"),
            ("caf\u{e9}.toml".as_bytes(), "'caf\u{e9}.toml'"),
            (b"bad\xff7.toml", r"$'bad\3777.toml'"),
            (b"esc\x1b[31m.toml", r"$'esc\033[31m.toml'"),
            (b"it's\\\n", r"$'it\'s\\\012'"),
            ("\u{9b}\u{e9}".as_bytes(), "$'\\302\\233\u{e9}'"),
            ("a\u{202e}b".as_bytes(), r"$'a\342\200\256b'"),
            (b"-\xff", r"$'./-\377'"),
        ];
        for (name, expected) in names {
            assert_eq!(scene_name(name), expected);
        }
        let topology = OsString::from_vec(b"--topology=t\xff.gro".to_vec());
        let asked = asked(&[OsString::from_vec(b"t\xff.xtc".to_vec()), topology]);
        let line = told(&asked, 0, &View::FRONT, &Scene::new());
        assert!(line.starts_with(r"spherule $'t\377.xtc' --eye "), "{line}");
        assert!(line.ends_with(r" --topology $'t\377.gro'"), "{line}");
    }

    #[test]
    fn its_angle_can_be_asked_for() {
        for height in [1e30, 1e9, 1.0, 1e-9, 1e-30] {
            let view = View { lens: Lens::Parallel { height }, ..View::FRONT };
            let line = line("unit", &view);
            assert_eq!(again(&line).projection, Some(LensKind::Parallel), "{line}");
        }
    }

    #[test]
    fn it_has_the_frame_and_what_the_file_is_read_by() {
        let words = ["t.dat", "--format", "csv", "--columns", "a,b,c", "--radius", "0.5"];
        let line = of_words(&words, 0);
        let end = " --projection perspective --format csv --columns a,b,c --radius 0.5";
        assert!(line.ends_with(end), "{line}");
        let words = ["t.xtc", "--topology", "a b.gro", "--frame", "2", "--radius", "vdw"];
        let mut elements = Attributes::default();
        elements.elements = Some(vec![6]);
        let list = SphereList::from_iter([(Vec3::ZERO, 1.0)]);
        let scene = Scene::of_spheres(list, vec![Srgb::WHITE], elements);
        let line = told(&asked(&words), 7, &View::FRONT, &scene);
        let end = " --frame 7 --topology 'a b.gro' --radius van-der-waals";
        assert!(line.ends_with(end), "{line}");
    }

    /// A frame that is read alone has its own.
    #[test]
    fn it_has_the_radius_that_another_frame_has_fixed() {
        let mut scene = Scene::new();
        scene.push(Sphere { center: Vec3::ZERO, radius: 0.3 }, Srgb::WHITE, None);
        scene.unstated_radius = Some(0.3);
        let radius = |line: &[&str], frame, scene: &Scene| {
            let line = told(&asked(line), frame, &View::FRONT, scene);
            line.split_once(" --radius ").map(|(_, radius)| radius.to_owned())
        };
        assert_eq!(radius(&["t.dump"], 3, &scene).as_deref(), Some("0.3"));
        assert_eq!(radius(&["t.dump", "--frame", "3"], 0, &scene).as_deref(), Some("0.3"));
        assert_eq!(radius(&["t.dump", "--radius", "2"], 3, &scene).as_deref(), Some("2"));
        for lacking in ["rad", "vdw", "covalent"] {
            let line = ["t.dump", "--radius", lacking];
            assert_eq!(radius(&line, 3, &scene).as_deref(), Some("0.3"), "{lacking}");
            assert_eq!(radius(&line, 0, &scene), None, "{lacking}");
        }
        assert_eq!(radius(&["t.dump"], 0, &scene), None);
        assert_eq!(radius(&["t.dump", "--frame", "3"], 3, &scene), None);
        scene.push(Sphere { center: Vec3::X, radius: 1.7 }, Srgb::WHITE, None);
        assert_eq!(radius(&["t.dump"], 3, &scene), None);
    }

    #[test]
    fn it_is_in_the_coordinates_of_the_file() {
        let view = View { eye: Vec3::new(0.5, -2.0, 1e-7), ..View::FRONT };
        let mut scene = Scene::new();
        scene.origin = DVec3::new(5e5, 5.4e6, 0.0);
        let line = told(&asked(&["map"]), 0, &view, &scene);
        assert!(line.starts_with("spherule map --eye 500000.5,5399998,0.0000001"), "{line}");
        assert!(line.contains(" --target 500000,5400000,0 "), "{line}");
    }
}
