use super::*;

/// A frame of a dump with particles at these x.
fn at(particles: &[usize]) -> String {
    let rows: String = particles.iter().map(|x| format!("1 1 {x} 0 0\n")).collect();
    dump(BOUNDS, "id type x y z", &rows)
}

/// How large the first particle of a frame is.
fn radius(film: &mut Frames, index: usize) -> f32 {
    spheres(&frame(film, index).expect("a frame"))[0][3]
}

/// However far apart they are later.
#[test]
fn particles_without_a_radius_keep_their_size() {
    let dumps = [2, 4, 8].map(|x| at(&[0, x])).concat();
    let trajectory = [2.0, 4.0, 8.0].map(|x| xtc(&[0.0, x])).concat();
    for (name, bytes) in [("gas.dump", dumps.into_bytes()), ("gas.xtc", trajectory)] {
        let whole = &mut film(name, &bytes);
        let first = radius(whole, 0);
        assert_eq!([1, 2, 0].map(|index| radius(whole, index)), [first; 3], "{name}");
        // A frame that is read alone has its own.
        let part = &mut film(name, &bytes);
        assert_eq!([1, 0].map(|index| radius(part, index)), [2.0 * first; 2], "{name}");
    }
}

#[test]
fn one_particle_alone_tells_no_size() {
    let text = at(&[0]) + &at(&[0, 2]) + &at(&[0, 4]);
    let film = &mut film("lone.dump", text);
    let [lone, two, wide] = [0, 1, 2].map(|index| radius(film, index));
    assert_eq!((lone, wide), (1.0, two));
    assert!(two < 1.0, "{two}");
}

#[test]
fn frames_without_atoms_are_passed_over() {
    let atom = |x: usize| format!(" 1\n    1SOL     OW    1   {x}.000   0.000   0.000\n   1 1 1\n");
    let gro = format!("a\n{}b\n 0\n   1 1 1\nc\n{}", atom(0), atom(2));
    let xyz = "1\na\nC 0 0 0\n0\nb\n1\nc\nC 2 0 0\n";
    let xtc = [xtc(&[0.0]), xtc(&[]), xtc(&[2.0])].concat();
    for (name, bytes, x) in [
        ("passed.xyz", xyz.into(), 2.0),
        ("passed.gro", gro.into_bytes(), 20.0),
        ("passed.xtc", xtc, 20.0),
    ] {
        let film = &mut film(name, bytes);
        for _ in 0..2 {
            assert_eq!(centers_in(film, 2), Some(vec![[x, 0.0, 0.0]]), "{name}");
            let error = film.read(1).expect_err("no atoms");
            let has_lines = name != "passed.xtc";
            assert!(error.is_empty_frame, "{name}: {error}");
            assert_eq!(error.line.is_some(), has_lines, "{name}: {error}");
        }
        assert!(frame(film, 3).is_none());
        assert_eq!(film.count(), Some(3), "{name}");
    }
}
