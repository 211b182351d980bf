//! The values of options, each from its text; an error says what there is to choose from.

use super::CharsetChoice;
use crate::color_depth::ColorChoice;
use crate::draw::{AccuracyChoice, Charset, ColorDepth};
use crate::samples::MOST_SAMPLES;
use crate::scene::open::Format;
use crate::structure::{Structure, StructureChoice};
use crate::threads::MOST_THREADS;
use crate::view::LensKind;
use spherule_kernel::dispatch::{Level, LevelName};
use std::num::NonZeroUsize;

/// The largest picture, in columns or rows.
const LARGEST_SIDE: u16 = 4096;
/// The widest and the narrowest cell, width over height.
const ASPECTS: std::ops::RangeInclusive<f32> = 0.05..=20.0;

pub(super) fn accuracy(text: &str) -> Result<AccuracyChoice, &'static str> {
    let named = AccuracyChoice::ALL.into_iter().find(|choice| choice.as_str() == text);
    named.ok_or("fast, stable or exact")
}

pub(super) fn size(text: &str) -> Result<(u16, u16), String> {
    let (columns, rows) = text.split_once(['x', 'X']).ok_or("COLSxROWS, such as 80x24")?;
    let side = |text: &str| match text.parse::<u64>() {
        Ok(side) if (1..=u64::from(LARGEST_SIDE)).contains(&side) => Ok(side as u16),
        _ => Err(format!("COLSxROWS, each 1 to {LARGEST_SIDE}")),
    };
    Ok((side(columns)?, side(rows)?))
}

pub(super) fn charset(text: &str) -> Result<CharsetChoice, &'static str> {
    match text {
        "auto" => Ok(CharsetChoice::Auto),
        "ascii" => Ok(CharsetChoice::Only(Charset::Ascii)),
        "half" => Ok(CharsetChoice::Only(Charset::Half)),
        _ => Err("auto, ascii or half"),
    }
}

pub(super) fn color(text: &str) -> Result<ColorChoice, &'static str> {
    match text {
        "auto" => Ok(ColorChoice::Auto),
        "never" => Ok(ColorChoice::Never),
        "always" => Ok(ColorChoice::Always),
        "16" => Ok(ColorChoice::Depth(ColorDepth::Ansi16)),
        "256" => Ok(ColorChoice::Depth(ColorDepth::Ansi256)),
        "truecolor" => Ok(ColorChoice::Depth(ColorDepth::Truecolor)),
        _ => Err("auto, never, always, 16, 256 or truecolor"),
    }
}

pub(super) fn samples(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(samples) if (1..=MOST_SAMPLES).contains(&samples) => Ok(samples),
        _ => Err(format!("1 to {MOST_SAMPLES}")),
    }
}

pub(super) fn projection(text: &str) -> Result<LensKind, &'static str> {
    match text {
        "perspective" => Ok(LensKind::Perspective),
        "parallel" => Ok(LensKind::Parallel),
        _ => Err("perspective or parallel"),
    }
}

pub(super) fn format(text: &str) -> Result<Format, &'static str> {
    match text {
        "toml" => Ok(Format::Toml),
        "xyz" => Ok(Format::Xyz),
        _ => Err("toml or xyz"),
    }
}

pub(super) fn aspect(text: &str) -> Result<f32, &'static str> {
    let ratio = || {
        let (width, height) = text.split_once(':')?;
        Some(width.parse::<f32>().ok()? / height.parse::<f32>().ok()?)
    };
    ratio().filter(|ratio| ASPECTS.contains(ratio)).ok_or("W:H, such as 1:2; from 1:20 to 20:1")
}

pub(super) fn structure(text: &str) -> Result<StructureChoice, &'static str> {
    let named = Structure::ALL.into_iter().find(|structure| structure.as_str() == text);
    match named {
        Some(structure) => Ok(StructureChoice::Only(structure)),
        None if text == "auto" => Ok(StructureChoice::Auto),
        None => Err("auto, brute, tiles or bvh"),
    }
}

pub(super) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let count = text.parse::<NonZeroUsize>().ok().filter(|count| count.get() <= MOST_THREADS);
    count.ok_or_else(|| format!("1 to {MOST_THREADS}"))
}

pub(super) fn level(text: &str) -> Result<Level, String> {
    let name = LevelName::ALL.into_iter().find(|name| name.as_str() == text);
    let name = name.ok_or("baseline, avx2 or avx512")?;
    Level::named(name).ok_or_else(|| format!("this CPU has no {text}"))
}

pub(super) fn repeat(text: &str) -> Result<u32, &'static str> {
    text.parse().ok().filter(|&repeat| repeat >= 1).ok_or("1 or more")
}
