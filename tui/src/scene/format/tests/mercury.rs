use super::*;

/// As of MercuryDPM's own tests: no particles at first, then two, then one.
const SPACE: &str = "\
0 0 0 0 0 1 1 1 \n\
2 0.001 0 0 0 1 1 1 \n\
0.5 0.25 0.75 1 0 0 0.0625 0 0 0 0 0 -0 0\n\
0.25 0.125 0.5 -1 0 0 0.125 0 0 0 0 0 0 1\n\
1 0.002 0 0 0 1 1 1 \n\
0.75 0.25 0.5 1 0 0 0.0625 0 0 0 0 0 0 0\n";

const PLANE: &str = "\
2 0 0 0 5 5 \n\
0.5 0.25 0 -0.0001 0.5 -0 -0 0\n\
1.5 0.25 0 -0.0002 0.25 -0 -0 3\n\
2 0.2 0 0 5 5 \n\
0.5 0.125 0 -0.125 0.5 -0 -0 0\n\
1.5 0.125 0 -0.125 0.25 -0 -0 3\n";

#[test]
fn mercury_in_space() {
    let frames = &mut film("space.data", SPACE);
    assert!(frames.read(0).expect_err("no particles").is_empty_frame);
    let scene = frame(frames, 1).expect("a frame");
    assert_eq!(spheres(&scene), [[0.5, 0.25, 0.75, 0.0625], [0.25, 0.125, 0.5, 0.125]]);
    assert_eq!(numbers(&scene, "vx"), Some(vec![1.0, -1.0]));
    assert_eq!(numbers(&scene, "xi"), Some(vec![0.0, 1.0]));
    assert_eq!(numbers(&scene, "r"), None);
    // A frame is left out by the number of its lines, too.
    let frames = &mut film("space.data", SPACE);
    for index in [2, 1, 2] {
        assert_eq!(frame(frames, index).map(|scene| scene.spheres().len()), Some(3 - index));
    }
    assert!(!frames.has(3).expect("no error"));
}

#[test]
fn mercury_in_a_plane() {
    let frames = &mut film("plane.data", PLANE);
    let [first, second] = [0, 1].map(|index| frame(frames, index).expect("a frame"));
    assert_eq!(spheres(&first), [[0.5, 0.25, 0.0, 0.5], [1.5, 0.25, 0.0, 0.25]]);
    assert_eq!(spheres(&second), [[0.5, 0.125, 0.0, 0.5], [1.5, 0.125, 0.0, 0.25]]);
    assert_eq!(numbers(&second, "vy"), Some(vec![-0.125; 2]));
    assert_eq!(numbers(&second, "xi"), Some(vec![0.0, 3.0]));
}

#[test]
fn mercury_that_lies() {
    let row = "0 0 0 0 0 0 1 0 0 0 0 0 0 0\n";
    let frame = |count: usize| format!("{count} 0 0 0 0 1 1 1\n{row}{row}");
    assert_eq!(error(frame(3)), "f:4:1: the file ends after 2 of the 3 particles that line 1 says");
    let second = |text: &str| error_in(&mut film("lies.data", text), 1);
    let what = "3:1: 14 values; a number of particles, a time and a box are 6 or 8";
    assert!(second(&frame(1)).ends_with(what));
    let what = "4:1: \"-1\" is not a number of particles";
    assert!(second(&(frame(2) + "-1 0 0 0 0 1 1 1\n")).ends_with(what));
    wrong(frame(3) + &frame(2), "f:4:16: qy is missing");
    wrong(frame(2).replace(" 1 0 0", " -1 0 0"), "f:2:13: the radius is -1");
    wrong(frame(2).replace("\n0", "\nnan"), "f:2:1: x is");
}

/// Where all rows are as wide as the first.
#[test]
fn tables_of_as_many_columns_are_none_of_mercury_s() {
    for columns in [6, 8, 14] {
        let row = |from: usize| {
            let values: Vec<String> = (from..from + columns).map(|v| v.to_string()).collect();
            values.join(" ") + "\n"
        };
        for first in [0, 1] {
            let scene = good(row(first) + &row(1) + &row(2));
            assert_eq!(scene.spheres().len(), 3, "{columns}");
        }
    }
}
