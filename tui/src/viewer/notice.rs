//! Words of the program, over the last rows of the picture until the next key.

use super::command_line::command_line;
use super::film::Film;
use super::printable::in_cells;
use super::recording::{self, Recording};
use super::session::Viewer;
use crate::cells::{CellGrid, Color};
use crate::error::{Error, cause};
use crate::harmless::{LONGEST_LINE, cut};
use std::path::Path;
use std::time::Instant;

impl Viewer {
    /// Appends a message that no key has asked for to what is told already.
    pub(super) fn tell(&mut self, what: &str) {
        let what = cut(what, LONGEST_LINE);
        self.notice = Some(match self.notice.take() {
            Some(told) => format!("{told}; {what}"),
            None => what.into_owned(),
        });
        self.owes_notice = true;
    }

    /// Tells the command line that shows what is seen now; it is printed at the end, too.
    pub(super) fn tell_command_line(&mut self) {
        let frame = self.film.as_ref().map_or(0, Film::shown);
        let line = command_line(&self.asked, frame, &self.state, &self.scene, &self.colors);
        if self.told.last() != Some(&line) {
            self.told.push(line.clone());
        }
        self.notice = Some(line);
    }

    /// Begins a recording, or ends it and writes its file.
    pub(super) fn record(&mut self) {
        if self.end_recording() {
            return;
        }
        let stem = Path::new(&self.asked.scene.name).file_stem().unwrap_or_default();
        let stem = stem.to_string_lossy();
        // Standard input is called `-`, which begins an option.
        let name = if stem.starts_with('-') { "spherule" } else { &*stem };
        let told = if self.pixels.protocol.is_some() {
            "pixels are not recorded: --output cells".to_owned()
        } else {
            match Recording::begin(name, Instant::now()) {
                Ok(recording) => {
                    *recording::current() = Some(recording);
                    self.state.recording = true;
                    "recording: R ends it".to_owned()
                }
                Err(error) => format!("cannot record here: {}", cause(&error)),
            }
        };
        self.notice = Some(told);
    }

    /// Ends the recording, if there is one, and writes its file; returns whether there was one.
    pub(super) fn end_recording(&mut self) -> bool {
        // Held until the file is there: whoever ends the process meanwhile waits for it.
        let mut current = recording::current();
        let Some(recording) = current.take() else { return false };
        self.state.recording = false;
        if !recording.has_frames() {
            self.notice = Some("nothing was recorded".to_owned());
            return true;
        }
        self.notice = Some(match recording.write(Instant::now()) {
            Ok((path, frames)) => format!("{}: {frames} frames", path.display()),
            Err((path, error)) => {
                let failure = format!("{}: {}", path.display(), cause(&error));
                self.failure = Some(Error::Running(failure.clone()));
                failure
            }
        });
        true
    }
}

/// Writes `text` over the last of the first `rows` rows, in as many as it needs.
pub(super) fn write(cells: &mut CellGrid, rows: u16, text: &str) {
    let columns = usize::from(cells.columns()).max(1);
    let letters: Vec<char> = format!(" {} ", in_cells(text)).chars().collect();
    let lines: Vec<String> = letters.chunks(columns).map(|line| line.iter().collect()).collect();
    let first = usize::from(rows).saturating_sub(lines.len());
    for (row, line) in (first..usize::from(rows)).zip(lines) {
        let Ok(row) = u16::try_from(row) else { return };
        cells.write(0, row, &format!("{line:columns$}"), Color::Default, Color::Default);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_wrapped_over_the_last_rows() {
        let written = |text: &str| {
            let mut cells = CellGrid::new(5, 4);
            write(&mut cells, 3, text);
            cells.lines()
        };
        assert_eq!(written("abcdefg"), ["     ", " abcd", "efg  ", "     "]);
        // A quote is itself, in the name of a file.
        assert_eq!(written(r#""b.xyz"#), ["     ", r#" "b.x"#, "yz   ", "     "]);
        write(&mut CellGrid::new(1, 1), 1, "abc");
        write(&mut CellGrid::new(0, 0), 0, "abc");
    }
}
