//! `spherule lecture`: the graphics lecture, walked. Fourteen stations of one screen each, from vectors to where single
//! precision ends; every number on them is computed when it is shown, and arrows change it.
//!
//! Drawn in ASCII, so that it is the same on every terminal; colour only helps.

mod canvas;
mod chart;
mod few;
mod frame;
mod pixels;
mod shot;
mod station;
pub mod stations;
#[cfg(test)]
mod tests;
mod walk;

use crate::choice::size;
use crate::encode;
use crate::error::{Error, broken_off, write_stdout};
use crate::style::{ColorDepth, PIPE_SIZE, Style};
use crate::terminal::color_depth::{ColorChoice, Surroundings};
use crate::terminal::size_of_stdout;
use clap::Args;
use stations::{STATIONS, station};
use std::io::IsTerminal;

/// The lecture, or a part of it.
#[derive(Args, Clone, Debug)]
pub struct LectureArguments {
    /// The station, 1 to 14 or by its name
    #[arg(long, value_name = "STATION", value_parser = station, allow_negative_numbers = true)]
    pub station: Option<usize>,
    /// Write the station, or all, also to a terminal; so does --size
    #[arg(long)]
    pub once: bool,
    /// List the stations, with the part of the lecture and the source files of each
    #[arg(long, conflicts_with_all = ["station", "size"])]
    pub list: bool,
    /// Size of a station in cells [default: 80x24; on a terminal all rows but the last]
    #[arg(long, value_name = "COLSxROWS", value_parser = size)]
    pub size: Option<(u16, u16)>,
    /// Colours
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// Ask the terminal nothing
    #[arg(long)]
    pub no_probe: bool,
}

/// Walks through the lecture on a terminal that can show it. With `--once` or `--size`, or into a pipe, prints the
/// station that is asked for, or all of them.
///
/// # Errors
/// [`Error`] if nothing can be shown.
pub fn lecture(arguments: &LectureArguments) -> Result<(), Error> {
    if arguments.list {
        return write_stdout(list().as_bytes());
    }
    let is_terminal = std::io::stdout().is_terminal();
    let surroundings = Surroundings::of_process(is_terminal);
    let (depth, theme) = (surroundings.depth(arguments.color), surroundings.theme(None));
    let style = Style { depth, theme, ..Style::PLAIN };
    // A walk has the terminal's size.
    let at_once = arguments.once || arguments.size.is_some();
    if is_terminal && !at_once && !surroundings.is_dumb() {
        return walk::walk(arguments.station.unwrap_or(0), style, !arguments.no_probe);
    }
    // The prompt comes back below, and pushes the top row out if there is no row left.
    let on_terminal = || size_of_stdout().map(|(columns, rows)| (columns, (rows - 1).max(1)));
    let size = arguments.size.or_else(on_terminal).unwrap_or(PIPE_SIZE);
    if is_terminal && depth != ColorDepth::Never {
        broken_off::await_signals();
    }
    let chosen = arguments.station.map_or(0..STATIONS.len(), |index| index..index + 1);
    for index in chosen {
        let page = frame::page(index, STATIONS[index].first(), false, size, style);
        let mut bytes = Vec::new();
        encode::full(&page, &mut bytes);
        write_stdout(&bytes)?;
    }
    Ok(())
}

/// The stations: number, name, topic, and the sources with what to look for there.
#[must_use]
pub fn list() -> String {
    let mut text = String::new();
    for (number, station) in (1..).zip(&STATIONS) {
        text += &format!("{number:>2}  {:<14} {}\n", station.name, station.title);
        text += &format!("    {:<14} lecture: {}\n", "", station.topic);
        for source in station.sources {
            text += &format!("    {:<14} {}: {}\n", "", source.file, source.symbols.join(", "));
        }
    }
    text += "\nTriangles, the lecture's other surface, are left out: the kernel models only what a scene here requires,\n\
             and scenes here are made of spheres.\n";
    text
}
