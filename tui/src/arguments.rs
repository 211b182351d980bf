//! The command line.

mod crowd;
pub mod files;
mod overlay;
mod scene;
mod second_scene;
mod values;

use crate::cases::CasesArguments;
use crate::choice::{Auto, auto_or};
use crate::color::Srgb;
use crate::error::Error;
use crate::judge::JudgeArguments;
use crate::lecture::LectureArguments;
use crate::palette::Theme;
use crate::pixels::Output;
use crate::structure::{Order, Structure};
use crate::style::{CHAIR, Charset};
use crate::terminal::color_depth::ColorChoice;
use crate::threads::MOST_THREADS;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand, value_parser};
pub use crowd::CrowdArguments;
pub use overlay::Overlay;
pub use scene::SceneArguments;
use second_scene::{late_command, meant, second_scene};
use spherule_kernel::{Level, Tier};
use std::ffi::OsString;
use std::path::PathBuf;
use values::{aspect, cell, color, distance, level, overlay, tier};

/// Spheres in a terminal, by packets of rays.
///
/// On a terminal the viewer opens (? shows its keys); into a pipe or a file, on a dumb terminal, or
/// with --once, one picture is written.
#[derive(Clone, Debug, Parser)]
#[command(name = "spherule", version, args_conflicts_with_subcommands = true)]
#[command(disable_help_subcommand = true)]
pub struct Arguments {
    /// Something other than a picture.
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
    /// Walk through the graphics lecture: fourteen stations whose numbers are computed as they are shown
    ///
    /// On a terminal ? shows the keys. Into a pipe or a file, on a dumb terminal, or with --once or --size, the station
    /// that --station names is written, or all of them.
    Lecture(LectureArguments),
    /// Write cases in which ray-sphere intersection goes wrong, or list their families
    Cases(CasesArguments),
    /// Judge another program's answers against exact truth
    Judge(JudgeArguments),
    /// List the built-in scenes
    Scenes,
    /// Write man pages and completions for bash, zsh and fish
    #[command(hide = true)]
    Generate {
        /// Where man/ and completions/ are made
        folder: PathBuf,
    },
}

/// A scene, and how to draw it.
#[derive(Args, Clone, Debug)]
pub struct PictureArguments {
    /// The scene, and its rays.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// How far hits may be trusted; algebraic is another name for fast
    #[arg(long, value_name = "TIER", default_value = Tier::Exact.as_str())]
    #[arg(value_parser = tier())]
    pub accuracy: Tier,
    /// Characters
    ///
    /// auto stays with what every font has, and with ascii where the locale has no Unicode (LANG=C). Finer sets are chosen by name; in the viewer c goes through all of them.
    /// Quadrants and braille are in most fonts, sextants and octants in Unifont and Cascadia Code; kitty, foot,
    /// Ghostty and GNOME's terminal draw them without a font.
    #[arg(long, value_name = "SET", default_value = "auto")]
    #[arg(value_parser = auto_or::<Charset>("Half with colour, ascii without colour or Unicode"))]
    pub charset: Auto<Charset>,
    /// Colours
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// The colour of what no sphere covers, unless the scene names one
    #[arg(long, value_name = "#RRGGBB", value_parser = color)]
    pub background: Option<Srgb>,
    /// What the terminal's 16 colours are: xterm, vga, tango, solarized, or 16 of six digits, with commas [default: xterm,
    /// on Linux's console vga]
    #[arg(long, value_name = "COLOURS")]
    pub palette: Option<Theme>,
    /// Shape of a cell, width to height [default: the terminal's, else 1:2]
    #[arg(long, value_name = "W:H", value_parser = aspect)]
    pub cell_aspect: Option<f32>,
    /// How far away the eye is, in widths of a cell: 60 cm by default, if cells are 2.2 mm wide
    ///
    /// From afar an eye sees the mean of a cell, from near its pixels: glyphs and colours are chosen for both.
    #[arg(long, value_name = "WIDTHS", default_value_t = CHAIR, value_parser = distance, allow_negative_numbers = true)]
    pub distance: f32,
    /// error: what the tier gets wrong against exact, cell by cell; split:TIER,TIER: two tiers side by side; table: what
    /// every tier costs and gets wrong
    #[arg(long, value_name = "WHAT", value_parser = overlay, conflicts_with = "png")]
    pub show: Option<Overlay>,
    /// What tells spheres of a crowd apart.
    #[command(flatten)]
    pub crowd: CrowdArguments,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
    /// Ask the terminal nothing: not what it can do, nor how far it has come
    #[arg(long)]
    pub no_probe: bool,
    /// Send the viewer's frames exactly, none that merely looks alike
    #[arg(long)]
    pub lossless: bool,
    /// Frames a second of the viewer at most, 1 to 240 [default: 60, over SSH 30]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=240), allow_negative_numbers = true)]
    pub fps: Option<u16>,
    /// What is written: cells, or pixels by a protocol of terminals
    #[arg(long, value_name = "HOW", default_value = "cells", conflicts_with_all = ["cast", "pick"])]
    pub output: Output,
    /// Write one picture, also to a terminal; so does --size
    #[arg(long)]
    pub once: bool,
    /// Write one turn around the scene as a recording of a terminal (asciinema, version 2); - for standard output
    ///
    /// It has --frames N frames [default: 120], and --fps [default: 30].
    #[arg(long, value_name = "FILE", conflicts_with_all = ["png", "pick", "show"])]
    pub cast: Option<PathBuf>,
    /// Write one picture as a PNG of 8x16 pixels a cell; - for standard output
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
    /// Instead of a picture, write what the ray through the middle of a cell meets, by every tier
    ///
    /// Cells are counted from 0, from the top left of the picture that --once writes. p in the viewer shows the same.
    #[arg(long, value_name = "COL,ROW", value_parser = cell, conflicts_with_all = ["png", "show"], allow_hyphen_values = true)]
    pub pick: Option<(u16, u16)>,
    /// With --pick, write a JSON object
    // clap does not miss --pick beside what conflicts with it.
    #[arg(long, requires = "pick", conflicts_with_all = ["cast", "output", "png", "show"])]
    pub json: bool,
}

/// How answers are computed: they do not depend on it.
#[derive(Args, Clone, Copy, Debug)]
pub struct ComputingArguments {
    /// How spheres are searched
    #[arg(long, value_name = "HOW", default_value = "auto")]
    #[arg(value_parser = auto_or::<Structure>("The one that is likely the fastest"))]
    pub structure: Auto<Structure>,
    /// Threads, 1 to 1024 [default: one a core, or as many as the system gives]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = value_parser!(u16).range(1..=i64::from(MOST_THREADS)), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Instructions [default: the best that the CPU has]
    #[arg(long, value_name = "LEVEL", value_parser = level())]
    pub level: Option<Level>,
}

/// Rays and spheres from files, hits to files.
#[derive(Args, Clone, Debug)]
pub struct TraceArguments {
    /// Spheres: .npy, float32 or float64, (N, 4): centre xyz, radius
    #[arg(long, value_name = "S.npy")]
    pub spheres: PathBuf,
    /// Rays: .npy, float32 or float64, (M, 8): origin xyz, direction xyz, t_min, t_max
    #[arg(long, value_name = "R.npy")]
    pub rays: PathBuf,
    /// Test ray i against sphere i
    #[arg(long)]
    pub pairs: bool,
    /// Write only whether rays hit anything
    #[arg(long, conflicts_with = "out_t")]
    pub any: bool,
    /// Where to write t: .npy, float32, (M,), +inf if a ray has no hit
    #[arg(long, value_name = "T.npy")]
    pub out_t: Option<PathBuf>,
    /// Where to write the sphere: .npy, int32, (M,), -1 if a ray has no hit; with --any 1 or 0
    #[arg(long, value_name = "I.npy")]
    pub out_id: Option<PathBuf>,
    /// Passes, 1 to 1000000; the speed is that of their median
    #[arg(long, value_name = "N", default_value = "1", value_parser = value_parser!(u32).range(1..=1_000_000), allow_negative_numbers = true)]
    pub repeat: u32,
    /// Report as a JSON object
    #[arg(long)]
    pub json: bool,
    /// How far hits may be trusted; algebraic is another name for fast
    #[arg(long, value_name = "TIER", default_value = Tier::Exact.as_str())]
    #[arg(value_parser = tier())]
    pub accuracy: Tier,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
}

/// A scene whose rays are timed and judged.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("frames", |frames| frames.hide(true)))]
#[command(mut_arg("frame", |frame| frame.help("The frame that is measured, from 0 [default: the first with particles]")))]
#[command(mut_arg("size", |size| size.help("Size of the picture in cells, each 1 to 4096 [default: 80x24]")))]
pub struct TradeoffArguments {
    /// The scene, and its rays.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Report as a JSON object
    #[arg(long)]
    pub json: bool,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
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
/// [`Error::Input`], in one line, if it is wrong.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Request, Error> {
    let words: Vec<_> = arguments.into_iter().collect();
    let program = Arguments::command();
    let matches = program.clone().try_get_matches_from(&words).and_then(|matches| {
        check_conflicts(&matches)?;
        Arguments::from_arg_matches(&matches)
    });
    match matches {
        Ok(mut arguments) => match late_command(&program, &words) {
            None => {
                let scene = &mut arguments.picture.scene;
                scene.file.meant = meant(&scene.name, &program);
                Ok(Request::Run(Box::new(arguments)))
            }
            Some(message) => Err(Error::Input(message)),
        },
        Err(error) if error.exit_code() == 0 => Ok(Request::Print(error.to_string())),
        Err(error) => {
            let behind = words.get(1..).unwrap_or_default();
            let message = late_command(&program, &words)
                .or_else(|| second_scene(&error, &program, behind))
                .unwrap_or_else(|| in_one_line(&error));
            Err(Error::Input(message))
        }
    }
}

/// Refuses `--structure` beside `--order object`, which searches no structure, and `--frames` beside `tradeoff`, which
/// measures one frame.
fn check_conflicts(matches: &ArgMatches) -> Result<(), clap::Error> {
    let tradeoff = matches.subcommand_matches("tradeoff");
    let matches = tradeoff.unwrap_or(matches);
    let is_said = |option| matches.value_source(option) == Some(ValueSource::CommandLine);
    let is_object = matches!(matches.try_get_one("order"), Ok(Some(Order::Object)));
    let message = if is_object && is_said("structure") {
        "the argument '--order object' cannot be used with '--structure <HOW>'"
    } else if tradeoff.is_some() && is_said("frames") {
        "the argument '--frames <A..B>' cannot be used with 'tradeoff', which measures one frame: --frame <N>"
    } else {
        return Ok(());
    };
    Err(Arguments::command().error(ErrorKind::ArgumentConflict, message))
}

/// clap's message without its prefix and usage, its lines joined, and what it takes to be meant.
fn in_one_line(error: &clap::Error) -> String {
    let message = error.to_string();
    let message = message.strip_prefix("error: ").unwrap_or(&message);
    let first = message.split("\n\n").next().unwrap_or_default();
    let line = first.split_whitespace().collect::<Vec<_>>().join(" ");
    let meant = [ContextKind::SuggestedArg, ContextKind::SuggestedValue];
    match meant.into_iter().find_map(|kind| error.get(kind)) {
        Some(ContextValue::String(meant)) => format!("{line}; did you mean '{meant}'?"),
        _ => line,
    }
}

#[cfg(test)]
mod tests;
