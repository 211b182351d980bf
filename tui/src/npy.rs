//! Arrays in numpy's `.npy` files, written and read by the crate `npyz`, behind checks that it
//! does not make: a header may lie about its own length and about the array's.

use crate::error::{Error, cause};
use npyz::{DType, NpyFile, NpyHeader, Order, Serialize, WriteOptions, WriterBuilder};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::Path;

/// The longest header: one that states a type, an order and a shape takes some hundred bytes, and
/// the parser must not recurse without end.
const LONGEST_HEADER: usize = 1024;
/// The most digits in a header: of so many the product of the shape cannot overflow.
const MOST_DIGITS: usize = 19;

/// The rows of a little-endian `float32` array in C order with `N` columns.
///
/// Memory grows with the file, not with what its header claims.
///
/// # Errors
/// [`Error::Input`] if the file cannot be read, or is something else.
pub fn read_rows<const N: usize>(path: &Path) -> Result<Vec<[f32; N]>, Error> {
    let name = path.display();
    let wrong = |what: String| Error::Input(format!("{name}: {what}"));
    let failed = |error: io::Error| wrong(cause(&error));
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);

    let header = read_header(&mut reader).map_err(wrong)?;
    let dtype = header.dtype().descr();
    if dtype != "'<f4'" {
        return Err(wrong(format!("dtype {dtype}, not '<f4' (little-endian float32)")));
    }
    if header.order() != Order::C {
        return Err(wrong("in Fortran order, not in C order".to_owned()));
    }
    let &[rows, width] = header.shape() else {
        return Err(wrong(format!("shape {:?}, not (N, {N})", header.shape())));
    };
    if width != N as u64 {
        return Err(wrong(format!("shape ({rows}, {width}), not (N, {N})")));
    }

    // Read what is there, at most a byte more than announced.
    let length = rows.checked_mul(4 * N as u64).filter(|&length| length < u64::MAX);
    let length = length.ok_or_else(|| wrong(format!("{rows} rows are more than any file has")))?;
    let mut bytes = Vec::new();
    reader.take(length + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 != length {
        let relation = if (bytes.len() as u64) < length { "fewer" } else { "more" };
        let what = format!("{relation} bytes than the {length} of its shape ({rows}, {N})");
        return Err(wrong(what));
    }
    let values: Vec<f32> =
        NpyFile::with_header(header, bytes.as_slice()).into_vec().map_err(failed)?;
    Ok(values.as_chunks().0.to_vec())
}

/// Writes a one-dimensional array of the type that numpy calls `dtype`.
///
/// # Errors
/// [`Error::Running`] if the file cannot be written.
pub fn write_column<T: Serialize>(
    path: &Path,
    dtype: &str,
    values: impl ExactSizeIterator<Item = T>,
) -> Result<(), Error> {
    let write = || {
        let dtype = dtype.parse().map_err(io::Error::other)?;
        let mut file = BufWriter::new(File::create(path)?);
        let options = WriteOptions::new().dtype(DType::Plain(dtype)).shape(&[values.len() as u64]);
        let mut writer = options.writer(&mut file).begin_nd()?;
        writer.extend(values)?;
        writer.finish()?;
        file.flush()
    };
    write().map_err(|error| Error::of_output(&path.display().to_string(), &error))
}

/// The header, once it is known to be harmless.
pub(crate) fn read_header(reader: &mut impl Read) -> Result<NpyHeader, String> {
    let mut bytes = Vec::new();
    let mut take = |count: usize, bytes: &mut Vec<u8>| {
        let read = reader.take(count as u64).read_to_end(bytes);
        match read {
            Ok(read) if read == count => Ok(()),
            Ok(_) => Err("no .npy file: it ends within its header".to_owned()),
            Err(error) => Err(cause(&error)),
        }
    };
    take(8, &mut bytes)?;
    if !bytes.starts_with(b"\x93NUMPY") {
        return Err("no .npy file".to_owned());
    }
    let (digits, length) = match bytes[6] {
        1 => (2, 2),
        2 | 3 => (4, 4),
        version => return Err(format!("a .npy file of the unknown version {version}")),
    };
    take(length, &mut bytes)?;
    let size = bytes[8..].iter().rev().fold(0, |size, &byte| size << 8 | usize::from(byte));
    if size > LONGEST_HEADER {
        return Err(format!("a header of {size} bytes is none of a plain float32 array"));
    }
    take(size, &mut bytes)?;
    let text = &bytes[8 + digits..];
    if text.iter().filter(|byte| byte.is_ascii_digit()).count() > MOST_DIGITS {
        return Err("a shape larger than any file".to_owned());
    }
    NpyHeader::from_reader(bytes.as_slice()).map_err(|error| cause(&error))
}
