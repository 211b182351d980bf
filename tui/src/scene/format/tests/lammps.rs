use super::*;

#[test]
fn lammps_dumps_in_order_scaled_and_sheared() {
    let bounds = "pp pp pp\n-1 3\n0 10\n0 10";
    let plain = good(dump(bounds, "id type x y z vx", "2 1 4 5 6 0.5\n1 2 1 2 3 0.25\n"));
    assert_eq!(centers(&plain), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(plain.label(0).as_deref(), Some("2 1"));
    assert_eq!(numbers(&plain, "vx"), Some(vec![0.25, 0.5]));
    let atoms = "1 1 0.5 0.1 0.2 2\n2 1 0 0 1 3\n";
    let scaled = good(dump(bounds, "id type xs ys zs radius", atoms));
    assert_eq!(spheres(&scaled), [[1.0, 1.0, 2.0, 2.0], [-1.0, 0.0, 10.0, 3.0]]);
    // xlo_bound = xlo + min(0, xy, xz, xy + xz): lo is 0, and hi 4.
    let bounds = "xy xz yz pp pp pp\n0 6 2\n0 10 0\n0 10 0";
    let sheared = good(dump(bounds, "id element xs ys zs", "1 Fe 0.5 0.5 0\n"));
    assert_eq!(centers(&sheared), [[3.0, 5.0, 0.0]]);
    assert_eq!(sheared.attributes().elements, Some(vec![26]));
    // Edges, and behind each a coordinate of the corner.
    let bounds = "abc origin pp pp pp\n10 0 0 -2\n3 20 0 -5\n0 0 1 -0.5";
    let general = good(dump(bounds, "id type xs ys zs", "1 1 0 0 0\n2 1 1 0 0\n3 1 0 0.5 1\n"));
    assert_eq!(centers(&general), [[-2.0, -5.0, -0.5], [8.0, -5.0, -0.5], [-0.5, 5.0, 0.5]]);
}

#[test]
fn lammps_data_by_style_and_by_columns() {
    let data = |head: &str, atoms: &str| {
        format!(
            "LAMMPS data\n\n2 atoms\n1 atom types\n\n0 10 xlo xhi\n\nMasses\n\n1 12.0\n\n{head}\n\n{atoms}\nBonds\n\n1 1 1 2\n"
        )
    };
    for (head, atoms) in [
        ("Atoms # full", "2 1 1 -0.5 4 5 6 0 0 0\n1 1 1 0.5 1 2 3 0 0 0\n"),
        ("Atoms", "1 1 1 0.5 1 2 3 0 0 0\n2 1 1 -0.5 4 5 6 0 0 0\n"),
        ("Atoms", "1 1 1 0.5 1 2 3\n2 1 1 -0.5 4 5 6\n"),
        ("Atoms # atomic", "1 1 1 2 3\n2 1 4 5 6\n"),
        ("Atoms", "1 1 1 2 3\n2 1 4 5 6\n"),
        ("Atoms", "1 1 0.5 1 2 3\n2 1 -0.5 4 5 6\n"),
        ("Atoms", "1 7 1 1 2 3\n2 7 1 4 5 6\n"),
    ] {
        assert_eq!(
            centers(&good(data(head, atoms))),
            [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
            "{head}\n{atoms}"
        );
    }
}

/// As LAMMPS's manual lists them, except that of dielectric it leaves out the molecule, which LAMMPS reads.
#[test]
fn lammps_data_of_every_style() {
    let read = |style: &str, atom: &str| {
        good(format!("LAMMPS data\n\n1 atoms\n\nAtoms # {style}\n\n# a comment\n{atom} 0 0 0\n"))
    };
    for (style, atom) in [
        ("atomic", "1 9 1 2 3"),
        ("angle", "1 7 9 1 2 3"),
        ("bond", "1 7 9 1 2 3"),
        ("molecular", "1 7 9 1 2 3"),
        ("body", "1 9 0 5 1 2 3"),
        ("charge", "1 9 0.5 1 2 3"),
        ("dielectric", "1 7 9 0.5 1 2 3 0 0 1 4 5 6 7 8"),
        ("dipole", "1 9 0.5 1 2 3 0 0 1"),
        ("dpd", "1 9 300 1 2 3"),
        ("edpd", "1 9 1.5 1e5 1 2 3"),
        ("electron", "1 9 0.5 -1 1.8 1 2 3"),
        ("ellipsoid", "1 9 1 1.5 1 2 3"),
        ("full", "1 7 9 0.5 1 2 3"),
        ("line", "1 7 9 1 1.5 1 2 3"),
        ("mdpd", "1 9 1.5 1 2 3"),
        ("peri", "1 9 5 1.5 1 2 3"),
        ("rheo", "1 9 0 1.5 1 2 3"),
        ("rheo/thermal", "1 9 0 1.5 4 1 2 3"),
        ("smd", "1 9 7 5 1.5 4 4 11 12 13 1 2 3"),
        ("sph", "1 9 1.5 4 5 1 2 3"),
        ("spin", "1 9 1 2 3 0 0 1 2"),
        ("tdpd", "1 9 1 2 3 0.5"),
        ("template", "1 9 7 1 5 1 2 3"),
        ("tri", "1 7 9 1 1.5 1 2 3"),
        ("wavepacket", "1 9 0.5 -1 1.8 3 0.1 0.2 1 2 3"),
        ("hybrid", "1 9 1 2 3 0.5 4 5"),
        ("hybrid sphere bond", "1 9 1 2 3 4 5 7"),
        ("full/kk", "1 7 9 0.5 1 2 3"),
        ("  full  id mol type q x y z", "1 7 9 0.5 1 2 3"),
    ] {
        let scene = read(style, atom);
        assert_eq!(centers(&scene), [[1.0, 2.0, 3.0]], "{style}");
        let types = scene.attributes().names(Naming::Type);
        assert_eq!(types.and_then(|types| types.get(0)), Some("9"), "{style}");
    }
    for (style, atom) in [("sphere", "1 9 4 5 1 2 3"), ("bpm/sphere", "1 7 9 4 5 1 2 3")] {
        assert_eq!(spheres(&read(style, atom)), [[1.0, 2.0, 3.0, 2.0]], "{style}");
    }
    let unknown = "LAMMPS data\n\n1 atoms\n\nAtoms # foo/bar\n\n1 2 3\n";
    let expected = "f:7:1: the atom style \"foo/bar\" is not known, and its columns tell none";
    assert_eq!(error(unknown), expected);
}

/// As of LIGGGHTS, which names no style.
#[test]
fn lammps_data_of_spheres_without_a_style() {
    let scene = good("LIGGGHTS\n\n1 atoms\n\nAtoms\n\n1 1 2e-3 2500 0.0020 0.005 0.0495\n");
    assert_eq!(spheres(&scene), [[0.002, 0.005, 0.0495, 0.001]]);
}

#[test]
fn fractions_of_a_box_are_at_finite_points() {
    let dump = |columns: &str, bounds: &str, atom: &str| {
        dump(&format!("pp pp pp\n{bounds}\n0 1\n0 1"), columns, &format!("{atom}\n"))
    };
    for (bounds, atom) in
        [("nan 1", "0 0 0"), ("0 inf", "0 0 0"), ("0 1e300", "0.5 0 0"), ("-1e38 1e38", "3 0 0")]
    {
        let message = error(dump("xs ys zs", bounds, atom));
        let what = "], which is not finite in single precision";
        assert!(
            message.starts_with("f:10:1: an atom is at [") && message.ends_with(what),
            "{message}"
        );
    }
    // Other positions do not need the box.
    assert_eq!(centers(&good(dump("x y z", "nan 1", "1 2 3"))), [[1.0, 2.0, 3.0]]);
}
