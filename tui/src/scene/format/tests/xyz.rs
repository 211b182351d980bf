use super::*;

#[test]
fn xyz_as_it_always_was() {
    let scene = good("3\nwater\nO 0 0 0.119\n h 0 0.763 -0.477 extra 7\n1\t0 -0.763 -4.77e-1\n");
    assert_eq!(centers(&scene)[2], [0.0, -0.763, -0.477]);
    assert_eq!(spheres(&scene)[2][3], 1.10);
    assert_eq!(scene.label(0).as_deref(), Some("O 1"));
    assert_eq!(scene.attributes().element(1), Some(1));
}

#[test]
fn line_ends_a_byte_order_mark_and_latin1_do_not_matter() {
    let plain = "2\nwater\nO 0 0 0.119\nH 0 0.763 -0.477\n";
    for text in [
        plain.replace('\n', "\r\n"),
        plain.trim_end().to_owned(),
        format!("{plain}\n\n"),
        format!("\u{feff}{plain}"),
    ] {
        assert_eq!(good(text).spheres().len(), 2);
    }
    assert_eq!(good(b"1\n\xc5ngstr\xf6m\nHe 0 0 0\n").spheres().len(), 1);
}

/// The order of columns is what Properties say: forces are never taken for positions.
#[test]
fn properties_are_obeyed() {
    let text = "2\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=forces:R:3:species:S:1:pos:R:3:radius:R:1:color:R:3:q:R:1 pbc=\"T T T\"\n\
        9 9 9 C 1 2 3 0.5 1 0 0.5 -1\n8 8 8 O 4 5 6 0.25 0 1 0 2.5\n";
    let scene = good(text);
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 0.5], [4.0, 5.0, 6.0, 0.25]]);
    assert_eq!(scene.colors(), [Srgb([255, 0, 128]), Srgb([0, 255, 0])]);
    assert_eq!(numbers(&scene, "q"), Some(vec![-1.0, 2.5]));
    assert!(scene.attributes().own.radii && scene.attributes().own.colors);
    let without = good("1\nProperties=\"pos:R:3\"\n1 2 3\n");
    assert_eq!(centers(&without), [[1.0, 2.0, 3.0]]);
}

#[test]
fn an_unknown_type_is_grey() {
    let scene = good("3\n\nH 0 0 0\nXx 1 0 0\nMW 2 0 0\n");
    assert_eq!(scene.colors()[1], crate::scene::particles::NEUTRAL);
    assert_eq!(scene.attributes().names(Naming::Type).and_then(|names| names.get(1)), Some("Xx"));
    let reading = Reading { strict: true, ..Reading::default() };
    let strict = &mut frames_of("strict.xyz", "2\n\nH 0 0 0\nXx 1 0 0\n", &reading);
    let message = error_in(strict, 0);
    assert!(message.contains("strict.xyz:4:1: \"Xx\" is not an element"), "{message}");
    let grey = &mut film("grey.xyz", "3\n\nXx 0 0 0\nYy 1 0 0\nXx 2 0 0\n");
    assert!(frame(grey, 0).is_some());
    assert_eq!(grey.notes(), ["3 particles are of 2 unknown types (Xx, Yy): drawn grey"]);
    assert!(grey.notes().is_empty());
}

/// Whichever comes first.
#[test]
fn one_column_tells_elements_and_another_names_types() {
    for (properties, atom) in [
        ("species:S:1:pos:R:3:molid:I:1:type:S:1", "C 1 2 3 7 OW"),
        ("type:S:1:pos:R:3:species:S:1", "OW 1 2 3 C"),
        ("atom_types:S:1:element:S:1:pos:R:3:type:S:1", "OW C 1 2 3 O"),
        ("type:S:1:pos:R:3:Z:I:1", "OW 1 2 3 6"),
    ] {
        let scene = good(format!("1\nProperties={properties}\n{atom}\n"));
        assert_eq!(scene.attributes().elements, Some(vec![6]), "{properties}");
        let types = scene.attributes().names(Naming::Type);
        assert_eq!(types.and_then(|types| types.get(0)), Some("OW"), "{properties}");
    }
    for name in ["Z", "numbers", "atomic_numbers"] {
        let scene = good(format!("1\nProperties={name}:I:1:pos:R:3\n29 0 0 0\n"));
        assert_eq!(scene.attributes().elements, Some(vec![29]), "{name}");
    }
    let both = good("1\nProperties=species:S:1:pos:R:3:Z:I:1\nC 0 0 0 29\n");
    assert_eq!(both.attributes().elements, Some(vec![6]));
    assert_eq!(numbers(&both, "Z"), Some(vec![29.0]));
}

#[test]
fn a_diameter_is_twice_the_radius_which_wins() {
    let radius = |properties: &str, numbers: &str| {
        let text = format!("1\nProperties=species:S:1:pos:R:3:{properties}\nC 0 0 0 {numbers}\n");
        spheres(&good(text))[0][3]
    };
    assert_eq!(radius("diameter:R:1", "20"), 10.0);
    assert_eq!(radius("diameter:R:1:radius:R:1", "20 3"), 3.0);
    assert_eq!(radius("radius:R:1:diameter:R:1", "3 20"), 3.0);
    // Missing: carbon's.
    assert_eq!(["nan", "-20"].map(|missing| radius("diameter:R:1", missing)), [1.70; 2]);
    let message = error("1\nProperties=pos:R:3:diameter:R:1\n0 0 0 wide\n");
    assert_eq!(message, "f:3:7: diameter is \"wide\", which is not a number");
}

#[test]
fn what_is_told_twice_is_ignored_but_once() {
    let text = "1\nProperties=pos:R:3:residue:S:1:residuenames:S:1:radius:R:1:radii:R:1:name:S:1\n\
        1 2 3 ALA GLY 0.5 9 CA\n";
    let scene = good(text);
    assert_eq!(spheres(&scene), [[1.0, 2.0, 3.0, 0.5]]);
    assert_eq!(scene.label(0).as_deref(), Some("CA ALA"));
    assert_eq!(notes("twice.xyz", text), ["2 columns are ignored (residuenames, radii)"]);
}

#[test]
fn truths_are_told_in_any_case() {
    let words = ["T", "true", "True", "TRUE", "t", "F", "false", "False", "FALSE", "f"];
    let atoms: String = words.iter().map(|word| format!("C 0 0 0 {word}\n")).collect();
    let text = format!("{}\nProperties=species:S:1:pos:R:3:fixed:L:1\n{atoms}", words.len());
    assert_eq!(numbers(&good(text), "fixed"), Some([[1.0; 5], [0.0; 5]].concat()));
    let message = error("1\nProperties=pos:R:3:fixed:L:1\n0 0 0 yes\n");
    assert_eq!(message, "f:3:7: fixed is \"yes\", which is neither a number nor T or F");
}
