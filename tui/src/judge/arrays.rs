//! Arrays of numpy that are read row by row, and the answers that two of them hold.

use crate::error::{Error, cause};
use crate::npy::read_header;
use npyz::Order;
use spherule_referee::answer::Answer;
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

/// A type of numbers: numpy's name, and its bytes.
pub(super) type Dtype = (&'static str, usize);
pub(super) const DTYPE_F4: Dtype = ("<f4", 4);
pub(super) const DTYPE_F8: Dtype = ("<f8", 8);
pub(super) const DTYPE_U1: Dtype = ("|u1", 1);
const DTYPE_I4: Dtype = ("<i4", 4);
const DTYPE_U4: Dtype = ("<u4", 4);
const DTYPE_I8: Dtype = ("<i8", 8);

/// A file of rows.
pub(super) struct Array {
    name: String,
    reader: BufReader<File>,
    dtype: Dtype,
    /// Bytes of a row.
    row: usize,
    rows: u64,
    bytes: Vec<u8>,
}

impl Array {
    /// Opens an array of one of these types, of one dimension or of rows of `columns` numbers.
    ///
    /// # Errors
    /// [`Error::Input`] if it is another, or longer or shorter than its header says.
    pub(super) fn open(path: &Path, dtypes: &[Dtype], columns: Option<u64>) -> Result<Self, Error> {
        let name = path.display().to_string();
        let wrong = |what: String| Error::Input(format!("{name}: {what}"));
        let failed = |error: std::io::Error| wrong(cause(&error));
        let file = File::open(path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?;
        let mut reader = BufReader::with_capacity(1 << 18, file);
        let header = read_header(&mut reader).map_err(wrong)?;
        let found = header.dtype().descr();
        let dtype = dtypes.iter().find(|(dtype, _)| found == format!("'{dtype}'"));
        let Some(&dtype) = dtype else {
            let names: Vec<_> = dtypes.iter().map(|(name, _)| format!("'{name}'")).collect();
            return Err(wrong(format!("dtype {found}, not {}", names.join(" or "))));
        };
        if header.order() != Order::C {
            return Err(wrong("in Fortran order, not in C order".to_owned()));
        }
        let rows = match (header.shape(), columns) {
            (&[rows], None) => rows,
            (&[rows, width], Some(columns)) if width == columns => rows,
            (shape, _) => {
                let expected =
                    columns.map_or("(N,)".to_owned(), |columns| format!("(N, {columns})"));
                return Err(wrong(format!("shape {shape:?}, not {expected}")));
            }
        };
        let row = dtype.1 * columns.unwrap_or(1) as usize;
        if length.is_file() {
            let data = length.len() - reader.stream_position().map_err(failed)?;
            let expected = rows.checked_mul(row as u64);
            if Some(data) != expected {
                let relation =
                    if expected.is_none_or(|expected| data < expected) { "fewer" } else { "more" };
                return Err(wrong(format!("{relation} bytes than {rows} rows have")));
            }
        }
        Ok(Self { name, reader, dtype, row, rows, bytes: Vec::new() })
    }

    pub(super) fn rows(&self) -> u64 {
        self.rows
    }

    /// An error of this file.
    pub(super) fn wrong(&self, what: &str) -> Error {
        Error::Input(format!("{}: {what}", self.name))
    }

    /// The bytes of the next rows.
    ///
    /// # Errors
    /// [`Error::Input`] if there are not so many.
    pub(super) fn read(&mut self, count: usize) -> Result<&[u8], Error> {
        self.bytes.resize(count * self.row, 0);
        match self.reader.read_exact(&mut self.bytes) {
            Ok(()) => Ok(&self.bytes),
            Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                Err(self.wrong(&format!("fewer bytes than {} rows have", self.rows)))
            }
            Err(error) => Err(self.wrong(&cause(&error))),
        }
    }

    /// The next rows of `N` numbers.
    pub(super) fn read_rows<const N: usize>(
        &mut self,
        count: usize,
    ) -> Result<Vec<[f32; N]>, Error> {
        let rows = self.read(count)?.as_chunks::<4>().0.as_chunks::<N>().0;
        Ok(rows.iter().map(|row| row.map(f32::from_le_bytes)).collect())
    }

    /// Checks that all has been read; a pipe tells that only now.
    pub(super) fn check_end(&mut self) -> Result<(), Error> {
        match self.reader.read(&mut [0]) {
            Ok(0) => Ok(()),
            Ok(_) => Err(self.wrong(&format!("more bytes than {} rows have", self.rows))),
            Err(error) => Err(self.wrong(&cause(&error))),
        }
    }
}

/// Checks that there is a row for every ray.
pub(super) fn paired_rows(array: &Array, rays: &Array) -> Result<(), Error> {
    if array.rows == rays.rows {
        return Ok(());
    }
    Err(array.wrong(&format!("{} rows, and {} rays", array.rows, rays.rows)))
}

/// The answers: t, and perhaps the sphere, for every ray.
pub(super) struct Answers {
    t: Array,
    id: Option<Array>,
}

impl Answers {
    pub(super) fn open(t: &Path, id: Option<&Path>) -> Result<Self, Error> {
        let t = Array::open(t, &[DTYPE_F4, DTYPE_F8], None)?;
        let of_id = |path| Array::open(path, &[DTYPE_I4, DTYPE_U4, DTYPE_I8], None);
        Ok(Self { t, id: id.map(of_id).transpose()? })
    }

    pub(super) fn check_rows(&self, rays: &Array) -> Result<(), Error> {
        [Some(&self.t), self.id.as_ref()]
            .into_iter()
            .flatten()
            .try_for_each(|array| paired_rows(array, rays))
    }

    pub(super) fn rows(&self) -> u64 {
        self.t.rows
    }

    pub(super) fn are_double(&self) -> bool {
        self.t.dtype == DTYPE_F8
    }

    /// The next answers, from row `from` on; to pairs if `spheres` is `None`, else of so many
    /// spheres. All but +inf is answered as a hit: the judge counts NaN, -inf and spheres past the last.
    ///
    /// # Errors
    /// [`Error::Input`] with the first row whose t and id contradict each other, or whose id is no index.
    pub(super) fn read(
        &mut self,
        from: u64,
        count: usize,
        spheres: Option<u64>,
    ) -> Result<Vec<Option<Answer>>, Error> {
        let double = self.are_double();
        let bytes = self.t.read(count)?;
        let t: Vec<f64> = if double {
            bytes.as_chunks().0.iter().map(|&t| f64::from_le_bytes(t)).collect()
        } else {
            bytes.as_chunks().0.iter().map(|&t| f32::from_le_bytes(t).into()).collect()
        };
        let answer = |t: f64, sphere| (t != f64::INFINITY).then_some(Answer { t, sphere });
        let Some(array) = &mut self.id else {
            // A pair has one sphere.
            let sphere = if spheres.is_none() { Some(0) } else { None };
            return Ok(t.into_iter().map(|t| answer(t, sphere)).collect());
        };
        let dtype = array.dtype;
        let bytes = array.read(count)?;
        let ids: Vec<i64> = match dtype {
            DTYPE_I8 => bytes.as_chunks().0.iter().map(|&id| i64::from_le_bytes(id)).collect(),
            DTYPE_U4 => {
                let id = |id: u32| if id == u32::MAX { -1 } else { i64::from(id) };
                bytes.as_chunks().0.iter().map(|&bytes| id(u32::from_le_bytes(bytes))).collect()
            }
            _ => bytes.as_chunks().0.iter().map(|&id| i32::from_le_bytes(id).into()).collect(),
        };
        let mut answers = Vec::with_capacity(count);
        for (index, (&t, &id)) in t.iter().zip(&ids).enumerate() {
            let row = from + index as u64;
            let sphere = match spheres {
                // A pair's sphere is that of its row.
                None => (id == row as i64).then_some(0),
                Some(_) => (id >= 0).then(|| u32::try_from(id).unwrap_or(u32::MAX)),
            };
            let what = if id == -1 && t.is_finite() {
                format!("row {row}: t = {t} where nothing is hit; +inf with id -1")
            } else if id != -1 && t == f64::INFINITY {
                format!("row {row}: id {id} without a hit; -1 with t = +inf")
            } else if id != -1 && sphere.is_none() {
                match spheres {
                    None => format!("row {row}: id {id}; {row} of a pair, or -1"),
                    Some(spheres) => format!("row {row}: id {id} of {spheres} spheres"),
                }
            } else {
                answers.push(answer(t, sphere));
                continue;
            };
            return Err(array.wrong(&what));
        }
        Ok(answers)
    }

    pub(super) fn check_end(&mut self) -> Result<(), Error> {
        [Some(&mut self.t), self.id.as_mut()].into_iter().flatten().try_for_each(Array::check_end)
    }
}
