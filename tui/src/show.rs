//! One picture, or the viewer: what `spherule [SCENE]` does.

use crate::arguments::{CharsetChoice, ComputingArguments, PictureArguments};
use crate::color_depth::Surroundings;
use crate::draw::{Charset, ColorDepth, Renderer, Style, picture_aspect, picture_workload};
use crate::failure::{Failure, write_stdout};
use crate::structure::{SceneStructures, TreeMemory};
use crate::threads::Threads;
use crate::{encode, scene, view, viewer};
use crossterm::terminal;
use spherule_kernel::dispatch::Level;
use std::io::IsTerminal;

/// The size of a picture in a pipe.
pub(crate) const PIPE_SIZE: (u16, u16) = (80, 24);
/// Width over height of a cell where no terminal says.
pub(crate) const USUAL_ASPECT: f32 = 0.5;
/// The widest cell and the narrowest that a terminal is believed to have.
const LIKELY_ASPECTS: std::ops::RangeInclusive<f32> = 0.2..=2.0;

/// Shows a scene: in the viewer where standard output is a terminal, unless one picture is asked
/// for.
///
/// # Errors
/// [`Failure`] where there is no such scene, or it cannot be shown.
pub fn show(arguments: &PictureArguments) -> Result<(), Failure> {
    let scene = scene::open::open(&arguments.scene, arguments.format)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let is_terminal = std::io::stdout().is_terminal();
    let depth = Surroundings::of_process(is_terminal).depth(arguments.color);
    let (columns, rows) = arguments
        .size
        .or_else(|| terminal::size().ok().filter(|&size| is_terminal && is_usable(size)))
        .unwrap_or(PIPE_SIZE);
    let style = Style {
        accuracy: arguments.accuracy,
        charset: match (arguments.charset, depth) {
            (CharsetChoice::Only(charset), _) => charset,
            (CharsetChoice::Auto, ColorDepth::Never) => Charset::Ascii,
            (CharsetChoice::Auto, _) => Charset::Half,
        },
        depth,
        samples: arguments.samples,
        cell_aspect: arguments
            .cell_aspect
            .or_else(|| terminal_aspect().filter(|_| is_terminal))
            .unwrap_or(USUAL_ASPECT),
    };
    let mut view = scene.first_view(picture_aspect(&style, columns, rows) as f32);
    if let Some(kind) = arguments.projection {
        view = view::with_projection(&view, kind);
    }

    let ComputingArguments { structure, threads, level } = arguments.computing;
    let threads = Threads::new(threads)?;
    let mut renderer = Renderer::new(level.unwrap_or_else(Level::best), &threads);
    let mut memory = TreeMemory::default();
    let mut structures = SceneStructures::new(scene.spheres(), &threads, &mut memory);
    if is_terminal && !arguments.once {
        return viewer::run(&scene, structures, structure, view, style, renderer);
    }
    let workload = picture_workload(scene.spheres().len(), &style, columns, rows, 1.0);
    let structure = structures.structure(structure, &workload);
    let search = structures.picture(structure, workload.kind, view.viewpoint(), &scene.lights)?;
    let drawn = renderer.draw(&scene, &search, &view, &style, columns, rows);
    let mut bytes = Vec::new();
    encode::full(&drawn.cells, &mut bytes);
    write_stdout(&bytes)
}

/// A terminal may not know its size, or lie.
fn is_usable((columns, rows): (u16, u16)) -> bool {
    (1..=4096).contains(&columns) && (1..=4096).contains(&rows)
}

/// The shape of the terminal's cells, where it knows how many pixels they have.
fn terminal_aspect() -> Option<f32> {
    let size = terminal::window_size().ok()?;
    let width = f32::from(size.width) / f32::from(size.columns);
    let aspect = width / (f32::from(size.height) / f32::from(size.rows));
    LIKELY_ASPECTS.contains(&aspect).then_some(aspect)
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
