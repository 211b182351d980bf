//! One picture, or the viewer: what `spherule [SCENE]` does.

mod background;
mod cast;
mod conflicts;
mod once;
mod overwriting;
mod reading;
mod written;

use crate::arguments::files::Subject;
use crate::arguments::{ComputingArguments, Overlay, PictureArguments};
use crate::coloring::seen::Seen;
use crate::coloring::{Coloring, coloring};
use crate::draw::pixels::PixelGrid;
use crate::draw::{Renderer, picture_workload};
use crate::error::Error;
use crate::machine::check_floats;
use crate::pixels::Output;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::notes::say;
use crate::structure::scene::SceneStructures;
use crate::style::{Charset, ColorDepth, PIPE_SIZE, Style};
use crate::terminal::color_depth::{ColorChoice, Surroundings};
use crate::terminal::locale::is_without_unicode;
use crate::terminal::{Abilities, Terminal, Uses, lost, pixels_of_cell, size_of_stdout};
use crate::threads::Threads;
use crate::viewer::film::Film;
use crate::{scene, viewer};
use spherule_kernel::{Level, Tier};
use std::io::IsTerminal;
use std::ops::RangeInclusive;
use std::sync::Arc;
use std::time::Duration;
use written::{Written, is_in_square_pixels};

/// The widest cell and the narrowest that a terminal is believed to have.
const LIKELY_ASPECTS: RangeInclusive<f32> = 0.2..=2.0;

/// Shows a scene: in the viewer if standard output is a terminal that can show it, except with `--once`, `--size` and options that
/// write something else.
///
/// # Errors
/// [`Error`] if there is no such scene, or it cannot be shown.
pub fn show(arguments: &PictureArguments) -> Result<(), Error> {
    if arguments.show.is_some() {
        // Answers are wrong where they differ from exact.
        check_floats(Tier::Exact)?;
    }
    let Subject { mut scene, frame, frames } = open(arguments)?;
    overwriting::refuse(arguments, frames.is_some())?;
    let is_terminal = std::io::stdout().is_terminal();
    let mut surroundings = Surroundings::of_process(is_terminal);
    let PictureArguments { png, cast, pick, crowd, .. } = arguments;
    let has_frames = arguments.scene.file.frames.is_some();
    let has_size = arguments.scene.size.is_some();
    let at_once = arguments.once || png.is_some() || pick.is_some() || cast.is_some();
    let in_viewer = is_terminal && !(at_once || has_frames || has_size || surroundings.is_dumb());
    if !in_viewer {
        conflicts::refuse(arguments, is_terminal)?;
    }
    let color_by = crowd.color_by(&scene);
    let mut seen = Seen::default();
    let colored = coloring(&scene, &color_by, crowd.range, &mut seen);
    let colored =
        colored.map_err(|error| Error::Input(format!("{}: {error}", arguments.scene.name)))?;
    if !in_viewer && crowd.range.is_some() && !colored.has_numbers() {
        let what = format!("--range needs a column of numbers; colours are by {}", color_by.name());
        return Err(Error::Input(what));
    }
    let ComputingArguments { structure, level, threads } = arguments.computing;
    let threads = Threads::new(threads)?;
    // There every picture has another caller.
    let threads = if in_viewer { threads.apart() } else { threads };
    let mut structures =
        SceneStructures::new(scene.list(), &threads).in_order(arguments.scene.order);
    if in_viewer && scene.spheres().len() >= MANY {
        // The tree is built before the terminal is taken: then Ctrl-C ends the program at once.
        let mut progress = Progress::after(Duration::ZERO);
        progress.say("building a tree");
        let (style, (columns, rows)) = (Style::PLAIN, PIPE_SIZE);
        let count = scene.spheres().len();
        let workload = picture_workload(count, &style, columns, rows, f64::INFINITY);
        let view = arguments.scene.view(&scene, style.picture_aspect(columns, rows));
        structures.picture(structure, &workload, &view, &scene)?;
    }
    // From here on every error is told by `main`, after the terminal was given back.
    let uses = Uses {
        color: surroundings.depth(arguments.color) != ColorDepth::Never,
        kitty: arguments.output == Output::Kitty,
        sixel: matches!(arguments.output, Output::Sixel | Output::Auto),
    };
    let terminal = in_viewer.then(|| Terminal::enter(!arguments.no_probe, uses)).transpose();
    let terminal = terminal.map_err(|error| lost(&error))?;
    let abilities =
        terminal.as_ref().map_or_else(Abilities::default, |terminal| *terminal.abilities());
    surroundings.told = abilities.truecolor;
    // Without colours, letters and dots are chosen as light ink on dark paper.
    let own = abilities.background.filter(|_| uses.color);
    let own = own.filter(|&own| background::sets_off(own, &scene));
    let background = arguments.background.or(own);
    background::paint(&mut scene, background);
    // The viewer starts from the scene's own colours and changes them itself.
    if let Some(colors) = colored.colors.filter(|_| !in_viewer) {
        scene.set_colors(colors);
    }
    // The viewer's table is measured by a thread that no one waits for, so the scene is shared.
    let scene = Arc::new(scene);
    let depth = match arguments.color {
        // Whoever plays the recording has colours.
        ColorChoice::Auto if cast.is_some() && !surroundings.no_color => ColorDepth::Truecolor,
        choice => surroundings.depth(choice),
    };
    let on_terminal = || {
        let (columns, rows) = size_of_stdout()?;
        // The prompt comes back below a picture, and pushes the top row out if there is no row left.
        Some((columns, if in_viewer { rows } else { (rows - 1).max(1) }))
    };
    let (columns, rows) = arguments.scene.size.or_else(on_terminal).unwrap_or(PIPE_SIZE);
    let style = Style {
        accuracy: arguments.accuracy,
        charset: arguments.charset.unwrap_or(match depth {
            ColorDepth::Never => Charset::Ascii,
            _ if is_without_unicode() => Charset::Ascii,
            _ => Charset::Half,
        }),
        depth,
        theme: surroundings.theme(arguments.palette),
        samples: arguments.scene.samples,
        cell_aspect: arguments
            .cell_aspect
            .or_else(|| terminal_aspect(abilities.cell_pixels))
            .unwrap_or(Style::PLAIN.cell_aspect),
        distance: arguments.distance,
        aids: arguments.crowd.aids(&scene),
    };
    let is_in_pixels = is_in_square_pixels(arguments, is_terminal);
    let style = if is_in_pixels { PixelGrid::square(&style) } else { style };
    let view = arguments.scene.view(&scene, style.picture_aspect(columns, rows));
    let renderer = Renderer::new(level.unwrap_or_else(Level::best), &threads);
    structures.set_aids(style.aids);
    if let Some(terminal) = terminal {
        let comparison = arguments.show.and_then(Overlay::comparison);
        let table = arguments.show == Some(Overlay::Table);
        let start =
            viewer::Start { view, style, structure, comparison, table, legend: crowd.legend };
        let wire = viewer::Wire { terminal, surroundings, asked: arguments.clone() };
        let asked = arguments.scene.clone();
        let prepare = move |scene: &mut Scene| {
            background::paint(scene, background);
            asked.set_radii(scene).map_err(|error| format!("keeps its radii: {error}"))
        };
        let film = frames.map(|frames| Film::new(frames, frame, prepare));
        return viewer::run(scene, structures, start, renderer, (wire, film.transpose()?));
    }

    let size = (columns, rows);
    let mut written =
        Written { arguments, scene: &scene, view, style, size, is_terminal, renderer, structures };
    written.first(colored.legend.filter(|_| crowd.legend))?;
    let Some(mut frames) = frames else { return Ok(()) };
    let of_frames = arguments.scene.file.frames.clone().filter(|_| cast.is_none());
    let Some(range) = of_frames else {
        let by = if written.is_picture() { "--frame N, --frames A..B" } else { "--frame N" };
        let what = if has_frames {
            // They were those of the turn.
            format!("a turn around frame {frame} is recorded; R in the viewer records frames")
        } else {
            format!("frame {frame} is shown; there are more: {by}")
        };
        frames.report_more(frame, what);
        return Ok(());
    };
    // What some frames do not have is told once, of the first of them: before the end, which a file that is followed has not.
    let source = frames.source().to_owned();
    let [mut all_have_radii, mut all_have_colors] = [true; 2];
    let prepared = |index: usize, mut scene: Scene| {
        background::paint(&mut scene, background);
        if let Err(error) = arguments.scene.set_radii(&mut scene)
            && std::mem::take(&mut all_have_radii)
        {
            say(&source, &format!("frame {index} keeps its radii: {error}"));
        }
        let colored = coloring(&scene, &color_by, crowd.range, &mut seen);
        let colored = colored.unwrap_or_else(|error| {
            if std::mem::take(&mut all_have_colors) {
                say(&source, &format!("frame {index} keeps its colours: {error}"));
            }
            Coloring::default()
        });
        if let Some(colors) = colored.colors {
            scene.set_colors(colors);
        }
        (scene, colored.legend.filter(|_| crowd.legend))
    };
    written.following(frames, frame + 1..range.end, prepared)
}

/// Opens the scene. The frames of a turn are not the file's: they do not end the search for one with particles.
fn open(arguments: &PictureArguments) -> Result<Subject, Error> {
    let mut asked = arguments.scene.clone();
    if arguments.cast.is_some() {
        asked.file.frames = asked.file.frames.map(|frames| frames.start..usize::MAX);
    }
    asked.open()
}

/// From so many spheres on, building a tree takes a while.
const MANY: usize = 1_000_000;

/// The shape of the terminal's cells, if it knows how many pixels they have.
fn terminal_aspect(told: Option<(u16, u16)>) -> Option<f32> {
    let (width, height) = pixels_of_cell(told)?;
    Some(width as f32 / height as f32).filter(|aspect| LIKELY_ASPECTS.contains(aspect))
}

/// The built-in scenes, a line each: name, number of spheres, description.
#[must_use]
pub fn scenes() -> String {
    let mut text = String::new();
    for builtin in scene::builtin::BUILTINS {
        let count = (builtin.scene)().spheres().len();
        text += &format!("{:<10}{count:>6}  {}\n", builtin.name, builtin.description);
    }
    text
}
