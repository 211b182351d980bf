//! From bytes to the frames of a file, whose format its content tells.

use super::Scene;
use super::file_name::FileName;
use super::format::recognise::{UNKNOWN, recognise, settled};
use super::format::{Context, Format};
use super::frames::Frames;
use super::input::Input;
use super::notes::Notes;
use super::read_error::ReadError;
use crate::choice;
use clap::{Args, ValueEnum};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// What is asked of a file besides its name.
#[derive(Args, Clone, Debug, Default)]
pub struct Reading {
    /// Format of the scene [default: by content; .gz and .bz2 are unpacked]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<Format>,
    /// Columns of a table for x, y, z and perhaps the radius: names, or numbers from 1
    #[arg(long, value_name = "X,Y,Z[,R]")]
    pub columns: Option<String>,
    /// Refuse particles of unknown types, which are drawn grey otherwise
    #[arg(long)]
    pub strict: bool,
    /// The file that says what the particles of an .xtc are
    #[arg(long, value_name = "FILE")]
    pub topology: Option<FileName>,
    /// Wait for frames that are still being written
    #[arg(long)]
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
    first(&mut frames(Input::of_reader(reader, source)?, &reading)?)
}

/// The first frame, which there must be.
pub(super) fn first(frames: &mut Frames) -> Result<Scene, ReadError> {
    frames.read(0)?.ok_or_else(|| ReadError::whole(frames.source(), "no particles"))
}

pub(super) fn frames(mut input: Input, reading: &Reading) -> Result<Frames, ReadError> {
    let format = match reading.format {
        Some(format) => format,
        None => format_of(&mut input, reading.follow)?,
    };
    let topology = match &reading.topology {
        None => None,
        Some(name) if format != Format::Xtc => {
            let why = "this file says itself what its particles are";
            let what = format!("--topology {name} applies to .xtc files only; {why}");
            return Err(ReadError::whole(input.source(), what));
        }
        Some(name) => Some(Arc::new(topology(name, reading.strict)?)),
    };
    let columns = reading.columns.clone();
    if columns.is_some() && format != Format::Csv {
        let what = "--columns applies to tables only; this file is not a table";
        return Err(ReadError::whole(input.source(), what));
    }
    let notes = Notes::new(reading.strict);
    let context = Context { columns, topology, notes, ..Context::default() };
    Ok(Frames::new(input, format, context, reading.follow))
}

/// The file called `name`, as what the particles of a trajectory are.
fn topology(name: &FileName, strict: bool) -> Result<Scene, ReadError> {
    let file = File::open(name.path()).map_err(ReadError::io(name))?;
    let mut frames = frames(input_of(file, name)?, &Reading { strict, ..Reading::default() })?;
    let scene = first(&mut frames)?;
    frames.report();
    Ok(scene)
}

/// The format that the content tells; if it is unknown, or still to come, that which the name ends in.
fn format_of(input: &mut Input, follow: bool) -> Result<Format, ReadError> {
    let source = input.source().to_owned();
    let is_awaited = follow && input.can_be_read_again();
    let wrong = |what: &str| ReadError::whole(&source, what);
    let head = input.head(|head| settled(head).is_some());
    let (recognised, is_empty) = (recognise(head), head.is_empty());
    let what = match recognised {
        Ok(Format::Pdb)
            if extension(&source)
                .is_some_and(|extension| extension.eq_ignore_ascii_case("pqr")) =>
        {
            let what = "PQR, which is not read; --format pdb reads what has the columns of PDB";
            return Err(wrong(what));
        }
        Ok(format) => return Ok(format),
        Err(what) => what,
    };
    if what == UNKNOWN
        && (is_awaited || !is_empty)
        && let Some(format) = ending(&source)
    {
        return Ok(format);
    }
    // Where reading failed, the content is not all that there is.
    input.check()?;
    Err(match (is_empty, is_awaited) {
        (true, true) => wrong("the file is empty; --format says what it will be"),
        (true, false) => wrong("the file is empty"),
        (false, _) if what == UNKNOWN => wrong(&unknown()),
        (false, _) => wrong(what),
    })
}

/// The message that the format is not known, and which formats are.
fn unknown() -> String {
    let names: Vec<_> = Format::value_variants().iter().map(choice::name).collect();
    format!("{UNKNOWN}; --format names one of {}", names.join(", "))
}

/// The format that the name ends in.
fn ending(name: &str) -> Option<Format> {
    Format::from_str(extension(name)?, true).ok()
}

/// The extension of a file, without that of its compression.
fn extension(name: &str) -> Option<&str> {
    let name = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".bz2")).unwrap_or(name);
    Path::new(name).extension()?.to_str()
}

/// The bytes of a file that is called `name`.
pub(super) fn input_of(file: File, name: &FileName) -> Result<Input, ReadError> {
    let metadata = file.metadata().map_err(ReadError::io(name))?;
    if metadata.is_dir() {
        return Err(ReadError::whole(name, "is a directory"));
    }
    if metadata.is_file() {
        Input::of_file(file, name.path().to_owned(), name)
    } else {
        Input::of_reader(Box::new(file), name)
    }
}
