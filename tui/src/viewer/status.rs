//! The last row: what is shown and what it costs.

use super::meter::Figures;
use super::shown::Shown;
use super::state::State;
use crate::cells::{CellGrid, Color};
use crate::choice::{Auto, name};
use crate::structure::{Order, Structure};
use std::iter;

const HINT: &str = "? help  q quit ";

/// Writes the status line into `row`: names and figures from the left, the hint from the right.
///
/// Before them stands what is to come `first`: which frame of a file is shown, and that a picture is being drawn. Where
/// there is no room for all of it, the `structure` that the program chose itself is left out first, then the figures,
/// from the last. A structure that the user chose stays, and so does object order. The hint is left out where there is
/// no room for it beside the names.
pub(super) fn write(
    cells: &mut CellGrid,
    row: u16,
    (state, first): (&State, &str),
    (order, structure): (Order, Auto<Structure>),
    figures: Figures,
) {
    let columns = usize::from(cells.columns());
    let first = if first.is_empty() { String::new() } else { format!("{first}  ") };
    let (names, figures) = (first + &names(state, order), figure_texts(figures));
    let word = structure.map_or_else(String::new, |structure| format!(" {}", name(&structure)));
    let chosen = if state.shown.structure.is_some() { &*word } else { "" };
    let line = |structure: &str, count: usize| {
        format!(" {names}{structure}{} ", figures[..count].concat())
    };
    let width = |line: &str| line.chars().count();
    let most = figures.len();
    let mut lines =
        iter::once(line(&word, most)).chain((0..=most).rev().map(|count| line(chosen, count)));
    let line = match lines.find(|line| width(line) + HINT.len() <= columns) {
        Some(line) => format!("{line}{HINT:>room$}", room = columns - width(&line)),
        None => line(chosen, most),
    };
    cells.write(0, row, &format!("{line:columns$}"), Color::Default, Color::Default);
}

fn names(state: &State, order: Order) -> String {
    let Shown { view, style, .. } = &state.shown;
    let (lens, charset) = (name(&view.lens_kind()), name(&style.charset));
    let order = if order == Order::Object { " object" } else { "" };
    let recording = if state.recording { " rec" } else { "" };
    format!("{} {lens} {charset}{order}{recording}", style.accuracy.as_str())
}

/// The figures, from the one that is missed the most.
fn figure_texts(figures: Figures) -> [String; 5] {
    let rate =
        figures.frames_per_second.map_or_else(|| "--".to_owned(), |rate| format!("{rate:.0}"));
    [
        format!("  {rate:>2} fps"),
        format!(" {:>5.1} ms", figures.milliseconds),
        format!(" {:>5.1} Mrays/s", figures.megarays_per_second),
        format!(" {:>5.1} kB", figures.bytes as f64 / 1e3),
        figures
            .round_trip
            .map_or_else(String::new, |time| format!(" rtt {:>3.0} ms", 1e3 * time.as_secs_f64())),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::{Charset, Style};
    use crate::viewer::Start;
    use clap::ValueEnum;
    use spherule_kernel::Tier;
    use std::time::Duration;

    fn state(structure: Auto<Structure>) -> State {
        let style = Style { accuracy: Tier::Stable, charset: Charset::Half, ..Style::PLAIN };
        State::new(Start { style, structure, ..Start::FRONT }, (0, 3))
    }

    fn text(
        columns: u16,
        state: (&State, &str),
        searched: (Order, Auto<Structure>),
        figures: Figures,
    ) -> String {
        let mut cells = CellGrid::new(columns, 2);
        write(&mut cells, 1, state, searched, figures);
        cells.lines().remove(1)
    }

    fn line(columns: u16, choice: Auto<Structure>) -> String {
        line_in(Order::Image, columns, choice)
    }

    fn line_in(order: Order, columns: u16, choice: Auto<Structure>) -> String {
        let figures = Figures {
            frames_per_second: Some(59.94),
            milliseconds: 3.21,
            megarays_per_second: 12.34,
            bytes: 45_678,
            round_trip: None,
        };
        text(columns, (&state(choice), ""), (order, CHOSEN), figures)
    }

    const AUTO: Auto<Structure> = None;
    const CHOSEN: Auto<Structure> = Some(Structure::Bvh);

    #[test]
    fn it_fills_the_row() {
        assert_eq!(
            line(90, AUTO),
            " stable perspective half bvh  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB       ? help  q quit "
        );
    }

    #[test]
    fn the_round_trip_is_the_last_figure() {
        let figures = Figures { round_trip: Some(Duration::from_millis(23)), ..Figures::default() };
        let text = text(100, (&state(AUTO), ""), (Order::Image, CHOSEN), figures);
        assert_eq!(
            text,
            " stable perspective half bvh  -- fps   0.0 ms   0.0 Mrays/s   0.0 kB rtt  23 ms      ? help  q quit "
        );
    }

    #[test]
    fn what_auto_chose_goes_first() {
        assert_eq!(
            line(83, AUTO),
            " stable perspective half  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB    ? help  q quit "
        );
    }

    #[test]
    fn then_the_figures_go() {
        assert_eq!(
            line(83, CHOSEN),
            " stable perspective half bvh  60 fps   3.2 ms  12.3 Mrays/s         ? help  q quit "
        );
        assert_eq!(line(44, CHOSEN), " stable perspective half bvh ? help  q quit ");
        assert_eq!(line(43, CHOSEN), " stable perspective half bvh  60 fps   3.2 ");
    }

    #[test]
    fn object_order_stays() {
        assert_eq!(
            line_in(Order::Object, 90, AUTO),
            " stable perspective half object  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB    ? help  q quit "
        );
        assert_eq!(
            line_in(Order::Object, 47, AUTO),
            " stable perspective half object ? help  q quit "
        );
    }

    /// The longest of every name, figures of a slow picture, and of a fast one.
    #[test]
    fn at_eighty_columns_there_is_always_the_hint() {
        for choice in Structure::value_variants().iter().copied().map(Some).chain([None]) {
            for charset in Charset::value_variants() {
                let mut state = state(choice);
                state.shown.style.accuracy = Tier::Geometric;
                state.shown.style.charset = *charset;
                for scale in [0.0, 1.0, 100.0, 1e4] {
                    let figures = Figures {
                        frames_per_second: Some(scale),
                        milliseconds: scale,
                        megarays_per_second: scale,
                        bytes: (1e4 * scale) as usize,
                        round_trip: Some(Duration::from_secs_f64(scale / 1e3)),
                    };
                    let structure = choice.unwrap_or(Structure::DepthList);
                    for order in [Order::Image, Order::Object] {
                        let text = text(80, (&state, ""), (order, Some(structure)), figures);
                        assert!(text.ends_with(&format!(" {HINT}")), "{text}");
                        assert!(text.contains("fps"), "{text}");
                        assert!(choice.is_none() || text.contains(&name(&structure)), "{text}");
                        assert_eq!(text.contains(" object "), order == Order::Object);
                    }
                }
            }
        }
    }

    #[test]
    fn letters_of_two_bytes_have_one_cell() {
        let (state, searched) = (state(AUTO), (Order::Image, CHOSEN));
        let text = text(90, (&state, "frame 1: \u{e9}"), searched, Figures::default());
        assert!(text.starts_with(" frame 1: \u{e9}  stable ") && text.ends_with(HINT), "{text}");
    }

    /// Before the first picture nothing is known of its structure.
    #[test]
    fn what_comes_first_stays_where_there_is_little_room() {
        for (columns, expected) in [
            (61, " drawing ...  stable perspective half  -- fps ? help  q quit "),
            (12, " drawing ..."),
        ] {
            let (state, searched) = (state(AUTO), (Order::Image, None));
            let text = text(columns, (&state, "drawing ..."), searched, Figures::default());
            assert_eq!(text, expected);
        }
    }

    #[test]
    fn it_is_cut_where_there_is_no_room() {
        assert_eq!(line(10, CHOSEN), " stable pe");
        assert_eq!(line(0, AUTO), "");
    }
}
