//! From bytes to the frames of a file, whose format its content tells.

use super::Scene;
use super::format::recognise::{UNKNOWN, recognise};
use super::format::{Context, Format};
use super::frames::Frames;
use super::input::Input;
use super::notes::Notes;
use super::read_error::ReadError;
use crate::choice;
use crate::error::cause;
use clap::ValueEnum;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// What is asked of a file besides its name.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The format, whatever the file looks like.
    pub format: Option<Format>,
    /// The columns of a table, with commas.
    pub columns: Option<String>,
    /// The file that says what the particles of a trajectory are.
    pub topology: Option<String>,
    /// Whether particles of unknown types are an error.
    pub strict: bool,
    /// Whether more may be written to the file.
    pub follow: bool,
}

/// Reads the first frame of `reader`.
///
/// # Errors
/// [`ReadError`] if it is no valid frame.
pub fn read(
    reader: Box<dyn Read + Send>,
    source: &str,
    format: Option<Format>,
) -> Result<Scene, ReadError> {
    let reading = Reading { format, ..Reading::default() };
    first(frames(Input::of_reader(reader, source)?, &reading)?)
}

pub(super) fn first(mut frames: Frames) -> Result<Scene, ReadError> {
    let source = frames.source().to_owned();
    frames.read(0)?.ok_or_else(|| ReadError::whole(&source, "no particles"))
}

pub(super) fn frames(mut input: Input, reading: &Reading) -> Result<Frames, ReadError> {
    let format = match reading.format {
        Some(format) => format,
        None => format_of(&mut input)?,
    };
    let topology = match &reading.topology {
        None => None,
        Some(name) if format != Format::Xtc => {
            let what = format!(
                "--topology {name}: for .xtc; this file says itself what its particles are"
            );
            return Err(ReadError::whole(input.source(), what));
        }
        Some(name) => {
            let file = File::open(name).map_err(|error| ReadError::whole(name, cause(&error)))?;
            Some(Arc::new(first(frames(input_of(file, name)?, &Reading::default())?)?))
        }
    };
    let columns = reading.columns.clone();
    if columns.is_some() && format != Format::Csv {
        return Err(ReadError::whole(input.source(), "--columns: for tables; this file is none"));
    }
    let notes = Notes::new(reading.strict);
    let context = Context { columns, topology, notes, ..Context::default() };
    Ok(Frames::new(input, format, context, reading.follow))
}

/// The format that the content tells, or else the name.
fn format_of(input: &mut Input) -> Result<Format, ReadError> {
    let source = input.source().to_owned();
    let head = input.head()?;
    if head.is_empty() {
        return Err(ReadError::whole(&source, "the file is empty"));
    }
    recognise(head).or_else(|what| {
        ending(&source).ok_or_else(|| {
            let what = if what == UNKNOWN { unknown() } else { what.to_owned() };
            ReadError::whole(&source, what)
        })
    })
}

/// The message that the format is not known, and which formats are.
fn unknown() -> String {
    let names: Vec<_> = Format::value_variants().iter().map(choice::name).collect();
    format!("{UNKNOWN}; --format names one of {}", names.join(", "))
}

/// The format that the name ends in.
fn ending(name: &str) -> Option<Format> {
    let name = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".bz2")).unwrap_or(name);
    let ending = Path::new(name).extension()?.to_str()?;
    Format::from_str(ending, true).ok()
}

/// The bytes of a file that is called `name`.
pub(super) fn input_of(file: File, name: &str) -> Result<Input, ReadError> {
    let metadata = file.metadata().map_err(|error| ReadError::whole(name, cause(&error)))?;
    if metadata.is_dir() {
        return Err(ReadError::whole(name, "is a directory"));
    }
    if metadata.is_file() {
        Input::of_file(file, name.into(), name)
    } else {
        Input::of_reader(Box::new(file), name)
    }
}
