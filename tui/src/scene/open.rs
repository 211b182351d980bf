//! From the name of a scene to the scene: built in, a file, or standard input.

use super::frames::Frames;
use super::input::Input;
use super::read_error::ReadError;
use super::reading::{Reading, first, frames, input_of};
use super::{Scene, builtin};
use crate::error::cause;
use std::fs::File;
use std::io;
use std::path::Path;

/// What a name stands for.
#[derive(Debug)]
pub enum Opened {
    /// A built-in scene.
    Builtin(Scene),
    /// A file, or standard input.
    File(Frames),
}

/// Opens what is called `name`: a built-in scene, a file, or for `-` standard input. The content of a file tells its
/// format, unless `reading` names one.
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
    frames(input_of(file, name)?, reading).map(Opened::File)
}

/// The scene called `name`; of a file, its first frame.
///
/// # Errors
/// As [`open`].
pub fn scene(name: &str) -> Result<Scene, ReadError> {
    match open(name, &Reading::default())? {
        Opened::Builtin(scene) => Ok(scene),
        Opened::File(frames) => first(frames),
    }
}

fn is_plain_word(name: &str) -> bool {
    let path = Path::new(name);
    path.extension().is_none() && path.components().count() == 1
}
