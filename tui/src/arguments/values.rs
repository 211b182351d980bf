//! Values of options, read from their words.

use super::overlay::Overlay;
use crate::choice::Auto;
use crate::color::Srgb;
use crate::compare::{self, ALGEBRAIC, Comparison};
use crate::samples::MOST_SAMPLES;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use glam::DVec3;
use spherule_kernel::{Level, LevelName, Tier};
use std::ops::RangeInclusive;

/// The widest and the narrowest cell, width over height.
const ASPECTS: RangeInclusive<f32> = 0.05..=20.0;

/// Column and row of a cell.
pub(super) fn cell(text: &str) -> Result<(u16, u16), &'static str> {
    let cell = || {
        let (column, row) = text.split_once(',')?;
        Some((column.parse().ok()?, row.parse().ok()?))
    };
    cell().ok_or("COL,ROW, counted from 0, such as 40,12")
}

/// `N` numbers that single precision can hold, separated by commas.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Vec<f64> = text.split(',').map(|word| word.parse().ok()).collect::<Option<_>>()?;
    numbers
        .try_into()
        .ok()
        .filter(|numbers: &[f64; N]| numbers.iter().all(|&number| (number as f32).is_finite()))
}

/// A point in the coordinates of the scene's file.
pub(super) fn point(text: &str) -> Result<DVec3, &'static str> {
    numbers(text).map(DVec3::from_array).ok_or("X,Y,Z, such as 0,1.5,-3")
}

/// Two angles in degrees.
pub(super) fn orbit(text: &str) -> Result<[f32; 2], &'static str> {
    numbers(text)
        .map(|angles| angles.map(|angle| angle as f32))
        .ok_or("RIGHT,UP in degrees, such as 30,-10")
}

/// An angle in degrees, which is one in single precision, too.
pub(super) fn field_of_view(text: &str) -> Result<f64, &'static str> {
    let is_angle = |degrees: &f64| *degrees as f32 > 0.0 && (*degrees as f32) < 180.0;
    let degrees = text.parse().ok().filter(is_angle);
    degrees.ok_or("degrees, above 0 and below 180, such as 40")
}

/// What is to be shown.
pub(super) fn overlay(text: &str) -> Result<Overlay, &'static str> {
    let tiers = || Comparison::named(text).map(Overlay::Tiers);
    let table = (text == "table").then_some(Overlay::Table);
    table.or_else(tiers).ok_or("error, table, or split:TIER,TIER such as split:fast,exact")
}

/// Rays a cell.
pub(super) fn samples(text: &str) -> Result<Auto<u32>, String> {
    let number = || text.parse().ok().filter(|number| (1..=MOST_SAMPLES).contains(number));
    match text {
        "auto" => Ok(None),
        _ => number().map(Some).ok_or_else(|| format!("auto, or 1 to {MOST_SAMPLES}")),
    }
}

/// A cell's width over its height.
pub(super) fn aspect(text: &str) -> Result<f32, &'static str> {
    let ratio = || {
        let (width, height) = text.split_once(':')?;
        let side = |text: &str| text.parse::<f32>().ok().filter(|side| *side > 0.0);
        Some(side(width)? / side(height)?)
    };
    ratio().filter(|ratio| ASPECTS.contains(ratio)).ok_or("W:H, such as 1:2; from 1:20 to 20:1")
}

/// Widths of a cell.
pub(super) fn distance(text: &str) -> Result<f32, &'static str> {
    let widths = text.parse().ok().filter(|widths: &f32| widths.is_finite() && *widths >= 0.0);
    widths.ok_or("widths of a cell, 0 or more, such as 273")
}

/// A colour as in scenes, or without the `#`, which begins a comment in a shell.
pub(super) fn color(text: &str) -> Result<Srgb, String> {
    text.parse().or_else(|error| format!("#{text}").parse().map_err(|_: String| error))
}

/// A tier. One has a second name, which lists do not show.
pub(super) fn tier() -> impl TypedValueParser<Value = Tier> {
    let name = |tier: Tier| {
        PossibleValue::new(tier.as_str()).aliases((tier == Tier::Fast).then_some(ALGEBRAIC))
    };
    PossibleValuesParser::new(Tier::ALL.map(name)).try_map(|name| compare::tier(&name))
}

/// A level that this CPU has.
pub(super) fn level() -> impl TypedValueParser<Value = Level> {
    let names = PossibleValuesParser::new(LevelName::ALL.map(LevelName::as_str));
    names.try_map(|name| name.parse::<LevelName>()).try_map(|name| {
        Level::named(name).ok_or_else(|| format!("this CPU has no {}", name.as_str()))
    })
}
