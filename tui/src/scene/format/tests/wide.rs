use super::*;

/// An atom with so many numbers before its position and behind it, and its element.
fn dump(before: usize, behind: usize) -> String {
    let (names, others) = ("a ".repeat(before), "z ".repeat(behind));
    super::dump(BOUNDS, &format!("{names}x y z {others}element"), &atom(before, behind))
}

/// The same.
fn xyz(before: usize, behind: usize) -> String {
    let (names, others) = ("a:R:1:".repeat(before), "b:R:1:".repeat(behind));
    format!("1\nProperties={names}pos:R:3:{others}species:S:1\n{}", atom(before, behind))
}

fn atom(before: usize, behind: usize) -> String {
    format!("{}1 2 3 {}C\n", "7 ".repeat(before), "8 ".repeat(behind))
}

#[test]
fn a_million_columns() {
    let numbers = " 7".repeat(1_000_000);
    let xyz = good(format!("1\nProperties=many:R:1000000:pos:R:3\n{numbers} 1 2 3\n"));
    assert_eq!(centers(&xyz), [[1.0, 2.0, 3.0]]);
    assert_eq!(centers(&good(format!("1\n\nH 1 2 3{numbers}\n"))), [[1.0, 2.0, 3.0]]);
    let names: String = (0..1_000_000).map(|column| format!("c{column},")).collect();
    let table = format!("{names}x,y,z\n{}1,2,3\n", "7,".repeat(1_000_000));
    assert_eq!(centers(&good(table)), [[1.0, 2.0, 3.0]]);
    let nameless = soon(|| good(format!("x,y,z{}\n1,2,3\n", ",".repeat(1_000_000))));
    assert_eq!(centers(&nameless), [[1.0, 2.0, 3.0]]);
    assert_eq!(nameless.attributes().columns.len(), 8);
}

#[test]
fn a_million_numbers_of_an_atom() {
    for text in [dump(500_000, 500_000), xyz(500_000, 500_000)] {
        let scene = soon(|| good(text));
        assert_eq!(centers(&scene), [[1.0, 2.0, 3.0]]);
        assert_eq!(scene.attributes().elements, Some(vec![6]));
        assert_eq!(scene.attributes().columns.len(), 64);
    }
}

#[test]
fn numbers_beyond_64_are_passed_over() {
    for (name, text) in [("wide.dump", dump(66, 2)), ("wide.xyz", xyz(66, 2))] {
        assert_eq!(notes(name, &text), ["4 further columns are ignored"], "{name}");
        let scene = good(&*text);
        let mut columns = scene.attributes().columns.iter();
        assert!(columns.all(|column| column.values == [7.0]), "{name}");
        let fewer = error(text.replace(" 8 8 C", " 8"));
        assert!(fewer.ends_with("a further column is missing"), "{fewer}");
    }
    let words = format!("1\nProperties=pos:R:3{}\n1 2 3{}\n", ":f:S:1".repeat(66), " w".repeat(66));
    let expected =
        ["64 columns are ignored (f, f, f, f, f, f, ...)", "2 further columns are ignored"];
    assert_eq!(notes("words.xyz", &words), expected);
}
