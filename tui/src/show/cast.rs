//! `--cast`: an orbit as a recording.

use crate::cast::Cast;
use crate::choice::Auto;
use crate::draw::picture_workload;
use crate::draw::{Renderer, Spending};
use crate::encode::Economy;
use crate::error::Error;
use crate::progress::{PATIENCE, Progress};
use crate::scene::Scene;
use crate::structure::Structure;
use crate::structure::scene::SceneStructures;
use crate::style::Style;
use crate::view::{View, orbited};
use crate::whole_file::WholeFile;
use std::io::BufWriter;
use std::path::Path;

/// How many frames there are, how many a second, and whether each is shown as it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub(super) frames: u16,
    pub(super) rate: u16,
    pub(super) lossless: bool,
}

/// Colours of a frame may be off by so much in `OKLab`: no one sees it.
const TOLERANCE: f32 = 0.01;

/// Writes one turn around the scene to the file `name`, or to standard output if that is `-`.
///
/// # Errors
/// [`Error`] if the file cannot be written, or there is no memory for a structure. Then there is no file of this name,
/// or it is as it was.
pub(super) fn write(
    name: &Path,
    turn: Turn,
    scene: &Scene,
    (structures, structure): (&mut SceneStructures<'_>, Auto<Structure>),
    (view, style, size): (&View, &Style, (u16, u16)),
    renderer: &mut Renderer<'_>,
) -> Result<(), Error> {
    let failed = |error: std::io::Error| Error::of_file(name, &error);
    let mut file = BufWriter::new(WholeFile::create(name).map_err(failed)?);
    let (mut cast, mut progress) = (Cast::default(), Progress::after(PATIENCE));
    let tolerance = if turn.lossless { 0.0 } else { TOLERANCE };
    let economy = Economy { tolerance, ..Economy::NONE };
    let count = scene.spheres().len();
    let workload = picture_workload(count, style, size.0, size.1, f64::from(turn.frames));
    let seconds = |frame: u16| f64::from(frame) / f64::from(turn.rate);
    for frame in 0..turn.frames {
        let angle = f32::from(frame) / f32::from(turn.frames) * std::f32::consts::TAU;
        let view = orbited(view, angle, 0.0);
        let search = structures.picture(structure, &workload, &view, scene)?;
        // As a picture that moves: what does not change keeps its glyphs.
        let spending = Spending::AtMost(u64::MAX);
        let cells = renderer.draw(scene, &search, &view, style, size, spending).cells;
        cast.frame(&cells, seconds(frame), economy, &mut file).map_err(failed)?;
        progress.show("recording", f64::from(frame + 1) / f64::from(turn.frames));
    }
    cast.end(seconds(turn.frames), &mut file).map_err(failed)?;
    let file = file.into_inner().map_err(|error| failed(error.into_error()))?;
    file.finish().map_err(failed)
}
