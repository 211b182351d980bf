use super::*;
use crate::scene::input::LONGEST_LINE;
use std::io::{self, Read};

#[test]
fn a_count_that_lies() {
    let ends = "f:4:1: the file ends after 1 of the 4 atoms that line 1 says";
    assert_eq!(error("4\n\nH 0 0 0\n"), ends);
    wrong("18446744073709551615\n\nH 0 0 0\n", "after 1 of");
    wrong("18446744073709551616\n\nH 0 0 0\n", "f:1:1: ");
    let data = "LAMMPS data\n\n1 atoms\n\nAtoms # atomic\n\n1 1 0 0 0\n\n# a comment\n2 1 1 0 0\n";
    assert_eq!(error(data), "f:10:1: one atom more than the 1 that line 3 says");
    assert_eq!(error("1"), "f:2:1: the file ends before its comment");
    assert_eq!(error("0\nnothing\n"), "f:1:1: a molecule without atoms");
    assert_eq!(error(""), "f: the file is empty");
    wrong("-3\n\n", "f:1:1: ");
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n9\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n1 1 0 0 0\n";
    assert_eq!(error(dump), "f:11:1: the file ends after 1 of the 9 atoms that line 4 says");
    let two = "1\n\nH 0 0 0\nH 0 0 1\n";
    let more = ":4:1: one atom more than the 1 that line 1 says";
    assert_eq!(error(two), format!("f{more}"));
    // Of a file, where looking at the next line waits for nothing; and not at what a run that was cut off has left.
    let message = error_in(&mut film("one-more.xyz", two), 0);
    assert!(message.ends_with(&format!(".xyz{more}")), "{message}");
    let one = dump.replace("\n9\n", "\n1\n");
    let with = |end: &str| film("count.dump", one.clone() + end);
    let message = error_in(&mut with("2 1 0 0 0\n"), 0);
    let what = "11:1: \"2 1 0 0 0\" where an ITEM: should be; the number of atoms in line 4 is 1";
    assert!(message.ends_with(what), "{message}");
    for end in ["", "IT", "\0\0\0", "ITEM: TIMESTEP\n"] {
        let scene = frame(&mut with(end), 0).expect("a frame");
        assert_eq!(scene.spheres().len(), 1, "{end:?}");
    }
    wrong("t\n 2\n    1SOL     OW    1   0.000   1.624   1.679\n", "ends after 1 of the 2");
    let gro = |end: &str| format!("t\n 1\n    1SOL     OW    1   0.000   1.624   1.679\n{end}\n");
    assert_eq!(
        error(gro("    2SOL     OW    2   0.000   1.624   1.679\n   1 1 1")),
        "f:4:5: \"2SOL\" in the box is not a number; the number of atoms in line 2 is 1"
    );
    for end in ["", "   1 1 1", "1000.000001000.00000-100.00000", "1e3 1D3 1"] {
        assert_eq!(good(gro(end)).spheres().len(), 1, "{end}");
    }
    assert_eq!(
        error(gro("   1 1 1").replace("  1.679", "   1.679")),
        "f:3:21: the line does not have three coordinates of one width"
    );
}

#[test]
fn a_residue_of_many_alternate_locations() {
    let count = 300_000_u32;
    let name = |index: u32| -> String {
        let letter = |place| char::from(b'A' + (index / 26_u32.pow(place) % 26) as u8);
        (0..4).map(letter).collect()
    };
    let atom =
        |index| format!("ATOM      1 {}AALA A   1       0.000   0.000   0.000\n", name(index));
    let pdb: String = (0..count).map(atom).collect();
    let tags = ["type_symbol", "Cartn_x", "Cartn_y", "Cartn_z", "label_alt_id", "label_atom_id"]
        .map(|tag| format!("_atom_site.{tag}\n"))
        .concat();
    let rows: String = (0..count).map(|index| format!("C 0 0 0 A {}\n", name(index))).collect();
    for text in [pdb, format!("data_x\nloop_\n{tags}{rows}")] {
        assert_eq!(soon(|| good(text)).spheres().len(), count as usize);
    }
}

#[test]
fn coordinates_are_finite_numbers() {
    assert_eq!(
        error("1\n\nH 0 nan 0\n"),
        "f:3:5: y is \"nan\", which is not finite in single precision"
    );
    wrong("1\n\nH inf 0 0\n", "f:3:3: x is");
    wrong("1\n\nH 0 0 1e39\n", "f:3:7: z is");
    assert_eq!(error("1\n\nH 0 0 zero\n"), "f:3:7: z is \"zero\", which is not a number");
    assert_eq!(error("1\n\nH 0 0\n"), "f:3:6: z is missing");
    assert_eq!(error("1\n\n\n"), "f:3:1: an element is missing");
    wrong("x,y,z\n1,NaN,2\n", "f:2:3: y is \"NaN\", which is not finite");
    wrong("x,y,z\n1,,2\n", "f:2:3: y is \"\", which is not a number");
    wrong("x,y,z\n1,2\n", "z is missing");
    let nan: Vec<u8> = [0.0, f32::NAN, 0.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    wrong(npy("<f4", "False", "(1, 3)", &nan), "row 0");
    wrong(PDB.replace("  11.104", "     nan"), "f:4:31: x is");
}

/// The largest numbers there are can be drawn.
#[test]
fn far_away_is_no_error() {
    let scene = good("2\n\nH 1e38 0 0\nH -1e38 0 3e38\n");
    assert!(scene.first_view(1.0).eye.is_finite());
    assert_eq!(good("x,y,z\n1e38,0,0\n-1e38,3e38,0\n").spheres().len(), 2);
}

#[test]
fn properties_that_lie() {
    for (properties, atom, part) in [
        ("species:S:1:forces:R:3", "H 0 0 0", "f:2:12: Properties="),
        ("species:S:1:pos:R:2", "H 0 0", "positions have 3"),
        ("species:S:1:pos:R", "H 0 0 0", "not name:type:columns"),
        ("species:S:one:pos:R:3", "H 0 0 0", "is not name:type:columns"),
        ("species:Q:1:pos:R:3", "H 0 0 0", "is not name:type:columns"),
        ("pos:R:3:position:R:3", "0 0 0 0 0 0", "\"position\" names a second position"),
        ("species:S:1:pos:R:3:q:R:1", "H 0 0 0", "f:3:8: q is missing"),
        ("species:S:1:pos:R:3", "H 0 0 0 7", "f:3:9: more columns"),
        ("species:S:1:pos:R:3:v:R:99999999999", "H 0 0 0", "is not name:type:columns"),
        ("species:S:1:pos:R:3:radius:R:1", "H 0 0 0 -1", "negative"),
    ] {
        wrong(format!("1\nProperties={properties}\n{atom}\n"), part);
    }
}

/// So many bytes without an end of line, made as they are read.
struct Endless {
    left: u64,
    head: &'static [u8],
}

impl Read for Endless {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        if !self.head.is_empty() {
            return self.head.read(bytes);
        }
        let count = self.left.min(bytes.len() as u64) as usize;
        bytes[..count].fill(b'7');
        self.left -= count as u64;
        Ok(count)
    }
}

#[test]
fn ten_gigabytes_in_a_line() {
    for (head, place) in [
        ("", "f:1:1: "),
        ("1\n\nH ", "f:3:1: "),
        ("x,y,z\n", "f:2:1: "),
        ("data_x\n_a ", "f:2:1: "),
        ("HEADER\nATOM", "f:2:1: "),
    ] {
        let endless = Endless { left: 10_000_000_000, head: head.as_bytes() };
        let message = read(Box::new(endless), "f", None).expect_err("endless").to_string();
        assert!(
            message.starts_with(place) && message.ends_with("a line of more than 16 MiB"),
            "{message}"
        );
    }
    let endless = Endless { left: 10_000_000_000, head: b"" };
    let mut input = Input::of_reader(Box::new(endless), "f").expect("an input");
    assert!(input.line().is_err());
    assert!(input.room() <= 4 * LONGEST_LINE, "{}", input.room());
}

#[test]
fn damaged_and_growing_gz() {
    let text: String =
        (0..5000).map(|index| format!("H {index} 0 {}\n", index * 7919 % 1000)).collect();
    let whole = gz(format!("5000\n\n{text}").as_bytes());
    // The end of a pipe is not waited for once the frame is whole.
    for length in [whole.len() - 9, whole.len() - 1] {
        let message = error_in(&mut film("cut.xyz.gz", &whole[..length]), 0);
        assert!(message.contains("the compressed data ends early"), "{length}: {message}");
    }
    for length in [11, whole.len() / 2] {
        let message = error(&whole[..length]);
        assert!(
            message.starts_with("f:") && message.contains("the compressed data ends early"),
            "{length}: {message}"
        );
    }
    let mut damaged = whole.clone();
    for byte in &mut damaged[whole.len() / 2..whole.len() / 2 + 40] {
        *byte ^= 0x55;
    }
    assert!(film("damaged.xyz.gz", &damaged).read(0).is_err());
    let bz = bz2(text.as_bytes());
    assert!(scene(&bz[..bz.len() / 2]).is_err());
    // A gigabyte of zeros in a megabyte, and lines that never end to come.
    let zeros = gz(&vec![b'\n'; 1 << 20]);
    let bomb: Vec<u8> = std::iter::repeat_n(zeros, 40).flatten().collect();
    wrong([gz(b"data_x\n"), bomb].concat(), "grows to more than 200 times its size");
}

#[test]
fn an_empty_model() {
    let empty = "MODEL        1\nENDMDL\n".to_owned();
    let scene = good(empty.clone() + &PDB[PDB.find("MODEL").expect("a model")..]);
    assert_eq!(scene.spheres().len(), 3);
    assert_eq!(error(empty), "f: no ATOM and no HETATM");
    assert_eq!(error("data_x\n_a.b c\n"), "f: no loop over _atom_site");
    let axes = "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n";
    wrong(format!("data_x\nloop_\n{axes}#\n"), "f: no");
    let ply = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n";
    wrong(ply, "no vertices");
    wrong(npy("<f4", "False", "(0, 3)", b""), "without rows");
    wrong("x,y,z\n", "no line with numbers");
    wrong("<robot name='r'/>", "without spheres");
}

#[test]
fn arrays_that_lie() {
    wrong(npy("<f4", "False", "(4611686018427387904, 4)", b""), "any file");
    wrong(npy("<f4", "False", "(1000000000, 4)", b""), "fewer bytes");
    wrong(npy("<f4", "True", "(1000000000, 4)", b""), "fewer bytes");
    wrong(npy("<f4", "False", "(1, 4)", &[0; 17]), "more bytes");
    wrong(npy("<i4", "False", "(1, 4)", &[0; 16]), "float32 or float64");
    wrong(npy("<f4", "False", "(1, 5)", &[0; 20]), "(N, 3) or (N, 4)");
    wrong(npy("<f4", "False", "(4,)", &[0; 16]), "two dimensions");
    let of_python_2 = error(npy("<f4", "False", "(1L, 4L)", &[0; 16]));
    assert_eq!(of_python_2, "f: the header is not a Python 3 dictionary");
    let minus_one = [0.0_f32, 0.0, 0.0, -1.0].map(f32::to_le_bytes).concat();
    wrong(npy("<f4", "False", "(1, 4)", &minus_one), "radius");
    // The parser would take a time that grows as a power of the depth.
    for part in ["[", "{", "((),", "[')',"] {
        let nested = part.repeat(900 / part.len());
        wrong(npy("<f4", "False", &nested, b""), "brackets is not that of a plain array");
    }
}

#[test]
fn a_trajectory_that_is_none() {
    let frame = |magic: u32, atoms: u32, again: u32, rest: &[u8]| {
        let mut bytes = magic.to_be_bytes().to_vec();
        bytes.extend(atoms.to_be_bytes());
        bytes.extend([0; 44]);
        bytes.extend(again.to_be_bytes());
        bytes.extend(rest);
        bytes
    };
    let three: Vec<u8> = [0.1_f32, 0.2, 0.3].iter().flat_map(|value| value.to_be_bytes()).collect();
    assert_eq!(centers(&good(frame(1995, 1, 1, &three))), [[0.1 * 10.0, 0.2 * 10.0, 0.3 * 10.0]]);
    wrong(frame(1995, 1, 2, &three), "two numbers of atoms");
    wrong(frame(1995, 2, 2, &three), "ends within a frame");
    let huge = [vec![0; 32], 100_u32.to_be_bytes().to_vec(), vec![0; 100]].concat();
    let billions = frame(1995, 4_000_000_000, 4_000_000_000, &huge);
    wrong(billions, "4000000000 atoms in 100 bytes");
    let longest = [&[0; 32][..], &[0xff; 8]].concat();
    let longest = frame(2023, u32::MAX, u32::MAX, &longest);
    wrong(longest, "4294967295 atoms in 18446744073709551615 bytes");
    // Atoms at one point take two bits each; of more than a million each takes a byte.
    let (precision, step) = (1_f32.to_be_bytes(), 9_u32.to_be_bytes());
    let one_point =
        |bytes: u32| [&precision[..], &[0; 24], &step, &bytes.to_be_bytes(), &[0; 100]].concat();
    assert_eq!(good(frame(1995, 400, 400, &one_point(100))).spheres().len(), 400);
    for (atoms, bytes) in [(800, 100), (401, 100), (1_000_004, 1_000_000)] {
        let lie = frame(1995, atoms, atoms, &one_point(bytes));
        wrong(lie, &format!("{atoms} atoms in {bytes} bytes"));
    }
    let noise = |seed: u8| {
        let noise: Vec<u8> = (0..136_u32)
            .map(|index| (index.wrapping_mul(2_654_435_761) >> 13) as u8 ^ seed)
            .collect();
        let noise = [&noise[..32], &100_u32.to_be_bytes(), &noise[36..]].concat();
        scene(frame(1995, 100, 100, &noise))
    };
    assert!(noise(0).is_err());
    // Nothing panics.
    for seed in 1..50 {
        let _ = noise(seed);
    }
}

#[test]
fn what_is_known_and_not_read() {
    wrong(b"PK\x03\x04............", "zip archive");
    wrong(b"\x89HDF\r\n\x1a\n", "HDF5");
    let unknown = "unknown format; --format names one of toml, xyz, pdb";
    wrong("//! Some text, of a program.\nfn main() {}\n", unknown);
    wrong("<html></html>", "no <robot>");
    wrong("a,b,c\n1,2,3\n", "--columns names others");
    wrong("data_x\nloop_\n_atom_site_fract_x\n0.5\n", "fractions");
    let component =
        "data_ALA\nloop_\n_chem_comp_atom.atom_id\n_chem_comp_atom.model_Cartn_x\nN 2.281\n";
    wrong(component, "f: components without positions");
}
