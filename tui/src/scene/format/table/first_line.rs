//! The first line of a table: the names of columns, in a comment or not, or the first row.

use super::separator::{Separator, comment_signs, number_before_comment};
use crate::scene::input::Line;
use std::ops::Range;

/// What a comment says behind its sign; `None` of a line that is none. A first word that ends in `:` tells what follows, as
/// in `# columns: x y z`, and is left out.
pub(in crate::scene::format) fn comment(line: &[u8]) -> Option<&[u8]> {
    let text = line.trim_ascii();
    let signs = comment_signs(text);
    if signs == 0 {
        return None;
    }
    let text = text[signs..].trim_ascii_start();
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    Some(if word.ends_with(b":") { rest.trim_ascii_start() } else { text })
}

/// The names that a comment of Yade's has: `#format x_y_z_r`.
fn names_of_format(comment: &[u8]) -> Option<&[u8]> {
    let names = comment.strip_prefix(b"format ")?.trim_ascii();
    (!names.iter().any(u8::is_ascii_whitespace)).then_some(names)
}

/// How many names a comment has at most: several are kept, and most are sentences.
const MOST_NAMES: usize = 1 << 20;

/// The first line, kept while the next is read.
#[derive(Debug)]
pub(super) struct FirstLine {
    text: Vec<u8>,
    fields: Vec<Range<usize>>,
    pub(super) separator: Separator,
    pub(super) is_comment: bool,
    /// Whether it is one behind `//`.
    pub(super) has_slashes: bool,
    /// Whether rows may lack values at their end: where they are separated by the byte that separates the names. (A comment, or names
    /// between spaces above values between commas, may be a sentence that has nothing to do with the columns.)
    pub(super) some_may_be_missing: bool,
    /// Which line it is, from 1.
    pub(super) number: usize,
}

impl FirstLine {
    pub(super) fn of(line: &Line<'_>) -> Self {
        let comment = comment(line.bytes);
        let is_comment = comment.is_some();
        let has_slashes = line.trimmed().starts_with(b"//");
        let joined = comment.and_then(names_of_format);
        let text = joined.or(comment).unwrap_or(line.bytes).to_vec();
        let separator = joined.map_or_else(|| Separator::of(&text), |_| Separator::Byte(b'_'));
        let mut fields = Vec::new();
        let most = if is_comment { MOST_NAMES } else { usize::MAX };
        separator.split(&text, most, &mut fields);
        let some_may_be_missing = !is_comment && separator != Separator::Space;
        let number = line.number;
        Self { text, fields, separator, is_comment, has_slashes, some_may_be_missing, number }
    }

    /// Its fields, which are names if it is a header.
    pub(super) fn names(&self) -> Vec<&[u8]> {
        self.fields.iter().map(|field| &self.text[field.clone()]).collect()
    }

    /// Leaves out the comment behind the values of a row.
    pub(super) fn end_at_comment(&mut self) {
        let end = self.fields.iter().enumerate().find_map(|(index, field)| {
            let text = &self.text[field.clone()];
            let has_value = number_before_comment(&self.text, field).is_some();
            (has_value || comment_signs(text) > 0).then_some(index + usize::from(has_value))
        });
        self.fields.truncate(end.unwrap_or(self.fields.len()));
    }

    /// Leaves out what is empty behind the values of a row: it may end in separators.
    pub(super) fn end_at_value(&mut self) {
        let end = self.fields.iter().rposition(|field| !field.is_empty());
        self.fields.truncate(end.map_or(0, |last| last + 1));
    }

    /// Makes the names of a header those of the fields of `row`, the first below it; `false` if it is not known how.
    pub(super) fn fit(&mut self, row: &Line<'_>) -> bool {
        let (count, mut fields) = (self.fields.len(), Vec::new());
        self.separator.split(row.bytes, usize::MAX, &mut fields);
        // Positions are three: names between commas may stand above values between spaces. And tabs, which are spaces too, may have
        // nothing between them.
        let other = Separator::of(row.bytes);
        if fields.len() < 3 || self.separator == Separator::Space && fields.len() < count {
            self.some_may_be_missing &= other == self.separator;
            self.separator = other;
            other.split(row.bytes, usize::MAX, &mut fields);
        }
        let (separator, some_may_be_missing) = (self.separator, self.some_may_be_missing);
        let fits = |count: usize| separator.fits(row.bytes, &fields, (count, some_may_be_missing));
        if fits(count) {
            return true;
        }
        if separator == Separator::Space {
            let with_units = self.with_units();
            if fits(with_units.len()) {
                self.fields = with_units;
                return true;
            }
        }
        // R's write.table names rows, but not the column of these names, and quotes the names of both.
        let is_quoted = |text: &[u8]| text.trim_ascii_start().starts_with(b"\"");
        let has_row_names = is_quoted(&self.text) && is_quoted(row.bytes) && fits(count + 1);
        if has_row_names {
            self.fields.insert(0, 0..0);
        }
        has_row_names
    }

    /// The fields, each with what follows it in brackets: `x [km]` is one name.
    fn with_units(&self) -> Vec<Range<usize>> {
        let mut names: Vec<Range<usize>> = Vec::new();
        let mut open = 0_usize;
        for field in &self.fields {
            let text = &self.text[field.clone()];
            let is_unit = open > 0 || matches!(text.first(), Some(b'(' | b'['));
            match names.last_mut() {
                Some(name) if is_unit => name.end = field.end,
                _ => names.push(field.clone()),
            }
            for byte in text {
                match byte {
                    b'(' | b'[' => open += 1,
                    b')' | b']' => open = open.saturating_sub(1),
                    _ => {}
                }
            }
        }
        names
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::input::Input;
    use std::io::Cursor;

    #[test]
    fn a_comment_has_a_million_names_at_most() {
        let names = |sign: &str| {
            let text = format!("{sign}x y z{}\n", " c".repeat(MOST_NAMES));
            let mut input = Input::of_reader(Box::new(Cursor::new(text)), "f").expect("an input");
            let line = input.line().expect("no error").expect("a line");
            FirstLine::of(&line).names().len()
        };
        assert_eq!(names("# "), MOST_NAMES);
        assert_eq!(names(""), MOST_NAMES + 3);
    }
}
