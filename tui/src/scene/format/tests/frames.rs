use super::*;
use crate::coloring::seen::Seen;
use crate::coloring::{ColorBy, coloring};
use clap::ValueEnum;

fn xyz(frames: usize) -> String {
    let frame = |index: usize| {
        let atoms: String = (0..=index).map(|atom| format!("C {index} {atom} 0\n")).collect();
        format!("{}\nframe {index}\n{atoms}", index + 1)
    };
    (0..frames).map(frame).collect()
}

fn first_x(frames: &mut Frames, index: usize) -> Option<f32> {
    let centers = centers_in(frames, index)?;
    assert_eq!(centers.len(), index + 1, "the count of atoms changes");
    Some(centers[0][0])
}

#[test]
fn in_any_order_plain_and_compressed() {
    let text = xyz(20);
    for (name, bytes) in [
        ("f.xyz", text.clone().into_bytes()),
        ("f.xyz.gz", gz(text.as_bytes())),
        ("f.xyz.bz2", bz2(text.as_bytes())),
    ] {
        let frames = &mut film(name, bytes);
        for index in [0, 1, 7, 3, 19, 0, 18, 19, 2] {
            assert_eq!(first_x(frames, index), Some(index as f32), "{name}");
        }
        assert_eq!(first_x(frames, 20), None);
        assert_eq!(first_x(frames, 400), None);
        assert_eq!(first_x(frames, 5), Some(5.0));
        assert!(frames.has(19).expect("no error") && !frames.has(20).expect("no error"));
    }
}

/// However far behind it a frame is asked for.
#[test]
fn the_end_tells_how_many_there_are() {
    let follow = Reading { follow: true, ..Reading::default() };
    for (reading, count) in [(Reading::default(), Some(3)), (follow, None)] {
        let frames = &mut frames_of("count.xyz", xyz(3).as_bytes(), &reading);
        assert_eq!((first_x(frames, 60), frames.count()), (None, count));
        assert_eq!((first_x(frames, 2), frames.at()), (Some(2.0), 3));
        assert_eq!((first_x(frames, 3), frames.count()), (None, count));
    }
    let table = &mut film("count.csv", "x,y,z\n1,2,3\n");
    assert!(table.read(60).expect("no error").is_none());
    assert_eq!(table.count(), Some(1));
    assert!(table.read(0).expect("no error").is_some());
}

/// Whatever else is written to it.
#[test]
fn a_table_that_is_followed_has_one_frame() {
    for index in [0, 3] {
        let table = &mut followed("one.csv", "x,y,z\n1,2,3\n");
        assert_eq!((table.count(), table.follows()), (None, true));
        assert_eq!(table.read(index).expect("no error").is_some(), index == 0);
        assert_eq!((table.count(), table.follows()), (Some(1), false));
        assert!(table.read(1).expect("no error").is_none());
    }
}

fn piped(text: String, format: Format, follows: bool) -> Frames {
    let input = Input::of_reader(Box::new(Cursor::new(text)), "-");
    Frames::new(input.expect("a pipe"), format, Default::default(), follows)
}

#[test]
fn a_pipe_goes_forward() {
    let mut frames = piped(xyz(300), Format::Xyz, false);
    assert_eq!((first_x(&mut frames, 0), first_x(&mut frames, 250)), (Some(0.0), Some(250.0)));
    assert!(!frames.can_go_back());
}

/// With its last line complete or not: nothing more comes out of it.
#[test]
fn a_pipe_that_is_followed_ends_where_it_ends() {
    for text in [xyz(2), xyz(2).trim_end().to_owned()] {
        let frames = &mut piped(text, Format::Xyz, true);
        assert_eq!((first_x(frames, 0), first_x(frames, 1)), (Some(0.0), Some(1.0)));
        assert_eq!((first_x(frames, 2), frames.follows()), (None, false));
    }
}

#[test]
fn a_frame_that_is_none_has_its_line() {
    let text = xyz(2) + "3\nframe 2\nC 0 0 0\nC 0 0\n";
    let frames = &mut film("broken.xyz", text);
    assert_eq!(first_x(frames, 1), Some(1.0));
    let message = error_in(frames, 2);
    assert!(message.contains("broken.xyz:11:"), "{message}");
}

/// A frame that is being written is not there before its last line has an end.
#[test]
fn a_file_that_grows() {
    let (two, three) = (xyz(2), xyz(3));
    let frames = &mut followed("grows.xyz", &two);
    let path = written("grows.xyz", &two);
    assert_eq!((first_x(frames, 0), first_x(frames, 1)), (Some(0.0), Some(1.0)));
    let more = &three.as_bytes()[two.len()..];
    for (index, byte) in more.iter().enumerate() {
        assert_eq!(first_x(frames, 2), None, "after {index} bytes");
        append(&path, &[*byte]);
    }
    assert_eq!(first_x(frames, 2), Some(2.0));
    assert_eq!(first_x(frames, 3), None);
}

#[test]
fn an_empty_file_that_is_followed_has_no_frame_yet() {
    for &format in Format::value_variants().iter().filter(|format| format.has_frames()) {
        let reading = Reading { format: Some(format), follow: true, ..Reading::default() };
        let frames = &mut frames_of(&format!("empty.{format:?}"), b"", &reading);
        assert!(frame(frames, 0).is_none(), "{format:?}");
    }
}

/// Where lines end, half a model is not a frame yet.
#[test]
fn a_model_that_grows_is_a_frame_once_it_is_whole() {
    let atom = |x: f32, y: f32| {
        format!("ATOM      1  C   ALA A   1    {x:8.3}{y:8.3}   0.000  1.00  0.00           C\n")
    };
    let model = |x: f32| format!("MODEL        1\n{}{}", atom(x, 0.0), atom(x, 1.0));
    let pdb = format!("{}ENDMDL\n{}ENDMDL\n", model(0.0), model(1.0));
    let table = "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n\
        _atom_site.Cartn_z\n_atom_site.pdbx_PDB_model_num\n";
    let rows = "C 0 0 0 1\nC 0 1 0 1\nC 1 0 0 2\nC 1 1 0 2\n";
    let expected: [[[f32; 3]; 2]; 2] =
        [[[0.0; 3], [0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]];
    for (name, head, rest) in [
        ("growing.pdb", "HEADER    TEST\n", pdb),
        ("commented.cif", table, format!("{rows}#\n")),
        ("growing.cif", table, format!("{rows}loop_\n")),
        (
            "growing-blocks.cif",
            table,
            format!("C 0 0 0 1\nC 0 1 0 1\n#\n{table}C 1 0 0 1\nC 1 1 0 1\n#\n"),
        ),
    ] {
        let frames = &mut followed(name, head);
        let path = written(name, head);
        let mut seen = Vec::new();
        for byte in rest.bytes() {
            append(&path, &[byte]);
            seen.extend(centers_in(frames, seen.len()));
        }
        assert_eq!(seen, expected, "{name}");
    }
    // Nothing more comes to a file that is not followed.
    assert_eq!(centers(&good(model(0.0))), expected[0]);
    assert_eq!(centers(&good(format!("{table}C 0 0 0 1\nC 0 1 0 1\n"))), expected[0]);
}

#[test]
fn dumps_pdb_gro_and_mmcif_have_frames() {
    let dump = dump(BOUNDS, "id type x y z", "1 1 @ 0 0\n");
    let gro = "t\n 1\n    1SOL     OW    1   @.000   1.624   1.679\n   1 1 1\n";
    for (name, frame, scale) in [("a.dump", &*dump, 1.0), ("a.gro", gro, 10.0)] {
        let text: String = (0..5).map(|index| frame.replace('@', &index.to_string())).collect();
        let frames = &mut film(name, text);
        for index in [0, 4, 2] {
            let centers = centers_in(frames, index).expect("a frame");
            assert_eq!(centers[0][0], scale * index as f32, "{name}");
        }
        assert!(frames.read(5).expect("no error").is_none());
    }
}

/// A frame of a dump with these atoms: id, molecule, type, x, y, z.
fn molecules(atoms: &[&str]) -> String {
    let rows: String = atoms.iter().map(|atom| format!("{atom}\n")).collect();
    dump(BOUNDS, "id mol type x y z", &rows)
}

/// LAMMPS writes atoms in any order, and they come and go.
#[test]
fn types_keep_their_colours() {
    let atoms = ["1 5 1 0 0 0", "2 4 2 9 0 0", "3 4 9 5 0 0"];
    let reversed = [atoms[2], atoms[1], atoms[0]];
    let text = molecules(&atoms) + &molecules(&reversed) + &molecules(&atoms[1..]);
    let frames = &mut film("types.dump", text);
    let [first, other_order, without_one] =
        [0, 1, 2].map(|index| frame(frames, index).expect("a frame"));
    assert_eq!(other_order.colors(), first.colors());
    assert_eq!(without_one.colors(), &first.colors()[1..]);
    for by in [Naming::Type, Naming::Molecule].map(ColorBy::Names) {
        let seen = &mut Seen::default();
        let mut colored = |scene| coloring(scene, &by, None, seen).expect("colours");
        let all = colored(&first);
        assert_eq!(colored(&other_order), all, "{by:?}");
        let (some, all) = (colored(&without_one).colors, all.colors.expect("its own"));
        assert_eq!(some.as_deref(), Some(&all[1..]), "{by:?}");
    }
}

#[test]
fn a_frame_of_a_dump_without_atoms_is_passed_over_unless_it_is_shown() {
    let text = molecules(&["1 1 1 0 0 0"]) + &molecules(&[]) + &molecules(&["1 1 1 2 0 0"]);
    let frames = &mut film("none.dump", text);
    assert_eq!(centers_in(frames, 2), Some(vec![[2.0, 0.0, 0.0]]));
    let message = error_in(frames, 1);
    assert!(message.ends_with("none.dump:14:1: a frame without atoms"), "{message}");
}

/// A frame of GRO with one atom.
fn gro(title: &str, x: usize) -> String {
    format!("{title}\n    1\n    1SOL     OW    1   {x}.000   1.624   1.679\n   1 1 1\n")
}

fn gro_x(frames: &mut Frames, index: usize) -> Option<f32> {
    centers_in(frames, index).map(|centers| centers[0][0])
}

#[test]
fn a_title_of_gro_may_be_blank() {
    // Blank lines before a title and at the end are no titles.
    let text = gro("", 0) + &gro("  ", 1) + &gro("t", 2) + "\n" + &gro("t", 3) + "\n \n";
    let frames = &mut film("blank.gro", &text);
    for index in [0, 1, 2, 3, 1, 0, 3] {
        assert!(frames.has(index).expect("no error"));
        assert_eq!(gro_x(frames, index), Some(10.0 * index as f32));
    }
    assert!(!frames.has(4).expect("no error"));
    assert_eq!(gro_x(frames, 4), None);
    let mut pipe = piped(text, Format::Gro, false);
    let found: Vec<_> = (0..5).map(|index| gro_x(&mut pipe, index)).collect();
    assert_eq!(found, [Some(0.0), Some(10.0), Some(20.0), Some(30.0), None]);
}

/// While a blank title is all that has been written of a frame, it is not taken for the end.
#[test]
fn a_gro_file_that_grows() {
    let path = written("grows.gro", gro("", 0));
    let frames = &mut followed("grows.gro", gro("", 0));
    assert_eq!(gro_x(frames, 0), Some(0.0));
    for (index, byte) in gro("", 1).bytes().enumerate() {
        assert_eq!(gro_x(frames, 1), None, "after {index} bytes");
        append(&path, &[byte]);
    }
    assert_eq!(gro_x(frames, 1), Some(10.0));
}

/// Nor are there notes about a frame that is only asked for.
#[test]
fn what_follows_the_last_model_is_no_frame() {
    let end = "ENDMDL\nCONECT    1    2\nEND\n";
    let pdb = |models: usize| {
        let atom = "ATOM      1  N   ALA A   1      11.104   6.134  -6.504\n";
        vec![format!("MODEL        1\n{atom}"); models].join("ENDMDL\n") + end
    };
    let mmcif = |models: usize| {
        let atoms: String = (1..=models).map(|model| format!("N 1 2 3 {model}\n")).collect();
        let head = ["type_symbol", "Cartn_x", "Cartn_y", "Cartn_z", "pdbx_PDB_model_num"]
            .map(|column| format!("_atom_site.{column}\n"))
            .concat();
        format!("data_X\nloop_\n{head}{atoms}#\nloop_\n_x.y\n_x.z\n1 2\n3 4\n#\n_u.v 5\n")
    };
    for (name, text) in [("models.pdb", [1, 2].map(pdb)), ("models.cif", [1, 2].map(mmcif))] {
        for (text, models) in text.iter().zip(1..) {
            let frames = &mut film(name, text);
            assert!(frames.read(0).expect("no error").is_some());
            assert_eq!(frames.has(1).expect("no error"), models == 2, "{text}");
            assert!(frames.notes().is_empty());
            assert!(!frames.has(2).expect("no error"));
            assert_eq!(frames.read(1).expect("no error").is_some(), models == 2, "{text}");
        }
    }
}
