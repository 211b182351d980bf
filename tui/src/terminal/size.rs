//! The size of the terminal that standard output is. That which controls the process may be another one.

use super::reply::LARGEST_CELL;
use rustix::termios::tcgetwinsize;
use std::{env, io};

/// The largest size, as for `--size`: a terminal that claims more is not believed.
const LARGEST: u16 = 4096;

/// Columns and rows of standard output, if that is a terminal that knows them: 1 to 4096 of both.
#[must_use]
pub fn size_of_stdout() -> Option<(u16, u16)> {
    let size = tcgetwinsize(io::stdout()).ok()?;
    let is_known = |count: u16| (1..=LARGEST).contains(&count);
    (is_known(size.ws_col) && is_known(size.ws_row)).then_some((size.ws_col, size.ws_row))
}

/// Columns and rows, each at most 4096; one of them may be 0. A terminal that knows neither, as on a serial line, has
/// those of `COLUMNS` and `LINES`, or the usual ones, until it tells others.
///
/// # Errors
/// If the terminal does not tell.
pub(super) fn size() -> io::Result<(u16, u16)> {
    let size = tcgetwinsize(io::stdout())?;
    let (columns, rows) = match (size.ws_col, size.ws_row) {
        (0, 0) => (count_of("COLUMNS").unwrap_or(80), count_of("LINES").unwrap_or(24)),
        size => size,
    };
    Ok((columns.min(LARGEST), rows.min(LARGEST)))
}

/// How many columns or rows a variable tells.
fn count_of(variable: &str) -> Option<u16> {
    env::var(variable).ok()?.parse::<u16>().ok().filter(|&count| count > 0)
}

/// Width and height of a cell in pixels: by the system's word, else by what the terminal has told. The system says nothing
/// of what is no terminal.
#[must_use]
pub fn pixels_of_cell(told: Option<(u16, u16)>) -> Option<(u32, u32)> {
    let of_system = || {
        let size = tcgetwinsize(io::stdout()).ok()?;
        let pixels = |all: u16, cells: u16| {
            all.checked_div(cells).filter(|pixels| (1..=LARGEST_CELL).contains(pixels))
        };
        Some((pixels(size.ws_xpixel, size.ws_col)?, pixels(size.ws_ypixel, size.ws_row)?))
    };
    of_system().or(told).map(|(width, height)| (u32::from(width), u32::from(height)))
}
