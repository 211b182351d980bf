//! A summary for developers of the program: ours beside chafa's, a line a mode.

use super::motion::Unrest;
use super::row::{Reached, Row};
use super::still::Score;
use spherule_tests::art::figures::Figures;
use std::fmt::Write;

/// A table: its head, which figure it shows, and whether the figure's aim is reached.
type Table = (&'static str, fn(&Figures, Option<&Figures>) -> String, fn(&Reached) -> bool);

const TABLES: [Table; 4] = [
    ("FLIP, ours / chafa's: lower is better", flip, |reached| reached.flip),
    (
        "SSIM, ours less chafa's",
        |ours, chafa| less(ours, chafa, 3, |f| f.ssim),
        |reached| reached.ssim,
    ),
    ("PSNR, ours less chafa's, dB", |ours, chafa| less(ours, chafa, 1, |f| f.psnr), |_| true),
    ("from across the room, ours less chafa's, dB", far, |reached| reached.far),
];

fn flip(ours: &Figures, chafa: Option<&Figures>) -> String {
    let digits = |value: f64| format!("{value:.3}").trim_start_matches('0').to_owned();
    match chafa {
        Some(chafa) => {
            let ratio = ours.flip / chafa.flip;
            format!("{ratio:.3} {}/{}", digits(ours.flip), digits(chafa.flip))
        }
        None => digits(ours.flip),
    }
}

fn far(ours: &Figures, chafa: Option<&Figures>) -> String {
    let difference = less(ours, chafa, 1, |figures| figures.far);
    format!("{:.1} {difference}", ours.far)
}

fn less(
    ours: &Figures,
    chafa: Option<&Figures>,
    digits: usize,
    figure: fn(&Figures) -> f64,
) -> String {
    let difference = figure(ours) - chafa.map_or(0.0, figure);
    format!("{difference:+.digits$}")
}

/// All tables, of the scenes that were judged.
pub(crate) fn summary(rows: &[Row], scenes: &[&str]) -> String {
    let mut text = String::new();
    for (head, show, is_reached) in TABLES {
        text += &heading(head, scenes);
        let _ = writeln!(text);
        for row in rows {
            let _ = write!(text, "{:24}", row.name());
            for (place, score) in &row.scores {
                let Score { ours, chafa } = score;
                let mark = Reached::mark(is_reached(&row.reached(*place, score)));
                let _ = write!(text, "{:18}", show(ours, chafa.as_ref()) + mark);
            }
            if head.starts_with("FLIP") {
                let ratios = row.scores.iter().filter_map(|(_, score)| score.flip_ratio());
                let (sum, count) =
                    ratios.fold((0.0, 0), |(sum, count), ratio| (sum + ratio.ln(), count + 1));
                let _ = write!(text, "mean {:.3}", (sum / f64::from(count.max(1))).exp());
            }
            let _ = writeln!(text);
        }
    }
    if rows.iter().any(|row| !row.unrest.is_empty()) {
        text += &motion(rows, scenes);
    }
    text
}

/// What a table is of, and the names of its columns.
fn heading(what: &str, scenes: &[&str]) -> String {
    let columns: String = scenes.iter().map(|scene| format!("{scene:18}")).collect();
    format!("\n{what}\n{:24}{columns}", "")
}

/// Ours as a share of chafa's: as seen, and pixel by pixel.
fn motion(rows: &[Row], scenes: &[&str]) -> String {
    let what = "error of changes in motion, ours by chafa's: seen, pixels";
    let mut text = heading(what, scenes);
    for row in rows {
        let _ = write!(text, "\n{:24}", row.name());
        for (_, unrest) in &row.unrest {
            let Unrest { ours, chafa } = unrest;
            let shown = match chafa {
                Some(chafa) => {
                    format!("{:.2} {:.2}", ours.seen / chafa.seen, ours.plain / chafa.plain)
                }
                None => format!("{:.4} {:.4}", ours.seen, ours.plain),
            };
            let _ = write!(text, "{:18}", shown + Reached::mark(row.is_calm(unrest)));
        }
    }
    text + "\n"
}
