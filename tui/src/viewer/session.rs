//! What the viewer holds while it runs.

use super::film::Film;
use super::meter::Meter;
use super::pace::Pace;
use super::state::{Shown, State};
use super::table::Table;
use crate::compare::error_map::ErrorMapper;
use crate::compare::split::Times;
use crate::draw::{Drawn, Renderer};
use crate::encode::Encoder;
use crate::scene::Scene;
use crate::structure::scene::SceneStructures;
use crate::structure::{Order, Structure};
use crate::terminal::Terminal;
use std::sync::Arc;

/// The scene and the terminal, and what is kept from frame to frame.
pub(super) struct Viewer<'a> {
    pub(super) scene: Arc<Scene>,
    /// Its file, if it may have more frames.
    pub(super) film: Option<Film>,
    pub(super) structures: SceneStructures<'a>,
    pub(super) terminal: Terminal,
    pub(super) state: State,
    pub(super) renderer: Renderer<'a>,
    pub(super) mapper: ErrorMapper,
    pub(super) times: Times,
    pub(super) encoder: Encoder,
    pub(super) meter: Meter,
    pub(super) pace: Pace,
    pub(super) table: Table,
    /// The last.
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
    /// How its rays found spheres.
    pub(super) searched: (Order, Structure),
    pub(super) drawn: Drawn,
}

impl Viewer<'_> {
    /// Asks the terminal for its size, which may be without a cell.
    pub(super) fn learn_size(&mut self) -> std::io::Result<(u16, u16)> {
        let (columns, rows) = self.terminal.size()?;
        self.state.set_size(columns, picture_rows(rows));
        Ok((columns, rows))
    }
}

/// The rows of the picture, of so many of the terminal: the last is the status line's, if there are two.
pub(super) fn picture_rows(rows: u16) -> u16 {
    if rows >= 2 { rows - 1 } else { rows }
}
