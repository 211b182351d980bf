//! What a command line becomes.

use super::*;
use crate::choice::name;
use crate::compare::Comparison;
use crate::palette::THEMES;
use crate::view::LensKind;
use clap::ValueEnum;
use glam::DVec3;

fn parsed(line: &str) -> Result<Request, Error> {
    parse(std::iter::once("spherule").chain(line.split_whitespace()).map(Into::into))
}

fn picture(line: &str) -> PictureArguments {
    match parsed(line) {
        Ok(Request::Run(arguments)) => arguments.picture,
        other => panic!("{line}: {other:?}"),
    }
}

#[test]
fn what_is_not_said_has_a_default() {
    let arguments = picture("");
    assert_eq!(arguments.scene.name, "marbles");
    assert_eq!(arguments.accuracy, Tier::Exact);
    assert_eq!((arguments.scene.size, arguments.scene.samples), (None, None));
    assert_eq!(arguments.color, ColorChoice::Auto);
    assert_eq!(arguments.charset, None);
    assert_eq!(arguments.background, None);
    assert_eq!((arguments.scene.order, arguments.computing.structure), (Order::Image, None));
    assert_eq!(arguments.computing.threads, None);
    assert!(!arguments.once && arguments.png.is_none());
    assert!(!arguments.json && arguments.pick.is_none());
}

#[test]
fn every_option_is_read() {
    let arguments = picture(
        "a.xyz --accuracy fast --size 200x60 --charset half --color 256 --samples 9 \
         --projection parallel --format xyz --cell-aspect 3:4 --structure bvh \
         --threads 3 --background #ffeedd --once --png a.png",
    );
    assert_eq!(arguments.scene.name, "a.xyz");
    assert_eq!(arguments.accuracy, Tier::Fast);
    assert_eq!((arguments.scene.size, arguments.scene.samples), (Some((200, 60)), Some(9)));
    assert_eq!(arguments.charset, Some(Charset::Half));
    assert_eq!(arguments.color, ColorChoice::Ansi256);
    assert_eq!(arguments.scene.projection, Some(LensKind::Parallel));
    assert_eq!(arguments.scene.file.reading.format, Some(crate::scene::format::Format::Xyz));
    assert!(!arguments.scene.file.reading.follow);
    assert!(picture("a.xyz --follow").scene.file.reading.follow);
    assert_eq!(arguments.cell_aspect, Some(0.75));
    assert_eq!(arguments.background, Some(Srgb([0xff, 0xee, 0xdd])));
    assert_eq!(picture("--background FFeedd").background, arguments.background);
    assert_eq!(arguments.computing.structure, Some(Structure::Bvh));
    assert_eq!(arguments.computing.threads, Some(3));
    assert!(arguments.once);
    assert_eq!(arguments.png, Some("a.png".into()));
    assert_eq!(picture("--order object").scene.order, Order::Object);
    assert_eq!(picture("--order image --structure bvh").scene.order, Order::Image);
    let arguments = picture("--eye -1,2.5,3 --target 0,-1e3,0 --fov 12.5 --orbit -30,5 unit").scene;
    assert_eq!(arguments.eye, Some(DVec3::new(-1.0, 2.5, 3.0)));
    assert_eq!((arguments.target, arguments.fov), (Some(DVec3::new(0.0, -1e3, 0.0)), Some(12.5)));
    assert_eq!(arguments.orbit, Some([-30.0, 5.0]));
    let arguments = picture("--no-probe --lossless --fps 24 --output sixel");
    assert_eq!((arguments.no_probe, arguments.lossless, arguments.fps), (true, true, Some(24)));
    assert_eq!((arguments.output, picture("").output), (Output::Sixel, Output::Cells));
    let arguments = picture("--cast a.cast --frames 36");
    assert_eq!((arguments.cast, arguments.scene.file.turn()), (Some("a.cast".into()), Ok(36)));
    let arguments = picture("--pick 0,65535 --json --once");
    assert_eq!((arguments.pick, arguments.json), (Some((0, 65535)), true));
}

#[test]
fn what_is_wrong_is_said_in_one_line() {
    for (line, part) in [
        ("--size 0x0", "each 1 to 4096"),
        ("--size 1000000x1000000", "each 1 to 4096"),
        ("--size 80", "COLSxROWS"),
        ("--samples 0", "auto, or 1 to 256"),
        ("--samples 257", "auto, or 1 to 256"),
        ("--charset sixel", "auto, ascii, half, quadrant, sextant, octant, braille, block"),
        ("--palette amber", "xterm, vga, tango, solarized"),
        ("--palette 000000,ffffff", "2 colours; 16 are needed"),
        ("--accuracy sloppy", "fast, geometric, stable, exact"),
        ("--structure octree", "auto, brute, depth-list, bvh"),
        ("--order pixel", "image, object"),
        ("--order object --structure bvh", "cannot be used with '--structure <HOW>'"),
        ("tradeoff --structure auto --order object", "cannot be used with '--structure <HOW>'"),
        ("tradeoff t.xyz --frames 2..9", "one frame: --frame <N>"),
        ("--threads 0", "1..=1024"),
        ("tradeoff --threads 1025", "1..=1024"),
        ("trace --threads two", "--threads <N>"),
        ("--level sse", "baseline, avx2, avx512"),
        ("--cell-aspect 1:0", "W:H"),
        ("--cell-aspect nan:1", "W:H"),
        ("--cell-aspect=-1:-2", "W:H"),
        ("--pick 5", "COL,ROW"),
        ("--pick -1,0", "COL,ROW"),
        ("--pick 1e9,0", "COL,ROW"),
        ("--pick 0,65536", "COL,ROW"),
        ("--pick 1,2,3", "COL,ROW"),
        ("--pick nan,0", "COL,ROW"),
        ("--pick 1,1 --png a.png", "cannot be used with"),
        ("--json", "--pick <COL,ROW>"),
        ("--json --png a.png", "'--json' cannot be used with '--png <FILE>'"),
        ("--json --cast a.cast", "'--json' cannot be used with '--cast <FILE>'"),
        ("--json --show table", "'--json' cannot be used with '--show <WHAT>'"),
        ("--json --output kitty", "'--json' cannot be used with '--output <HOW>'"),
        ("--eye 1,2", "X,Y,Z"),
        ("--eye 1,2,nan", "X,Y,Z"),
        ("--target 1,2,1e39", "X,Y,Z"),
        ("--orbit 30", "RIGHT,UP"),
        ("--fov 180", "below 180"),
        ("--fov 0", "below 180"),
        ("--fov -5", "below 180"),
        ("--distance -1", "0 or more"),
        ("--distance nan", "0 or more"),
        ("--samples -1", "auto, or 1 to 256"),
        ("--fps 0", "1..=240"),
        ("--fps -1", "1..=240"),
        ("--threads -2", "1..=1024"),
        ("--frame -1", "--frame <N>"),
        ("--frames -1", "A below B"),
        ("--frames 3..2", "A below B"),
        ("--frames 0", "A below B"),
        ("--cast a --png b", "cannot be used with"),
        ("--cast a --output kitty", "cannot be used with"),
        ("--output pixels", "auto, cells, kitty, sixel, iterm2"),
        ("--background red", "\"red\" is not a colour: write \"#rrggbb\""),
        ("--background ##ffeedd", "is not a colour"),
        ("--background #ffeeddcc", "is not a colour"),
        ("a b", "'b' is a second scene; one is shown"),
        ("--once unit a.toml", "'a.toml' is a second scene; one is shown"),
        ("unit cases", "cases is a command; it comes first, its options behind it"),
        ("help trace", "trace is a command; it comes first"),
        ("--once tradeoff unit", "tradeoff is a command; it comes first"),
        ("--size 8x4 tradeoff", "tradeoff is a command; it comes first"),
        ("--color never lecture", "lecture is a command; it comes first"),
        ("--threads 1 trace --spheres s --rays r", "trace is a command; it comes first"),
        ("--json cases", "cases is a command; it comes first"),
        ("--topology trace a b", "'b' is a second scene; one is shown"),
        ("tradeof unit", "'tradeof' is neither a scene nor a command; tradeoff is a command"),
        ("trace", "--spheres <S.npy> --rays <R.npy>"),
        ("trace --spheres s --rays r --any --out-t t", "cannot be used with"),
        ("trace --spheres s --rays r --repeat 0", "1.."),
        ("scenes --once", "--once"),
        ("--colour never", "'--colour' found; did you mean '--color'?"),
        ("--color nevr", "; did you mean 'never'?"),
        ("cases --count 5", "not provided"),
        ("cases --seed 4", "not provided"),
        ("cases --unit", "not provided"),
        ("cases --json --count -1", "--count <N>"),
        ("cases --json --seed -1", "--seed <N>"),
        ("lecture --list --station 1", "cannot be used with"),
        ("lecture --list --size 80x24", "cannot be used with"),
        ("lecture --station -1", "--station <STATION>"),
    ] {
        match parsed(line) {
            Err(Error::Input(message)) => {
                assert!(message.contains(part), "{line}: {message}");
                assert!(!message.contains('\n') && !message.contains("Usage"), "{message}");
            }
            other => panic!("{line}: {other:?}"),
        }
    }
}

#[test]
fn behind_two_dashes_a_command_is_a_scene() {
    for line in ["-- tradeoff", "--once -- tradeoff"] {
        assert_eq!(picture(line).scene.name, "tradeoff", "{line}");
    }
}

#[test]
fn an_eye_on_the_target_sees_nothing() {
    for line in [
        "unit --eye 0,0,0",
        "unit --eye 0,0,0 --projection parallel",
        "unit --eye 1,2,3 --target 1,2,3 --orbit 30,0",
        "unit --eye 1,1,1 --target 1.00000001,1,1",
    ] {
        match picture(line).scene.open() {
            Err(Error::Input(message)) => {
                let expected =
                    "unit: the camera's target is its eye; give another --eye or --target";
                assert_eq!(message, expected, "{line}");
            }
            other => panic!("{line}: {other:?}"),
        }
    }
    picture("unit --eye 0,0,3 --target 0,0,1").scene.open().expect("an eye beside the target");
}

/// Scripts say `tiles`, the name that the depth list had first.
#[test]
fn names_are_accepted_and_listed() {
    for (word, expected) in [
        ("auto", None),
        ("depth-list", Some(Structure::DepthList)),
        ("tiles", Some(Structure::DepthList)),
    ] {
        assert_eq!(picture(&format!("--structure {word}")).computing.structure, expected);
    }
    for charset in Charset::value_variants() {
        assert_eq!(picture(&format!("--charset {}", name(charset))).charset, Some(*charset));
    }
    assert_eq!(picture("--charset auto --samples auto").charset, None);
    assert_eq!(picture("--charset auto --samples auto").scene.samples, None);
    for (word, theme) in THEMES {
        assert_eq!(picture(&format!("--palette {word}")).palette, Some(theme));
    }
    for depth in ColorChoice::value_variants() {
        assert_eq!(picture(&format!("--color {}", name(depth))).color, *depth);
    }
    for tier in Tier::ALL {
        assert_eq!(picture(&format!("--accuracy {}", tier.as_str())).accuracy, tier);
    }
    assert_eq!(picture("--accuracy algebraic").accuracy, Tier::Fast);
    let tiers = [Tier::Fast, Tier::Exact];
    for (words, overlay) in [
        ("", None),
        ("--show error", Some(Overlay::Tiers(Comparison::Errors))),
        ("--show split:algebraic,exact", Some(Overlay::Tiers(Comparison::Split(tiers)))),
        ("--show table", Some(Overlay::Table)),
    ] {
        assert_eq!(picture(words).show, overlay, "{words}");
    }
}

/// It measures one frame, and no terminal decides about its size.
#[test]
fn the_help_of_tradeoff_has_what_it_takes() {
    let Ok(Request::Print(help)) = parsed("tradeoff --help") else { panic!("no help") };
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("--frame <N>") && !help.contains("--frames"), "{help}");
    assert!(help.contains("1 to 4096 [default: 80x24] --samples"), "{help}");
}

/// A terminal shows them as they are.
#[test]
fn no_help_has_backticks() {
    for command in ["", "trace ", "tradeoff ", "cases ", "judge ", "lecture ", "generate "] {
        let Ok(Request::Print(help)) = parsed(&format!("{command}--help")) else {
            panic!("{command}: no help")
        };
        assert!(!help.contains('`'), "{command}: {help}");
    }
}

#[test]
fn the_help_says_what_auto_chooses() {
    let Ok(Request::Print(help)) = parsed("--help") else { panic!("no help") };
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for what in [
        "auto: Half with colour, ascii without colour or Unicode",
        "auto: The one that is likely the fastest",
        "auto: On if there are chains",
        "--size <COLSxROWS> Size of a picture in cells, each 1 to 4096; the viewer does not open [",
        "--charset <SET> Characters auto stays with what every font has,",
    ] {
        assert!(help.contains(what), "{what}: {help}");
    }
}

#[test]
fn help_and_version_are_no_errors() {
    for line in ["--help", "-h", "--version", "trace --help"] {
        assert!(matches!(parsed(line), Ok(Request::Print(_))), "{line}");
    }
}
