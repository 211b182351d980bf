//! The rows of a table of mmCIF, up to its end.

use super::row::Row;
use crate::scene::input::{Input, Line};
use crate::scene::read_error::ReadError;

/// Reads rows of so many values until the table ends, or `add` returns `false`: then the row is the next one again; so is a line that
/// is wrong. Returns whether no row of these may still be on its way.
///
/// # Errors
/// [`ReadError`] of `add`, and if a row has other values.
pub(super) fn read_rows(
    input: &mut Input,
    count: usize,
    mut add: impl FnMut(&Line<'_>, &Row) -> Result<bool, ReadError>,
) -> Result<bool, ReadError> {
    let mut row = Row::default();
    // Where nothing follows yet, a comment is taken for the end of the table: writers end a table with one.
    let mut has_ended = false;
    while let Some(line) = input.line()? {
        let text = line.trimmed();
        if !row.is_begun() && (text.is_empty() || text[0] == b'#') {
            has_ended |= !text.is_empty();
            continue;
        }
        if !row.is_begun() && ends_loop(text) {
            // The next call ends here, too.
            has_ended = true;
            input.give_back();
            break;
        }
        has_ended = false;
        match take(&line, &mut row, count, &mut add) {
            Ok(true) => {}
            Ok(false) => {
                has_ended = true;
                input.give_back();
                break;
            }
            Err(error) => {
                // The line may begin a text, or another block.
                input.give_back();
                return Err(error);
            }
        }
    }
    if row.is_begun() && row.words.len() < count {
        return Err(input.ends(format!(
            "the file ends after {} of {count} values of an atom",
            row.words.len()
        )));
    }
    Ok(has_ended)
}

/// Takes a line of a row, and adds the row when it has all its values; returns `false` if `add` does.
fn take(
    line: &Line<'_>,
    row: &mut Row,
    count: usize,
    add: &mut impl FnMut(&Line<'_>, &Row) -> Result<bool, ReadError>,
) -> Result<bool, ReadError> {
    if line.bytes.starts_with(b";") {
        return Err(line.error(0, "a text of many lines among atoms"));
    }
    row.add(line)?;
    if row.words.len() < count {
        return Ok(true);
    }
    if row.words.len() > count {
        let what = format!("{} values; the table has {count} columns", row.words.len());
        return Err(line.error(0, what));
    }
    let goes_on = add(line, row)?;
    if goes_on {
        row.clear();
    }
    Ok(goes_on)
}

/// Whether a line begins with a word, in any case.
pub(super) fn begins(text: &[u8], word: &[u8]) -> bool {
    text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}

/// Whether a line can no longer be a row of the table.
pub(super) fn ends_loop(text: &[u8]) -> bool {
    let words: [&[u8]; 4] = [b"_", b"loop_", b"data_", b"save_"];
    words.iter().any(|word| begins(text, word))
}
