//! What tells spheres of a crowd apart: what is off changes nothing, what is on does, at every size and distance.

use crate::run::{file, prints};

fn picture(scene: &str, options: &str) -> String {
    prints(&format!("{scene} --once --size 60x20 --color truecolor {options}"))
}

#[test]
fn what_is_off_changes_no_byte_and_each_that_is_on_does() {
    for scene in ["marbles", "caffeine", "flake"] {
        let usual = picture(scene, "");
        assert!(picture(scene, "--occlusion=off --edges=off --depth-cue=off") == usual, "{scene}");
        assert!(picture(scene, "--occlusion=auto --color-by scene") == usual, "{scene}");
        let others = ["--occlusion", "--edges", "--depth-cue", "--occlusion --edges --depth-cue"];
        let pictures = others.map(|options| picture(scene, options));
        for (index, picture) in pictures.iter().enumerate() {
            // Nothing in caffeine is far behind anything.
            let has_none = scene == "caffeine" && others[index] == "--edges";
            assert!((*picture != usual) != has_none, "{scene} {}", others[index]);
            assert!(!pictures[..index].contains(picture), "{scene} {}", others[index]);
        }
    }
}

/// A heap of spheres, `scale` times as large, or `away` times its size away from zero.
fn heap(scale: f64, away: f64) -> String {
    let mut text = "light = \"camera\"\n".to_owned();
    for index in 0..60 {
        let place = [index % 4, index / 4 % 4, index / 16].map(f64::from);
        let [x, y, z] = place.map(|step| scale * (1.25 * step + away));
        text +=
            &format!("[[sphere]]\ncenter = [{x:e}, {y:e}, {z:e}]\nradius = {:e}\n", 0.5 * scale);
    }
    text
}

#[test]
fn a_scene_has_no_size_and_no_place() {
    let draw = |name: &str, scale: f64, away: f64| {
        picture(&file(name, heap(scale, away)), "--occlusion --edges --depth-cue")
    };
    let usual = draw("crowd.toml", 1.0, 0.0);
    // Powers of two round no number in another way.
    for power in [-40, 40] {
        assert!(draw("crowd-scaled.toml", 2.0_f64.powi(power), 0.0) == usual, "2^{power}");
    }
    // Far away it is about the same picture: as many cells as elsewhere have the background.
    let far = draw("crowd-far.toml", 1.0, 65_536.0);
    let blanks = |picture: &str| picture.matches(' ').count();
    assert!(blanks(&far).abs_diff(blanks(&usual)) < 60, "{} and {}", blanks(&far), blanks(&usual));
}

#[test]
fn a_legend_says_what_colours_mean() {
    let lines = picture("caffeine", "--color-by element --legend");
    let lines: Vec<_> = lines.lines().collect();
    assert!(lines[0].contains(" element "), "{}", lines[0]);
    // As many H as there are, C, N, O: from the most frequent.
    let rows: Vec<_> = ["H", "C", "N", "O"]
        .iter()
        .map(|name| lines.iter().position(|line| line.contains(&format!(" {name} "))))
        .collect();
    assert_eq!(rows, [Some(1), Some(2), Some(3), Some(4)]);
    assert!(!picture("caffeine", "--color-by element").contains(" element "));
}

/// A colour means one number in all frames: the scale of the first widens where others exceed it, and never narrows. So
/// do their legends.
#[test]
fn every_frame_has_its_legend() {
    let frames = "1\nProperties=species:S:1:pos:R:3:q:R:1\nC 0 0 0 1\n".to_owned()
        + "2\nProperties=species:S:1:pos:R:3:q:R:1\nC 0 0 0 5\nC 2 0 0 7\n"
        + "1\nProperties=species:S:1:pos:R:3:q:R:1\nC 0 0 0 3\n";
    let path = file("legends.xyz", frames);
    let words = "--size 40x10 --frames 0..3 --color-by q --legend --color 16 --charset ascii";
    let printed = prints(&format!("{path} {words}"));
    let lines: Vec<_> = printed.lines().collect();
    assert_eq!(lines.len(), 30);
    let ends = [["1", "1"], ["1", "7"], ["1", "7"]];
    for (frame, [low, high]) in lines.chunks(10).zip(ends) {
        let has = |line: &&str, what: &str| line.contains(&format!(" {what}"));
        assert!(frame.iter().any(|line| has(line, "q ")), "{printed}");
        assert!(frame.iter().any(|line| has(line, low) && has(line, high)), "{printed}");
    }
}

/// A file with chains is seen with all aids, several chains in their colours; a file without chains is as it always
/// was.
#[test]
fn chains_are_told_apart_unless_somebody_says_otherwise() {
    let pdb = |name: &str, chains: [char; 2]| {
        let atom = |(number, chain): (usize, &char)| {
            let x = 1.2 * number as f32;
            format!(
                "ATOM  {number:5}  CA  ALA {chain}{number:4}    {x:8.3}   0.000{:8.3}",
                -4.0 * x
            ) + "  1.00  0.00           C\n"
        };
        let text: String = (1..).zip(&chains).map(atom).collect();
        file(name, text)
    };
    let (one, two) = (pdb("one-chain.pdb", ['A', 'A']), pdb("two-chains.pdb", ['A', 'B']));
    let none = pdb("no-chain.pdb", [' ', ' ']);
    let (all, off) = (
        "--occlusion --edges --depth-cue --color-by scene",
        "--occlusion=off --edges=off --depth-cue=off --color-by scene",
    );
    assert!(picture(&one, "") == picture(&one, all) && picture(&one, "") != picture(&one, off));
    let of_chains = all.replace("scene", "chain");
    assert!(picture(&two, "") == picture(&two, &of_chains));
    assert!(picture(&two, "") != picture(&two, all));
    assert!(picture(&none, "") == picture(&none, off) && picture(&none, "") != picture(&none, all));
}
