//! Arrays in numpy's `.npy` files, whose headers the crate `npyz` reads, behind checks that it
//! does not make: a header may lie about its own length and about the array's.

mod written;

use crate::error::{Error, cause};
use npyz::{NpyHeader, Order};
use spherule_kernel::{Ray, Vec3};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
pub(crate) use written::{Output, bytes_of_row, header};

/// The longest header: one that states a type, an order and a shape takes some hundred bytes.
const LONGEST_HEADER: usize = 1024;
/// The most opening brackets in a header: a plain array's has two, a record's some more, and the parser reads what is in one up to
/// three times. (They are counted, not how deep they are: a closing one may be in a name.)
const MOST_BRACKETS: usize = 8;
/// The most digits in a header: with no more, the product of the shape cannot overflow.
const MOST_DIGITS: usize = 19;

/// An array of rows, whose header has been read.
#[derive(Clone, Copy, Debug)]
pub struct Array {
    rows: u64,
    width: u64,
    /// Bytes a number: 4 or 8.
    size: usize,
    is_big_endian: bool,
    is_fortran: bool,
}

/// Rows that are read at once.
const BLOCK: usize = 1 << 14;

/// The most columns: no one means more.
const MOST_COLUMNS: u64 = 64;

impl Array {
    /// Reads the header of an array of two dimensions: `f4` or `f8`, of either byte order, in C or Fortran order.
    ///
    /// # Errors
    /// Says what is wrong with it.
    pub fn of(reader: &mut impl Read) -> Result<Self, String> {
        let header = read_header(reader)?;
        let dtype = header.dtype().descr();
        let (order, size) = match dtype.as_str() {
            "'<f4'" => (false, 4),
            "'>f4'" => (true, 4),
            "'<f8'" => (false, 8),
            "'>f8'" => (true, 8),
            _ => return Err(format!("dtype {dtype}, not float32 or float64")),
        };
        let &[rows, width] = header.shape() else {
            return Err(format!("shape {:?}: not of two dimensions", header.shape()));
        };
        if width > MOST_COLUMNS {
            return Err(format!("shape ({rows}, {width}): more than {MOST_COLUMNS} columns"));
        }
        let is_fortran = header.order() == Order::Fortran;
        Ok(Self { rows, width, size, is_big_endian: order, is_fortran })
    }

    /// Rows and columns.
    #[must_use]
    pub fn shape(&self) -> (u64, u64) {
        (self.rows, self.width)
    }

    /// Calls `row` with the index and the numbers of every row.
    ///
    /// In C order rows are read as they come; in Fortran order a copy is made. Memory grows with the file, not with
    /// what its header claims.
    ///
    /// # Errors
    /// The error of `row`, or that there are fewer bytes than the header claims, or more.
    pub fn each(
        &self,
        reader: &mut impl Read,
        mut row: impl FnMut(usize, &[f64]) -> Result<(), String>,
    ) -> Result<(), String> {
        let width = self.width as usize;
        let total = self.rows.checked_mul(self.width * self.size as u64);
        let total =
            total.ok_or_else(|| format!("{} rows are more than any file has", self.rows))?;
        let (rows, columns) = (self.rows, self.width);
        let claimed = || format!("bytes than the {total} of its shape ({rows}, {columns})");
        let fewer = || format!("fewer {}", claimed());
        let mut numbers = Vec::new();
        if self.is_fortran {
            let mut columns: Vec<Vec<f64>> = Vec::new();
            for _ in 0..width {
                let mut column: Vec<f64> = Vec::new();
                self.blocks(reader, self.rows, &mut numbers, fewer, |block| {
                    column.extend_from_slice(block);
                    Ok(())
                })?;
                columns.push(column);
            }
            let mut one = vec![0.0; width];
            for index in 0..self.rows as usize {
                for (value, column) in one.iter_mut().zip(&columns) {
                    *value = column[index];
                }
                row(index, &one)?;
            }
        } else {
            let mut index = 0;
            self.blocks(reader, self.rows * self.width, &mut numbers, fewer, |block| {
                for one in block.chunks_exact(width) {
                    row(index, one)?;
                    index += 1;
                }
                Ok(())
            })?;
        }
        match reader.take(1).read_to_end(&mut Vec::new()) {
            Ok(0) => Ok(()),
            Ok(_) => Err(format!("more {}", claimed())),
            Err(error) => Err(cause(&error)),
        }
    }

    /// So many numbers, in blocks of whole rows.
    fn blocks(
        &self,
        reader: &mut impl Read,
        count: u64,
        numbers: &mut Vec<f64>,
        fewer: impl Fn() -> String,
        mut block: impl FnMut(&[f64]) -> Result<(), String>,
    ) -> Result<(), String> {
        let most = BLOCK as u64 * self.width;
        let (mut left, mut bytes) = (count, Vec::new());
        while left > 0 {
            let now = left.min(most);
            left -= now;
            let length = now as usize * self.size;
            bytes.clear();
            let read = reader.take(length as u64).read_to_end(&mut bytes);
            if read.map_err(|error| cause(&error))? < length {
                return Err(fewer());
            }
            numbers.clear();
            let four = |bytes: &[u8; 4]| match self.is_big_endian {
                true => f64::from(f32::from_be_bytes(*bytes)),
                false => f64::from(f32::from_le_bytes(*bytes)),
            };
            let eight = |bytes: &[u8; 8]| match self.is_big_endian {
                true => f64::from_be_bytes(*bytes),
                false => f64::from_le_bytes(*bytes),
            };
            match self.size {
                4 => numbers.extend(bytes.as_chunks().0.iter().map(four)),
                _ => numbers.extend(bytes.as_chunks().0.iter().map(eight)),
            }
            block(numbers)?;
        }
        Ok(())
    }
}

/// The rows of an array of `float32` or `float64` with `N` columns, rounded to `f32`.
///
/// Memory grows with the file, not with what its header claims.
///
/// # Errors
/// [`Error::Input`] if the file cannot be read, or is something else.
pub fn read_rows<const N: usize>(path: &Path) -> Result<Vec<[f32; N]>, Error> {
    let name = path.display();
    let wrong = |what: String| Error::Input(format!("{name}: {what}"));
    let file = File::open(path).map_err(|error| wrong(cause(&error)))?;
    let mut reader = BufReader::new(file);
    let array = Array::of(&mut reader).map_err(wrong)?;
    let (rows, width) = array.shape();
    if width != N as u64 {
        return Err(wrong(format!("shape ({rows}, {width}), not (N, {N})")));
    }
    let mut values = Vec::new();
    let read = array.each(&mut reader, |_, row| {
        values.extend(<[f64; N]>::try_from(row).map(|row| row.map(|value| value as f32)));
        Ok(())
    });
    read.map_err(wrong)?;
    Ok(values)
}

/// The ray of a row: origin, direction, `t_min`, `t_max`.
pub(crate) fn ray([x, y, z, dx, dy, dz, t_min, t_max]: [f32; 8]) -> Ray {
    Ray { origin: Vec3::new(x, y, z), direction: Vec3::new(dx, dy, dz), t_min, t_max }
}

/// The header, once it is known to be harmless.
pub(crate) fn read_header(reader: &mut impl Read) -> Result<NpyHeader, String> {
    let mut bytes = Vec::new();
    let mut take = |count: usize, bytes: &mut Vec<u8>| {
        let read = reader.take(count as u64).read_to_end(bytes);
        match read {
            Ok(read) if read == count => Ok(()),
            Ok(_) => Err("not a .npy file: it ends within its header".to_owned()),
            Err(error) => Err(cause(&error)),
        }
    };
    take(8, &mut bytes)?;
    if !bytes.starts_with(b"\x93NUMPY") {
        return Err("not a .npy file".to_owned());
    }
    let length = match bytes[6] {
        1 => 2,
        2 | 3 => 4,
        version => return Err(format!("a .npy file of the unknown version {version}")),
    };
    take(length, &mut bytes)?;
    let size = bytes[8..].iter().rev().fold(0, |size, &byte| size << 8 | usize::from(byte));
    if size > LONGEST_HEADER {
        return Err(format!("a header of {size} bytes is not that of a plain array of numbers"));
    }
    take(size, &mut bytes)?;
    let text = &bytes[8 + length..];
    if text.iter().filter(|byte| byte.is_ascii_digit()).count() > MOST_DIGITS {
        return Err("a shape larger than any file".to_owned());
    }
    let brackets = text.iter().filter(|byte| matches!(byte, b'(' | b'[' | b'{')).count();
    if brackets > MOST_BRACKETS {
        return Err(format!(
            "a header of {brackets} brackets is not that of a plain array of numbers"
        ));
    }
    NpyHeader::from_reader(bytes.as_slice()).map_err(|error| {
        let what = cause(&error);
        // The parser draws where it has stopped, in several lines: at `3L`, as Python 2 writes an integer.
        match what.contains('\n') {
            true => "the header is not a Python 3 dictionary".to_owned(),
            false => what,
        }
    })
}
