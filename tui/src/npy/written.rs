//! An array that is written row by row.

use crate::error::Error;
use crate::whole_file::WholeFile;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// An array that is being written, and has not got its name yet.
#[derive(Debug)]
pub(crate) struct Output {
    name: String,
    file: BufWriter<WholeFile>,
}

impl Output {
    /// Begins an array of this shape, of the type that numpy calls `dtype`.
    ///
    /// # Errors
    /// [`Error::Running`] if the file cannot be written. Then there is no file of this name, or it is as it was.
    pub(crate) fn create(path: &Path, dtype: &str, shape: &[u64]) -> Result<Self, Error> {
        let name = path.display().to_string();
        let failed = |error: io::Error| Error::of_output(&name, &error);
        let mut file = BufWriter::new(WholeFile::create(path).map_err(failed)?);
        file.write_all(&header(dtype, shape)).map_err(failed)?;
        Ok(Self { name, file })
    }

    /// Writes the bytes of what comes next.
    ///
    /// # Errors
    /// As [`Self::create`].
    pub(crate) fn write(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(|error| Error::of_output(&self.name, &error))
    }

    /// Sees to it that all of the array is on the disk.
    ///
    /// # Errors
    /// As [`Self::create`].
    pub(crate) fn written(&mut self) -> Result<(), Error> {
        let written = self.file.flush().and_then(|()| self.file.get_ref().written());
        written.map_err(|error| Error::of_output(&self.name, &error))
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// As [`Self::create`].
    pub(crate) fn finish(self) -> Result<(), Error> {
        let Self { name, file } = self;
        let failed = |error: io::Error| Error::of_output(&name, &error);
        let file = file.into_inner().map_err(|error| failed(error.into_error()))?;
        file.finish().map_err(failed)
    }
}

/// What a `.npy` file begins with: version 1, its data at a multiple of 64 bytes.
pub(crate) fn header(dtype: &str, shape: &[u64]) -> Vec<u8> {
    let mut sizes = shape.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    // A tuple of one number is told from a number in brackets.
    if shape.len() == 1 {
        sizes.push(',');
    }
    let text = format!("{{'descr': '{dtype}', 'fortran_order': False, 'shape': ({sizes}), }}");
    let padding = 63 - (10 + text.len()) % 64;
    let text = text + &" ".repeat(padding) + "\n";
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}

/// A row of an array.
pub(crate) fn bytes_of_row(row: &[f32]) -> Vec<u8> {
    row.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::npy::read_header;

    #[test]
    fn a_header_is_as_numpy_writes_it() {
        for (shape, text) in [(&[5][..], "(5,)"), (&[5, 8], "(5, 8)")] {
            let bytes = header("<f4", shape);
            assert!(bytes.len().is_multiple_of(64) && bytes.ends_with(b" \n"));
            let text = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {text}, }} ");
            assert!(bytes[10..].starts_with(text.as_bytes()));
            let read = read_header(&mut bytes.as_slice()).expect("a header");
            assert_eq!((read.dtype().descr().as_str(), read.shape()), ("'<f4'", shape));
        }
    }
}
