use super::*;

#[test]
fn mmcif_by_the_names_of_columns() {
    let text = "data_X\n#\n_entry.id X\n_struct.title\n;many\nlines\n;\nloop_\n_atom_site.group_PDB\n_atom_site.type_symbol\n\
        _atom_site.Cartn_z\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.auth_asym_id\n_atom_site.label_alt_id\n\
        _atom_site.label_atom_id\n_atom_site.auth_comp_id\n_atom_site.auth_seq_id\n_atom_site.pdbx_PDB_model_num\n\
        ATOM C 3 1 2.5(3) AA . \"C1'\" DA 7 1\nATOM N 6 4 5 AA A N DA 7 1\nATOM N 9 4 5 AA B N DA\n7 1\n\
        ATOM O 30 10 20 AB . O DA 7 2\n#\nloop_\n_x.y\n1\n";
    let scene = good(text);
    assert_eq!(centers(&scene), [[1.0, 2.5, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(scene.label(0).as_deref(), Some("C1' DA 7 AA"));
    let frames = &mut film("by-names.cif", text);
    assert_eq!(centers_in(frames, 1), Some(vec![[10.0, 20.0, 30.0]]));
    assert!(frame(frames, 2).is_none());
    assert_eq!(frame(frames, 0).map(|scene| scene.spheres().len()), Some(2));
}

#[test]
fn mmcif_residues_are_told_apart_by_their_insertion_codes() {
    let table = "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n\
        _atom_site.auth_asym_id\n_atom_site.auth_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.label_alt_id\n\
        _atom_site.label_atom_id\n";
    let rows =
        "C 1 0 0 H 52 ? A CA\nC 2 0 0 H 52 ? B CA\nC 3 0 0 H 52 A A CA\nC 4 0 0 H 52 A B CA\n";
    let scene = good(format!("{table}{rows}"));
    assert_eq!(centers(&scene), [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
}

#[test]
fn mmcif_blank_lines_and_comments_do_not_end_a_model() {
    let text = "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n\
        C 1 0 0\n\nC 2 0 0\n# a comment\n  # and one more\nC 3\n\n# within a row\n0 0\n#\nloop_\n_x.y\n_x.z\n1\n2\n";
    let frames = &mut film("comments.cif", text);
    let expected = vec![[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    assert_eq!(centers_in(frames, 0), Some(expected));
    // However often one asks: the next table is not read as atoms.
    for _ in 0..4 {
        assert!(frame(frames, 1).is_none());
    }
}

/// As of several models that are saved together; each block has columns of its own.
#[test]
fn mmcif_blocks_are_frames() {
    let table = |axes: [char; 3], rows: &str| {
        let tags = axes.map(|axis| format!("_atom_site.Cartn_{axis}\n")).concat();
        let tags = format!("_atom_site.type_symbol\n_atom_site.pdbx_PDB_model_num\n{tags}");
        format!("#\nloop_\n{tags}{rows}#\n")
    };
    let one = "data_A\n".to_owned() + &table(['x', 'y', 'z'], "C 1 0 0 0\nC 2 1 0 0\n");
    let other = "data_B\n".to_owned() + &table(['z', 'y', 'x'], "C 1 0 0 2\nC 2 0 0 3\n");
    let none = "data_N\n#\nloop_\n_x.y\n_x.z\n1 2\n#\n";
    let no_row = "data_R\n".to_owned() + &table(['x', 'y', 'z'], "");
    for (name, text) in [
        ("blocks.cif", format!("{one}{other}")),
        ("between.cif", format!("{none}{no_row}{one}{none}{no_row}{other}")),
        ("end.cif", format!("{one}{other}{no_row}{none}")),
    ] {
        let frames = &mut film(name, text);
        assert!(frames.has(1).expect("no error"), "{name}");
        for index in [0, 2, 1, 3, 1, 0, 3] {
            let expected = Some(vec![[index as f32, 0.0, 0.0]]);
            assert_eq!(centers_in(frames, index), expected, "{name}");
        }
        for _ in 0..2 {
            assert!(!frames.has(4).expect("no error"), "{name}");
            assert!(frame(frames, 4).is_none(), "{name}");
        }
    }
}

/// What the wwPDB's dictionary says of the atoms of a component.
const OF_ATOMS: [&str; 9] = [
    "comp_id",
    "atom_id",
    "type_symbol",
    "model_Cartn_x",
    "model_Cartn_y",
    "model_Cartn_z",
    "pdbx_model_Cartn_x_ideal",
    "pdbx_model_Cartn_y_ideal",
    "pdbx_model_Cartn_z_ideal",
];

/// A block of that dictionary.
fn component(code: &str, rows: &str) -> String {
    let tags = OF_ATOMS.map(|name| format!("_chem_comp_atom.{name}\n")).concat();
    format!(
        "data_{code}\n#\n_chem_comp.id {code}\n_chem_comp.name\n;several\nlines\n;\n#\nloop_\n{tags}{rows}#\n\
        loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n{code} C\n#\n"
    )
}

/// One of an atom alone, which is no loop.
fn ion(values: &str) -> String {
    let pairs = OF_ATOMS.iter().zip(values.split(' '));
    let lines: String =
        pairs.map(|(name, value)| format!("_chem_comp_atom.{name}   {value} \n")).collect();
    format!("data_ION\n#\n{lines}#\n_chem_comp.id ION\n")
}

/// Where an atom was not seen, its molecule is as computed; where that is not known either, what was seen is drawn.
#[test]
fn mmcif_components_are_frames() {
    let text = [
        component("SEE", "SEE \"C1'\" C 1 2 3 7 8 9\nSEE CL1 CL 4 5 6 7 8 9\n"),
        component("UNL", "UNL C C ? ? ? ? ? ?\n"),
        component("IDE", "IDE C1 C 1 2 3 7 8 9\nIDE H1 H ? ? ? 4 5 6\n"),
        ion("MG MG MG 0.5 0 0 . . ."),
        component("PAR", "PAR C1 C 1 2 3 ? ? ?\nPAR H1 H ? 5 6 ? ? ?\n"),
    ];
    let expected: [&[[f32; 3]]; 4] = [
        &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        &[[7.0, 8.0, 9.0], [4.0, 5.0, 6.0]],
        &[[0.5, 0.0, 0.0]],
        &[[1.0, 2.0, 3.0]],
    ];
    let frames = &mut film("components.cif", text.concat());
    for index in [0, 1, 2, 3, 1, 0, 3, 2] {
        assert!(frames.has(index).expect("no error"));
        assert_eq!(centers_in(frames, index).as_deref(), Some(expected[index]), "{index}");
    }
    assert!(!frames.has(4).expect("no error"));
    assert_eq!(frames.notes(), ["1 atom without a position is left out"]);
    let scene = good(text[0].clone());
    assert_eq!(scene.label(0).as_deref(), Some("C1' SEE"));
    assert_eq!(scene.attributes().elements, Some(vec![6, 17]));
    let library = "data_comp_X\nloop_\n_chem_comp_atom.type_symbol\n_chem_comp_atom.x\n_chem_comp_atom.y\n_chem_comp_atom.z\nO 1 2 3\n";
    assert_eq!(centers(&good(library)), [[1.0, 2.0, 3.0]]);
}

#[test]
fn mmcif_components_of_an_entry_are_no_frames() {
    let component = component("SEE", "SEE C1 C 1 2 3 7 8 9\n");
    let table = "loop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\nN 0 0 1\n#\n";
    let rest = component.strip_prefix("data_SEE\n").expect("its name");
    // Nor does it matter how they are written.
    let tags = ["atom_id", "model_Cartn_x", "model_Cartn_y", "model_Cartn_z", "details"];
    let tags = tags.map(|name| format!("_chem_comp_atom.{name}\n")).concat();
    let text = format!("data_X\nloop_\n{tags}C1 1 2 3\n;a text\n;\n");
    assert_eq!(error(&*text), "f:9:1: a text of many lines among atoms");
    for text in [
        format!("{component}{table}"),
        format!("data_X\n{table}{rest}"),
        format!("{text}{table}"),
        format!("data_X\nloop_ _chem_comp_atom.comp_id\n{tags}SEE C1 1 2 3 .\n{table}"),
        format!("data_X\nloop_\n{tags}C1 1 2 3 . C2 4 5 6 .\n{table}"),
    ] {
        let frames = &mut film("entry.cif", &text);
        assert_eq!(centers_in(frames, 0), Some(vec![[0.0, 0.0, 1.0]]), "{text}");
        assert!(!frames.has(1).expect("no error"), "{text}");
        assert!(frame(frames, 1).is_none(), "{text}");
    }
}

#[test]
fn mmcif_components_that_lie() {
    let what = "\"x\" is not a finite coordinate";
    let loops = component("BAD", "BAD C1 C 1 2 3 7 8 9\nBAD C2 C 1 x 3 7 8 9\n");
    assert_eq!(error(loops), format!("f:20:1: {what}"));
    assert_eq!(error(ion("MG MG MG x 0 0 . . .")), format!("f:11:1: {what}"));
    let none = component("UNL", "UNL C C ? ? ? ? ? ?\n");
    wrong(none, "f: components without positions");
    // One that is still being written, or was cut.
    let whole = component("CUT", "CUT C1 C 1 2 3 7 8 9\nCUT C2 C 1 2 3 7 8\n");
    let (cut, _) = whole.split_once("#\nloop_\n_chem_comp_bond").expect("bonds");
    assert_eq!(error(cut), "f:21:1: the file ends after 8 of 9 values of an atom");
    let text = component("SEE", "SEE C1 C 1 2 3 7 8 9\n") + cut;
    let frames = &mut film("cut.cif", text);
    assert_eq!(centers_in(frames, 0), Some(vec![[1.0, 2.0, 3.0]]));
    assert!(frames.has(1).is_err());
    // What the row lacks is not taken from the next block.
    let text = format!("{cut}{}", component("SEE", "SEE C1 C 1 2 3 7 8 9\n"));
    assert_eq!(error(text), "f:21:1: \"data_SEE\" is not a finite coordinate");
}
