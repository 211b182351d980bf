use super::*;
use std::fs::OpenOptions;

fn xyz(frames: usize) -> String {
    let frame = |index: usize| {
        let atoms: String = (0..=index).map(|atom| format!("C {index} {atom} 0\n")).collect();
        format!("{}\nframe {index}\n{atoms}", index + 1)
    };
    (0..frames).map(frame).collect()
}

fn first_x(frames: &mut Frames, index: usize) -> Option<f32> {
    let scene = frames.read(index).unwrap_or_else(|error| panic!("{error}"))?;
    assert_eq!(scene.spheres().len(), index + 1, "the count of atoms changes");
    Some(centers(&scene)[0][0])
}

#[test]
fn in_any_order_plain_and_compressed() {
    let text = xyz(20);
    for (name, bytes) in [
        ("f.xyz", text.clone().into_bytes()),
        ("f.xyz.gz", gz(text.as_bytes())),
        ("f.xyz.bz2", bz2(text.as_bytes())),
    ] {
        let frames = &mut frames_of(name, &bytes, &Reading::default());
        for index in [0, 1, 7, 3, 19, 0, 18, 19, 2] {
            assert_eq!(first_x(frames, index), Some(index as f32), "{name}");
        }
        assert_eq!(first_x(frames, 20), None);
        assert_eq!(first_x(frames, 400), None);
        assert_eq!(first_x(frames, 5), Some(5.0));
        assert!(frames.has(19).expect("no error") && !frames.has(20).expect("no error"));
    }
}

#[test]
fn a_pipe_goes_forward() {
    let input =
        crate::scene::input::Input::of_reader(Box::new(Cursor::new(xyz(300).into_bytes())), "-");
    let mut frames = Frames::new(input.expect("a pipe"), Format::Xyz, Default::default(), false);
    assert_eq!((first_x(&mut frames, 0), first_x(&mut frames, 250)), (Some(0.0), Some(250.0)));
    assert!(!frames.can_go_back());
}

#[test]
fn a_frame_that_is_none_has_its_line() {
    let text = xyz(2) + "3\nframe 2\nC 0 0 0\nC 0 0\n";
    let frames = &mut frames_of("broken.xyz", text.as_bytes(), &Reading::default());
    assert_eq!(first_x(frames, 1), Some(1.0));
    let message = frames.read(2).expect_err("broken").to_string();
    assert!(message.contains("broken.xyz:11:"), "{message}");
}

/// A frame that is being written is not there before its last line has an end.
#[test]
fn a_file_that_grows() {
    let (two, three) = (xyz(2), xyz(3));
    let reading = Reading { follow: true, ..Reading::default() };
    let frames = &mut frames_of("grows.xyz", two.as_bytes(), &reading);
    let path = file("grows.xyz", two.as_bytes());
    assert_eq!((first_x(frames, 0), first_x(frames, 1)), (Some(0.0), Some(1.0)));
    let more = &three.as_bytes()[two.len()..];
    for (index, byte) in more.iter().enumerate() {
        assert_eq!(first_x(frames, 2), None, "after {index} bytes");
        let mut file = OpenOptions::new().append(true).open(&path).expect("a file");
        file.write_all(&[*byte]).expect("written");
    }
    assert_eq!(first_x(frames, 2), Some(2.0));
    assert_eq!(first_x(frames, 3), None);
}

#[test]
fn dumps_pdb_gro_and_mmcif_have_frames() {
    let dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n1 1 @ 0 0\n";
    let gro = "t\n 1\n    1SOL     OW    1   @.000   1.624   1.679\n   1 1 1\n";
    for (name, frame, scale) in [("a.dump", dump, 1.0), ("a.gro", gro, 10.0)] {
        let text: String = (0..5).map(|index| frame.replace('@', &index.to_string())).collect();
        let frames = &mut frames_of(name, text.as_bytes(), &Reading::default());
        for index in [0, 4, 2] {
            let scene =
                frames.read(index).unwrap_or_else(|error| panic!("{error}")).expect("a frame");
            assert_eq!(centers(&scene)[0][0], scale * index as f32, "{name}");
        }
        assert!(frames.read(5).expect("no error").is_none());
    }
}
