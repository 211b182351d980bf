//! The page.

use super::modes::{Aim, Mode, SCENES, SIZE};
use super::pictures::Scores;
use spherule_tests::art::figures::Figures;
use std::fmt::Write;

/// A line of the table.
pub(crate) struct Row<'a> {
    pub(crate) mode: &'a Mode,
    /// Of each scene.
    pub(crate) scores: Vec<Scores>,
}

/// The page, in Markdown.
pub(crate) fn page(rows: &[Row<'_>], chafa: Option<&str>) -> String {
    let chafa = chafa.unwrap_or("chafa is not installed");
    let mut page = format!(
        "# Pictures\n\n\
         Scenes at {SIZE} cells against the same picture at 8x16 pixels a cell (`--png`). Figures are dB of distance in OKLab \
         after a Gaussian blur of half a cell's width in linear light: as seen from reading distance; higher is better. \
         Without colour, the correlation of lightness stands beside. Default options but charset and colour; a * is below \
         what is to be reached. {chafa}: it draws the same PNG with `--work 9`; in parentheses with its dither, \
         by diffusion, or ordered without colour. Blocks are exact areas, ASCII and dots are GNU Unifont's unless \
         another font is named.\n\n\
         Written by `cargo run --release -p spherule-tests --example art -- --write`.\n\n"
    );
    page += "| mode |";
    for scene in SCENES {
        let _ = write!(page, " {scene} | to reach | chafa |");
    }
    page += "\n|---|";
    page += &"--:|".repeat(3 * SCENES.len());
    page.push('\n');
    for Row { mode, scores } in rows {
        let _ = write!(page, "| {} |", mode.name);
        // Tones are free without colour.
        let mono = mode.to_reach.iter().flatten().any(|aim| aim.correlation.is_some());
        for (scores, aim) in scores.iter().zip(&mode.to_reach) {
            let ours = cell(&scores.ours, mono);
            let mark = if aim.is_some_and(|aim| !reaches(&scores.ours, aim)) { " *" } else { "" };
            let aim = aim.map_or_else(String::new, |aim| match aim.correlation {
                Some(correlation) => format!("{} {correlation}", aim.far),
                None => aim.far.to_string(),
            });
            let chafa = scores.chafa.map_or_else(String::new, |figures| cell(&figures, mono));
            let dithered = scores
                .dithered
                .map_or_else(String::new, |figures| format!(" ({})", cell(&figures, mono)));
            let _ = write!(page, " {ours}{mark} | {aim} | {chafa}{dithered} |");
        }
        page.push('\n');
    }
    page
}

fn cell(figures: &Figures, mono: bool) -> String {
    match mono {
        true => format!("{:.1} {:.2}", figures.far, figures.correlation),
        false => format!("{:.1}", figures.far),
    }
}

fn reaches(figures: &Figures, aim: Aim) -> bool {
    figures.far >= aim.far && aim.correlation.is_none_or(|least| figures.correlation >= least)
}
