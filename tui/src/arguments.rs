//! The command line, as DESIGN.md states it.

mod values;

use crate::color_depth::ColorChoice;
use crate::draw::{AccuracyChoice, Charset};
use crate::failure::Failure;
use crate::scene::builtin::DEFAULT;
use crate::scene::open::Format;
use crate::structure::StructureChoice;
use crate::view::LensKind;
use clap::{Args, Parser, Subcommand};
use spherule_kernel::dispatch::Level;
use std::ffi::OsString;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Spheres in a terminal, by packets of rays.
///
/// On a terminal the viewer opens (? shows its keys); into a pipe or a file, or with --once, one
/// picture is written.
#[derive(Clone, Debug, Parser)]
#[command(name = "spherule", version, args_conflicts_with_subcommands = true)]
#[command(disable_help_subcommand = true)]
pub struct Arguments {
    /// Something else than a picture.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The picture.
    #[command(flatten)]
    pub picture: PictureArguments,
}

/// What there is besides pictures.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Trace rays from a file against spheres from a file
    Trace(TraceArguments),
    /// Measure speed and error of every tier on a scene, on this machine
    Tradeoff(TradeoffArguments),
    /// List the built-in scenes
    Scenes,
}

/// A scene, and how to draw it.
#[derive(Args, Clone, Debug)]
pub struct PictureArguments {
    /// A built-in scene, a file (.toml, .xyz), or - for standard input
    #[arg(value_name = "SCENE", default_value = DEFAULT)]
    pub scene: String,
    /// How far hits may be trusted: fast, stable or exact
    #[arg(long, value_name = "TIER", default_value = AccuracyChoice::default().as_str(), value_parser = values::accuracy)]
    pub accuracy: AccuracyChoice,
    /// Picture size in cells, each 1 to 4096 [default: the terminal's, 80x24 in a pipe]
    #[arg(long, value_name = "COLSxROWS", value_parser = values::size)]
    pub size: Option<(u16, u16)>,
    /// Characters: auto (half with colour, else ascii), ascii or half
    #[arg(long, value_name = "SET", default_value = "auto", value_parser = values::charset)]
    pub charset: CharsetChoice,
    /// Colours: auto, always, never, 16, 256 or truecolor
    #[arg(long, value_name = "WHEN", default_value = "auto", value_parser = values::color)]
    pub color: ColorChoice,
    /// Rays a cell, 1 to 256
    #[arg(long, value_name = "N", default_value = "4", value_parser = values::samples)]
    pub samples: u32,
    /// perspective or parallel, whatever the scene says
    #[arg(long, value_name = "KIND", value_parser = values::projection)]
    pub projection: Option<LensKind>,
    /// Format of the scene: toml or xyz [default: by name; from standard input by first line]
    #[arg(long, value_name = "FORMAT", value_parser = values::format)]
    pub format: Option<Format>,
    /// Shape of a cell, width to height [default: asked of the terminal, else 1:2]
    #[arg(long, value_name = "W:H", value_parser = values::aspect)]
    pub cell_aspect: Option<f32>,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
    /// Write one picture, also to a terminal
    #[arg(long)]
    pub once: bool,
}

/// How answers are computed: they do not depend on it.
#[derive(Args, Clone, Copy, Debug)]
pub struct ComputingArguments {
    /// How spheres are searched: auto, brute, tiles or bvh
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = values::structure)]
    pub structure: StructureChoice,
    /// Threads, 1 to 1024 [default: all that the machine has]
    #[arg(long, value_name = "N", value_parser = values::threads)]
    pub threads: Option<NonZeroUsize>,
    /// Instructions: baseline, avx2 or avx512 [default: the best that the CPU has]
    #[arg(long, value_name = "LEVEL", value_parser = values::level)]
    pub level: Option<Level>,
}

/// Rays and spheres from files, hits to files.
#[derive(Args, Clone, Debug)]
pub struct TraceArguments {
    /// Spheres: .npy, float32, (N, 4): centre xyz, radius
    #[arg(long, value_name = "S.npy")]
    pub spheres: PathBuf,
    /// Rays: .npy, float32, (M, 8): origin xyz, direction xyz, `t_min`, `t_max`
    #[arg(long, value_name = "R.npy")]
    pub rays: PathBuf,
    /// Ray i meets sphere i alone
    #[arg(long)]
    pub pairs: bool,
    /// Ask only whether a ray meets anything
    #[arg(long, conflicts_with = "out_t")]
    pub any: bool,
    /// Where to write t: .npy, float32, (M,), +inf where nothing was hit
    #[arg(long, value_name = "T.npy")]
    pub out_t: Option<PathBuf>,
    /// Where to write the sphere: .npy, int32, (M,), -1 where nothing was hit; with --any 1 or 0
    #[arg(long, value_name = "I.npy")]
    pub out_id: Option<PathBuf>,
    /// Trace so often and report the median speed
    #[arg(long, value_name = "N", default_value = "1", value_parser = values::repeat)]
    pub repeat: u32,
    /// Report as a JSON object
    #[arg(long)]
    pub json: bool,
    /// How far hits may be trusted: fast, stable or exact
    #[arg(long, value_name = "TIER", default_value = AccuracyChoice::default().as_str(), value_parser = values::accuracy)]
    pub accuracy: AccuracyChoice,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
}

/// A scene whose rays are timed and judged.
#[derive(Args, Clone, Debug)]
pub struct TradeoffArguments {
    /// A built-in scene, a file (.toml, .xyz), or - for standard input
    #[arg(value_name = "SCENE", default_value = DEFAULT)]
    pub scene: String,
    /// Report as a JSON object
    #[arg(long)]
    pub json: bool,
    /// The picture whose rays they are, in cells, each 1 to 4096 [default: 80x24]
    #[arg(long, value_name = "COLSxROWS", value_parser = values::size)]
    pub size: Option<(u16, u16)>,
    /// Rays a cell, 1 to 256
    #[arg(long, value_name = "N", default_value = "4", value_parser = values::samples)]
    pub samples: u32,
    /// perspective or parallel, whatever the scene says
    #[arg(long, value_name = "KIND", value_parser = values::projection)]
    pub projection: Option<LensKind>,
    /// Format of the scene: toml or xyz [default: by name; from standard input by first line]
    #[arg(long, value_name = "FORMAT", value_parser = values::format)]
    pub format: Option<Format>,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
}

/// What `--charset` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CharsetChoice {
    /// Half blocks with colour, ASCII without.
    Auto,
    /// This one.
    Only(Charset),
}

/// What the arguments ask for.
#[derive(Clone, Debug)]
pub enum Request {
    /// To do something.
    Run(Box<Arguments>),
    /// To print a text and be done: help, or the version.
    Print(String),
}

/// Reads a command line, the name of the program first.
///
/// # Errors
/// [`Failure::Input`] in one line where it is wrong.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Request, Failure> {
    match Arguments::try_parse_from(arguments) {
        Ok(arguments) => Ok(Request::Run(Box::new(arguments))),
        Err(error) if error.exit_code() == 0 => Ok(Request::Print(error.to_string())),
        Err(error) => Err(Failure::Input(in_one_line(&error.to_string()))),
    }
}

/// clap's message without its prefix, usage and tips, its lines joined.
fn in_one_line(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let first = message.split("\n\n").next().unwrap_or_default();
    first.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::ColorDepth;
    use crate::structure::Structure;

    fn parsed(line: &str) -> Result<Request, Failure> {
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
        assert_eq!(arguments.scene, "marbles");
        assert_eq!(arguments.accuracy, AccuracyChoice::Exact);
        assert_eq!((arguments.size, arguments.samples), (None, 4));
        assert_eq!(arguments.color, ColorChoice::Auto);
        assert_eq!(arguments.charset, CharsetChoice::Auto);
        assert_eq!(arguments.computing.structure, StructureChoice::Auto);
        assert_eq!(arguments.computing.threads, None);
        assert!(!arguments.once);
    }

    #[test]
    fn every_option_is_read() {
        let arguments = picture(
            "a.xyz --accuracy fast --size 200x60 --charset half --color 256 --samples 9 \
             --projection parallel --format xyz --cell-aspect 3:4 --structure bvh \
             --threads 3 --once",
        );
        assert_eq!(arguments.scene, "a.xyz");
        assert_eq!(arguments.accuracy, AccuracyChoice::Fast);
        assert_eq!((arguments.size, arguments.samples), (Some((200, 60)), 9));
        assert_eq!(arguments.charset, CharsetChoice::Only(Charset::Half));
        assert_eq!(arguments.color, ColorChoice::Depth(ColorDepth::Ansi256));
        assert_eq!(arguments.projection, Some(LensKind::Parallel));
        assert_eq!(arguments.format, Some(Format::Xyz));
        assert_eq!(arguments.cell_aspect, Some(0.75));
        assert_eq!(arguments.computing.structure, StructureChoice::Only(Structure::Bvh));
        assert_eq!(arguments.computing.threads.map(NonZeroUsize::get), Some(3));
        assert!(arguments.once);
    }

    #[test]
    fn what_is_wrong_is_said_in_one_line() {
        for (line, part) in [
            ("--size 0x0", "each 1 to 4096"),
            ("--size 1000000x1000000", "each 1 to 4096"),
            ("--size 80", "COLSxROWS"),
            ("--samples 0", "1 to 256"),
            ("--accuracy sloppy", "fast, stable or exact"),
            ("--structure octree", "auto, brute, tiles or bvh"),
            ("--threads 0", "1 to 1024"),
            ("tradeoff --threads 1025", "1 to 1024"),
            ("trace --threads two", "1 to 1024"),
            ("--level sse", "baseline, avx2 or avx512"),
            ("--cell-aspect 1:0", "W:H"),
            ("--cell-aspect nan:1", "W:H"),
            ("a b", "'b'"),
            ("trace", "--spheres <S.npy> --rays <R.npy>"),
            ("trace --spheres s --rays r --any --out-t t", "cannot be used with"),
            ("trace --spheres s --rays r --repeat 0", "1 or more"),
            ("scenes --once", "--once"),
        ] {
            match parsed(line) {
                Err(Failure::Input(message)) => {
                    assert!(message.contains(part), "{line}: {message}");
                    assert!(!message.contains('\n') && !message.contains("Usage"), "{message}");
                }
                other => panic!("{line}: {other:?}"),
            }
        }
    }

    #[test]
    fn help_and_version_are_no_errors() {
        for line in ["--help", "-h", "--version", "trace --help"] {
            assert!(matches!(parsed(line), Ok(Request::Print(_))), "{line}");
        }
    }
}
