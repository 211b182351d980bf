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

const SPHERE: &str = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";

fn error(text: &str) -> String {
    read(text, "s.toml").expect_err(text).to_string()
}

#[test]
fn everything_that_can_be_said() {
    let scene = read(EVERYTHING, "s.toml").expect("a scene");
    assert_eq!((scene.background, scene.names_background), (Srgb([0x10, 0x10, 0x18]), true));
    assert!(scene.shadows);
    let (eye, up) = (Vec3::new(0.0, 1.0, 5.0), Vec3::Y);
    let lens = Lens::Perspective { fov: 35.0 };
    assert_eq!(scene.view, Some(View { eye, target: Vec3::ZERO, up, lens }));
    assert_eq!(scene.colors(), [Srgb([0xd0, 0x40, 0x20]), Srgb::WHITE]);
    assert_eq!((scene.label(0).as_deref(), scene.label(1)), (Some("C 12"), None));
    let second = Sphere { center: Vec3::new(1e3, -0.5, 2.0), radius: 0.0 };
    assert_eq!(scene.spheres().get(1), Some(second));
    let Lighting::World(lights) = scene.lighting else { panic!("{:?}", scene.lighting) };
    assert_eq!(lights[1].source, Source::Position(Vec3::new(0.0, 9.0, 0.0)));
}

#[test]
fn one_sphere_is_enough() {
    let scene = read(SPHERE, "").expect("a scene");
    assert!(scene.view.is_none() && scene.lighting.is_plain() && !scene.shadows);
    assert_eq!((scene.background, scene.names_background), (Srgb::BLACK, false));
}

#[test]
fn a_parallel_camera_has_a_height() {
    let text = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nprojection = \"parallel\"\n";
    let scene = read(&format!("{text}height = 3\n{SPHERE}"), "").expect("a scene");
    assert_eq!(scene.view.map(|view| view.lens), Some(Lens::Parallel { height: 3.0 }));
    assert_eq!(error(&format!("{text}{SPHERE}")), "s.toml:1:1: a parallel camera has a height");
    assert!(error(&format!("{text}fov = 3\n{SPHERE}")).starts_with("s.toml:5:7: fov is for"));
    assert!(error(&format!("{text}height = 0\n{SPHERE}")).starts_with("s.toml:5:10: height is 0"));
}

#[test]
fn the_light_of_the_camera_is_asked_for_by_its_name() {
    let scene = read(&format!("light = \"camera\"\n{SPHERE}"), "").expect("a scene");
    assert_eq!(scene.lighting, Lighting::Camera);
    let scene = read(&format!("light = []\n{SPHERE}"), "").expect("a scene");
    assert_eq!(scene.lighting, Lighting::Plain);
    // It goes with no other light: TOML has no key twice.
    let both = error(&format!("light = \"camera\"\n{SPHERE}[[light]]\ndirection = [1, 0, 0]\n"));
    assert!(both.starts_with("s.toml:5:3: duplicate key `light`"), "{both}");
}

#[test]
fn every_mistake_has_a_line_and_a_column() {
    let sphere = |lines: &str| format!("[[sphere]]\n{lines}\n");
    let light = |lines: &str| format!("{SPHERE}[[light]]\n{lines}\n");
    let camera = |lines: &str| format!("{SPHERE}[camera]\neye = [0, 0, 5]\n{lines}\n");
    let radius = |value: &str| sphere(&format!("center = [0, 0, 0]\nradius = {value}"));
    let target = |line: &str| camera(&format!("target = [0, 0, 0]\n{line}"));
    for (text, message) in [
        ("shadows = 1\n".to_owned(), "1:11: invalid type"),
        ("\nshadow = true\n".to_owned(), "2:1: unknown field `shadow`"),
        ("é = [[[\n".to_owned(), "1:"),
        (sphere("radius = \"big\""), "2:10: invalid type"),
        (sphere("center = [0, 0]\nradius = 1"), "2:10: center is an array of 2, not of 3"),
        (sphere("center = [0, 0, 0, 1]\nradius = 1"), "2:10: center is an array of 4, not of 3"),
        (sphere("center = [0, 0, 0, \"x\"]\nradius = 1"), "2:20: invalid type: string"),
        (
            "sphere = [[[0, 0, 0], 1]]\n".to_owned(),
            "1:11: invalid type: sequence, expected a table",
        ),
        ("[[camera]]\n".to_owned(), "1:1: invalid type: sequence, expected a table"),
        (sphere("colour = \"#ffffff\""), "2:1: unknown field"),
        (radius("-1.0"), "3:10: radius is -1, which is negative"),
        (radius("nan"), "3:10: radius is NaN, which is not finite in single precision"),
        (radius("inf"), "3:10: radius is inf, which is not finite in single precision"),
        (radius("-inf"), "3:10: radius is -inf"),
        (radius("1e39"), "3:10: radius is 1000"),
        (
            sphere("center = [0, 1, nan]\nradius = 1"),
            "2:17: center is NaN, which is not finite in single precision",
        ),
        (
            sphere("center = [0, 0, 0]\nradius = 1\ncolor = \"red\""),
            "4:9: \"red\" is not a colour: write \"#rrggbb\"",
        ),
        (
            "\nlight = \"sun\"\n".to_owned(),
            "2:9: invalid value: string \"sun\", expected \"camera\" or tables [[light]]",
        ),
        ("light = 3\n".to_owned(), "1:9: invalid type: integer `3`, expected \"camera\" or"),
        ("light = [3]\n".to_owned(), "1:10: invalid type: integer `3`"),
        (light(""), "4:1: a light has a direction or a position"),
        (light("direction = [1, 0, 0]\nposition = [1, 0, 0]"), "4:1: "),
        (light("direction = [0, 0, 0]"), "5:13: direction has no direction"),
        (camera("target = [0, 0, 5]"), "6:10: the camera's target"),
        (target("fov = 180"), "7:7: fov is 180"),
        (target("up = [0, 0, 0]"), "7:6: up has no"),
        (target("up = [0, 1, 0, 0]"), "7:6: up is an array of 4, not of 3"),
        (light("position = [0, 9, 0, 1]"), "5:12: position is an array of 4, not of 3"),
        (target("projection = {perspective = []}"), "7:14: invalid type: map, expected \"persp"),
        (
            target("projection = 3"),
            "7:14: invalid type: integer `3`, expected \"perspective\" or \"parallel\"",
        ),
        (target("projection = \"fish\""), "7:14: unknown"),
    ] {
        let found = error(&text);
        assert!(found.starts_with(&format!("s.toml:{message}")), "{text}: {found}");
        assert_eq!(found.lines().count(), 1, "{text}");
    }
    assert!(error(&sphere("center = [0, 0, 0]")).contains("missing field `radius`"));
    for text in ["[[sphere]\n", "a = \"\"\"\n", "\u{0}"] {
        assert_eq!(error(text).lines().count(), 1, "{text}");
    }
}

#[test]
fn a_scene_has_limits() {
    let what = "s.toml:33554433:1: a scene of more than 33554432 lines, values and brackets";
    assert_eq!(read(&"\n".repeat(64 << 20), "s.toml").expect_err("limits").to_string(), what);
    let what = "s.toml:21846:4: a scene of more than 65536 dots in keys";
    assert_eq!(
        read(&"a.b.c.d=1\n".repeat(30_000), "s.toml").expect_err("limits").to_string(),
        what
    );
}

#[test]
fn a_camera_may_have_dotted_keys() {
    let text = format!("camera.eye = [0, 0.5, 5]\ncamera.target = [0, 0, 0]\n{SPHERE}");
    let scene = read(&text, "").expect("a scene");
    assert_eq!(scene.view.map(|view| view.eye), Some(Vec3::new(0.0, 0.5, 5.0)));
}

#[test]
fn a_scene_is_not_empty() {
    assert_eq!(error(""), "s.toml: the scene is empty; it needs at least one [[sphere]]");
    assert!(error("sphere = []\n").ends_with("at least one [[sphere]]"));
}
