//! Every format by a small file, recognised by its content; and what is wrong with files.

mod arriving;
mod bad;
mod films;
mod first_lines;
mod frames;
mod good;
mod lammps;
mod mercury;
mod mmcif;
mod pdb;
mod recognised;
mod tables;
mod urdf;
mod wide;
mod xyz;

use super::Format;
use crate::color::Srgb;
use crate::scene::attributes::Naming;
use crate::scene::frames::Frames;
use crate::scene::input::Input;
use crate::scene::open::{Opened, open};
use crate::scene::reading::{Reading, frames, read};
use crate::scene::{ReadError, Scene};
use crate::test_file::written;
use std::fs::OpenOptions;
use std::io::{Cursor, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// The scene in `bytes`, told by them alone.
fn scene(bytes: impl Into<Vec<u8>>) -> Result<Scene, ReadError> {
    read(Box::new(Cursor::new(bytes.into())), "f", None)
}

fn good(bytes: impl Into<Vec<u8>>) -> Scene {
    scene(bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn error(bytes: impl Into<Vec<u8>>) -> String {
    scene(bytes).expect_err("an error").to_string()
}

/// Asserts what is in the error of `bytes`: at its start, where that begins with the name of the file.
#[track_caller]
fn wrong(bytes: impl Into<Vec<u8>>, part: &str) {
    let message = error(bytes);
    let is_there =
        if part.starts_with("f:") { message.starts_with(part) } else { message.contains(part) };
    assert!(is_there, "{message}");
}

/// What `read` returns, in a time that grows with the file, not with its square.
#[track_caller]
fn soon<T>(read: impl FnOnce() -> T) -> T {
    let begun = Instant::now();
    let result = read();
    let took = begun.elapsed();
    assert!(took < Duration::from_secs(20), "{took:?}");
    result
}

/// Centres and radii.
fn spheres(scene: &Scene) -> Vec<[f32; 4]> {
    let row = |sphere: spherule_kernel::Sphere| {
        let [x, y, z] = sphere.center.to_array();
        [x, y, z, sphere.radius]
    };
    scene.spheres().iter().map(row).collect()
}

fn centers(scene: &Scene) -> Vec<[f32; 3]> {
    spheres(scene).into_iter().map(|[x, y, z, _]| [x, y, z]).collect()
}

/// The values of a column of numbers.
fn numbers(scene: &Scene, name: &str) -> Option<Vec<f32>> {
    scene.attributes().column(name).map(|column| column.values.clone())
}

fn frames_of(name: &str, bytes: impl AsRef<[u8]>, reading: &Reading) -> Frames {
    let path = written(name, bytes);
    match open(path.to_str().expect("UTF-8"), reading).unwrap_or_else(|error| panic!("{error}")) {
        Opened::File(frames) => frames,
        Opened::Builtin(_) => panic!("a built-in scene"),
    }
}

/// The frames of a file, told by its content.
fn film(name: &str, bytes: impl AsRef<[u8]>) -> Frames {
    frames_of(name, bytes, &Reading::default())
}

/// One that grows.
fn followed(name: &str, bytes: impl AsRef<[u8]>) -> Frames {
    frames_of(name, bytes, &Reading { follow: true, ..Reading::default() })
}

/// Adds to a file of this test's own.
fn append(path: &Path, bytes: &[u8]) {
    let mut file = OpenOptions::new().append(true).open(path).expect("a file");
    file.write_all(bytes).expect("written");
}

/// Frame `index`; `None` if there is none.
fn frame(film: &mut Frames, index: usize) -> Option<Scene> {
    film.read(index).unwrap_or_else(|error| panic!("{error}"))
}

/// The centres in frame `index`; `None` if there is none.
fn centers_in(film: &mut Frames, index: usize) -> Option<Vec<[f32; 3]>> {
    frame(film, index).as_ref().map(centers)
}

/// The error of frame `index`.
#[track_caller]
fn error_in(film: &mut Frames, index: usize) -> String {
    film.read(index).expect_err("an error").to_string()
}

/// The table in `text`, read by these columns: as a table, where its content tells that or `format` does.
fn by(format: Option<Format>, columns: &str, text: &str) -> Scene {
    let reading = Reading { format, columns: Some(columns.to_owned()), ..Reading::default() };
    let input = Input::of_reader(Box::new(Cursor::new(text.to_owned())), "f").expect("an input");
    let film = &mut frames(input, &reading).unwrap_or_else(|error| panic!("{error}"));
    frame(film, 0).expect("a table")
}

/// What there is to say of the first frame.
fn notes(name: &str, text: &str) -> Vec<String> {
    let film = &mut film(name, text);
    assert!(frame(film, 0).is_some(), "{name}");
    film.notes()
}

fn gz(bytes: &[u8]) -> Vec<u8> {
    let mut writer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    writer.write_all(bytes).expect("memory");
    writer.finish().expect("memory")
}

fn bz2(bytes: &[u8]) -> Vec<u8> {
    let mut writer = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::best());
    writer.write_all(bytes).expect("memory");
    writer.finish().expect("memory")
}

/// A frame of a `.xtc` file with atoms at these x: so few are not compressed.
fn xtc(atoms: &[f32]) -> Vec<u8> {
    let count = (atoms.len() as u32).to_be_bytes();
    let points = atoms.iter().flat_map(|&x| [x, 0.0, 0.0]).flat_map(f32::to_be_bytes);
    // What says when it is and in which box is between the counts.
    let mut bytes = [1995_u32.to_be_bytes(), count].concat();
    bytes.extend([0; 44]);
    bytes.extend(count);
    bytes.extend(points);
    bytes
}

/// A `.npy` file of version 1.
fn npy(descr: &str, fortran: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header =
        format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

/// A frame of a dump of LAMMPS, of atoms in a box.
fn dump(bounds: &str, columns: &str, atoms: &str) -> String {
    let (head, count) = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS", atoms.lines().count());
    format!("{head}\n{count}\nITEM: BOX BOUNDS {bounds}\nITEM: ATOMS {columns}\n{atoms}")
}

/// One that does not matter.
const BOUNDS: &str = "pp pp pp\n0 1\n0 1\n0 1";

const PDB: &str = "\
HEADER    TEST
CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1
MODEL        1
ATOM      1  N   ALA A   1      11.104   6.134  -6.504  1.00 10.50           N
ATOM  A0000  CA AALA A   1      11.639   6.071  -5.147  0.60 11.00           C
ATOM  A0001  CA BALA A   1      12.639   6.071  -5.147  0.40 11.00           C
HETATM    3 FE   HEM BA000       1.000   2.000   3.000  1.00  0.00
ENDMDL
MODEL        2
ATOM      1  N   ALA A   1      21.104   6.134  -6.504  1.00 10.50           N
ENDMDL
CONECT    1    2
END
";
