//! What is told of the frames of a file: how many there are, and why no more come.

use super::ahead::State;
use crate::scene::ReadError;
use crate::viewer::printable::in_cells;

/// For the status line: which frame of how many is shown, or where it stops. Why is in a [`reason`].
pub(super) fn status(state: &State, shown: usize, is_playing: bool) -> String {
    // What ends the film is read long before it would be shown, and is told of where it would be next.
    let is_at_end = !is_playing && state.count == Some(shown + 1);
    let ending = state.ending.as_ref().filter(|_| is_at_end);
    if let Some((frame, error)) = state.failure.as_ref().or(ending) {
        return match error.line {
            Some(line) => format!("frame {frame}: line {line}"),
            None => format!("frame {frame}: {}", in_cells(&error.what)),
        };
    }
    let mark = if is_playing { ">" } else { "" };
    let end = match (state.count, &state.ending) {
        (None, _) => "+",
        (Some(_), Some(_)) => "!",
        (Some(_), None) => "",
    };
    let of = state.count.unwrap_or(state.seen).max(shown + 1);
    format!("{mark}{shown}/{of}{end}")
}

/// Why a frame cannot be shown.
pub(super) fn reason(frame: usize, error: &ReadError) -> String {
    format!("frame {frame}: {error}")
}
