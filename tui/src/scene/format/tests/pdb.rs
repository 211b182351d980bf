use super::*;

#[test]
fn pdb_by_its_columns() {
    let scene = good(PDB);
    assert_eq!(
        centers(&scene),
        [[11.104, 6.134, -6.504], [11.639, 6.071, -5.147], [1.0, 2.0, 3.0]]
    );
    assert_eq!(scene.label(1).as_deref(), Some("CA ALA 1 A"));
    // A000 is what follows 9999.
    assert_eq!(scene.label(2).as_deref(), Some("FE HEM 10000 B"));
    // a000 is what follows ZZZZ.
    let small = good(PDB.replace("BA000", "Ba000"));
    assert_eq!(small.label(2).as_deref(), Some("FE HEM 1223056 B"));
    assert_eq!(scene.attributes().elements, Some(vec![7, 6, 26]));
    assert_eq!(scene.attributes().column("b_factor").map(|b| b.values[1]), Some(11.0));
    let frames = &mut film("alt.pdb", PDB);
    assert_eq!(centers_in(frames, 1), Some(vec![[21.104, 6.134, -6.504]]));
    assert!(frames.read(2).expect("no error").is_none());
    let expected = ["1 atom is left out: alternate locations after the first", "ignored: CONECT"];
    assert_eq!(frames.notes(), expected);
}

#[test]
fn pdb_atoms_without_a_symbol() {
    let expected = [
        ("SOD ", "SOD", 11),
        (" POT", "POT", 19),
        ("POT ", "POT", 19),
        (" CLA", "CLA", 17),
        (" NA ", " NA", 11),
        (" CL ", " CL", 17),
        (" FE2", "FE2", 26),
        (" CA ", "ALA", 6),
        (" NA ", "HEM", 7),
    ];
    let rows = expected.map(|(name, residue, _)| {
        format!(
            "HETATM    1 {name} {residue}    2        0.000   0.000   0.000  0.00  0.00      I\n"
        )
    });
    let elements = expected.map(|(_, _, element)| element).to_vec();
    assert_eq!(good(rows.concat()).attributes().elements, Some(elements));
}

/// As gemmi writes more than 62 chains: in columns 21 and 22. Names of four letters end in column 21, too.
#[test]
fn pdb_chains_of_two_letters() {
    let labels = |atoms: &[(&str, &str)]| -> Vec<String> {
        let row = |(residue, chain): &(&str, &str)| {
            format!(
                "ATOM      1  CA  {residue}{chain}   1       3.000   0.000   0.000  1.00 20.00           C\n"
            )
        };
        let scene = good(atoms.iter().map(row).collect::<String>());
        (0..atoms.len()).filter_map(|atom| Some(scene.label(atom)?.into_owned())).collect()
    };
    let long = [
        ("ALA", " A"),
        ("ALA", "AA"),
        ("HIS", "BA"),
        ("  A", "AB"),
        (" MG", "AB"),
        ("HOH", "AB"),
        ("SOL", " B"),
    ];
    let expected = [
        "CA ALA 1 A",
        "CA ALA 1 AA",
        "CA HIS 1 BA",
        "CA A 1 AB",
        "CA MG 1 AB",
        "CA HOH 1 AB",
        "CA SOL 1 B",
    ];
    assert_eq!(labels(&long), expected);
    for (chain, expected) in [("CA", "CA ALA 1 CA"), ("1B", "CA ALA 1 1B")] {
        assert_eq!(labels(&[("ALA", chain)]), [expected]);
    }
    // As GROMACS and CHARMM write residues.
    let short = [("ALA", " A"), ("CYS", "HA"), ("LYS", "HA"), ("HIS", "BA"), ("TIP", "3B")];
    let expected = ["CA ALA 1 A", "CA CYSH 1 A", "CA LYSH 1 A", "CA HISB 1 A", "CA TIP3 1 B"];
    assert_eq!(labels(&short), expected);
}

/// An atom without a symbol in columns 77 and 78.
fn atom(name: &str, residue: &str) -> String {
    format!(
        "ATOM      1 {name:4} {residue:4}    2       0.000   0.000   0.000  1.00  0.00      4AKE\n"
    )
}

fn elements(atoms: &[(&str, &str)]) -> Option<Vec<u8>> {
    let rows: String = atoms.iter().map(|(name, residue)| atom(name, residue)).collect();
    good(rows).attributes().elements.clone()
}

/// As CHARMM writes them. Which atom shows it, and where that stands, does not matter.
#[test]
fn pdb_names_that_begin_in_the_first_column() {
    let atoms = [
        ("CA", "LIG", 6),
        ("HG1", "LIG", 1),
        ("N", "LIG", 7),
        ("NE", "LIG", 7),
        ("OG", "LIG", 8),
        ("CAL", "CAL", 20),
        ("ZN", "ZN2", 30),
        (" CB", "LIG", 6),
    ];
    let names = atoms.map(|(name, residue, _)| (name, residue));
    assert_eq!(elements(&names), Some(atoms.map(|(_, _, element)| element).to_vec()));
    // Where no atom shows it, a metal is one.
    assert_eq!(elements(&[("CA", "LIG"), (" N", "LIG")]), Some(vec![20, 7]));
    assert_eq!(elements(&[("N", "N"), ("CA", "LIG")]), Some(vec![7, 20]));
}

#[test]
fn pdb_proteins_and_nucleic_acids_have_no_metal() {
    let atoms = [
        ("CA", "MET", 6),
        ("CE", "MET", 6),
        ("HG1", "THR", 1),
        ("HE1", "HSD", 1),
        ("OG", "SER", 8),
        ("1HB", "ALA", 1),
        ("P", "DA", 15),
    ];
    for (name, residue, element) in atoms {
        assert_eq!(elements(&[(name, residue)]), Some(vec![element]), "{name} {residue}");
    }
}

/// Wherever names begin.
#[test]
fn pdb_selenium_stands_for_sulfur() {
    let atoms = [("N", "MSE"), ("SE", "MSE"), ("CE", "MSE"), ("SE", "SEC"), ("SD", "MET")];
    assert_eq!(elements(&atoms), Some(vec![7, 34, 6, 34, 16]));
    assert_eq!(elements(&[("SE", "MSE"), (" SE", "MSE")]), Some(vec![34, 34]));
}

/// As of force fields.
#[test]
fn pdb_symbols_that_are_none_leave_it_to_the_name() {
    let rows = [(" CA ", " C"), (" HN ", "HD"), (" OD1", "OA"), (" CG ", " A"), ("CL  ", "CL")];
    let rows = rows.map(|(name, symbol)| {
        format!("HETATM    1 {name} LIG     2       0.000   0.000   0.000  1.00  0.00          {symbol}\n")
    });
    assert_eq!(good(rows.concat()).attributes().elements, Some(vec![6, 1, 8, 6, 17]));
}

/// As AutoDock, Vina and Open Babel write them: behind a charge, in column 78, where PDB has the end of a symbol.
#[test]
fn pdbqt_types_tell_elements() {
    let types = "CL 17, Cl 17, BR 35, C 6, A 6, CA 20, CG0 6, HD 1, N 7, NA 7, Na 11, OA 8, OS 8, W 8, \
        SA 16, Mg 12, FE 26, Zn 30, I 53, G0 0";
    let types = || types.split(", ").map(|row| row.split_once(' ').expect("a type"));
    let elements: Vec<u8> = types().map(|(_, number)| number.parse().expect("a number")).collect();
    for charge in [" 0.123", "-0.123", "+0.123"] {
        let row = |(kind, _): (&str, &str)| {
            format!(
                "HETATM    1  CA  LIG     2       0.000   0.000   0.000  1.00  0.00    {charge} {kind}\n"
            )
        };
        let scene = good(types().map(row).collect::<String>());
        assert_eq!(scene.attributes().elements.as_ref(), Some(&elements), "{charge}");
        assert_eq!([0, 1, 2].map(|atom| spheres(&scene)[atom][3]), [1.75, 1.75, 1.83]);
        // Digits of a charge are no name of a segment.
        assert_eq!(scene.attributes().names(Naming::Chain), None);
    }
}
