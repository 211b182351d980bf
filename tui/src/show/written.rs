//! What is written without the viewer: a recording, an image, a pick, a picture in pixels or in cells, and those of the frames that follow.

use super::cast;
use super::once::Once;
use super::reading::while_reading;
use crate::arguments::{Overlay, PictureArguments};
use crate::choice::Auto;
use crate::coloring::legend::Legend;
use crate::compare::Comparison;
use crate::draw::pixels::{PixelGrid, SAMPLES};
use crate::draw::{Renderer, picture_workload};
use crate::error::{Error, broken_off, write_stdout};
use crate::machine::check_floats;
use crate::pick::report::Report;
use crate::pick::{Pick, cell_ray};
use crate::pixels::{Output, Protocol};
use crate::png_file;
use crate::progress::{PATIENCE, Progress};
use crate::scene::Scene;
use crate::scene::frames::Frames;
use crate::structure::choose::Workload;
use crate::structure::scene::SceneStructures;
use crate::style::{ColorDepth, PIPE_SIZE, Style};
use crate::terminal::{Abilities, pixels_of_cell, size_of_stdout};
use crate::tradeoff::Question;
use crate::view::View;
use spherule_kernel::{Ray, Tier};
use std::ops::Range;
use std::path::Path;

/// The most pixels of a picture that is written by a protocol, since it is held whole: 200 MB.
const MOST_PIXELS: u64 = 1 << 26;

/// The protocol by which pixels are written; `None` for cells. A file or a pipe gets pixels only where a protocol is named.
pub(super) fn protocol(arguments: &PictureArguments, is_terminal: bool) -> Auto<Protocol> {
    let output = match arguments.output {
        Output::Auto if !is_terminal => Output::Cells,
        output => output,
    };
    output.protocol(&Abilities::default())
}

/// Whether pixels are written that no terminal stretches over its cells: they are square.
pub(super) fn is_in_square_pixels(arguments: &PictureArguments, is_terminal: bool) -> bool {
    let is_sent = arguments.show.is_none() && protocol(arguments, is_terminal).is_some();
    arguments.png.is_some() || is_sent && !is_terminal
}

/// What is drawn, and how.
pub(super) struct Written<'a, 't> {
    pub(super) arguments: &'a PictureArguments,
    pub(super) scene: &'a Scene,
    pub(super) view: View,
    pub(super) style: Style,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    pub(super) is_terminal: bool,
    pub(super) renderer: Renderer<'t>,
    pub(super) structures: SceneStructures<'t>,
}

impl Written<'_, '_> {
    /// Whether a picture in cells is written, and nothing else.
    pub(super) fn is_picture(&self) -> bool {
        let PictureArguments { png, cast, pick, show, .. } = self.arguments;
        let is_other = png.is_some() || cast.is_some() || pick.is_some() || show.is_some();
        !is_other && protocol(self.arguments, self.is_terminal).is_none()
    }

    /// Writes what is asked for of the first frame; a picture in cells with a `legend`, if there is one.
    pub(super) fn first(&mut self, legend: Option<Legend>) -> Result<(), Error> {
        let PictureArguments { png, cast, pick, show, .. } = self.arguments;
        if let Some(file) = cast {
            return self.cast(file);
        }
        if let Some(file) = png {
            return self.png(file);
        }
        if let Some(cell) = *pick {
            return self.pick(cell);
        }
        let protocol = protocol(self.arguments, self.is_terminal).filter(|_| show.is_none());
        if self.is_terminal && (protocol.is_some() || self.style.depth != ColorDepth::Never) {
            broken_off::await_signals();
        }
        match protocol {
            Some(protocol) => self.pixels(protocol),
            None => self.cells(legend),
        }
    }

    fn cast(&mut self, file: &Path) -> Result<(), Error> {
        self.refuse_terminal("--cast", file)?;
        let frames = self.arguments.scene.file.turn().map_err(Error::Input)?;
        let rate = self.arguments.fps.unwrap_or(30);
        let turn = cast::Turn { frames, rate, lossless: self.arguments.lossless };
        let picture = (&self.view, &self.style, self.size);
        let search = (&mut self.structures, self.arguments.computing.structure);
        cast::write(file, turn, self.scene, search, picture, &mut self.renderer)
    }

    fn png(&mut self, file: &Path) -> Result<(), Error> {
        self.refuse_terminal("--png", file)?;
        let Self { scene, view, style, size: (columns, rows), .. } = *self;
        let grid = PixelGrid::new(&view, &style, columns, rows);
        let workload = grid.workload(scene.spheres().len());
        let structure = self.arguments.computing.structure;
        let search = self.structures.picture(structure, &workload, &view, scene)?;
        let (mut progress, mut done) = (Progress::after(PATIENCE), 0_u32);
        png_file::write(file, grid.size(), |output| {
            self.renderer.draw_pixels(scene, &search, style.accuracy, &grid, |row| {
                output.write_all(row)?;
                done += 1;
                progress.show("drawing", f64::from(done) / f64::from(grid.size().1));
                Ok(())
            })
        })
    }

    /// Refuses bytes on a terminal.
    fn refuse_terminal(&self, option: &str, file: &Path) -> Result<(), Error> {
        if self.is_terminal && file == Path::new("-") {
            return Err(Error::Input(format!("{option} -: standard output is a terminal")));
        }
        Ok(())
    }

    fn pick(&mut self, cell: (u16, u16)) -> Result<(), Error> {
        let Self { arguments, scene, size, .. } = *self;
        let ray = ray_of_pick(&self.view, &self.style, size, cell)?;
        let level = self.renderer.machine().0;
        let (structure, workload) = (arguments.computing.structure, self.workload());
        let search = self.structures.picture(structure, &workload, &self.view, scene)?;
        let pick = Pick::new(scene, &search, level, ray);
        let report = Report { scene: &arguments.scene.name, size, cell, pick };
        let text = if arguments.json { report.json() } else { report.text() };
        write_stdout(text.as_bytes())
    }

    fn pixels(&mut self, protocol: Protocol) -> Result<(), Error> {
        let Self { scene, view, style, size, is_terminal, .. } = *self;
        let cell = pixels_of_cell(None).unwrap_or_else(|| PixelGrid::usual_cell(&style));
        let grid = PixelGrid::in_cells(&view, &style, size, cell, SAMPLES);
        let (width, height) = grid.size();
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            let what = format!("{width}x{height} pixels are too many for --output; --png has any");
            return Err(Error::Input(what));
        }
        let workload = grid.workload(scene.spheres().len());
        let structure = self.arguments.computing.structure;
        let search = self.structures.picture(structure, &workload, &view, scene)?;
        let image = self.renderer.draw_image(scene, &search, style.accuracy, &grid);
        let mut bytes = Vec::new();
        // A screen that is not known is supposed to be as high as a picture for a pipe.
        let rows =
            if is_terminal { size_of_stdout().map_or(0, |size| size.1) } else { PIPE_SIZE.1 };
        let is_higher = (1..size.1).contains(&rows);
        protocol.write_in_line(&image, size, is_higher, &mut bytes);
        write_stdout(&bytes)
    }

    fn cells(&mut self, legend: Option<Legend>) -> Result<(), Error> {
        let Self { arguments, scene, view, style, size, is_terminal, .. } = *self;
        let once = Once { scene, view, style, size, is_terminal };
        let (structure, workload) = (arguments.computing.structure, self.workload());
        let Self { renderer, structures, .. } = self;
        let search = structures.picture(structure, &workload, &view, scene)?;
        match arguments.show {
            None => once.picture(renderer, &search, legend),
            Some(Overlay::Tiers(Comparison::Errors)) => once.errors(renderer, &search),
            Some(Overlay::Tiers(Comparison::Split(tiers))) => once.split(tiers, renderer, &search),
            Some(Overlay::Table) => {
                let cells = once.drawn(renderer, &search);
                let machine = renderer.machine();
                let question = Question { scene, view, style, size, structure, machine };
                once.table(cells, &question, structures)
            }
        }
    }

    /// Writes the pictures of a range of frames, one after another, from where the first is seen.
    pub(super) fn following(
        &mut self,
        frames: Frames,
        range: Range<usize>,
        mut prepared: impl FnMut(usize, Scene) -> (Scene, Option<Legend>),
    ) -> Result<(), Error> {
        let Self { arguments, view, style, size, is_terminal, .. } = *self;
        let Self { renderer, structures, .. } = self;
        let (structure, (columns, rows), end) = (arguments.computing.structure, size, range.end);
        while_reading(frames, range, |index, scene| {
            let (scene, legend) = prepared(index, scene);
            structures.go_on(scene.list());
            let workload = picture_workload(scene.spheres().len(), &style, columns, rows, 1.0)
                .with_moves((end - index - 1) as f64);
            let search = structures.picture(structure, &workload, &view, &scene)?;
            let once = Once { scene: &scene, view, style, size, is_terminal };
            once.picture(renderer, &search, legend)
        })
    }

    /// The work of a picture in cells, and of the frames that follow it.
    fn workload(&self) -> Workload {
        let frames = self.arguments.scene.file.frames.as_ref();
        let moves = frames.map_or(0, |range| range.len().saturating_sub(1));
        let (columns, rows) = self.size;
        let spheres = self.scene.spheres().len();
        picture_workload(spheres, &self.style, columns, rows, 1.0).with_moves(moves as f64)
    }
}

/// The ray through a cell of `--pick`.
fn ray_of_pick(
    view: &View,
    style: &Style,
    (columns, rows): (u16, u16),
    cell: (u16, u16),
) -> Result<Ray, Error> {
    // A pick asks every tier.
    check_floats(Tier::Exact)?;
    cell_ray(view, style, (columns, rows), cell).ok_or_else(|| {
        let (column, row) = cell;
        let picture = format!("the picture, which is {columns}x{rows}");
        Error::Input(format!("--pick {column},{row}: outside of {picture}; cells count from 0"))
    })
}
