//! Tables that begin otherwise than with names or a row.

use super::*;

const EXPECTED: [[f32; 4]; 2] = [[0.5, 1.5, 2.5, 0.25], [3.0, 4.0, 5.0, 0.5]];

/// The frames of a file that is to be read as a table.
fn table(name: &str, text: &str) -> Frames {
    frames_of(name, text, &Reading { format: Some(Format::Csv), ..Reading::default() })
}

/// As pandas writes them where columns have no names.
#[test]
fn numbers_from_zero_are_a_header() {
    let plain = "0,1,2,3\n0.5,1.5,2.5,0.25\n3.0,4.0,5.0,0.5\n";
    let with_index = ",0,1,2,3\n0,0.5,1.5,2.5,0.25\n1,3.0,4.0,5.0,0.5\n";
    let below = plain.replacen('\n', "\r\n\n# a comment\n", 1);
    for text in [plain, with_index, &plain.replace(',', "\t"), &below] {
        assert_eq!(spheres(&good(text)), EXPECTED, "{text}");
    }
    assert_eq!(spheres(&by(Some(Format::Csv), "1,2,3,4", plain)), EXPECTED);
    assert_eq!(spheres(&by(Some(Format::Csv), "2,3,4,5", with_index)), EXPECTED);
    let wide = good("0,1,2,3,4\n0.5,1.5,2.5,7,8.5\n");
    assert_eq!(centers(&wide), [[0.5, 1.5, 2.5]]);
    assert_eq!(numbers(&wide, "3"), Some(vec![7.0]));
    let said = "line 1 has the numbers of columns from 0: it is read as a header";
    assert_eq!(notes("numbered.csv", plain), [said]);
}

/// Or of a file in which nothing tells.
#[test]
fn numbers_from_zero_may_be_the_first_sphere() {
    assert_eq!(spheres(&good("0,1,2,3\n")), [[0.0, 1.0, 2.0, 3.0]]);
    assert_eq!(centers(&good("0,1,2\n3,4,5\n")), [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]);
    for text in ["0 1 2\n0.5 1.5 2.5\n", "0,1,2,\n0.5,1.5,2.5,\n", "0,1,3\n0.5,1.5,2.5\n"] {
        assert_eq!(good(text).spheres().len(), 2, "{text}");
    }
}

#[test]
fn a_row_may_end_in_separators() {
    for separator in [",", "\t", ";", ",,", ", \"\","] {
        let text = "0.5,1.5,2.5,0.25END\n3,4,5,0.5END\n".replace("END", separator);
        let text = if separator.len() == 1 { text.replace(',', separator) } else { text };
        assert_eq!(spheres(&good(&*text)), EXPECTED, "{text}");
        assert!(notes("ends.csv", &text).is_empty(), "{text}");
    }
    assert_eq!(centers(&good("0,0,0,\n3,0,0,\n")), [[0.0; 3], [3.0, 0.0, 0.0]]);
}

/// As Excel reads it.
#[test]
fn a_line_that_tells_the_separator() {
    for first in ["sep=;", "SEP=;", "\"sep=;\"", "sep=\t", "\u{feff}sep=,"] {
        for names in ["x;y;z;r\n", ""] {
            let text = format!("{first}\r\n{names}0.5;1.5;2.5;0.25\n3;4;5;0.5\n");
            assert_eq!(spheres(&good(&*text)), EXPECTED, "{text}");
        }
    }
    let message = error("x,y,z\nsep=;\n1,2,3\n");
    assert!(message.starts_with("f:2:"), "{message}");
    let key = error("sep=5\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n");
    assert!(key.contains("unknown field"), "{key}");
}

/// As `paste` writes it.
#[test]
fn a_tab_among_spaces_is_one() {
    for text in [
        "0.5 1.5 2.5\t0.25\n3 4 5\t0.5\n",
        "x y z\tr\n0.5 1.5 2.5\t0.25\n3 4 5\t0.5\n",
        "x y z r\t\n0.5 1.5 2.5 0.25\t\n3 4 5 0.5\n",
        "0.5, 1.5, 2.5, 0.25\t\n3, 4, 5, 0.5\n",
    ] {
        assert_eq!(spheres(&good(text)), EXPECTED, "{text}");
    }
}

/// As Leica and CloudCompare write it: by its content such a file is XYZ.
#[test]
fn the_number_of_rows_may_stand_above_them() {
    for (name, text) in [
        ("bare.pts", "2\n0.5 1.5 2.5 0.25\n3 4 5 0.5\n"),
        ("named.txt", "\n2\nx,y,z,r\n0.5,1.5,2.5,0.25\n3,4,5,0.5\n"),
        ("behind.txt", "2\r\n//X Y Z R\n0.5 1.5 2.5 0.25\n3 4 5 0.5\n"),
    ] {
        let scene = frame(&mut table(name, text), 0).expect("a table");
        assert_eq!(spheres(&scene), EXPECTED, "{name}");
    }
    let message = error_in(&mut table("twice.pts", "2\n2\n1 2 3\n"), 0);
    assert!(message.ends_with("twice.pts:2:1: 1 column; positions need three"), "{message}");
}
