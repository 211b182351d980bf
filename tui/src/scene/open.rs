//! From the name of a scene to the scene: built in, a file, or standard input.

use super::read_error::ReadError;
use super::{Scene, builtin, lines, toml, xyz};
use crate::error::cause;
use clap::ValueEnum;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// The formats that scenes are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Spheres, lights and a camera, as in the README
    Toml,
    /// A molecule
    Xyz,
}

/// The longest TOML text, in bytes: some half a million spheres.
const LONGEST_TOML: u64 = 64 << 20;

/// Opens the scene called `name`: a built-in one, a file (its format told by its ending), or for
/// `-` standard input. `format` overrides what the name or the first line tells.
///
/// # Errors
/// [`ReadError`] if there is no such scene, or it cannot be read.
pub fn open(name: &str, format: Option<Format>) -> Result<Scene, ReadError> {
    if name == "-" {
        return read(io::stdin().lock(), "-", format);
    }
    if let Some(scene) = builtin::builtin(name) {
        return Ok(scene);
    }
    let file = match File::open(name) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return match builtin::shipped_file(name) {
                Some(scene) => Ok(scene),
                None if is_plain_word(name) => {
                    Err(ReadError::whole(name, "no such scene, built in or in a file"))
                }
                None => Err(ReadError::whole(name, "no such file")),
            };
        }
        Err(error) => return Err(ReadError::whole(name, cause(&error))),
    };
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err(ReadError::whole(name, "is a directory"));
    }
    match format.or_else(|| format_of(name)) {
        Some(format) => read(BufReader::new(file), name, Some(format)),
        None => Err(ReadError::whole(name, "of no known format: .toml, .xyz, or say --format")),
    }
}

/// Reads a scene; without a format, one whose first line is an integer is XYZ, else TOML.
///
/// # Errors
/// [`ReadError`] if it is none.
pub fn read(
    mut reader: impl BufRead,
    source: &str,
    format: Option<Format>,
) -> Result<Scene, ReadError> {
    let mut first = Vec::new();
    let format = match format {
        Some(format) => format,
        None => {
            let mut limited = reader.by_ref().take(lines::LONGEST_LINE);
            let line = limited.read_until(b'\n', &mut first);
            line.map_err(|error| ReadError::whole(source, cause(&error)))?;
            let line = String::from_utf8_lossy(&first);
            let line = line.trim_start_matches('\u{feff}').trim();
            if line.parse::<i128>().is_ok() { Format::Xyz } else { Format::Toml }
        }
    };
    let mut reader = first.chain(reader);
    match format {
        Format::Xyz => xyz::read(reader, source),
        Format::Toml => {
            let mut bytes = Vec::new();
            let read = reader.by_ref().take(LONGEST_TOML + 1).read_to_end(&mut bytes);
            read.map_err(|error| ReadError::whole(source, cause(&error)))?;
            if bytes.len() as u64 > LONGEST_TOML {
                return Err(ReadError::whole(source, "a scene of more than 64 MiB"));
            }
            let text = std::str::from_utf8(&bytes).map_err(|error| {
                let line = bytes[..error.valid_up_to()].split(|&byte| byte == b'\n').count();
                ReadError { line: Some(line), ..ReadError::whole(source, "no UTF-8 text") }
            })?;
            toml::read(text, source)
        }
    }
}

fn is_plain_word(name: &str) -> bool {
    let path = Path::new(name);
    path.extension().is_none() && path.components().count() == 1
}

fn format_of(name: &str) -> Option<Format> {
    let ending = Path::new(name).extension()?.to_str()?;
    Format::from_str(ending, true).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_tells_the_format() {
        assert!(read(" 1 \n\nH 0 0 0\n".as_bytes(), "-", None).is_ok());
        let toml = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
        assert!(read(toml.as_bytes(), "-", None).is_ok());
        assert!(read(toml.as_bytes(), "-", Some(Format::Xyz)).is_err());
        let negative = read("-1\n".as_bytes(), "-", None).expect_err("no molecule");
        assert!(negative.to_string().contains("number of atoms"));
        let empty = read("".as_bytes(), "-", None).expect_err("nothing");
        assert!(empty.to_string().contains("empty scene"), "{empty}");
    }

    #[test]
    fn names_and_endings() {
        assert!(open("marbles", None).is_ok());
        assert!(open("caffeine.xyz", None).is_ok());
        let message = |name| open(name, None).expect_err(name).to_string();
        assert_eq!(message("nonesuch"), "nonesuch: no such scene, built in or in a file");
        assert_eq!(message("none/such.xyz"), "none/such.xyz: no such file");
        assert_eq!(message("src"), "src: is a directory");
        assert!(message("Cargo.lock.txt").contains("no such file"));
        assert!(message("src/lib.rs").contains("of no known format"));
        assert_eq!(format_of("a/B.XYZ"), Some(Format::Xyz));
    }

    #[test]
    fn endless_input_is_refused() {
        let endless = || BufReader::new(io::repeat(b'#'));
        assert!(read(endless(), "-", Some(Format::Xyz)).is_err());
        assert!(read(endless(), "-", None).expect_err("endless").to_string().contains("64 MiB"));
    }

    #[test]
    fn what_is_no_text_has_a_line() {
        let error = read(b"# one\n# \xff\n".as_slice(), "s.toml", None).expect_err("no text");
        assert_eq!(error.to_string(), "s.toml:2: no UTF-8 text");
    }
}
