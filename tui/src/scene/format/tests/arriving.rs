use super::*;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::fs::rename;
use std::io::{self, Read};

/// A pipe that has brought so much, in parts of so many bytes. Who asks it for more waits, perhaps for ever.
struct Brought {
    bytes: Cursor<Vec<u8>>,
    part: usize,
}

impl Read for Brought {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let part = bytes.len().min(self.part);
        let read = self.bytes.read(&mut bytes[..part])?;
        assert!(read > 0, "more is waited for");
        Ok(read)
    }
}

#[test]
fn a_pipe_s_frame_is_there_before_the_next_has_come() {
    let xyz = "2\nwater\nO 0 0 0\nH 1 0 0\n";
    let extended = "2\nProperties=species:S:1:pos:R:3\nO 0 0 0\nH 1 0 0\n";
    let atom = |x: f32| {
        format!("ATOM      1  C   ALA A   1    {x:8.3}   0.000   0.000  1.00  0.00           C\n")
    };
    let pdb = format!("MODEL        1\n{}{}ENDMDL\n", atom(0.0), atom(1.0));
    // Only what follows tells that its table has ended.
    let mmcif = "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n\
        _atom_site.Cartn_z\nC 0 0 0\nC 1 0 0\nloop_\n";
    let gro = "t\n 2\n    1SOL     OW    1   0.000   0.000   0.000\n    1SOL    HW1    2   1.000   0.000   0.000\n   1 1 1\n";
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id type x y z\n1 1 0 0 0\n2 1 1 0 0\n";
    let mercury = "2 0 0 0 5 5\n0 0 0 0 0.5 0 0 0\n1 0 0 0 0.5 0 0 0\n";
    for (format, frame) in [
        (Format::Xyz, xyz.into()),
        (Format::Xyz, extended.into()),
        (Format::Pdb, pdb.into_bytes()),
        (Format::Mmcif, mmcif.into()),
        (Format::Gro, gro.into()),
        (Format::LammpsDump, dump.into()),
        (Format::Mercury, mercury.into()),
        (Format::Xtc, xtc(&[0.0, 1.0])),
    ] {
        for (part, asked) in
            [(7, None), (7, Some(format)), (usize::MAX, None), (usize::MAX, Some(format))]
        {
            let pipe = Brought { bytes: Cursor::new(frame.clone()), part };
            let input = Input::of_reader(Box::new(pipe), "-").expect("a pipe");
            let reading = Reading { format: asked, ..Reading::default() };
            let film = frames(input, &reading);
            let mut film = film.unwrap_or_else(|error| panic!("{format:?}: {error}"));
            let scene = film.read(0).unwrap_or_else(|error| panic!("{format:?}: {error}"));
            assert_eq!(scene.map(|scene| scene.spheres().len()), Some(2), "{format:?}");
        }
    }
}

/// However little it holds.
#[test]
fn a_compressed_file_that_grows() {
    let xyz = |x: u8| format!("1\n\nC {x} 0 0\n").into_bytes();
    for (name, [first, second]) in
        [("live.xyz.gz", [0, 1].map(xyz)), ("live.xtc.gz", [0.0, 1.0].map(|x| xtc(&[x, 5.0])))]
    {
        let (half, most) = (second.len() / 2, second.len() - 4);
        let parts: [&[u8]; 5] =
            [b"", &first, &second[..half], &second[half..most], &second[most..]];
        let mut writer = GzEncoder::new(Vec::new(), Compression::best());
        let lengths = parts.map(|part| {
            writer.write_all(part).expect("memory");
            writer.flush().expect("memory");
            writer.get_ref().len()
        });
        let whole = writer.finish().expect("memory");
        let film = &mut followed(name, &whole[..lengths[0]]);
        let lengths = [lengths.as_slice(), &[whole.len()]].concat();
        for (length, there) in lengths.into_iter().zip([0, 1, 1, 1, 2, 2]) {
            written(name, &whole[..length]);
            for index in 0..3 {
                let is_there = frame(film, index).is_some();
                assert_eq!(is_there, index < there, "{name}: {index} after {length}");
            }
        }
    }
}

/// One that is cut, too: nothing more comes to it, which is told behind what is there.
#[test]
fn a_compressed_file_that_is_cut_has_frames() {
    let text: String =
        (0..50).map(|index| format!("1\n\nC {index} {} 0\n", index * 7919 % 1000)).collect();
    let whole = gz(text.as_bytes());
    let film = &mut film("cut-film.xyz.gz", &whole[..whole.len() - 9]);
    assert!(frame(film, 0).is_some());
    let message = error_in(film, 50);
    assert!(message.contains("the compressed data ends early"), "{message}");
}

/// Frames of an atom.
fn atoms(count: usize) -> String {
    (0..count).map(|index| format!("1\n\nC {index} 0 0\n")).collect()
}

/// Who copies a file over another cuts it, and it grows again; others put a new one in its place.
#[test]
fn a_file_that_is_written_anew_goes_on_where_it_was() {
    let copy = |count: usize| written("anew.xyz", atoms(count));
    let path = copy(3);
    let replace = |text: String| rename(written("anew.new", text), &path).expect("the file");
    let frames = &mut followed("anew.xyz", atoms(3));
    let mut x = |index| centers_in(frames, index).map(|centers| centers[0][0]);
    // All three are in the buffer then.
    assert_eq!(x(0), Some(0.0));
    for count in [0, 1] {
        copy(count);
        assert_eq!(x(1), None, "{count}");
    }
    copy(3);
    assert_eq!([x(1), x(2), x(3)], [Some(1.0), Some(2.0), None]);
    for count in [0, 2, 3] {
        copy(count);
        assert_eq!(x(3), None, "{count}");
    }
    copy(4);
    assert_eq!([x(3), x(4)], [Some(3.0), None]);
    replace(atoms(2));
    assert_eq!([x(4), x(0)], [None, None]);
    replace(atoms(5));
    assert_eq!([x(4), x(0), x(5)], [Some(4.0), Some(0.0), None]);
    replace(atoms(6).replace('C', "O"));
    let what = "the file was written anew, with other contents";
    assert_eq!(error_in(frames, 5), format!("{}: {what}", path.display()));
}

#[test]
fn a_file_that_was_empty_may_be_compressed() {
    let frames = &mut followed("empty.xyz.gz", "");
    assert!(frame(frames, 0).is_none());
    written("empty.xyz.gz", gz(atoms(50).as_bytes()));
    for index in 0..=50 {
        assert_eq!(frame(frames, index).is_some(), index < 50, "{index}");
    }
}
