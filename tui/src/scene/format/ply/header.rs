//! The header of a PLY file: how it is written, and which elements follow.

use super::super::words::{count, excerpt, split};
use crate::scene::input::Input;
use crate::scene::read_error::ReadError;

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Int(usize),
    Uint(usize),
    Float,
    Double,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::Int(1),
            b"uchar" | b"uint8" => Self::Uint(1),
            b"short" | b"int16" => Self::Int(2),
            b"ushort" | b"uint16" => Self::Uint(2),
            b"int" | b"int32" => Self::Int(4),
            b"uint" | b"uint32" => Self::Uint(4),
            b"float" | b"float32" => Self::Float,
            b"double" | b"float64" => Self::Double,
            _ => return None,
        })
    }

    pub(super) fn size(self) -> usize {
        match self {
            Self::Int(size) | Self::Uint(size) => size,
            Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// The value of little-endian bytes.
    pub(super) fn value(self, bytes: [u8; 8]) -> f64 {
        let bits = u64::from_le_bytes(bytes);
        match self {
            Self::Uint(_) => bits as f64,
            Self::Int(size) => {
                let spare = 64 - 8 * size as u32;
                (((bits << spare) as i64) >> spare) as f64
            }
            Self::Float => f64::from(f32::from_bits(bits as u32)),
            Self::Double => f64::from_bits(bits),
        }
    }
}

/// A property of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Scalar,
    /// The type of the length, if it is a list.
    pub(super) list: Option<Scalar>,
}

/// So many elements of the same properties.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) is_vertex: bool,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Reads the header.
///
/// # Errors
/// [`ReadError`] at the first line that is not known in a header.
pub(super) fn header(input: &mut Input) -> Result<(Encoding, Vec<Element>), ReadError> {
    let (mut encoding, mut elements) = (None, Vec::<Element>::new());
    input.expect("ply")?;
    loop {
        let line = input.expect("end_header")?;
        let wrong =
            |text: &[u8], what: &str| Err(line.error(0, format!("{} {what}", excerpt(text))));
        match split(line.bytes).collect::<Vec<_>>().as_slice() {
            [b"end_header"] => break,
            [b"comment" | b"obj_info", ..] | [] => {}
            [b"format", name, b"1.0"] => {
                encoding = Some(match *name {
                    b"ascii" => Encoding::Ascii,
                    b"binary_little_endian" => Encoding::Little,
                    b"binary_big_endian" => Encoding::Big,
                    _ => {
                        let what = format!("the format {} is not known", excerpt(name));
                        return Err(line.error(0, what));
                    }
                });
            }
            [b"element", name, number] => {
                let Some(count) = count(number) else {
                    return wrong(number, "is not a number of elements");
                };
                let (is_vertex, properties) = (*name == b"vertex", Vec::new());
                elements.push(Element { is_vertex, count, properties });
            }
            [b"property", rest @ ..] => {
                let property = match rest {
                    [b"list", length, kind, name] => {
                        let length = Scalar::named(length);
                        Scalar::named(kind).zip(length).map(|(kind, list)| (kind, Some(list), name))
                    }
                    [kind, name] => Scalar::named(kind).map(|kind| (kind, None, name)),
                    _ => None,
                };
                let (Some((kind, list, name)), Some(element)) = (property, elements.last_mut())
                else {
                    return wrong(line.bytes, "is not a property");
                };
                let name = String::from_utf8_lossy(name).into_owned();
                element.properties.push(Property { name, kind, list });
            }
            _ => return wrong(line.bytes, "is not known in a header"),
        }
    }
    let encoding =
        encoding.ok_or_else(|| ReadError::whole(input.source(), "no format in the header"))?;
    Ok((encoding, elements))
}
