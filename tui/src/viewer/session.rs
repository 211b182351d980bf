//! What the viewer holds while it runs.

use super::colors::Colors;
use super::film::Film;
use super::flow::Flow;
use super::meter::Meter;
use super::pace::Pace;
use super::picking::Cursor;
use super::pixels::Pixels;
use super::state::State;
use super::table::Table;
use super::wanted::Wanted;
use crate::arguments::PictureArguments;
use crate::cells::CellGrid;
use crate::choice::Auto;
use crate::coloring::legend::Legend;
use crate::draw::{Drawn, Effort};
use crate::encode::Encoder;
use crate::error::Error;
use crate::picture::Image;
use crate::scene::Scene;
use crate::structure::Structure;
use crate::terminal::Terminal;
use crate::terminal::color_depth::Surroundings;
use crossterm::event::Event;
use spherule_kernel::Sphere;
use std::sync::Arc;

/// The scene and the terminal, and what is kept from frame to frame, except what draws.
pub(super) struct Viewer {
    pub(super) scene: Arc<Scene>,
    /// How many scenes have come after the first: frames of its file, some of them again.
    pub(super) changes: usize,
    pub(super) colors: Colors,
    /// Its file, if it may have more frames.
    pub(super) film: Option<Film>,
    pub(super) terminal: Terminal,
    pub(super) surroundings: Surroundings,
    pub(super) pixels: Pixels,
    /// What the command line says.
    pub(super) asked: PictureArguments,
    /// What is framed since the last picture.
    pub(super) framed: Option<Sphere>,
    /// What the user did while a picture was drawn, and what can only be done when no one draws.
    pub(super) postponed: Option<Event>,
    /// The picture that came of the last Enter, and the cell that was picked then.
    pub(super) entered: Option<(Wanted, Option<Cursor>)>,
    /// A word of the program, until the next key.
    pub(super) notice: Option<String>,
    /// Whether what came by itself has not been shown yet: until then no key takes it away.
    pub(super) owes_notice: bool,
    /// Command lines that were asked for: printed when the terminal is given back.
    pub(super) told: Vec<String>,
    /// Why a recording could not be written.
    pub(super) failure: Option<Error>,
    /// What removes images; it is sent with the next frame.
    pub(super) pending_removal: Vec<u8>,
    pub(super) flow: Flow,
    pub(super) state: State,
    pub(super) encoder: Encoder,
    pub(super) meter: Meter,
    pub(super) pace: Pace,
    pub(super) table: Table,
    /// The last picture.
    pub(super) picture: Option<Picture>,
    /// Kept so that its allocation is reused.
    pub(super) bytes: Vec<u8>,
    pub(super) panic_key: bool,
}

/// A picture without what is written over it.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) of: Wanted,
    /// By which structure it was drawn; `None` if it is [blank](Picture::blank).
    pub(super) structure: Auto<Structure>,
    pub(super) drawn: Drawn,
    /// The image that is shown instead of cells.
    pub(super) image: Option<Image>,
    /// What its colours mean: those of the next one may mean something else.
    pub(super) legend: Option<Legend>,
}

impl Picture {
    /// What is there before the first picture of its size.
    pub(super) fn blank(of: Wanted) -> Self {
        let cells = CellGrid::new(of.size.0, of.size.1);
        let effort = Effort { is_full: false, ..Effort::NONE };
        Self { of, structure: None, drawn: Drawn { cells, effort }, image: None, legend: None }
    }
}

impl Viewer {
    /// Which picture is wanted now.
    pub(super) fn wanted(&self) -> Wanted {
        let size = self.state.size();
        Wanted {
            scene: self.changes,
            pictured: self.state.shown.pictured(),
            size,
            // A font of another size may leave columns and rows as they are.
            cell: self.protocol().map(|protocol| self.pixels_of_cell(protocol, size)),
        }
    }

    /// Asks the terminal for its size, which may be without a cell.
    pub(super) fn learn_size(&mut self) -> std::io::Result<(u16, u16)> {
        let (columns, rows) = self.terminal.size()?;
        self.state.set_size(columns, picture_rows(rows));
        Ok((columns, rows))
    }
}

/// The rows of the picture on a terminal of so many rows: the last is the status line's, if there are two.
fn picture_rows(rows: u16) -> u16 {
    if rows >= 2 { rows - 1 } else { rows }
}
