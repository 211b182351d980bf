//! What comes out of a terminal.

use super::look::last_row;

/// Begins every frame on a terminal that is known to draw between brackets.
pub(crate) const BEGIN: &str = "\x1b[?2026h";

/// What has come out of the terminal so far.
pub(crate) struct Output {
    pub(crate) terminal: vt100::Parser,
    pub(crate) sent: Vec<u8>,
}

impl Output {
    pub(crate) fn screen(&self) -> &vt100::Screen {
        self.terminal.screen()
    }

    /// The text on the screen.
    pub(crate) fn contents(&self) -> String {
        self.screen().contents()
    }

    /// The viewer's status line.
    pub(crate) fn status(&self) -> String {
        last_row(self.screen())
    }

    /// Whether the status line tells how many frames there are in a second.
    pub(crate) fn tells_a_rate(&self) -> bool {
        let line = self.status();
        line.contains(" fps") && !line.contains("-- fps")
    }

    /// What is behind the first cell.
    pub(crate) fn corner(&self) -> Option<vt100::Color> {
        Some(self.screen().cell(0, 0)?.bgcolor())
    }

    /// Whether an ink or a paper was sent that is not one of the eight.
    pub(crate) fn has_colors(&self) -> bool {
        ["\x1b[38", "\x1b[48"].iter().any(|code| self.text().contains(code))
    }

    /// All that was sent.
    pub(crate) fn text(&self) -> String {
        self.text_after(0)
    }

    /// What was sent after so many bytes.
    pub(crate) fn text_after(&self, count: usize) -> String {
        String::from_utf8_lossy(&self.sent[count..]).into_owned()
    }

    /// Whether the screen shows all of what was sent last, including the status line.
    pub(crate) fn is_whole(&self) -> bool {
        self.screen().alternate_screen()
            && (self.sent.ends_with(b"\x1b[?2026l") || self.sent.ends_with(b"\x1b[?2026l\x1b[5n"))
            && !self.status().trim().is_empty()
    }

    /// Whether the screen shows a whole frame, whose status line does not say that the next picture is being drawn.
    pub(crate) fn shows_a_frame(&self) -> bool {
        self.is_whole() && !self.status().contains("drawing ...")
    }
}
