//! The last row: what is shown and what it costs.

use super::meter::Figures;
use super::state::State;
use crate::cells::{CellGrid, Color};
use crate::draw::Charset;
use crate::view::LensKind;

const HINT: &str = "? help  q quit ";

/// Writes the status line into `row`: figures from the left; from the right, if there is room, how
/// to go on.
pub(super) fn write(cells: &mut CellGrid, row: u16, state: &State, figures: Figures) {
    let columns = usize::from(cells.columns());
    let mut line = figures_line(state, figures);
    let room = columns.saturating_sub(line.len());
    if room > HINT.len() {
        line.push_str(&format!("{HINT:>room$}"));
    }
    cells.write(0, row, &format!("{line:columns$}"), Color::Default, Color::Default);
}

fn figures_line(state: &State, figures: Figures) -> String {
    let accuracy = state.style.accuracy.as_str();
    let lens = match state.view.lens_kind() {
        LensKind::Perspective => "perspective",
        LensKind::Parallel => "parallel",
    };
    let charset = match state.style.charset {
        Charset::Ascii => "ascii",
        Charset::Half => "half",
    };
    let rate =
        figures.frames_per_second.map_or_else(|| "--".to_owned(), |rate| format!("{rate:.0}"));
    format!(
        " {accuracy} {lens} {charset}  {rate:>2} fps {:>5.1} ms {:>5.1} Mrays/s {:>5.1} kB ",
        figures.milliseconds,
        figures.megarays_per_second,
        figures.bytes as f64 / 1e3,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{AccuracyChoice, ColorDepth, Style};
    use crate::view::{Lens, View};
    use spherule_kernel::Vec3;

    fn line(columns: u16) -> String {
        let view = View {
            eye: Vec3::Z,
            target: Vec3::ZERO,
            up: Vec3::Y,
            lens: Lens::Perspective { fov: 40.0 },
        };
        let style = Style {
            accuracy: AccuracyChoice::Stable,
            charset: Charset::Half,
            depth: ColorDepth::Never,
            samples: 1,
            cell_aspect: 0.5,
        };
        let state = State::new(view, style);
        let figures = Figures {
            frames_per_second: Some(59.94),
            milliseconds: 3.21,
            megarays_per_second: 12.34,
            bytes: 45_678,
        };
        let mut cells = CellGrid::new(columns, 2);
        write(&mut cells, 1, &state, figures);
        cells.row(1).iter().map(|cell| cell.glyph).collect()
    }

    #[test]
    fn it_fills_the_row() {
        assert_eq!(
            line(90),
            " stable perspective half  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB           ? help  q quit "
        );
    }

    #[test]
    fn it_is_cut_where_there_is_no_room() {
        assert_eq!(line(10), " stable pe");
        assert_eq!(line(0), "");
    }
}
