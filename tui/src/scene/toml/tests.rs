use super::*;

const EVERYTHING: &str = r##"
background = "#101018"
shadows = true
[camera]
eye = [0, 1, 5]
target = [0, 0.0, 0]
up = [0, 1, 0]
projection = "perspective"
fov = 35
[[sphere]]
center = [0, 0, 0]
radius = 1.0
color = "#d04020"
label = "C 12"
[[sphere]]
center = [1e3, -0.5, 2]
radius = 0
[[light]]
direction = [1, 2, 1]
color = "#ffeedd"
[[light]]
position = [0, 9, 0]
"##;

fn error(text: &str) -> String {
    read(text, "s.toml").expect_err(text).to_string()
}

/// A scene with `line` as the sphere's second.
fn sphere_error(line: &str) -> String {
    error(&format!("[[sphere]]\n{line}\n"))
}

#[test]
fn everything_that_can_be_said() {
    let scene = read(EVERYTHING, "s.toml").expect("a scene");
    assert_eq!(scene.background, Srgb([0x10, 0x10, 0x18]));
    assert!(scene.shadows);
    let (eye, up) = (Vec3::new(0.0, 1.0, 5.0), Vec3::Y);
    let lens = Lens::Perspective { fov: 35.0 };
    assert_eq!(scene.view, Some(View { eye, target: Vec3::ZERO, up, lens }));
    assert_eq!(scene.colors(), [Srgb([0xd0, 0x40, 0x20]), Srgb::WHITE]);
    assert_eq!((scene.label(0), scene.label(1)), (Some("C 12"), None));
    let second = Sphere { center: Vec3::new(1e3, -0.5, 2.0), radius: 0.0 };
    assert_eq!(scene.spheres().get(1), Some(second));
    assert_eq!(scene.lights[1].source, Source::Position(Vec3::new(0.0, 9.0, 0.0)));
}

#[test]
fn one_sphere_is_enough() {
    let scene = read("[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n", "").expect("a scene");
    assert!(scene.view.is_none() && scene.lights.is_empty() && !scene.shadows);
    assert_eq!(scene.background, Srgb::BLACK);
}

#[test]
fn a_parallel_camera_has_a_height() {
    let text = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nprojection = \"parallel\"\n";
    let sphere = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
    let scene = read(&format!("{text}height = 3\n{sphere}"), "").expect("a scene");
    assert_eq!(scene.view.map(|view| view.lens), Some(Lens::Parallel { height: 3.0 }));
    assert_eq!(error(&format!("{text}{sphere}")), "s.toml:1:1: a parallel camera has a height");
    assert!(error(&format!("{text}fov = 3\n{sphere}")).starts_with("s.toml:5:7: fov is for"));
    assert!(error(&format!("{text}height = 0\n{sphere}")).starts_with("s.toml:5:10: height is 0"));
}

#[test]
fn wrong_types_and_keys_have_a_line_and_a_column() {
    assert!(error("shadows = 1\n").starts_with("s.toml:1:11: invalid type"));
    assert!(error("\nshadow = true\n").starts_with("s.toml:2:1: unknown field `shadow`"));
    assert!(sphere_error("radius = \"big\"").starts_with("s.toml:2:10: invalid type"));
    assert!(sphere_error("center = [0, 0]\nradius = 1").starts_with("s.toml:2:10: "));
    assert!(sphere_error("colour = \"#ffffff\"").starts_with("s.toml:2:1: unknown field"));
    assert!(sphere_error("center = [0, 0, 0]").contains("missing field `radius`"));
    assert!(error("é = [[[\n").starts_with("s.toml:1:"));
    for text in ["shadows = 1\n", "[[sphere]\n", "a = \"\"\"\n", "\u{0}"] {
        assert_eq!(error(text).lines().count(), 1, "{text}");
    }
}

#[test]
fn a_radius_is_finite_and_not_negative() {
    let radius = |value| sphere_error(&format!("center = [0, 0, 0]\nradius = {value}"));
    assert_eq!(radius("-1.0"), "s.toml:3:10: radius is -1: negative");
    assert_eq!(radius("nan"), "s.toml:3:10: radius is NaN: not finite in single precision");
    assert_eq!(radius("inf"), "s.toml:3:10: radius is inf: not finite in single precision");
    assert!(radius("-inf").starts_with("s.toml:3:10: radius is -inf"));
    assert!(radius("1e39").starts_with("s.toml:3:10: radius is 1000"));
}

#[test]
fn a_centre_is_finite() {
    let center = sphere_error("center = [0, 1, nan]\nradius = 1");
    assert_eq!(center, "s.toml:2:17: center is NaN: not finite in single precision");
}

#[test]
fn colours_are_written_in_six_digits() {
    let color = sphere_error("center = [0, 0, 0]\nradius = 1\ncolor = \"red\"");
    assert_eq!(color, "s.toml:4:9: \"red\" is no colour: write \"#rrggbb\"");
}

#[test]
fn a_scene_is_not_empty() {
    assert_eq!(error(""), "s.toml: an empty scene: at least one [[sphere]]");
    assert!(error("sphere = []\n").ends_with("at least one [[sphere]]"));
}

#[test]
fn a_light_comes_from_somewhere() {
    let light = |body: &str| {
        error(&format!("[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[light]]\n{body}\n"))
    };
    assert!(light("").starts_with("s.toml:4:1: a light has a direction or a position"));
    assert!(light("direction = [1, 0, 0]\nposition = [1, 0, 0]").starts_with("s.toml:4:1: "));
    assert!(light("direction = [0, 0, 0]").starts_with("s.toml:5:13: direction has no direction"));
}

#[test]
fn a_camera_sees() {
    let camera = |line: &str| {
        error(&format!(
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[camera]\neye = [0, 0, 5]\n{line}\n"
        ))
    };
    assert!(camera("target = [0, 0, 5]").starts_with("s.toml:6:10: the camera's target"));
    assert!(camera("target = [0, 0, 0]\nfov = 180").starts_with("s.toml:7:7: fov is 180"));
    assert!(camera("target = [0, 0, 0]\nup = [0, 0, 0]").starts_with("s.toml:7:6: up has no"));
    assert!(
        camera("target = [0, 0, 0]\nprojection = \"fish\"").starts_with("s.toml:7:14: unknown")
    );
}
