//! Recordings of a terminal that can be played: asciinema's format, version 2.
//!
//! The first line says how large the terminal is. Each of the others is an event: seconds from the start, its kind, and what was written.
//!
//! Source: asciinema's documentation, "asciicast v2".

use crate::cells::CellGrid;
use crate::encode::{Economy, Encoder};
use serde_json::json;
use std::io::{self, Write};

/// Writes frames of a picture as a terminal would show them.
#[derive(Debug, Default)]
pub struct Cast {
    encoder: Encoder,
    /// Columns and rows; `None` before the first frame.
    size: Option<(u16, u16)>,
    bytes: Vec<u8>,
}

impl Cast {
    /// Appends a frame at so many `seconds` from the start to `out`, as near to `cells` as `economy` says.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn frame(
        &mut self,
        cells: &CellGrid,
        seconds: f64,
        economy: Economy,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let size = (cells.columns(), cells.rows());
        self.bytes.clear();
        match self.size.replace(size) {
            None => {
                let (width, height) = size;
                writeln!(out, "{}", json!({"version": 2, "width": width, "height": height}))?;
                // Hides the cursor; lines do not wrap.
                self.bytes.extend_from_slice(b"\x1b[?25l\x1b[?7l");
            }
            Some(before) if before != size => {
                event(seconds, 'r', &format!("{}x{}", size.0, size.1), out)?;
            }
            Some(_) => {}
        }
        self.encoder.encode_part(cells, economy, &mut self.bytes);
        // All control characters are our own, so all bytes are text.
        event(seconds, 'o', &String::from_utf8_lossy(&self.bytes), out)
    }

    /// Appends the end: the cursor is shown again, and lines wrap.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn end(&self, seconds: f64, out: &mut impl Write) -> io::Result<()> {
        event(seconds, 'o', "\x1b[?7h\x1b[?25h", out)
    }
}

fn event(seconds: f64, kind: char, data: &str, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "[{seconds:.6}, {}, {}]", json!(kind), json!(data))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::Color;
    use serde_json::Value;

    #[test]
    fn it_is_a_head_and_events_that_show_the_frames() {
        let (mut cast, mut out) = (Cast::default(), Vec::new());
        let mut grid = CellGrid::new(4, 2);
        for (frame, text) in ["\"a\\", "bcd"].into_iter().enumerate() {
            grid.write(0, 0, text, Color::Default, Color::Default);
            cast.frame(&grid, frame as f64 / 30.0, Economy::NONE, &mut out).expect("a vector");
        }
        cast.frame(&CellGrid::new(3, 1), 2.0, Economy::NONE, &mut out).expect("a vector");
        cast.end(2.5, &mut out).expect("a vector");
        let text = String::from_utf8(out).expect("UTF-8");
        let lines: Vec<Value> =
            text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(lines[0], json!({"version": 2, "width": 4, "height": 2}));
        assert_eq!(lines[3], json!([2.0, "r", "3x1"]));
        assert_eq!(lines.len(), 6);
        let mut terminal =
            vt100::Parser::new(2.try_into().expect("not 0"), 4.try_into().expect("not 0"), 0);
        for (line, shown) in [(1, "\"a\\"), (2, "bcd")] {
            assert_eq!(lines[line][1], "o");
            terminal.process(lines[line][2].as_str().expect("text").as_bytes());
            assert_eq!(terminal.screen().contents(), shown);
        }
        assert!(terminal.screen().hide_cursor());
        terminal.process(lines[5][2].as_str().expect("text").as_bytes());
        assert!(!terminal.screen().hide_cursor());
    }
}
