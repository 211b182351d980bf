use super::*;
use crate::scene::input::Input;
use crate::scene::reading::frames;
use flate2::Compression;
use flate2::write::GzEncoder;
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
        let reading = Reading { follow: true, ..Reading::default() };
        let film = &mut frames_of(name, &whole[..lengths[0]], &reading);
        let lengths = [lengths.as_slice(), &[whole.len()]].concat();
        for (length, there) in lengths.into_iter().zip([0, 1, 1, 1, 2, 2]) {
            file(name, &whole[..length]);
            for index in 0..3 {
                let scene = film.read(index).unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!(scene.is_some(), index < there, "{name}: {index} after {length}");
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
    let film = &mut frames_of("cut-film.xyz.gz", &whole[..whole.len() - 9], &Reading::default());
    assert!(film.read(0).unwrap_or_else(|error| panic!("{error}")).is_some());
    let message = film.read(50).expect_err("cut").to_string();
    assert!(message.contains("the compressed data ends early"), "{message}");
}
