//! The keys, over the picture.

use crate::cells::{CellGrid, Color};

const LINES: [&str; 27] = [
    "                                         ",
    "  arrows, h j k l, drag   around          ",
    "  H J K L, right drag     along the picture ",
    "  + -, wheel              nearer, farther ",
    "  space                   spin; play the frames of a file ",
    "  , .                     a frame back, on ",
    "  f                       all of the scene",
    "  r                       first view      ",
    "  o                       projection      ",
    "  y, R                    command line of this view; record ",
    "                                         ",
    "  p, click                what a cell is of, by every tier; then ",
    "                          arrows lead on, Enter frames, Esc ends ",
    "                                         ",
    "  1 2 3 4                 fast, stable, exact, geometric ",
    "  e                       what the tier gets wrong ",
    "  v, [ ]                  two tiers side by side ",
    "  t                       what every tier costs and gets wrong ",
    "  c                       ascii, half, quadrant, sextant, ",
    "                          octant, braille, block ",
    "  s                       auto, brute, depth-list, bvh ",
    "  C, g                    what colours are by, what they mean ",
    "  a, E, d                 occlusion, edges, depth cue ",
    "  ?                       this            ",
    "  Ctrl-Z, Ctrl-L          stop, fg goes on; draw anew ",
    "  q, Esc, Ctrl-C          quit            ",
    "                                         ",
];

/// Writes the keys into the middle of the first `rows` rows: without the blank lines if they leave no room for all keys,
/// and cut if there is none even so.
pub(super) fn write(cells: &mut CellGrid, rows: u16) {
    let width = LINES.iter().map(|line| line.len()).max().unwrap_or(0);
    let left = usize::from(cells.columns()).saturating_sub(width) / 2;
    let is_room = LINES.len() <= usize::from(rows);
    let lines = LINES.iter().filter(|line| is_room || !line.trim().is_empty());
    let top = usize::from(rows).saturating_sub(lines.clone().count()) / 2;
    for (row, line) in (top..usize::from(rows)).zip(lines) {
        let (Ok(column), Ok(row)) = (u16::try_from(left), u16::try_from(row)) else { return };
        cells.write(column, row, &format!("{line:width$}"), Color::Default, Color::Default);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::name;
    use crate::structure::Structure;
    use crate::style::Charset;
    use clap::ValueEnum;
    use spherule_kernel::Tier;

    #[test]
    fn it_names_what_keys_go_through_within_eighty_columns() {
        let charsets = Charset::value_variants().iter().map(name);
        let tiers = Tier::ALL.map(|tier| tier.as_str().to_owned());
        for name in charsets.chain(Structure::value_variants().iter().map(name)).chain(tiers) {
            assert!(LINES.concat().contains(&format!(" {name}")), "{name}");
        }
        assert!(LINES.iter().all(|line| line.len() <= 80));
    }

    #[test]
    fn every_key_is_on_a_screen_of_the_usual_size() {
        let mut cells = CellGrid::new(80, 24);
        write(&mut cells, 23);
        let written = cells.lines().concat();
        for line in LINES {
            assert!(written.contains(line.trim()), "{line}");
        }
    }

    #[test]
    fn it_never_reaches_the_status_line() {
        for (columns, rows) in [(80, 24), (80, 5), (10, 3), (1, 1), (200, 60)] {
            let mut cells = CellGrid::new(columns, rows);
            cells.write(0, rows - 1, "status", Color::Default, Color::Default);
            let status = cells.row(rows - 1).to_vec();
            write(&mut cells, rows - 1);
            assert_eq!(cells.row(rows - 1), status);
        }
    }
}
