//! Which pixels the viewer shows, and what of them the terminal has.

use crate::choice::Auto;
use crate::pixels::{Output, Protocol};
use crate::terminal::Terminal;

/// Whether frames are pixels, and what of them the terminal has.
#[derive(Debug)]
pub(super) struct Pixels {
    pub(super) output: Output,
    pub(super) protocol: Auto<Protocol>,
    /// How many images were sent.
    pub(super) sent: u32,
    /// Whether one is on the screen.
    pub(super) is_shown: bool,
    /// Whether the terminal has still to say that it has shown the first.
    pub(super) awaits_first: bool,
}

impl Pixels {
    pub(super) fn new(output: Output, terminal: &Terminal) -> Self {
        let protocol = output.protocol(terminal.abilities());
        Self { output, protocol, sent: 0, is_shown: false, awaits_first: false }
    }

    /// Whether frames are pixels, where nothing is shown that is made of cells.
    pub(super) fn are_shown(&self) -> bool {
        self.protocol.is_some()
    }
}
