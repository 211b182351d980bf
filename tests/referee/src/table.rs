//! A judge's counts as a table, and as a picture of where in a family the intersector fails.

use crate::families::FAMILIES;
use crate::judge::{Judge, Score};
use crate::verdict::Kind;
use std::fmt::{self, Write};

/// Shades, by the share of wrong decisions: none, then each more.
const SHADES: [char; 9] = ['.', ':', '-', '=', '+', '*', '#', '%', '@'];

fn rows(judge: &Judge) -> impl Iterator<Item = (&'static str, &Score)> {
    judge.scores().map(|(number, score)| {
        let family = number.and_then(|number| FAMILIES.get(usize::from(number)));
        (family.map_or("of no family", |family| family.name), score)
    })
}

/// One row for each family, and one for all: how many rays were judged under the judge's rules, how many answers were wrong, and, in
/// brackets, how many decisions are wrong under the contract.
///
/// # Errors
/// If `out` cannot be written.
pub fn write_counts(judge: &Judge, out: &mut impl Write) -> fmt::Result {
    write!(out, "{:20} {:>9} {:>9}", "family", "judged", "hits")?;
    for kind in Kind::ALL {
        write!(out, " {:>12}", kind.name())?;
    }
    writeln!(out, " {:>10} {:>10} {:>10} (contract)", "median ulp", "p99.9 ulp", "max ulp")?;
    let total = judge.total();
    for (name, score) in rows(judge).chain([("all", &total)]) {
        let counts = &score.by_rules;
        write!(out, "{name:20} {:>9} {:>9}", counts.judged, counts.hits)?;
        for kind in Kind::ALL {
            write!(out, " {:>12}", counts.of(kind))?;
        }
        for ulp in [counts.ulp.quantile(500), counts.ulp.quantile(999), counts.ulp.max()] {
            let ulp = ulp.map_or_else(|| "-".to_owned(), |ulp| ulp.to_string());
            write!(out, " {ulp:>10}")?;
        }
        writeln!(out, " ({})", score.by_contract.decided_wrong())?;
    }
    let counts = &total.by_rules;
    if counts.unpromised + counts.open > 0 {
        let (none, open) = (counts.unpromised, counts.open);
        writeln!(
            out,
            "not judged: {none} of which nothing is promised, {open} that the rules leave open"
        )?;
    }
    Ok(())
}

/// One row for each family: the share of wrong decisions, from lines through the middle of spheres to lines that nearly touch them. Needs a
/// judge that maps places.
///
/// # Errors
/// If `out` cannot be written.
pub fn write_chart(judge: &Judge, out: &mut impl Write) -> fmt::Result {
    writeln!(
        out,
        "{:20} wrong decisions by |D| / (a r^2): 4^-i in column i, tangents on the right",
        ""
    )?;
    for (name, score) in rows(judge) {
        let cells: String =
            score.places.iter().map(|&[judged, wrong]| shade(judged, wrong)).collect();
        writeln!(out, "{name:20} |{cells}|")?;
    }
    writeln!(
        out,
        "{:20}  blank: no case, {}: none wrong, then more, {}: all",
        "", SHADES[0], SHADES[8]
    )?;
    Ok(())
}

fn shade(judged: u64, wrong: u64) -> char {
    match (judged, wrong) {
        (0, _) => ' ',
        (_, 0) => SHADES[0],
        _ => SHADES[1 + (wrong * 7 / judged) as usize],
    }
}
