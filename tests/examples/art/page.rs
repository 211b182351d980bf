//! The page `docs/benchmarks/art.md`.

use super::modes::{SCENES, SIZE};
use super::motion::{FRAMES, STEP};
use super::row::{Reached, Row};
use spherule_tests::art::figures::Figures;
use std::fmt::Write;

/// The page, in Markdown.
pub(crate) fn page(rows: &[Row], chafa: Option<&str>) -> String {
    let chafa = chafa.unwrap_or("chafa is not installed");
    let (columns, rows_of_cells) = SIZE;
    let mut page = format!(
        "# Pictures\n\n\
         Five scenes at {columns}x{rows_of_cells} cells against the same picture at 8x16 pixels a cell (`--png`), by default \
         options but charset and colour. Two of the scenes are the judge's own, in `tests/cases`: `night` is dark, `confetti` \
         is like noise. {chafa}: it draws the same PNG with `--work 9`, with its dither and without where \
         colours are few (by diffusion; ordered without colour); of each figure the better counts. It has no octants: beside \
         ours stand its sextants. Blocks are exact areas; letters are judged in four fonts; dots are GNU Unifont's. The 16 \
         colours are xterm's.\n\n\
         - *FLIP*: what an eye sees of the difference from reading distance, lower is better: 60 cm from cells 2.2 mm wide, \
         38 pixels a degree, the mean over the picture, by the authors' code (`nv-flip`). *Most* is what is to be reached, as a share of \
         chafa's.\n\
         - *PSNR*, dB, of encoded colours, pixel by pixel; *SSIM* of their luma, in windows of 11 x 11 pixels. In \
         colour SSIM is to be no less than chafa's.\n\
         - *Far*: dB of distance in OKLab from across the room, some four metres: after a Gaussian blur of half a cell's width in linear light. \
         *Least* is what was reached before there was FLIP, less 1, in Unifont; and it is to be above chafa's.\n\n\
         A * is where that is missed. Written by `cargo run --release -p spherule-tests --example art -- --write`; a part of it \
         at a time, `--help` tells.\n"
    );
    for (place, scene) in SCENES.into_iter().enumerate() {
        let _ = write!(
            page,
            "\n## {scene}\n\n\
             | mode | FLIP | chafa | ratio | most | PSNR | chafa | SSIM | chafa | far | chafa | least |\n\
             |---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
        );
        for row in rows {
            page += &line(row, place);
        }
    }
    page += &motion(rows);
    page
}

/// The line of one mode, for the scene at `place`.
fn line(row: &Row, place: usize) -> String {
    let Some((_, score)) = row.scores.iter().find(|(scene, _)| *scene == place) else {
        return String::new();
    };
    let reached = row.reached(place, score);
    let chafa = |digits: usize, figure: fn(&Figures) -> f64| {
        score.chafa.as_ref().map_or_else(String::new, |chafa| format!("{:.digits$}", figure(chafa)))
    };
    let ratio = score.flip_ratio().map_or_else(String::new, |ratio| format!("{ratio:.3}"));
    let least = row.least(place).map_or_else(String::new, |least| format!("{least:.1}"));
    let Figures { flip, psnr, ssim, far, .. } = score.ours;
    format!(
        "| {} | {flip:.4} | {} | {ratio}{} | {} | {psnr:.1} | {} | {ssim:.3}{} | {} | {far:.1}{} | {} | {least} |\n",
        row.name(),
        chafa(4, |figures| figures.flip),
        Reached::mark(reached.flip),
        row.mode.most_flip,
        chafa(1, |figures| figures.psnr),
        Reached::mark(reached.ssim),
        chafa(3, |figures| figures.ssim),
        Reached::mark(reached.far),
        chafa(1, |figures| figures.far),
    )
}

/// The table of motion.
fn motion(rows: &[Row]) -> String {
    let mut text = format!(
        "\n## In motion\n\n\
         An orbit of {STEP} degrees a frame, {FRAMES} frames, as the viewer draws them, one after the other with the same renderer, with \
         time enough; chafa draws the PNG of each. The error of what changes from a frame to the next, against what changes in truth: \
         the root of the mean squared distance in OKLab, in thousandths, ours / chafa's. First as an eye sees it from reading distance, blurred \
         by a thirtieth of a degree; in parentheses pixel by pixel. What is seen is to be no more than chafa's, and in `sextant`, `block` and ASCII \
         0.7 of it; a * is where it is more.\n\n| mode |"
    );
    for scene in SCENES {
        let _ = write!(text, " {scene} |");
    }
    text += "\n|---|";
    text += &"--:|".repeat(SCENES.len());
    text.push('\n');
    for row in rows {
        let _ = write!(text, "| {} |", row.name());
        for (_, unrest) in &row.unrest {
            let _ = write!(text, " {}{} |", unrest, Reached::mark(row.is_calm(unrest)));
        }
        text.push('\n');
    }
    text
}
