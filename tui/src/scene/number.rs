//! Numbers in text, fast: most have few digits, and are exact by one division.

use std::str::FromStr;

/// The number that `word` is, as the standard library reads it: the nearest `f64`. `None` if it is none. An exponent may
/// also follow a `D`, as Fortran writes double precision.
///
/// Where the digits make an integer below 2^53 and the power of ten is at most 22, both are exact in `f64`, and so one
/// rounding makes the nearest (W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990). All else
/// goes to the standard library.
#[inline]
pub(super) fn number(word: &[u8]) -> Option<f64> {
    match leading(word) {
        Some((value, length)) if length == word.len() => Some(value),
        _ => slowly(word),
    }
}

/// As [`number`], in single precision; NaN if it is none.
#[inline]
pub(super) fn number_or_nan(word: &[u8]) -> f32 {
    number(word).map_or(f32::NAN, |value| value as f32)
}

/// What the standard library reads `word` as; `None` if it is no such thing.
pub(super) fn parsed<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The number with which `text` begins, up to white space or the end, and its length in bytes, if one division gives it
/// exactly. `None` if there is no number, or it takes longer.
///
/// It works in one pass: looking for the end first, and then for digits, made reading an XYZ take a seventh more time.
#[inline]
pub(super) fn leading(text: &[u8]) -> Option<(f64, usize)> {
    let is_negative = text.first() == Some(&b'-');
    let start = usize::from(matches!(text.first(), Some(b'-' | b'+')));
    let mut mantissa = 0_u64;
    let mut digits = |from: usize| {
        let mut at = from;
        while let Some(byte) = text.get(at)
            && byte.is_ascii_digit()
        {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            at += 1;
        }
        at
    };
    let mut end = digits(start);
    let (mut count, mut after) = (end - start, 0);
    if text.get(end) == Some(&b'.') {
        let first = end + 1;
        end = digits(first);
        after = end - first;
        count += after;
    }
    let is_over = text.get(end).is_none_or(|&byte| byte <= b' ');
    if !is_over || count == 0 || count > 18 || mantissa > 1 << 53 || after >= POWERS.len() {
        return None;
    }
    let value = mantissa as f64 / POWERS[after];
    Some((if is_negative { -value } else { value }, end))
}

#[cold]
fn slowly(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| {
        let is_power = |exponent: &str| exponent.parse::<i32>().is_ok();
        let (mantissa, exponent) = text.split_once(['D', 'd'])?;
        if is_power(exponent) { format!("{mantissa}e{exponent}").parse().ok() } else { None }
    })
}

const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_no_number() {
        for word in [
            "", "-", ".", "+-1", "1-", "1.2.3", "0x1", "1e", "1_0", "--1", " 1", "\u{ff11}", "1D",
            "D1", "1e1D1", "1D1D1", "1D1.5", "infD1", "nand1",
        ] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
    }

    #[test]
    fn exponents_as_fortran_writes_them() {
        for (word, value) in [("0.1D+01", 1.0), ("-2.5d-3", -0.0025), (".5D2", 50.0), ("1D0", 1.0)]
        {
            assert_eq!(number(word.as_bytes()), Some(value), "{word}");
        }
    }

    proptest! {
        #[test]
        fn the_nearest_as_the_standard_library_reads_it(word in r"[-+]?[0-9]{0,21}(\.[0-9]{0,25})?([eE][-+]?[0-9]{1,3})?") {
            let expected = word.parse::<f64>().ok();
            prop_assert_eq!(number(word.as_bytes()).map(f64::to_bits), expected.map(f64::to_bits));
        }
    }
}
