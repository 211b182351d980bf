//! Which column is what: by a header, by `--columns`, or by their number.

use super::numbered::is_numbered;
use super::separator::number_before_comment;
use crate::counted::counted;
use crate::scene::format::words::excerpt;
use crate::scene::notes::listed;
use crate::scene::number::number;
use std::collections::HashSet;
use std::ops::Range;

/// How many other columns are kept at most: they take memory.
const MOST_KEPT: usize = 8;

/// Which column is what.
#[derive(Debug, Default)]
pub(super) struct Columns {
    pub(super) position: [usize; 3],
    pub(super) radius: Option<usize>,
    /// In place of radii.
    pub(super) diameter: Option<usize>,
    pub(super) color: Option<[usize; 3]>,
    pub(super) kind: Option<usize>,
    /// Whether `kind` is called a type, not an element: then numbers in it are no atomic numbers.
    pub(super) may_number_kinds: bool,
    pub(super) kept: Vec<(usize, Box<str>)>,
    /// How many more there are, which are ignored.
    pub(super) further: usize,
    /// How many fields of a line are looked at.
    pub(super) most: usize,
}

/// Whether a header names positions.
pub(in crate::scene::format) fn has_axes(names: &[&[u8]]) -> bool {
    ["x", "y", "z"].iter().all(|axis| find(names, &[axis]).is_some())
}

/// Whether a first line of these fields is a header: among those that positions are read from, one is no number. Those are
/// the first three, unless `chosen`, the value of `--columns`, says by numbers which; then the others may be labels.
pub(super) fn is_header(names: &[&[u8]], chosen: Option<&str>) -> bool {
    let is_number = |name: &[u8]| {
        number(name).is_some() || number_before_comment(name, &(0..name.len())).is_some()
    };
    match chosen.and_then(numbered) {
        Some(columns) => {
            !columns.iter().all(|&column| names.get(column).is_some_and(|name| is_number(name)))
        }
        None => !names.iter().take(3).all(|name| is_number(name)),
    }
}

/// Whether `--columns` says columns by numbers, so that names do not matter.
pub(super) fn is_by_number(chosen: Option<&str>) -> bool {
    chosen.and_then(numbered).is_some()
}

/// The columns that `--columns` says, if each of its words is a number from 1.
fn numbered(chosen: &str) -> Option<Vec<usize>> {
    let column = |word: &str| word.trim().parse::<usize>().ok()?.checked_sub(1);
    chosen.split(',').map(column).collect()
}

fn find(names: &[&[u8]], wanted: &[&str]) -> Option<usize> {
    let find_by = |wanted: &str, part: fn(&[u8]) -> &[u8]| {
        names.iter().position(|name| part(name).eq_ignore_ascii_case(wanted.as_bytes()))
    };
    wanted.iter().find_map(|wanted| {
        find_by(wanted, |name| name).or_else(|| find_by(wanted, |name| with_unit(name).0))
    })
}

/// The name of a column, and the unit in brackets behind it; an empty unit is none.
fn with_unit(name: &[u8]) -> (&[u8], &[u8]) {
    let at = name.iter().position(|byte| matches!(byte, b'(' | b'[')).unwrap_or(name.len());
    let (name, unit) = name.split_at(at);
    (name.trim_ascii_end(), unit.trim_ascii())
}

impl Columns {
    /// The columns of a table whose first line has these fields, which are names if it is a header. `chosen` is the
    /// value of `--columns`.
    ///
    /// # Errors
    /// What is wrong with that line, if positions are missing, or lengths have two units.
    pub(super) fn new(
        names: &[&[u8]],
        is_header: bool,
        chosen: Option<&str>,
    ) -> Result<Self, String> {
        let mut columns = Self::default();
        let named = |wanted: &[&str]| if is_header { find(names, wanted) } else { None };
        match chosen {
            Some(chosen) => {
                // Where all are numbers, a header's field that looks like one of them is not meant.
                let has_names = is_header && numbered(chosen).is_none();
                let column = |word: &str| column_of(names, has_names, word.trim());
                let numbers: Vec<usize> =
                    chosen.split(',').map(column).collect::<Result<_, _>>()?;
                let (&[x, y, z] | &[x, y, z, _]) = numbers.as_slice() else {
                    let what =
                        "--columns needs three for x, y and z, and perhaps one for the radius";
                    return Err(what.to_owned());
                };
                columns.position = [x, y, z];
                columns.radius = numbers.get(3).copied();
            }
            None if is_header && !is_numbered(names) => {
                let axis = |axis: &str| {
                    let names = ["", "pos_", "p", "coord_"].map(|before| format!("{before}{axis}"));
                    named(&names.each_ref().map(String::as_str))
                };
                let (Some(x), Some(y), Some(z)) = (axis("x"), axis("y"), axis("z")) else {
                    let first = excerpt(&names[..names.len().min(12)].join(&b','));
                    return Err(format!("no columns x, y, z in {first}; --columns names others"));
                };
                columns.position = [x, y, z];
                columns.radius = named(&["radius", "rad"]);
                // Beside g and b, r is red.
                if columns.radius.is_none() && named(&["g", "b"]).is_none() {
                    columns.radius = named(&["r"]);
                }
                let unit = |column: usize| with_unit(names[column]).1;
                let lengths = columns.position.into_iter().chain(columns.radius);
                let mut units = lengths.map(unit).filter(|unit| !unit.is_empty());
                let first = units.next().unwrap_or_default();
                if let Some(other) = units.find(|unit| *unit != first) {
                    let units = format!("{} and in {}", excerpt(first), excerpt(other));
                    let what = "nothing is converted, --columns takes them as they are";
                    return Err(format!("lengths in {units}; {what}"));
                }
                if columns.radius.is_none() {
                    // In another unit it is a number like any other.
                    let is_length = |&column: &usize| {
                        first.is_empty() || unit(column).is_empty() || unit(column) == first
                    };
                    columns.diameter = named(&["diameter"]).filter(is_length);
                }
            }
            None if names.len() < 3 => {
                let columns = counted(names.len() as u64, "column");
                return Err(format!("{columns}; positions need three"));
            }
            None => {
                // Behind an index, which has no name.
                let first = usize::from(is_header && names[0].is_empty());
                columns.position = [first, first + 1, first + 2];
                columns.radius = (names.len() == first + 4).then_some(first + 3);
            }
        }
        let channels = |set: [&str; 3]| {
            let found = set.map(|name| named(&[name]));
            found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
        };
        columns.color = channels(["red", "green", "blue"]).or_else(|| channels(["r", "g", "b"]));
        let (element, kind) = (named(&["element", "symbol", "species"]), named(&["type", "kind"]));
        columns.kind = element.or(kind);
        columns.may_number_kinds = element.is_none();
        // One without a name is called by its number, unless that is the name of another.
        let numbers: HashSet<&[u8]> = names
            .iter()
            .filter(|name| is_header && name.first().is_some_and(u8::is_ascii_digit))
            .flat_map(|name| [*name, with_unit(name).0])
            .collect();
        let has_others_name = |column: usize| {
            names[column].is_empty() && numbers.contains((column + 1).to_string().as_bytes())
        };
        let is_other = |&column: &usize| {
            !columns.must_be_number(column)
                && columns.kind != Some(column)
                && !has_others_name(column)
        };
        let others: Vec<usize> = (0..names.len()).filter(is_other).collect();
        columns.further = others.len().saturating_sub(MOST_KEPT);
        let name_of = |column: usize| -> Box<str> {
            match names[column] {
                name if is_header && !name.is_empty() => String::from_utf8_lossy(name).into(),
                // pandas writes its index without a name.
                _ => (column + 1).to_string().into(),
            }
        };
        let kept = others.into_iter().take(MOST_KEPT).map(|column| (column, name_of(column)));
        columns.kept = kept.collect();
        let kept = columns.kept.iter().map(|(column, _)| *column);
        columns.most = columns.numbers().chain(columns.kind).chain(kept).max().unwrap_or(0) + 1;
        Ok(columns)
    }

    /// The columns in which each row must have a number.
    fn numbers(&self) -> impl Iterator<Item = usize> {
        let sizes = self.radius.into_iter().chain(self.diameter);
        self.position.into_iter().chain(sizes).chain(self.color.into_iter().flatten())
    }

    /// Whether each row must have a number in this column.
    fn must_be_number(&self, column: usize) -> bool {
        self.numbers().any(|number| number == column)
    }

    /// Leaves out a comment behind a number, whatever separates its words: they are no values. (A label may have such a sign.)
    pub(super) fn end_at_comment(&self, line: &[u8], fields: &mut Vec<Range<usize>>) {
        if memchr::memchr3(b'#', b'%', b'/', line).is_none() {
            return;
        }
        let last = fields.iter().enumerate().position(|(column, field)| {
            self.must_be_number(column) && number_before_comment(line, field).is_some()
        });
        if let Some(last) = last {
            fields.truncate(last + 1);
        }
    }
}

fn column_of(names: &[&[u8]], has_names: bool, word: &str) -> Result<usize, String> {
    if has_names && let Some(column) = find(names, &[word]) {
        return Ok(column);
    }
    match word.parse::<usize>() {
        Ok(column) if (1..=names.len()).contains(&column) => Ok(column - 1),
        _ => Err(format!("no column {word:?}; the table has {}", those_of(names, has_names))),
    }
}

/// What a table has instead of a column: the first of its names, or so many columns.
fn those_of(names: &[&[u8]], has_names: bool) -> String {
    if !has_names {
        return counted(names.len() as u64, "column");
    }
    let names: Vec<_> = names.iter().map(|name| String::from_utf8_lossy(name)).collect();
    let names: Vec<&str> =
        names.iter().map(|name| &**name).filter(|name| !name.is_empty()).collect();
    listed(&names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_column_is_told_with_those_that_there_are() {
        let letters = ["", "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"];
        let names: Vec<&[u8]> = letters.map(str::as_bytes).into();
        let error = |count: usize, is_header, chosen| {
            Columns::new(&names[..count], is_header, Some(chosen)).expect_err("no such column")
        };
        assert_eq!(error(4, true, "a,b,z"), "no column \"z\"; the table has a, b, c");
        assert_eq!(error(4, true, "1,2,9"), "no column \"9\"; the table has 4 columns");
        assert_eq!(error(4, false, "a,b,c"), "no column \"a\"; the table has 4 columns");
        assert_eq!(error(1, false, "1,2,3"), "no column \"2\"; the table has 1 column");
        let many = error(13, true, "a,b,z");
        assert!(many.starts_with("no column \"z\"; the table has a, b, c, d, "), "{many}");
        assert!(many.ends_with(", ...") && !many.contains(", l"), "{many}");
    }

    #[test]
    fn a_column_without_a_name_has_its_number() {
        let names: [&[u8]; 5] = [b"", b"x", b"y", b"z", b"r"];
        let columns = Columns::new(&names, true, None).expect("a header");
        let kept: Vec<_> = columns.kept.iter().map(|(column, name)| (*column, &**name)).collect();
        assert_eq!(kept, [(0, "1")]);
        let names: [&[u8]; 5] = [b"", b"x", b"y", b"z", b"1"];
        let columns = Columns::new(&names, true, None).expect("a header");
        let kept: Vec<_> = columns.kept.iter().map(|(column, name)| (*column, &**name)).collect();
        assert_eq!(kept, [(4, "1")]);
    }
}
