//! Headers of numbers: pandas calls columns without names `0`, `1`, ..., and an index nothing.

use super::first_line::FirstLine;
use super::separator::{Separator, comment_signs};
use crate::scene::input::Input;
use crate::scene::number::{number, parsed};
use crate::scene::read_error::ReadError;

/// Whether these are the names of three such columns or more.
pub(super) fn is_numbered(names: &[&[u8]]) -> bool {
    let names = if let [b"", columns @ ..] = names { columns } else { names };
    let is_its_number = |(index, name): (usize, &&[u8])| *name == index.to_string().as_bytes();
    names.len() >= 3 && names.iter().enumerate().all(is_its_number)
}

/// Whether the row below `first`, the line that was read last, has as many values, of which one is no whole number.
///
/// Then `first` is a header: a sphere may be at (0, 1, 2), but programs write the numbers of a column alike, so that
/// it would be at `0.0,1.0,2.0`. Above whole numbers, or nothing, it stays a sphere.
pub(super) fn has_fractions_below(input: &mut Input, first: &FirstLine) -> Result<bool, ReadError> {
    if first.separator == Separator::Space {
        return Ok(false);
    }
    input.give_back();
    let head = input.head(|head| {
        // The last line may go on.
        memchr::memrchr(b'\n', head).is_some_and(|end| second_row(&head[..end]).is_some())
    });
    let has_fractions = second_row(head).is_some_and(|row| {
        let (count, mut fields) = (first.names().len(), Vec::new());
        first.separator.split(row, count + 1, &mut fields);
        let is_fraction = |value: &[u8]| number(value).is_some() && parsed::<i64>(value).is_none();
        fields.len() == count && fields.into_iter().any(|field| is_fraction(&row[field]))
    });
    input.line()?;
    Ok(has_fractions)
}

/// The first line after another that is neither blank nor a comment.
fn second_row(head: &[u8]) -> Option<&[u8]> {
    let is_row = |line: &&[u8]| !line.is_empty() && comment_signs(line) == 0;
    head.split(|&byte| byte == b'\n').skip(1).map(<[u8]>::trim_ascii).find(is_row)
}
