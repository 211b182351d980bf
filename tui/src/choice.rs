//! Values on the command line: those that have names, and sizes.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// The largest picture, in columns or rows.
const LARGEST_SIDE: u16 = 4096;

/// A value that the program chooses itself if it is `None`: `auto` on the command line.
///
/// Arguments do not spell it `Option`, which clap takes for an option that may be missing.
pub type Auto<T> = Option<T>;

/// Reads `auto`, or the name of a value; `help` says what `auto` chooses.
pub fn auto_or<T>(help: &'static str) -> impl TypedValueParser<Value = Auto<T>>
where
    T: ValueEnum + Send + Sync + 'static,
{
    let names = T::value_variants().iter().filter_map(T::to_possible_value);
    let auto = PossibleValue::new("auto").help(help);
    PossibleValuesParser::new([auto].into_iter().chain(names))
        .map(|text| T::from_str(&text, false).ok())
}

/// The name of a value.
#[must_use]
pub fn name(value: &impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The choice after `this`, around in a circle: `None`, then every value.
#[must_use]
pub fn next<T: ValueEnum + Copy + PartialEq>(this: Auto<T>) -> Auto<T> {
    let mut after = T::value_variants().iter();
    if this.is_some() {
        after.find(|&&value| this == Some(value));
    }
    after.next().copied()
}

/// Reads columns and rows of a picture: `COLSxROWS`.
///
/// # Errors
/// Says what would be right.
pub fn size(text: &str) -> Result<(u16, u16), String> {
    let (columns, rows) = text.split_once(['x', 'X']).ok_or("COLSxROWS, such as 80x24")?;
    let side = |text: &str| {
        let side = text.parse().ok().filter(|side| (1..=LARGEST_SIDE).contains(side));
        side.ok_or_else(|| format!("COLSxROWS, each 1 to {LARGEST_SIDE}"))
    };
    Ok((side(columns)?, side(rows)?))
}
