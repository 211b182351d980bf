//! Cases kept in the project with the oracle's answers: `tests/cases/regimes.txt`.
//!
//! One case a line: the regime's number, the bits of the twelve numbers of a [`Case`], and the bits
//! of the hit's t, or `miss`, in hexadecimal. Lines that start with `#` say where the cases come
//! from. A reader needs neither our generator nor our oracle, so a change of either is noticed.

use crate::oracle;
use spherule_referee::case::Case;
use spherule_referee::families::HARD;
use std::fmt::Write;
use std::path::PathBuf;

/// How many cases of each regime are kept.
pub const CASES_A_REGIME: u64 = 30;

/// A case with its answer.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// Which of the [`HARD`].
    pub regime: usize,
    /// Ray and sphere.
    pub case: Case,
    /// The t of the hit.
    pub expected: Option<f32>,
}

/// The path of the file.
#[must_use]
pub fn path() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "cases", "regimes.txt"].iter().collect()
}

/// The text of the file in the project.
///
/// # Panics
/// If it cannot be read.
#[must_use]
pub fn read() -> String {
    std::fs::read_to_string(path()).expect("tests/cases/regimes.txt")
}

/// The text that generator and oracle would write.
#[must_use]
pub fn write() -> String {
    let mut text = String::from(
        "# Cases of the 22 hard families: the generator of tests/referee/src/families.rs, answered by the\n\
         # integer oracle of tests/src/oracle.rs. Made again by:\n\
         #   cargo test -p spherule-tests -- --ignored keep_cases\n\
         # A line: regime; origin x y z, direction x y z, t_min, t_max, centre x y z, radius; t\n\
         # of the hit or miss. Numbers are the bits of single-precision floats, hexadecimal.\n",
    );
    for regime in HARD {
        let _ = writeln!(text, "# {} {}", regime.number, regime.name);
        for case in regime.cases(CASES_A_REGIME) {
            let _ = write!(text, "{}", regime.number);
            for bits in case.bits() {
                let _ = write!(text, " {bits:08x}");
            }
            let _ = match oracle::intersect(&case.ray, &case.sphere) {
                Some(t) => writeln!(text, " {:08x}", t.to_bits()),
                None => writeln!(text, " miss"),
            };
        }
    }
    text
}

/// The cases of such a text.
///
/// # Panics
/// With the number of the line, if one is not as documented.
#[must_use]
pub fn parse(text: &str) -> Vec<Kept> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
    let parsed = lines.map(|(index, line)| {
        parse_line(line).unwrap_or_else(|| panic!("line {}: no case: {line}", index + 1))
    });
    parsed.collect()
}

fn parse_line(line: &str) -> Option<Kept> {
    let words: Vec<&str> = line.split(' ').collect();
    let [regime, numbers @ .., expected] = words.as_slice() else { return None };
    let float = |word: &&str| u32::from_str_radix(word, 16).ok().map(f32::from_bits);
    let numbers = numbers.iter().map(float).collect::<Option<Vec<f32>>>()?;
    Some(Kept {
        regime: regime.parse().ok()?,
        case: Case::from_numbers(numbers.try_into().ok()?),
        expected: match *expected {
            "miss" => None,
            word => Some(float(&word)?),
        },
    })
}
