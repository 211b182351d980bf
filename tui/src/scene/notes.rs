//! What a reader of a file should know besides its picture, each once: what is ignored, what is not known.

use super::read_error::ReadError;
use crate::harmless::{cut, line};
use std::borrow::Cow;
use std::io::{self, Write};

/// The most names in a note.
const MOST_NAMES: usize = 6;

/// The most characters of a name in a note.
const LONGEST_NAME: usize = 40;

/// What there is to say about a file, and what has been said.
#[derive(Debug, Default)]
pub(super) struct Notes {
    strict: bool,
    texts: Vec<Cow<'static, str>>,
    said: usize,
    /// Records that are ignored, and how many of them have been said.
    ignored: (Vec<&'static str>, usize),
    unknown_said: bool,
}

impl Notes {
    /// Nothing yet; `strict`: an unknown type of particle is an error.
    #[must_use]
    pub(super) fn new(strict: bool) -> Self {
        Self { strict, ..Self::default() }
    }

    /// Notes something, once.
    pub(super) fn note(&mut self, text: impl Into<Cow<'static, str>>) {
        let text = text.into();
        if !self.texts.contains(&text) {
            self.texts.push(text);
        }
    }

    /// Notes that so many columns are not kept, if there are any.
    pub(super) fn further_columns(&mut self, count: usize) {
        match count {
            0 => {}
            1 => self.note("1 further column is ignored"),
            _ => self.note(format!("{count} further columns are ignored")),
        }
    }

    /// Notes that columns of these names are ignored, if there are any.
    pub(super) fn ignored_columns(&mut self, names: &[&str]) {
        match names {
            [] => {}
            [name] => {
                self.note(format!("the column {:?} is ignored", cut(name, LONGEST_NAME)));
            }
            _ => self.note(format!("{} columns are ignored ({})", names.len(), listed(names))),
        }
    }

    /// Notes that a kind of record is ignored, once.
    pub(super) fn ignore(&mut self, record: &'static str) {
        if !self.ignored.0.contains(&record) {
            self.ignored.0.push(record);
        }
    }

    /// Notes how many particles are of unknown types: the `names`, the first of them in `line`. Only the first such
    /// frame of a file is noted.
    ///
    /// # Errors
    /// [`ReadError`] where unknown types are not allowed.
    pub(super) fn unknown(
        &mut self,
        source: &str,
        line: usize,
        count: usize,
        names: &[&str],
    ) -> Result<(), ReadError> {
        if self.strict {
            let name = cut(names[0], LONGEST_NAME);
            let what = format!("{name:?} is not an element; without --strict it is drawn grey");
            return Err(ReadError::at(source, line, 1, what));
        }
        if self.unknown_said {
            return Ok(());
        }
        self.unknown_said = true;
        let list = listed(names);
        let (particles, are) = if count == 1 { ("particle", "is") } else { ("particles", "are") };
        let types = if names.len() == 1 {
            "an unknown type".to_owned()
        } else {
            format!("{} unknown types", names.len())
        };
        self.note(format!("{count} {particles} {are} of {types} ({list}): drawn grey"));
        Ok(())
    }

    /// What has been noted since the last call.
    pub(super) fn take(&mut self) -> Vec<Cow<'static, str>> {
        let (records, said) = &mut self.ignored;
        if records.len() > *said {
            let text = format!("ignored: {}", records[*said..].join(", "));
            *said = records.len();
            self.texts.push(text.into());
        }
        let new = self.texts[self.said..].to_vec();
        self.said = self.texts.len();
        new
    }

    /// Writes what has been noted since the last call to standard error, a line each.
    pub(super) fn report(&mut self, source: &str) {
        for text in self.take() {
            say(source, &text);
        }
    }
}

/// Writes what there is to say of a file to standard error, in one line.
pub(crate) fn say(source: &str, text: &str) {
    // If it cannot be said, the picture still comes.
    let _ = writeln!(io::stderr(), "spherule: {}", line(&format!("{source}: {text}")));
}

/// The first of `names`, with commas; of long ones their ends.
pub(super) fn listed(names: &[&str]) -> String {
    let first: Vec<_> = names.iter().take(MOST_NAMES).map(|name| cut(name, LONGEST_NAME)).collect();
    let list = first.join(", ");
    if names.len() > MOST_NAMES { list + ", ..." } else { list }
}
