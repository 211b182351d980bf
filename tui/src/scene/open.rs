//! From the name of a scene to the scene: built in, a file, or standard input.

use super::file_name::FileName;
use super::frames::Frames;
use super::input::Input;
use super::read_error::ReadError;
use super::reading::{Reading, first, frames, input_of};
use super::{Scene, builtin};
use crate::choice;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Cursor, IsTerminal, Read};
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
pub fn open(name: impl AsRef<OsStr>, reading: &Reading) -> Result<Opened, ReadError> {
    let name = &FileName::from(name.as_ref().to_owned());
    if *name == "-" {
        let input = standard_input().map_err(ReadError::io("-"))?;
        return frames(Input::of_reader(input, "-")?, reading).map(Opened::File);
    }
    if let Some(scene) = builtin::builtin(name) {
        return built_in(scene, name, reading);
    }
    let file = match File::open(name.path()) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            // The name is there to see.
            if name.path().is_symlink() {
                return Err(ReadError::whole(name, "the symbolic link points to no file"));
            }
            return match builtin::shipped_file(name) {
                Some(scene) => built_in(scene, name, reading),
                None if is_plain_word(name) => {
                    Err(ReadError::whole(name, "no built-in scene and no file has this name"))
                }
                None => Err(ReadError::whole(name, "no such file")),
            };
        }
        Err(error) => return Err(ReadError::io(name)(error)),
    };
    frames(input_of(file, name)?, reading).map(Opened::File)
}

/// Standard input. A terminal is read to its end at once: what is typed later are keys of the viewer.
fn standard_input() -> io::Result<Box<dyn Read + Send>> {
    let mut input = io::stdin();
    if !input.is_terminal() {
        return Ok(Box::new(input));
    }
    let mut typed = Vec::new();
    input.read_to_end(&mut typed)?;
    Ok(Box::new(Cursor::new(typed)))
}

/// A built-in scene, which no file tells how it is read.
fn built_in(scene: Scene, name: &str, reading: &Reading) -> Result<Opened, ReadError> {
    let what = match reading {
        Reading { topology: Some(file), .. } => {
            format!("--topology {file} applies to .xtc files only")
        }
        Reading { columns: Some(columns), .. } => {
            format!("--columns {columns} applies to tables only")
        }
        Reading { format: Some(format), .. } => {
            format!("--format {} applies to files only", choice::name(format))
        }
        Reading { strict: true, .. } => "--strict applies to files only".to_owned(),
        Reading { follow: true, .. } => "--follow applies to files only".to_owned(),
        _ => return Ok(Opened::Builtin(scene)),
    };
    Err(ReadError::whole(name, format!("{what}; this scene is built in")))
}

/// The scene called `name`; of a file, its first frame.
///
/// # Errors
/// As [`open`].
pub fn scene(name: &str) -> Result<Scene, ReadError> {
    match open(name, &Reading::default())? {
        Opened::Builtin(scene) => Ok(scene),
        Opened::File(mut frames) => first(&mut frames),
    }
}

fn is_plain_word(name: &str) -> bool {
    let path = Path::new(name);
    path.extension().is_none() && path.components().count() == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::format::Format;
    use crate::test_file::path;
    use std::ffi::OsString;
    use std::os::unix::fs::symlink;

    #[test]
    fn a_link_to_no_file_is_told() {
        let link = path("link");
        for target in ["spherule-nowhere", "spherule-nowhere/"] {
            symlink(target, &link).expect("a link");
            let opened = open(&link, &Reading::default());
            std::fs::remove_file(&link).expect("it was there");
            let refusal = opened.expect_err("refused").to_string();
            assert!(refusal.ends_with(": the symbolic link points to no file"), "{refusal}");
        }
    }

    #[test]
    fn a_built_in_scene_has_nothing_of_a_file() {
        let columns = Some("1,2,3".to_owned());
        let topology = Some(FileName::from(OsString::from("x.gro")));
        let format = Some(Format::LammpsDump);
        let none = Reading::default;
        for (reading, what) in [
            (Reading { columns, ..none() }, "--columns 1,2,3 applies to tables only"),
            (Reading { topology, ..none() }, "--topology x.gro applies to .xtc files only"),
            (Reading { format, ..none() }, "--format lammps-dump applies to files only"),
            (Reading { strict: true, ..none() }, "--strict applies to files only"),
            (Reading { follow: true, ..none() }, "--follow applies to files only"),
        ] {
            for name in ["marbles", "caffeine.xyz"] {
                let refusal = open(name, &reading).expect_err("refused").to_string();
                assert_eq!(refusal, format!("{name}: {what}; this scene is built in"));
                open(name, &none()).expect("it is built in");
            }
        }
    }
}
