//! What the viewer holds while it runs.

use super::colors::Colors;
use super::film::Film;
use super::flow::Flow;
use super::meter::Meter;
use super::pace::Pace;
use super::pixels::Pixels;
use super::recording::Recording;
use super::shown::Shown;
use super::state::State;
use super::table::Table;
use crate::arguments::SceneArguments;
use crate::compare::error_map::ErrorMapper;
use crate::compare::split::Times;
use crate::draw::{Drawn, Renderer};
use crate::encode::Encoder;
use crate::error::Error;
use crate::picture::Image;
use crate::scene::Scene;
use crate::structure::scene::SceneStructures;
use crate::structure::{Order, Structure};
use crate::terminal::Terminal;
use crate::terminal::color_depth::{ColorChoice, Surroundings};
use std::sync::Arc;

/// The scene and the terminal, and what is kept from frame to frame.
pub(super) struct Viewer<'a> {
    pub(super) scene: Arc<Scene>,
    pub(super) colors: Colors,
    /// Its file, if it may have more frames.
    pub(super) film: Option<Film>,
    pub(super) structures: SceneStructures<'a>,
    pub(super) terminal: Terminal,
    pub(super) surroundings: Surroundings,
    pub(super) color: ColorChoice,
    pub(super) lossless: bool,
    pub(super) pixels: Pixels,
    /// What the command line says of the scene.
    pub(super) asked: SceneArguments,
    /// A word of the program, until the next key.
    pub(super) notice: Option<String>,
    /// Command lines that were asked for: printed when the terminal is given back.
    pub(super) told: Vec<String>,
    pub(super) recording: Option<Recording>,
    /// Why a recording could not be written.
    pub(super) failure: Option<Error>,
    /// What removes images; it is sent with the next frame.
    pub(super) pending_removal: Vec<u8>,
    pub(super) flow: Flow,
    pub(super) state: State,
    pub(super) renderer: Renderer<'a>,
    pub(super) mapper: ErrorMapper,
    pub(super) times: Times,
    pub(super) encoder: Encoder,
    pub(super) meter: Meter,
    pub(super) pace: Pace,
    pub(super) table: Table,
    /// The last picture.
    pub(super) picture: Option<Picture>,
    /// Kept from frame to frame for its memory.
    pub(super) bytes: Vec<u8>,
    pub(super) panic_key: bool,
}

/// A picture without what is written over it.
#[derive(Debug)]
pub(super) struct Picture {
    /// What it is of.
    pub(super) of: Shown,
    /// Columns and rows.
    pub(super) size: (u16, u16),
    /// Width and height of a cell, if it is drawn in pixels.
    pub(super) cell: Option<(u32, u32)>,
    /// How its rays found spheres.
    pub(super) searched: (Order, Structure),
    pub(super) drawn: Drawn,
    /// The image that is shown instead of cells.
    pub(super) image: Option<Image>,
}

impl Viewer<'_> {
    /// Asks the terminal for its size, which may be without a cell.
    pub(super) fn learn_size(&mut self) -> std::io::Result<(u16, u16)> {
        let (columns, rows) = self.terminal.size()?;
        self.state.set_size(columns, picture_rows(rows));
        Ok((columns, rows))
    }
}

/// The rows of the picture on a terminal of so many rows: the last is the status line's, if there are two.
pub(super) fn picture_rows(rows: u16) -> u16 {
    if rows >= 2 { rows - 1 } else { rows }
}
