//! The last row: what is shown and what it costs.

use super::meter::Figures;
use super::state::State;
use crate::cells::{CellGrid, Color};

use crate::choice::name;
use crate::structure::Structure;

const HINT: &str = "? help  q quit ";

/// Writes the status line into `row`: figures from the left; from the right, if there is room, the
/// hint. The `structure` stands there too if there is room for both, or if the user has chosen it.
pub(super) fn write(
    cells: &mut CellGrid,
    row: u16,
    state: &State,
    structure: Structure,
    figures: Figures,
) {
    let columns = usize::from(cells.columns());
    let mut line = figures_line(state, "", figures);
    let word = format!(" {}", name(&structure));
    let taken = if state.shown.structure.is_none() { HINT.len() + 1 } else { 0 };
    if line.len() + word.len() + taken <= columns {
        line = figures_line(state, &word, figures);
    }
    let room = columns.saturating_sub(line.len());
    if room > HINT.len() {
        line.push_str(&format!("{HINT:>room$}"));
    }
    cells.write(0, row, &format!("{line:columns$}"), Color::Default, Color::Default);
}

fn figures_line(state: &State, structure: &str, figures: Figures) -> String {
    let accuracy = state.shown.style.accuracy.as_str();
    let (lens, charset) = (name(&state.shown.view.lens_kind()), name(&state.shown.style.charset));
    let rate =
        figures.frames_per_second.map_or_else(|| "--".to_owned(), |rate| format!("{rate:.0}"));
    format!(
        " {accuracy} {lens} {charset}{structure}  {rate:>2} fps {:>5.1} ms {:>5.1} Mrays/s {:>5.1} kB ",
        figures.milliseconds,
        figures.megarays_per_second,
        figures.bytes as f64 / 1e3,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Auto;
    use crate::style::{Charset, Style};
    use crate::view::{Lens, View};
    use spherule_kernel::{Tier, Vec3};

    fn line(columns: u16, choice: Auto<Structure>) -> String {
        let view = View {
            eye: Vec3::Z,
            target: Vec3::ZERO,
            up: Vec3::Y,
            lens: Lens::Perspective { fov: 40.0 },
        };
        let style = Style { accuracy: Tier::Stable, charset: Charset::Half, ..Style::PLAIN };
        let state = State::new(view, style, choice);
        let figures = Figures {
            frames_per_second: Some(59.94),
            milliseconds: 3.21,
            megarays_per_second: 12.34,
            bytes: 45_678,
        };
        let mut cells = CellGrid::new(columns, 2);
        write(&mut cells, 1, &state, Structure::Bvh, figures);
        cells.row(1).iter().map(|cell| cell.glyph).collect()
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
    fn what_auto_chose_needs_room() {
        assert_eq!(
            line(84, AUTO),
            " stable perspective half  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB     ? help  q quit "
        );
        assert_eq!(
            line(75, CHOSEN),
            " stable perspective half bvh  60 fps   3.2 ms  12.3 Mrays/s  45.7 kB       "
        );
    }

    #[test]
    fn it_is_cut_where_there_is_no_room() {
        assert_eq!(line(10, CHOSEN), " stable pe");
        assert_eq!(line(0, AUTO), "");
    }
}
