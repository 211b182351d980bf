//! From the name of a scene to the scene: built in, a file, or standard input.

use super::format::{Context, recognise};
use super::frames::Frames;
use super::input::Input;
use super::notes::Notes;
use super::read_error::ReadError;
use super::{Format, Scene, builtin};
use crate::error::cause;
use clap::ValueEnum;
use std::fs::File;
use std::io::{self, Read};
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

/// What a name stands for.
#[derive(Debug)]
pub enum Opened {
    /// A built-in scene.
    Builtin(Scene),
    /// A file, or standard input.
    File(Frames),
}

/// Opens what is called `name`: a built-in scene, a file, or for `-` standard input. What a file is, its content tells,
/// unless `reading` does.
///
/// # Errors
/// [`ReadError`] if there is no such scene, or it cannot be read.
pub fn open(name: &str, reading: &Reading) -> Result<Opened, ReadError> {
    if name == "-" {
        return frames(Input::of_reader(Box::new(io::stdin()), "-")?, reading).map(Opened::File);
    }
    if let Some(scene) = builtin::builtin(name) {
        return Ok(Opened::Builtin(scene));
    }
    let file = match File::open(name) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return match builtin::shipped_file(name) {
                Some(scene) => Ok(Opened::Builtin(scene)),
                None if is_plain_word(name) => {
                    Err(ReadError::whole(name, "no such scene, built in or in a file"))
                }
                None => Err(ReadError::whole(name, "no such file")),
            };
        }
        Err(error) => return Err(ReadError::whole(name, cause(&error))),
    };
    let metadata = file.metadata().map_err(|error| ReadError::whole(name, cause(&error)))?;
    if metadata.is_dir() {
        return Err(ReadError::whole(name, "is a directory"));
    }
    let input = if metadata.is_file() {
        Input::of_file(file, name.into(), name)?
    } else {
        Input::of_reader(Box::new(file), name)?
    };
    frames(input, reading).map(Opened::File)
}

/// The scene called `name`: of a file its first frame.
///
/// # Errors
/// As [`open`].
pub fn scene(name: &str) -> Result<Scene, ReadError> {
    match open(name, &Reading::default())? {
        Opened::Builtin(scene) => Ok(scene),
        Opened::File(frames) => first(frames),
    }
}

/// Reads the first frame of `reader`.
///
/// # Errors
/// [`ReadError`] if it is none.
pub fn read(
    reader: Box<dyn Read + Send>,
    source: &str,
    format: Option<Format>,
) -> Result<Scene, ReadError> {
    let reading = Reading { format, ..Reading::default() };
    first(frames(Input::of_reader(reader, source)?, &reading)?)
}

fn first(mut frames: Frames) -> Result<Scene, ReadError> {
    let source = frames.source().to_owned();
    frames.read(0)?.ok_or_else(|| ReadError::whole(&source, "no particles"))
}

fn frames(mut input: Input, reading: &Reading) -> Result<Frames, ReadError> {
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
        Some(name) => Some(Arc::new(scene(name)?)),
    };
    let columns = reading.columns.clone();
    if columns.is_some() && format != Format::Csv {
        return Err(ReadError::whole(input.source(), "--columns: for tables; this file is none"));
    }
    let notes = Notes::new(reading.strict);
    let context = Context { columns, topology, notes, mmcif: None };
    Ok(Frames::new(input, format, context, reading.follow))
}

/// What the content tells, or else the name.
fn format_of(input: &mut Input) -> Result<Format, ReadError> {
    let source = input.source().to_owned();
    let head = input.head()?;
    if head.is_empty() {
        return Err(ReadError::whole(&source, "the file is empty"));
    }
    recognise(head).or_else(|what| {
        let known = || {
            ending(&source).ok_or_else(|| {
                let hint = if what == "of no known format" { "; --format names one" } else { "" };
                ReadError::whole(&source, format!("{what}{hint}"))
            })
        };
        known()
    })
}

fn is_plain_word(name: &str) -> bool {
    let path = Path::new(name);
    path.extension().is_none() && path.components().count() == 1
}

/// The format that the name ends in.
fn ending(name: &str) -> Option<Format> {
    let name = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".bz2")).unwrap_or(name);
    let ending = Path::new(name).extension()?.to_str()?;
    Format::from_str(ending, true).ok()
}
