//! Every format by a small file, recognised by its content; and what is wrong with files.

mod arriving;
mod bad;
mod films;
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
use crate::scene::frames::Frames;
use crate::scene::open::{Opened, open};
use crate::scene::reading::Reading;
use crate::scene::reading::read;
use crate::scene::{ReadError, Scene};
use std::io::{Cursor, Write};
use std::path::PathBuf;

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

/// A file of this test's own.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("spherule-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file");
    path
}

fn frames_of(name: &str, bytes: &[u8], reading: &Reading) -> Frames {
    let path = file(name, bytes);
    match open(path.to_str().expect("UTF-8"), reading).unwrap_or_else(|error| panic!("{error}")) {
        Opened::File(frames) => frames,
        Opened::Builtin(_) => panic!("a built-in scene"),
    }
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
