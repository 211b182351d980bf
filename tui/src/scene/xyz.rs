//! XYZ molecules: the number of atoms, a comment, and a line an atom.
//!
//! ```text
//! 3
//! water
//! O  0.000  0.000  0.119
//! H  0.000  0.763 -0.477
//! 1  0.000 -0.763 -0.477   further columns are ignored
//! ```
//!
//! Only the first frame is read. Memory grows with the atoms that are there, not with the number
//! that the first line claims. The format names no lights, so they go with the eye.

use super::elements::element;
use super::lines::Lines;
use super::read_error::ReadError;
use super::{Lighting, Scene};
use crate::color::Srgb;
use spherule_kernel::{Sphere, Vec3};
use std::io::BufRead;

/// What is behind a molecule.
const BACKGROUND: Srgb = Srgb([0x10, 0x12, 0x1a]);

/// Reads the first frame of `reader`; `source` is its name in errors.
///
/// # Errors
/// [`ReadError`] at the first line that is not what it should be: no number of atoms, none or
/// fewer or more atoms than it says, an unknown element, a coordinate that is missing, no number,
/// or not a finite `f32`.
pub fn read(reader: impl BufRead, source: &str) -> Result<Scene, ReadError> {
    let mut lines = Lines::new(reader, source);
    let count = match lines.next()? {
        Some(line) => count(&line, source)?,
        None => return Err(ReadError::whole(source, "the file is empty")),
    };
    if lines.next()?.is_none() {
        return Err(ends_early(&lines, source, count, 0));
    }
    let mut scene = Scene::new();
    scene.background = BACKGROUND;
    scene.lighting = Lighting::Camera;
    for atoms in 0..count {
        let Some(line) = lines.next()? else {
            return Err(ends_early(&lines, source, count, atoms));
        };
        let (sphere, color, symbol) = atom(&line, lines.number(), source)?;
        scene.push(sphere, color, Some(&format!("{symbol} {}", atoms + 1)));
    }

    // What follows may be another frame, but not another atom.
    while let Some(line) = lines.next()? {
        if !line.trim().is_empty() {
            if atom(&line, lines.number(), source).is_ok() {
                let what = format!("one atom more than the {count} that line 1 says");
                return Err(ReadError::at(source, lines.number(), 1, what));
            }
            break;
        }
    }
    Ok(scene)
}

fn ends_early<R: BufRead>(
    lines: &Lines<'_, R>,
    source: &str,
    count: usize,
    atoms: usize,
) -> ReadError {
    let what = format!("the file ends after {atoms} of the {count} atoms that line 1 says");
    ReadError::at(source, lines.number() + 1, 1, what)
}

fn count(line: &str, source: &str) -> Result<usize, ReadError> {
    let text = line.trim();
    let wrong = |what: String| Err(ReadError::at(source, 1, 1, what));
    match text.parse::<usize>() {
        Ok(0) => wrong("a molecule without atoms".to_owned()),
        Ok(count) => Ok(count),
        Err(_) => wrong(format!("{} is no number of atoms", excerpt(text))),
    }
}

/// The sphere, the colour and the symbol of an atom.
fn atom(
    line: &str,
    number: usize,
    source: &str,
) -> Result<(Sphere, Srgb, &'static str), ReadError> {
    let mut columns = Columns { line, read: 0 };
    let (column, name) = columns.next_or("an element", number, source)?;
    let Some(element) = element(name) else {
        let what = format!("{} is no element", excerpt(name));
        return Err(ReadError::at(source, number, column, what));
    };
    let mut center = Vec3::ZERO;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let (column, text) = columns.next_or(name, number, source)?;
        center[axis] = match text.parse::<f32>() {
            Ok(value) if value.is_finite() => value,
            Ok(_) => {
                let what = format!("{name} is {}: not finite in single precision", excerpt(text));
                return Err(ReadError::at(source, number, column, what));
            }
            Err(_) => {
                let what = format!("{name} is {}: no number", excerpt(text));
                return Err(ReadError::at(source, number, column, what));
            }
        };
    }
    Ok((Sphere { center, radius: element.radius }, element.color, element.symbol))
}

/// `text` in quotes, cut if it is long.
fn excerpt(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}

/// The words of a line, with the columns in which they begin.
struct Columns<'a> {
    line: &'a str,
    /// The bytes already read.
    read: usize,
}

impl<'a> Columns<'a> {
    /// The next word, or an error at the end of the line that `wanted` is missing.
    fn next_or(
        &mut self,
        wanted: &str,
        number: usize,
        source: &str,
    ) -> Result<(usize, &'a str), ReadError> {
        let rest = &self.line[self.read..];
        let start = self.read + (rest.len() - rest.trim_start().len());
        let word = self.line[start..].split_whitespace().next().unwrap_or("");
        let column = self.line[..start].chars().count() + 1;
        if word.is_empty() {
            return Err(ReadError::at(source, number, column, format!("{wanted} is missing")));
        }
        self.read = start + word.len();
        Ok((column, word))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: &str = "3\nwater\nO 0 0 0.119\n h 0 0.763 -0.477 extra 7\n1\t0 -0.763 -4.77e-1\n";

    fn error(text: &str) -> String {
        read(text.as_bytes(), "m.xyz").expect_err(text).to_string()
    }

    #[test]
    fn a_molecule_becomes_lit_spheres() {
        let scene = read(WATER.as_bytes(), "m.xyz").expect("water");
        assert_eq!(scene.spheres().len(), 3);
        let hydrogen = scene.spheres().get(2).expect("the third atom");
        assert_eq!(hydrogen.center, Vec3::new(0.0, -0.763, -0.477));
        assert_eq!(hydrogen.radius, 1.10);
        assert_eq!(scene.label(0).as_deref(), Some("O 1"));
        assert!(scene.lighting == Lighting::Camera && scene.view.is_none());
    }

    #[test]
    fn line_ends_and_later_frames_do_not_matter() {
        let expected = read(WATER.as_bytes(), "").expect("water").spheres().len();
        for text in [
            WATER.replace('\n', "\r\n"),
            WATER.trim_end().to_owned(),
            format!("{WATER}\n\n"),
            format!("{WATER}3\nsecond frame\nnonsense"),
            format!("\u{feff}{WATER}"),
        ] {
            let scene = read(text.as_bytes(), "").expect("water");
            assert_eq!(scene.spheres().len(), expected);
        }
        let latin1 = [b"1\n\xc5ngstr\xf6m\n".as_slice(), b"He 0 0 0\n"].concat();
        assert!(read(latin1.as_slice(), "").is_ok());
    }

    #[test]
    fn a_count_that_lies() {
        assert_eq!(
            error("4\n\nH 0 0 0\n"),
            "m.xyz:4:1: the file ends after 1 of the 4 atoms that line 1 says"
        );
        assert!(error("18446744073709551615\n\nH 0 0 0\n").contains("after 1 of"));
        assert!(error("18446744073709551616\n\nH 0 0 0\n").starts_with("m.xyz:1:1: "));
        assert_eq!(
            error("1\n\nH 0 0 0\nH 0 0 1\n"),
            "m.xyz:4:1: one atom more than the 1 that line 1 says"
        );
        assert_eq!(error("1"), "m.xyz:2:1: the file ends after 0 of the 1 atoms that line 1 says");
        assert_eq!(error("0\nnothing\n"), "m.xyz:1:1: a molecule without atoms");
        assert_eq!(error(""), "m.xyz: the file is empty");
        assert_eq!(error("water\n"), "m.xyz:1:1: \"water\" is no number of atoms");
        assert!(error("-3\n\n").starts_with("m.xyz:1:1: "));
    }

    #[test]
    fn an_unknown_element_is_named_with_its_place() {
        assert_eq!(error("2\n\nH 0 0 0\n  Xx 0 0 1\n"), "m.xyz:4:3: \"Xx\" is no element");
        assert_eq!(error("1\n\n\n"), "m.xyz:3:1: an element is missing");
    }

    #[test]
    fn coordinates_are_finite_numbers() {
        assert_eq!(
            error("1\n\nH 0 nan 0\n"),
            "m.xyz:3:5: y is \"nan\": not finite in single precision"
        );
        assert!(error("1\n\nH inf 0 0\n").starts_with("m.xyz:3:3: x is"));
        assert!(error("1\n\nH 0 0 1e39\n").starts_with("m.xyz:3:7: z is"));
        assert_eq!(error("1\n\nH 0 0 zero\n"), "m.xyz:3:7: z is \"zero\": no number");
        assert_eq!(error("1\n\nH 0 0\n"), "m.xyz:3:6: z is missing");
    }

    #[test]
    fn an_endless_line_is_refused() {
        let line = "9".repeat(1 << 20);
        assert!(error(&line).starts_with("m.xyz:1:1: "));
    }
}
