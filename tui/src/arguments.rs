//! The command line.

pub mod files;
mod values;

use crate::cells::eye::CHAIR;
use crate::choice::{Auto, auto_or};
use crate::color::Srgb;
use crate::coloring::ColorBy;
use crate::coloring::scale::Range;
use crate::compare::Comparison;
use crate::error::Error;
use crate::lecture::stations::station;
use crate::palette::Theme;
use crate::scene::Scene;
use crate::scene::builtin::DEFAULT;
use crate::scene::radii::{RadiusBy, set_radii};
use crate::structure::{Order, Structure};
use crate::style::{Aids, Charset};
use crate::terminal::color_depth::ColorChoice;
use crate::threads::MOST_THREADS;
use crate::view::{LensKind, View, with_projection};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{
    ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum, value_parser,
};
use files::{FileArguments, Subject};
use spherule_kernel::{Level, Tier};
use std::ffi::OsString;
use std::path::PathBuf;
use values::{aspect, cell, color, distance, level, overlay, samples, size, tier};

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
    /// On a terminal ? shows the keys. Into a pipe or a file, on a dumb terminal, or with --once, the station that
    /// --station names is written, or all of them.
    Lecture(LectureArguments),
    /// List the built-in scenes
    Scenes,
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
    /// Characters; auto: half with colour, else ascii
    ///
    /// auto stays with what every font has, and with ascii where the locale has no Unicode (LANG=C). Finer sets are chosen by name; in the viewer c goes through all of them.
    /// Quadrants and braille are in most fonts, sextants and octants in Unifont and Cascadia Code; kitty, foot,
    /// Ghostty and GNOME's terminal draw them without a font.
    #[arg(long, value_name = "SET", default_value = "auto", value_parser = auto_or::<Charset>())]
    pub charset: Auto<Charset>,
    /// Colours
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// The colour of what no sphere covers, unless the scene names one
    #[arg(long, value_name = "#RRGGBB", value_parser = color)]
    pub background: Option<Srgb>,
    /// What the terminal's 16 colours are: xterm, vga, tango, solarized, or 16 of six digits, with commas
    #[arg(long, value_name = "COLOURS", default_value = "xterm")]
    pub palette: Theme,
    /// Shape of a cell, width to height [default: the terminal's, else 1:2]
    #[arg(long, value_name = "W:H", value_parser = aspect)]
    pub cell_aspect: Option<f32>,
    /// How far away the eye is, in widths of a cell: 60 cm by default, if cells are 2.2 mm wide
    ///
    /// From afar an eye sees the mean of a cell, from near its pixels: glyphs and colours are chosen for both.
    #[arg(long, value_name = "WIDTHS", default_value_t = CHAIR, value_parser = distance)]
    pub distance: f32,
    /// error: what the tier gets wrong against exact, cell by cell; split:TIER,TIER: two tiers side by side; table: what
    /// every tier takes and gets wrong
    #[arg(long, value_name = "WHAT", value_parser = overlay, conflicts_with = "png")]
    pub show: Option<Overlay>,
    /// What tells spheres of a crowd apart.
    #[command(flatten)]
    pub crowd: CrowdArguments,
    /// How it is computed.
    #[command(flatten)]
    pub computing: ComputingArguments,
    /// Write one picture, also to a terminal
    #[arg(long)]
    pub once: bool,
    /// Write one picture as a PNG of 8x16 pixels a cell; - for standard output
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,
    /// In place of a picture, write what the ray through the middle of a cell meets, by every tier
    ///
    /// Cells are counted from 0, from the top left of the picture that --once writes. p in the viewer shows the same.
    #[arg(long, value_name = "COL,ROW", value_parser = cell, conflicts_with_all = ["png", "show"], allow_hyphen_values = true)]
    pub pick: Option<(u16, u16)>,
    /// With --pick, write a JSON object
    #[arg(long, requires = "pick")]
    pub json: bool,
}

/// What `--show` asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Tiers held against each other, in place of the picture.
    Tiers(Comparison),
    /// What every tier takes and gets wrong, over it.
    Table,
}

impl Overlay {
    /// That of tiers, if it is one.
    #[must_use]
    pub fn comparison(self) -> Option<Comparison> {
        match self {
            Self::Tiers(comparison) => Some(comparison),
            Self::Table => None,
        }
    }
}

/// On, or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// Shown
    On,
    /// Not shown
    Off,
}

/// What tells spheres of a crowd apart.
#[derive(Args, Clone, Debug)]
pub struct CrowdArguments {
    /// What spheres are coloured by: scene, element, chain, residue, molecule, type, or a column of numbers [default:
    /// chain if there are several, else scene]
    #[arg(long, value_name = "WHAT")]
    pub color_by: Option<ColorBy>,
    /// The numbers with the darkest and the lightest colour, with --color-by a column [default: the least and the
    /// largest]
    #[arg(long, value_name = "LOW:HIGH", requires = "color_by", allow_hyphen_values = true)]
    pub range: Option<Range>,
    /// Write what colours mean over the picture, also outside the viewer
    #[arg(long, conflicts_with_all = ["png", "pick"])]
    pub legend: bool,
    /// Less light where others are in the way; auto: if there are several chains
    #[arg(long, value_name = "WHEN", default_value = "auto", value_parser = auto_or::<Switch>())]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub occlusion: Auto<Switch>,
    /// Dark edges before what is far behind, and around chains; auto: if there are several chains
    #[arg(long, value_name = "WHEN", default_value = "auto", value_parser = auto_or::<Switch>())]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub edges: Auto<Switch>,
    /// What is far away fades; auto: if there are several chains
    #[arg(long, value_name = "WHEN", default_value = "auto", value_parser = auto_or::<Switch>())]
    #[arg(num_args = 0..=1, require_equals = true, default_missing_value = "on")]
    pub depth_cue: Auto<Switch>,
}

impl CrowdArguments {
    /// What a scene is coloured by.
    #[must_use]
    pub fn color_by(&self, scene: &Scene) -> ColorBy {
        self.color_by.clone().unwrap_or_else(|| ColorBy::usual(scene.attributes()))
    }

    /// The aids of its pictures.
    #[must_use]
    pub fn aids(&self, scene: &Scene) -> Aids {
        let usual = Aids::usual(scene);
        let is_on =
            |switch: Auto<Switch>, usual: bool| switch.map_or(usual, |switch| switch == Switch::On);
        Aids {
            occlusion: is_on(self.occlusion, usual.occlusion),
            edges: is_on(self.edges, usual.edges),
            depth_cue: is_on(self.depth_cue, usual.depth_cue),
        }
    }
}

/// A scene, and the rays of a picture of it.
#[derive(Args, Clone, Debug)]
pub struct SceneArguments {
    /// A built-in scene, a file, or - for standard input; --format lists the formats that are told by content
    #[arg(value_name = "SCENE", default_value = DEFAULT)]
    pub name: String,
    /// Picture size in cells, each 1 to 4096 [default: 80x24; on a terminal all rows but the last]
    #[arg(long, value_name = "COLSxROWS", value_parser = size)]
    pub size: Option<(u16, u16)>,
    /// Rays a cell, 1 to 256; auto: more where they are needed
    #[arg(long, value_name = "N", default_value = "auto", value_parser = samples)]
    pub samples: Auto<u32>,
    /// The projection, whatever the scene says
    #[arg(long, value_name = "KIND")]
    pub projection: Option<LensKind>,
    /// Which loop is the outer one, over rays or spheres; with object there is no --structure
    #[arg(long, value_name = "ORDER", default_value = "image")]
    pub order: Order,
    /// What is to know of a file.
    #[command(flatten)]
    pub file: FileArguments,
    /// How large spheres are: van-der-waals, covalent, a number, or a column of numbers [default: as the scene says]
    #[arg(long, value_name = "WHAT", allow_hyphen_values = true)]
    pub radius: Option<RadiusBy>,
}

impl SceneArguments {
    /// The scene, and what follows it.
    ///
    /// # Errors
    /// [`Error::Input`] if there is no such scene, or it cannot be read.
    pub fn open(&self) -> Result<Subject, Error> {
        let mut subject = self.file.open(&self.name)?;
        let set = self.set_radii(&mut subject.scene);
        set.map_err(|error| Error::Input(format!("{}: {error}", self.name)))?;
        Ok(subject)
    }

    /// Gives a scene the radii that are asked for.
    ///
    /// # Errors
    /// If it does not have them.
    pub fn set_radii(&self, scene: &mut Scene) -> Result<(), String> {
        self.radius.as_ref().map_or(Ok(()), |radius| set_radii(scene, radius))
    }

    /// Where the scene is first seen from, in a picture of `aspect`, width over height.
    #[must_use]
    pub fn view(&self, scene: &Scene, aspect: f64) -> View {
        let view = scene.first_view(aspect as f32);
        self.projection.map_or(view, |kind| with_projection(&view, kind))
    }
}

/// How answers are computed: they do not depend on it.
#[derive(Args, Clone, Copy, Debug)]
pub struct ComputingArguments {
    /// How spheres are searched
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = auto_or::<Structure>())]
    pub structure: Auto<Structure>,
    /// Threads, 1 to 1024 [default: all that the machine has]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = value_parser!(u16).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u16>,
    /// Instructions [default: the best that the CPU has]
    #[arg(long, value_name = "LEVEL", value_parser = level())]
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
    /// Only whether a ray meets anything
    #[arg(long, conflicts_with = "out_t")]
    pub any: bool,
    /// Where to write t: .npy, float32, (M,), +inf if a ray has no hit
    #[arg(long, value_name = "T.npy")]
    pub out_t: Option<PathBuf>,
    /// Where to write the sphere: .npy, int32, (M,), -1 if a ray has no hit; with --any 1 or 0
    #[arg(long, value_name = "I.npy")]
    pub out_id: Option<PathBuf>,
    /// Passes, 1 or more; the speed is that of their median
    #[arg(long, value_name = "N", default_value = "1", value_parser = value_parser!(u32).range(1..))]
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

/// The lecture, or a part of it.
#[derive(Args, Clone, Debug)]
pub struct LectureArguments {
    /// The station, 1 to 14 or by its name
    #[arg(long, value_name = "STATION", value_parser = station)]
    pub station: Option<usize>,
    /// Write the station, or all, also to a terminal
    #[arg(long)]
    pub once: bool,
    /// List the stations, with the part of the lecture and the source files of each
    #[arg(long)]
    pub list: bool,
    /// Size of a station in cells [default: 80x24; on a terminal all rows but the last]
    #[arg(long, value_name = "COLSxROWS", value_parser = size)]
    pub size: Option<(u16, u16)>,
    /// Colours
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
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
    let matches = Arguments::command().try_get_matches_from(arguments).and_then(|matches| {
        check_order(&matches)?;
        Arguments::from_arg_matches(&matches)
    });
    match matches {
        Ok(arguments) => Ok(Request::Run(Box::new(arguments))),
        Err(error) if error.exit_code() == 0 => Ok(Request::Print(error.to_string())),
        Err(error) => Err(Error::Input(in_one_line(&error.to_string()))),
    }
}

/// Object order searches no structure: whoever names one expects something else.
fn check_order(matches: &ArgMatches) -> Result<(), clap::Error> {
    let matches = matches.subcommand_matches("tradeoff").unwrap_or(matches);
    let is_object = matches!(matches.try_get_one("order"), Ok(Some(Order::Object)));
    if is_object && matches.value_source("structure") == Some(ValueSource::CommandLine) {
        let message = "the argument '--order object' cannot be used with '--structure <HOW>'";
        return Err(Arguments::command().error(ErrorKind::ArgumentConflict, message));
    }
    Ok(())
}

/// clap's message without its prefix, usage and tips, its lines joined.
fn in_one_line(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let first = message.split("\n\n").next().unwrap_or_default();
    first.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests;
