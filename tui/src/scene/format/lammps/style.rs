//! LAMMPS's atom styles: which column of the section `Atoms` is what. (LAMMPS's manual, the command that reads data.)

use super::super::words::split;
use crate::scene::input::Line;
use crate::scene::number::{number, parsed};

/// Which column is what; the first is the id.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub(super) kind: usize,
    pub(super) molecule: Option<usize>,
    pub(super) charge: Option<usize>,
    pub(super) diameter: Option<usize>,
    pub(super) position: usize,
}

impl Style {
    const ATOMIC: Self =
        Self { kind: 1, molecule: None, charge: None, diameter: None, position: 2 };
    const CHARGE: Self = Self { charge: Some(2), position: 3, ..Self::ATOMIC };
    const MOLECULAR: Self = Self { kind: 2, molecule: Some(1), position: 3, ..Self::ATOMIC };
    const FULL: Self = Self { charge: Some(3), position: 4, ..Self::MOLECULAR };
    const SPHERE: Self = Self { diameter: Some(2), position: 4, ..Self::ATOMIC };

    /// The style that is written behind `Atoms`, perhaps with what it runs on, `sphere/kk`, or with styles of which a hybrid is
    /// made.
    pub(super) fn named(hint: &[u8]) -> Option<Self> {
        let name = hint.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        Some(match name.strip_suffix(b"/kk").unwrap_or(name) {
            // What a hybrid has besides is behind positions.
            b"atomic" | b"hybrid" | b"spin" | b"tdpd" => Self::ATOMIC,
            b"charge" | b"dipole" => Self::CHARGE,
            b"angle" | b"bond" | b"molecular" => Self::MOLECULAR,
            b"dielectric" | b"full" => Self::FULL,
            b"sphere" => Self::SPHERE,
            b"bpm/sphere" => Self { diameter: Some(3), position: 5, ..Self::MOLECULAR },
            b"dpd" | b"mdpd" => Self { position: 3, ..Self::ATOMIC },
            b"body" | b"edpd" | b"ellipsoid" | b"peri" | b"rheo" => {
                Self { position: 4, ..Self::ATOMIC }
            }
            b"rheo/thermal" | b"sph" => Self { position: 5, ..Self::ATOMIC },
            b"electron" => Self { charge: Some(2), position: 5, ..Self::ATOMIC },
            b"line" | b"tri" => Self { position: 5, ..Self::MOLECULAR },
            b"template" => Self { molecule: Some(2), position: 5, ..Self::ATOMIC },
            b"wavepacket" => Self { charge: Some(2), position: 8, ..Self::ATOMIC },
            b"smd" => Self { molecule: Some(2), position: 10, ..Self::ATOMIC },
            _ => return None,
        })
    }

    /// The style that the number of columns of a line tells. LIGGGHTS, which names no style, has spheres.
    pub(super) fn of_columns(line: &Line<'_>) -> Option<Self> {
        let text = line.bytes.split(|&byte| byte == b'#').next().unwrap_or_default();
        let words: Vec<&[u8]> = split(text).collect();
        let is_integer = |word: &[u8]| parsed::<i64>(word).is_some();
        let images =
            words.len() >= 8 && words[words.len() - 3..].iter().all(|word| is_integer(word));
        match words.len() - if images { 3 } else { 0 } {
            5 => Some(Self::ATOMIC),
            6 if is_integer(words[2]) => Some(Self::MOLECULAR),
            6 => Some(Self::CHARGE),
            // A type may be a name, but is no fraction.
            7 if number(words[2]).is_some() && !is_integer(words[2]) => Some(Self::SPHERE),
            7 => Some(Self::FULL),
            _ => None,
        }
    }
}
