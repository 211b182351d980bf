use super::*;

#[test]
fn gro_in_angstrom() {
    let text = [
        "water t= 1.0",
        "    3",
        "    1SOL     OW    1   0.126   1.624   1.679  0.1227 -0.0580  0.0434",
        "    1SOL    HW1    2   0.190   1.661   1.747",
        "    1SOL     MW    3   0.177   1.568   1.613",
        "   1.82060   1.82060   1.82060\n",
    ]
    .join("\n");
    let scene = good(text);
    assert_eq!(centers(&scene)[0], [0.126 * 10.0, 1.624 * 10.0, 1.679 * 10.0]);
    assert_eq!(scene.attributes().elements, Some(vec![8, 1, 0]));
    assert_eq!(scene.label(1).as_deref(), Some("HW1 SOL 1"));
    // Martini's water is a bead.
    let bead = good("t\n    1\n    1W        W    1   0.126   1.624   1.679\n   1 1 1\n");
    assert_eq!(bead.attributes().elements, None);
}

#[test]
fn tables_by_header_and_without() {
    let expected = [[1.0, 2.0, 3.0, 0.5], [4.0, 5.0, 6.0, 0.25]];
    for text in [
        "mag,X,y,z,radius\n7,1,2,3,0.5\n8,4,5,6,0.25\n",
        "# x y z radius\n1 2 3 0.5\n# a comment\n\n4 5 6 0.25\n",
        "z\tradius\ty\tx\n3\t0.5\t2\t1\n6\t0.25\t5\t4\n",
        "1;2;3;0.5\r\n4;5;6;0.25\r\n",
        "\u{feff}\"x\",\"y\",\"z\",\"name, of\",radius\n1,2,3,\"a, b\",0.5\n\"4\",5,6,c,0.25",
        "1.0 2 3 0.5\n4 5 6 0.25\n",
        "z (m),x (m),y (m),Radius(m),x0 (m)\n3,1,2,0.5,9\n6,4,5,0.25,9\n",
        "x (raw),x,y,z,radius\n9,1,2,3,0.5\n9,4,5,6,0.25\n",
        "x,y,z,radius (m)\n1,2,3,0.5\n4,5,6,0.25\n",
        "x [km]\ty [km]\tz[km]\tradius [km]\n1\t2\t3\t0.5\n4\t5\t6\t0.25\n",
        "0.1D+01 2.d0 3D0 5d-1\n4 5 6 0.25\n",
    ] {
        assert_eq!(spheres(&good(text)), expected, "{text}");
    }
    let colored = good("x,y,z,r,g,b,v\n0,0,0,255,0,128,9\n1,0,0,0,255,0,8\n");
    assert_eq!(colored.colors(), [Srgb([255, 0, 128]), Srgb([0, 255, 0])]);
    assert_eq!(numbers(&colored, "v"), Some(vec![9.0, 8.0]));
    let of_16_bits = good("X,Y,Z,Red,Green,Blue\n0,0,0,65535,0,32896\n1,0,0,257,65535,0\n");
    assert_eq!(of_16_bits.colors(), [Srgb([255, 0, 128]), Srgb([1, 255, 0])]);
    for columns in ["b,c,d,a", "2,3,4,1"] {
        let scene = by(None, columns, "a,b,c,d\n0.5,1,2,3\n0.25,4,5,6\n");
        assert_eq!(spheres(&scene), expected, "{columns}");
    }
}

#[test]
fn numbers_of_columns_are_no_names_and_a_label_makes_no_header() {
    for (columns, text, expected) in [
        ("2,3,4", "a,1,2,3\nb,4,5,6\n", vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]),
        ("2, 4, 5", "name,x,4,y,z\na,1,9,2,3\n", vec![[1.0, 2.0, 3.0]]),
        // No column has the number 0, so these are names.
        ("0,1,2", ",0,1,2\n0,1,2,3\n", vec![[1.0, 2.0, 3.0]]),
    ] {
        assert_eq!(centers(&by(None, columns, text)), expected, "{columns}");
    }
}

#[test]
fn ply_in_text_and_in_both_orders() {
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment c\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 2\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty float radius\nend_header\n"
        )
    };
    let text = header("ascii") + "3 0 1 1\n1 2 -3 255 0 128 0.5\n4 5 6 0 255 0 0.25\n";
    let binary = |format: &str, is_big: bool| {
        let mut values = vec![vec![3]];
        values.extend([0_i32, 1, 1].map(|index| index.to_le_bytes().to_vec()));
        for (x, y, z, color, radius) in
            [(1_f32, 2_f64, -3_i16, [255, 0, 128], 0.5_f32), (4.0, 5.0, 6, [0, 255, 0], 0.25)]
        {
            values.push(x.to_le_bytes().to_vec());
            values.push(y.to_le_bytes().to_vec());
            values.push(z.to_le_bytes().to_vec());
            values.extend(color.map(|channel| vec![channel]));
            values.push(radius.to_le_bytes().to_vec());
        }
        if is_big {
            values.iter_mut().for_each(|value| value.reverse());
        }
        [header(format).into_bytes(), values.concat()].concat()
    };
    for bytes in [
        text.into_bytes(),
        binary("binary_little_endian", false),
        binary("binary_big_endian", true),
    ] {
        let scene = good(bytes);
        assert_eq!(spheres(&scene), [[1.0, 2.0, -3.0, 0.5], [4.0, 5.0, 6.0, 0.25]]);
        assert_eq!(scene.colors(), [Srgb([255, 0, 128]), Srgb([0, 255, 0])]);
    }
}

#[test]
fn diffuse_colours_of_ply_are_colours() {
    let channels =
        ["red", "green", "blue"].map(|name| format!("property uchar diffuse_{name}\n")).concat();
    let scene = good(format!(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        {channels}end_header\n1 2 3 255 0 128\n"
    ));
    assert_eq!(scene.colors(), [Srgb([255, 0, 128])]);
}

/// From 0 to 1, or as they were in bytes.
#[test]
fn ply_colours_that_are_no_integers() {
    for (kind, color) in [("float", "1 0 0.5"), ("float", "255 0 128"), ("double", "255 0 127.5")] {
        let channels =
            ["red", "green", "blue"].map(|name| format!("property {kind} {name}\n")).concat();
        let scene = good(format!(
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
            {channels}end_header\n1 2 3 {color}\n3 2 3 0 0 0\n"
        ));
        assert_eq!(scene.colors(), [Srgb([255, 0, 128]), Srgb([0; 3])], "{kind} {color}");
    }
}

/// However many a header claims.
#[test]
fn binary_elements_without_properties_have_no_bytes() {
    let header = "ply\nformat binary_little_endian 1.0\nelement a 18446744073709551615\nelement vertex 1\n\
        property float x\nproperty float y\nproperty float z\nend_header\n";
    let point: Vec<u8> = [1.0_f32, 2.0, 3.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    assert_eq!(centers(&good([header.as_bytes(), &point].concat())), [[1.0, 2.0, 3.0]]);
}

#[test]
fn npy_of_every_order_and_size() {
    let rows = [[1.0, 2.0, 3.0, 0.5], [4.0, 5.0, 6.0, 0.25]];
    let c: Vec<f64> = rows.iter().flatten().copied().collect();
    let f: Vec<f64> = (0..4).flat_map(|column| rows.map(|row| row[column])).collect();
    let data = |values: &[f64], descr: &str| -> Vec<u8> {
        let bytes = |&value: &f64| match descr {
            "<f4" => (value as f32).to_le_bytes().to_vec(),
            ">f4" => (value as f32).to_be_bytes().to_vec(),
            "<f8" => value.to_le_bytes().to_vec(),
            _ => value.to_be_bytes().to_vec(),
        };
        values.iter().flat_map(bytes).collect()
    };
    let expected = rows.map(|row| row.map(|value| value as f32));
    for (fortran, values) in [("False", &c), ("True", &f)] {
        for descr in ["<f4", ">f4", "<f8", ">f8"] {
            let scene = good(npy(descr, fortran, "(2, 4)", &data(values, descr)));
            assert_eq!(spheres(&scene), expected, "{descr} {fortran}");
        }
    }
    let three = data(&[0.0, 0.0, 0.0, 8.0, 0.0, 0.0], "<f4");
    let three = good(npy("<f4", "False", "(2, 3)", &three));
    assert_eq!(centers(&three), [[0.0; 3], [8.0, 0.0, 0.0]]);
    assert!(spheres(&three)[0][3] > 0.0);
}

#[test]
fn a_robot_of_spheres() {
    let text = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><link name=\"base\"><collision><origin xyz=\"0 0 1\"/><geometry><sphere radius=\"0.5\"/></geometry></collision>\
        <visual><geometry><mesh filename=\"m\"/></geometry></visual></link>\n\
        <link name=\"arm\"><collision><origin xyz=\"1 0 0\"/><geometry><sphere radius=\"0.25\"/></geometry></collision></link>\
        <joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"0 0 2\" rpy=\"0 0 1.5707963267948966\"/></joint></robot>";
    let found = spheres(&good(text));
    let expected = [[0.0, 0.0, 1.0, 0.5], [0.0, 1.0, 2.0, 0.25]];
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    assert_eq!(found.len(), 2);
}

#[test]
fn compressed_by_its_bytes_from_a_pipe_too() {
    let xyz = b"2\n\nH 0 0 0\nC 1 2 3\n";
    assert_eq!(good(gz(xyz)).spheres().len(), 2);
    assert_eq!(good(bz2(xyz)).spheres().len(), 2);
    // Two members are one text.
    assert_eq!(good([gz(&xyz[..5]), gz(&xyz[5..])].concat()).spheres().len(), 2);
    assert_eq!(good(gz(PDB.as_bytes())).spheres().len(), 3);
}

#[test]
fn toml_still_is() {
    for before in ["", "# a comment\nshadows = true\n"] {
        let scene = good(format!("{before}[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n"));
        assert_eq!(scene.spheres().len(), 1, "{before}");
    }
}

#[test]
fn what_is_ignored_is_said() {
    let names: String = (0..12).map(|column| format!(",c{column}")).collect();
    let table = format!("x,y,z{names}\n1,2,3{}\n", ",1".repeat(12));
    assert_eq!(notes("wide.csv", &table), ["4 further columns are ignored"]);
    let property = |name: &str| format!("property float {name}\n");
    let properties: String = ["x", "y", "z", "a", "b", "c", "d", "e"].map(property).concat();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 1\n{properties}end_header\n1 2 3 4 5 6 7 8\n"
    );
    assert_eq!(notes("wide.ply", &ply), ["1 further column is ignored"]);
    let faces = |count: usize, rows: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement face {count}\nproperty list uchar int i\nelement vertex 1\n\
            property float x\nproperty list uchar float l\nproperty float y\nproperty float z\nend_header\n{rows}"
        )
    };
    assert_eq!(notes("no-faces.ply", &faces(0, "1 1 9 2 3\n")), ["1 further column is ignored"]);
    assert_eq!(
        notes("faces.ply", &faces(1, "3 0 0 0\n1 1 9 2 3\n")),
        ["only the vertices are drawn", "1 further column is ignored"]
    );
    let xyz = |properties: &str, values: &str| {
        format!("1\nProperties=pos:R:3:{properties}\n0 0 0 {values}\n")
    };
    assert_eq!(notes("one.xyz", &xyz("f:R:3", "1 1 1")), ["the column \"f\" is ignored"]);
    let letters = "abcdefg".chars().map(|name| format!("{name}:S:1")).collect::<Vec<_>>().join(":");
    assert_eq!(
        notes("several.xyz", &xyz(&letters, "1 1 1 1 1 1 1")),
        ["7 columns are ignored (a, b, c, d, e, f, ...)"]
    );
    let lammps = "LAMMPS data\n\n2 atoms\n1 bonds\n0 angles\n1 atom types\n\nAtoms # full\n\n\
        1 1 1 0.5 0 0 0\n2 1 1 -0.5 1 0 0\n\nBonds\n\n1 1 1 2\n";
    assert_eq!(notes("bonded.data", lammps), ["ignored: bonds"]);
}
