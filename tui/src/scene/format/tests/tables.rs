use super::*;

const EXPECTED: [[f32; 3]; 2] = [[0.5, 1.5, 2.5], [3.0, 4.0, 5.0]];

/// The table, read by these columns.
fn by(columns: &str, text: &str) -> Scene {
    super::by(Some(Format::Csv), columns, text)
}

/// R names rows, comments begin with a sign and perhaps a word, and units are words of their own.
#[test]
fn values_are_those_of_their_names() {
    for text in [
        "\"x\" \"y\" \"z\"\n\"1\" 0.5 1.5 2.5\n\"2\" 3 4 5\n",
        "\"x\",\"y\",\"z\"\n\"1\",0.5,1.5,2.5\n\"2\",3,4,5\n",
        "\"x\"\t\"y\"\t\"z\"\n\"a b\"\t0.5\t1.5\t2.5\n\"c\"\t3\t4\t5\n",
        "# columns: x y z vx vy vz\n0.5 1.5 2.5 4 5 6\n3 4 5 4 5 6\n",
        "# columns: x, y, z, vx\n0.5, 1.5, 2.5, 6\n3, 4, 5, 6\n",
        "## id x y z\n7 0.5 1.5 2.5\n8 3 4 5\n",
        "% a comment\n%x y z\n0.5 1.5 2.5\n% between\n3 4 5\n",
        "% 1 2 3\n0.5 1.5 2.5\n3 4 5\n",
        "# x [km] y [km] z[km]\n0.5 1.5 2.5\n3 4 5\n",
        "# x y z (in kpc) v\n0.5 1.5 2.5 9\n3 4 5 9\n",
        "# x, y, z\n0.5 1.5 2.5\n3 4 5\n",
        "x y z\n0.5;1.5;2.5\n3;4;5\n",
        "x y z\n0.5 1.5 2.5 # the first\n3 4 5 \n",
        "x,y,z\n0.5,1.5,2.5 # the first\n3,4,5 % a, b\n",
        "0.5,1.5,2.5 # a, b\n3,4,5 # the last\n",
        "0.5;1.5;2.5\n3;4;5 // the last\n",
        "x,y,z\n0.5,1.5,2.5,\n3,4,5, ,\"\"\n",
        "x,y,z,v\n0.5,1.5,2.5\n3,4,5,9\n",
        "\"name\",x,y,z\n\"a\",0.5,1.5,2.5,\n\"b\",3,4,5,\n",
        "# x y z in kpc\n# x y z mass\n0.5 1.5 2.5 9\n3 4 5 9\n",
        "# x y z mass\n# x y z are in kpc\n0.5 1.5 2.5 9\n3 4 5 9\n",
        "# x y z name\n0.5\t1.5\t2.5\t\n3\t4\t5\tb\n",
        "\"x\",\"y\",\"z\",\"humidity\",\"k\"\n\"1\",0.5,1.5,2.5,\"50 %\",7\n\"2\",3,4,5,\"40 %\",7\n",
        "\"x\" \"y\" \"z\" \"humidity\" \"k\"\n\"1\" 0.5 1.5 2.5 \"50 %\" 7\n\"2\" 3 4 5 \"40 %\" 7\n",
    ] {
        assert_eq!(centers(&good(text)), EXPECTED, "{text}");
    }
    let scene = good("% x y z r\n1 2 3 0.5\n");
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 0.5]]);
}

/// But not behind a label, which may have the sign in it.
#[test]
fn a_comment_follows_a_number() {
    let scene = good("x,y,z,r,temp\n1,2,3,0.5,300 # hot, \"dry\"\n");
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 0.5]]);
    assert_eq!(numbers(&scene, "temp"), Some(vec![300.0]));
    let label = numbers(&good("x,y,z,label\n1,2,3,\"5 % NaCl\"\n3,4,5,pure\n"), "label");
    assert!(label.is_none_or(|values| values.iter().all(|value| value.is_nan())));
    let scene = good("x,y,z,diameter\n1,2,3,1 # wide\n");
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 0.5]]);
    assert_eq!(centers(&good("name,x,y,z\n1 #2,0.5,1.5,2.5\nC #1,3,4,5\n")), EXPECTED);
    assert_eq!(centers(&by("2,3,4", "1 #2,0.5,1.5,2.5\nC #1,3,4,5 # c\n")), EXPECTED);
    // Its commas separate no values.
    let missing = "the radius is missing: 3 columns, not 4";
    for first in ["x,y,z,r\n0,0,0,1\n", "1,2,3,1\n4,5,6,1\n"] {
        for comment in ["moved by 5, 7", "a,7", "a, b, 7, 8"] {
            let text = format!("{first}4,5,6 # {comment}\n");
            assert_eq!(error(&*text), format!("f:3:{}: {missing}", 9 + comment.len()), "{text}");
        }
    }
    let what = "3 values; the header in line 1 names 4; --columns takes columns by number";
    assert_eq!(error("# x,y,z,r\n4,5,6 # a, 7\n"), format!("f:2:13: {what}"));
    let kept = numbers(&good("x,y,z,q\n0,0,0,1\n4,5,6 # moved by 5, 7\n"), "q").expect("numbers");
    assert!(kept[0] == 1.0 && kept[1].is_nan());
    assert_eq!(error("x,y,z\n1,2,3a # c\n"), "f:2:5: z is \"3a # c\", which is not a number");
}

/// What is not named would shift the names of the others.
#[test]
fn more_or_fewer_values_than_names_are_refused() {
    for (text, place, values) in [
        ("x y z\n1 0.5 1.5 2.5\n", "f:2:11", "4 values; the header in line 1 names 3"),
        ("x y z\n1 2 3 4 5 6\n", "f:2:7", "6 values; the header in line 1 names 3"),
        ("x y z\n\"1\" 0.5 1.5 2.5\n", "f:2:13", "4 values; the header in line 1 names 3"),
        ("\n# id: x y z\n7 1 2 3\n", "f:3:7", "4 values; the header in line 2 names 3"),
        ("# x y z\n1 2 3\n\n1 2\n", "f:4:4", "2 values; the header in line 1 names 3"),
        (
            "# positions x y z in km\n1,2,3,0.5\n",
            "f:2:10",
            "4 values; the header in line 1 names 6",
        ),
        ("Positions x y z (km)\n1,2,3,4\n", "f:2:8", "4 values; the header in line 1 names 5"),
        ("# stars, x, y, z, epoch\n1,2,3,4\n", "f:2:8", "4 values; the header in line 1 names 5"),
        ("# x y z of stars\n1 2 3\n", "f:2:6", "3 values; the header in line 1 names 5"),
        ("x,y,z\n1,2,3\n1,2,3,4\n", "f:3:7", "4 values; the header in line 1 names 3"),
        ("x;y;z\n1;2;3;;4\n", "f:2:7", "5 values; the header in line 1 names 3"),
        ("x\ty\tz\n7\t1\t2\t3\n", "f:2:7", "4 values; the header in line 1 names 3"),
    ] {
        let expected = format!("{place}: {values}; --columns takes columns by number");
        assert_eq!(error(text), expected, "{text}");
    }
}

#[test]
fn columns_by_number_need_no_names() {
    assert_eq!(centers(&by("2,3,4", "x y z\n1 0.5 1.5 2.5\n2 3 4 5\n")), EXPECTED);
    assert_eq!(centers(&by("1,2,3", "x, y, z\n0.5 1.5 2.5\n3 4 5\n")), EXPECTED);
    let ragged = by("1,2,3", "x y z name\n0.5 1.5 2.5 Sol\n3 4 5 Alpha Centauri\n");
    assert_eq!(centers(&ragged), EXPECTED);
    // Where the names fit, they hold.
    let named = by("2,3,4", "id,x,y,z,element\n1,0.5,1.5,2.5,C,\n2,3,4,5,O,\n");
    assert_eq!(named.attributes().elements, Some(vec![6, 8]));
}

#[test]
fn numbered_types_are_no_elements() {
    let plain = good("x,y,z\n0,0,0\n.01,0,0\n");
    for text in [
        "x,y,z,type\n0,0,0,1\n.01,0,0,2\n",
        "x,y,z,Kind\n0,0,0,1.0\n.01,0,0,-1e0\n",
        "x,y,z,type\n0,0,0,\n.01,0,0,2\n",
    ] {
        let scene = good(text);
        assert_eq!(spheres(&scene), spheres(&plain), "{text}");
        assert_eq!(scene.attributes().elements, None, "{text}");
        assert_ne!(scene.colors()[0], scene.colors()[1], "{text}");
    }
    for (text, numbers) in [
        ("x,y,z,element\n0,0,0,1\n1,0,0,2\n", [1, 2]),
        ("x,y,z,type\n0,0,0,C\n1,0,0,O\n", [6, 8]),
        ("x,y,z,type\n0,0,0,1\n1,0,0,O\n", [1, 8]),
        ("type,x,y,z,symbol\n1,0,0,0,6\n2,1,0,0,8\n", [6, 8]),
    ] {
        assert_eq!(good(text).attributes().elements, Some(numbers.to_vec()), "{text}");
    }
}

#[test]
fn r_without_g_and_b_is_the_radius() {
    let alone = good("x,y,z,r\n0,0,0,5\n20,0,0,1\n");
    assert_eq!(spheres(&alone), [[0.0, 0.0, 0.0, 5.0], [20.0, 0.0, 0.0, 1.0]]);
    let colored = good("x,y,z,r,red,green,blue\n0,0,0,5,255,0,128\n");
    assert_eq!(spheres(&colored), [[0.0, 0.0, 0.0, 5.0]]);
    assert!(colored.attributes().own.colors);
    let named = good("x,y,z,r,radius\n0,0,0,5,2\n");
    assert_eq!(spheres(&named), [[0.0, 0.0, 0.0, 2.0]]);
    // Magnitudes.
    let bands = good("x,y,z,g,r,i\n0,0,0,-5,-4,3\n");
    assert!(!bands.attributes().own.radii && bands.attributes().column("r").is_some());
    wrong("x (m),y (m),z (m),r (mm)\n1,2,3,4\n", "lengths in \"(m)\" and in");
}

/// Without a host's scheme an address begins like a comment.
#[test]
fn an_address_begins_a_row_below_a_header() {
    let rows = "//cdn.org/a.png,0.5,1.5,2.5\n//cdn.org/b.png,3,4,5\n";
    for header in ["file,x,y,z\n", "# file,x,y,z\n", "// of a shop\nfile,x,y,z\n"] {
        assert_eq!(centers(&good(format!("{header}{rows}"))), EXPECTED, "{header}");
    }
    assert_eq!(centers(&by("2,3,4", &format!("file,x,y,z\n{rows}"))), EXPECTED);
    // Or below a row that has a label, unless comments have slashes.
    assert_eq!(centers(&by("2,3,4", "/a 0.5 1.5 2.5\n//nas/b 3 4 5\n")), EXPECTED);
    assert_eq!(centers(&by("2,3,4", "# of a shop\n/a 0.5 1.5 2.5\n//nas/b 3 4 5\n")), EXPECTED);
    assert_eq!(centers(&by("2,3,4", "// of\na 0.5 1.5 2.5\n// between\nb 3 4 5\n")), EXPECTED);
    assert_eq!(centers(&by("1,2,3", "0.5 1.5 2.5\n// between\n3 4 5\n")), EXPECTED);
    let named = "# of a shop: x y z\n//X,Y,Z\n0.5,1.5,2.5\n// between\n3,4,5\n";
    assert_eq!(centers(&good(named)), EXPECTED);
}

/// CloudCompare's text, with the number of points below the header or without; the third line is as long as one of GRO.
#[test]
fn a_header_behind_slashes() {
    let row = |x: usize| {
        format!("{x}.12345678 2245.12345678 33.12345678 200 100 50 0.510000 0.5 0.5 0.5\n")
    };
    let rows = [row(1), row(2)].concat();
    for count in ["", "2\n"] {
        let scene = good(format!("//X Y Z R G B Scalar_field Nx Ny Nz\n{count}{rows}"));
        assert_eq!(scene.spheres().len(), 2, "{count}");
        assert_eq!(scene.colors(), [Srgb([200, 100, 50]); 2], "{count}");
        assert_eq!(numbers(&scene, "Scalar_field"), Some(vec![0.51; 2]), "{count}");
        assert_eq!(centers(&good(format!("//X Y Z\n{count}0.5 1.5 2.5\n3 4 5\n"))), EXPECTED);
    }
    assert_eq!(centers(&good("// a comment\n0.5 1.5 2.5\n// another\n3 4 5 // 1\n")), EXPECTED);
}

#[test]
fn names_between_underscores() {
    let scene = good("#format x_y_z_r_clumpId\n0.5 1.5 2.5 0.25 7\n3 4 5 0.5 7\n");
    assert_eq!(spheres(&scene), [[0.5, 1.5, 2.5, 0.25], [3.0, 4.0, 5.0, 0.5]]);
    assert!(scene.attributes().column("clumpId").is_some());
}

#[test]
fn a_diameter_is_twice_the_radius() {
    let scene = good("x,y,z,Diameter (m)\n0.5,1.5,2.5,1\n");
    assert_eq!(spheres(&scene), [[0.5, 1.5, 2.5, 0.5]]);
    let scene = good("x,y,z,diameter,radius\n0.5,1.5,2.5,1,2\n");
    assert_eq!(spheres(&scene), [[0.5, 1.5, 2.5, 2.0]]);
}

#[test]
fn a_diameter_that_is_missing_is_no_radius() {
    let missing = spheres(&good("x,y,z\n1,2,3\n4,5,6\n"))[0];
    for value in ["", "NaN", "-2"] {
        let scene = good(format!("x,y,z,diameter\n1,2,3,{value}\n4,5,6,2\n"));
        assert_eq!(spheres(&scene), [missing, [4.0, 5.0, 6.0, 1.0]], "{value}");
    }
    let scene = good("x,y,z,diameter\n1,2,3\n4,5,6,2\n");
    assert_eq!(spheres(&scene), [missing, [4.0, 5.0, 6.0, 1.0]]);
    let message = error("x,y,z,diameter\n1,2,3,wide\n");
    assert_eq!(message, "f:2:7: the diameter is \"wide\", which is not a number");
}

#[test]
fn a_diameter_in_another_unit_is_a_number() {
    let scene = good("x (m),y (m),z (m),diameter (cm)\n1,2,3,200\n");
    assert!(!scene.attributes().own.radii);
    assert_eq!(numbers(&scene, "diameter (cm)"), Some(vec![200.0]));
    let scene = good("x (m),y (m),z (m),diameter (m)\n1,2,3,2\n");
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 1.0]]);
}

/// As of MercuryDPM where it is to be read as a table: each frame has a line of its own, which then is a sphere, too.
#[test]
fn rows_of_another_width_are_said() {
    let notes = |text: &str| notes("widths.txt", text);
    let particle = "1 2 3 0 0 0 0.5 0 0 0 0 0 0 0\n";
    let text = format!("2 0 0 0 -1 10 10 1\n{particle}{particle}");
    let what = "has not as many values as the first row: all rows are read as spheres";
    let reading = Reading { format: Some(Format::Csv), ..Reading::default() };
    let table = &mut frames_of("table.txt", &text, &reading);
    assert!(frame(table, 0).is_some());
    let said = table.notes();
    assert!(said.contains(&format!("line 2 {what}")), "{said:?}");
    assert!(notes(&text).is_empty(), "it has a format of its own");
    let said = notes("1 2 3 4 5\n6 7 8 9 10 11\n");
    assert!(said.contains(&format!("line 2 {what}")), "{said:?}");
    for same in [
        "1 2 3\n4 5 6 # the last\n",
        "1 2 3 # the first\n4 5 6\n",
        "1 2 3 #1\n4 5 6\n",
        "1,2,3\n4,5,6 # c\n",
        "1,2,3 # a, b\n4,5,6\n",
    ] {
        assert!(notes(same).is_empty(), "{same}");
    }
}
