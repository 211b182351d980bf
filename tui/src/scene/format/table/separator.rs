//! The fields of a line.

use crate::scene::number::number;
use std::ops::Range;

/// How many bytes at the beginning of a text say that it is a comment; 0 if it is none. numpy and gnuplot write `#`, MATLAB
/// `%`, CloudCompare `//`.
pub(super) fn comment_signs(text: &[u8]) -> usize {
    let is_sign: fn(&u8) -> bool = match text {
        [b'#' | b'%', ..] => |byte: &u8| matches!(byte, b'#' | b'%'),
        [b'/', b'/', ..] => |byte: &u8| *byte == b'/',
        _ => return 0,
    };
    text.iter().take_while(|byte| is_sign(byte)).count()
}

/// Whether a line tells Excel what separates columns: `sep=;`, where white space may have been trimmed away.
pub(in crate::scene::format) fn says_separator(line: &[u8]) -> bool {
    let quoted = line.strip_prefix(b"\"").and_then(|text| text.strip_suffix(b"\""));
    let Some((name, separator)) = quoted.unwrap_or(line).split_at_checked(4) else { return false };
    name.eq_ignore_ascii_case(b"sep=")
        && (separator.is_empty() || matches!(separator, [byte] if !byte.is_ascii_alphanumeric()))
}

/// The number in a field of `line` that a comment follows, behind white space; `None` of any other field. (A label may have such a
/// sign, and so may whatever is in quotes.)
#[cold]
pub(super) fn number_before_comment<'a>(line: &'a [u8], field: &Range<usize>) -> Option<&'a [u8]> {
    let is_quoted = field.start.checked_sub(1).is_some_and(|before| line[before] == b'"');
    if is_quoted {
        return None;
    }
    let field = &line[field.clone()];
    let (value, rest) = field.split_at(field.iter().position(|&byte| byte <= b' ')?);
    (comment_signs(rest.trim_ascii_start()) > 0 && number(value).is_some()).then_some(value)
}

/// What separates columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene::format) enum Separator {
    Byte(u8),
    Space,
}

impl Separator {
    /// The separator that is in a line.
    pub(in crate::scene::format) fn of(line: &[u8]) -> Self {
        let has = |byte: &u8| match byte {
            // One among spaces is a space: positions are three.
            b'\t' => {
                let mut fields = Vec::new();
                Self::Byte(b'\t').split(line, 3, &mut fields);
                fields.len() == 3
            }
            _ => line.contains(byte),
        };
        [b'\t', b',', b';'].into_iter().find(has).map_or(Self::Space, Self::Byte)
    }

    /// The first `most` fields of a line, without quotes and white space around them.
    pub(in crate::scene::format) fn split(
        self,
        line: &[u8],
        most: usize,
        fields: &mut Vec<Range<usize>>,
    ) {
        fields.clear();
        let mut at = 0;
        while fields.len() < most {
            if self == Self::Space {
                while line.get(at).is_some_and(|&byte| byte <= b' ') {
                    at += 1;
                }
                if at >= line.len() {
                    return;
                }
            }
            let start = at;
            let mut quoted = false;
            while let Some(&byte) = line.get(at) {
                quoted ^= byte == b'"';
                let ends = match self {
                    Self::Byte(separator) => byte == separator,
                    Self::Space => byte <= b' ',
                };
                if ends && !quoted {
                    break;
                }
                at += 1;
            }
            fields.push(trimmed(line, start..at));
            if at >= line.len() {
                return;
            }
            at += 1;
        }
    }

    /// Whether a row of these fields, the first `count + 1` at least, has `count` values. A comment may follow them, and, where a
    /// byte separates fields, empty ones. If `some_may_be_missing`, those at the end may.
    #[inline]
    pub(super) fn fits(
        self,
        line: &[u8],
        fields: &[Range<usize>],
        (count, some_may_be_missing): (usize, bool),
    ) -> bool {
        match fields.get(count) {
            Some(surplus) => {
                let last = count.checked_sub(1).and_then(|last| fields.get(last));
                self.is_nothing(&line[surplus.start..])
                    || last.is_some_and(|last| number_before_comment(line, last).is_some())
            }
            None => fields.len() == count || some_may_be_missing,
        }
    }

    #[cold]
    fn is_nothing(self, rest: &[u8]) -> bool {
        let is_empty = |&byte: &u8| byte <= b' ' || byte == b'"' || self == Self::Byte(byte);
        rest.iter().all(is_empty) || comment_signs(rest) > 0
    }
}

fn trimmed(line: &[u8], range: Range<usize>) -> Range<usize> {
    let Range { mut start, mut end } = range;
    while start < end && line[start] <= b' ' {
        start += 1;
    }
    while start < end && line[end - 1] <= b' ' {
        end -= 1;
    }
    if end - start >= 2 && line[start] == b'"' && line[end - 1] == b'"' {
        start + 1..end - 1
    } else {
        start..end
    }
}
