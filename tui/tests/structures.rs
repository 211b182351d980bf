//! Every structure, at every level, on any number of threads: the same files, byte for byte.

mod program;

use program::scenes::{camera, cloud, flake, hostile, scattered};
use program::{array, file, printed, refusal, run};
use spherule_kernel::dispatch::{Level, LevelName};

/// Runs `trace` on files that are there, and returns what it printed and the bytes of T and I.
fn trace(spheres: &str, rays: &str, words: &str) -> (String, [Vec<u8>; 2]) {
    // Tests run side by side, each with a scene of its own.
    let outputs = ["t", "i"].map(|name| file(&format!("{spheres}.{rays}.{name}.npy"), b""));
    let of = |name: &str| format!("{}/{name}.npy", env!("CARGO_TARGET_TMPDIR"));
    let mut arguments = vec!["trace".into(), "--spheres".into(), of(spheres).into()];
    arguments.extend(["--rays".into(), of(rays).into()]);
    if !words.contains("--any") {
        arguments.extend(["--out-t".into(), outputs[0].clone().into_os_string()]);
    }
    arguments.extend(["--out-id".into(), outputs[1].clone().into_os_string()]);
    arguments.extend(words.split_whitespace().map(Into::into));
    let text = printed(&run(arguments));
    (text, outputs.map(|path| std::fs::read(path).expect("an output")))
}

/// The value of a key in what was printed.
fn value<'a>(text: &'a str, key: &str) -> &'a str {
    let pair = text.split_whitespace().find_map(|pair| pair.strip_prefix(key)?.strip_prefix('='));
    pair.expect(key)
}

/// A scene against rays of a camera and others: everything that changes no bit.
fn the_same_files(name: &str, spheres: &[f32]) {
    file(&format!("{name}.npy"), &array(spheres.len() / 4, 4, spheres));
    for (kind, rays) in [("camera", camera(40)), ("scattered", scattered(1611))] {
        let rays_name = format!("{name}-{kind}");
        file(&format!("{rays_name}.npy"), &array(rays.len() / 8, 8, &rays));
        for question in ["--accuracy exact", "--accuracy stable", "--accuracy exact --any"] {
            let words = |structure: &str, threads: usize, level: LevelName| {
                let level = level.as_str();
                format!("{question} --structure {structure} --threads {threads} --level {level}")
            };
            let best = Level::best().name();
            let (text, expected) = trace(name, &rays_name, &words("brute", 1, best));
            assert_eq!((value(&text, "structure"), value(&text, "threads")), ("brute", "1"));
            if question == "--accuracy exact" {
                let hits: usize = value(&text, "hits").parse().expect("a number");
                assert!(hits > 20, "{name} {kind}: {hits} hits");
            }
            let levels = LevelName::ALL.into_iter().filter(|&level| Level::named(level).is_some());
            for level in levels {
                for structure in ["brute", "tiles", "bvh", "auto"] {
                    for threads in [1, 3] {
                        let words = words(structure, threads, level);
                        let (text, found) = trace(name, &rays_name, &words);
                        assert!(found == expected, "{name} {kind} {words}");
                        let ran = value(&text, "structure");
                        // Tiles are for rays that share an origin or a direction.
                        let able = kind == "camera" || structure != "tiles";
                        let expected = if able { structure } else { "brute" };
                        assert!(structure == "auto" || ran == expected, "{text}");
                        assert_eq!(value(&text, "threads"), threads.to_string());
                    }
                }
            }
        }
    }
}

#[test]
fn one_sphere() {
    the_same_files("one", &[0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn sixty_four() {
    the_same_files("u64", &cloud(64, 3));
}

#[test]
fn spheres_on_spheres() {
    the_same_files("flake500", &flake(500));
}

#[test]
fn spheres_that_no_scene_should_have() {
    the_same_files("hostile3000", &hostile(3000));
}

/// `Fast` may lose false hits in a tree, but not one to a thread.
#[test]
fn fast_does_not_depend_on_threads() {
    file("fast.npy", &array(500, 4, &flake(500)));
    for (name, rays) in [("fast-camera", camera(80)), ("fast-scattered", scattered(5000))] {
        file(&format!("{name}.npy"), &array(rays.len() / 8, 8, &rays));
        for structure in ["brute", "tiles", "bvh"] {
            let words = format!("--accuracy fast --structure {structure} --threads ");
            let files =
                [1, 2, 5].map(|threads| trace("fast", name, &format!("{words}{threads}")).1);
            assert!(files[0] == files[1] && files[0] == files[2], "{name} {structure}");
        }
    }
}

/// The tree really ran.
#[test]
fn a_tree_is_twenty_times_as_fast_as_brute_force() {
    let (spheres, rays) = (cloud(10_000, 2), camera(256));
    file("u10k.npy", &array(10_000, 4, &spheres));
    file("u10k-camera.npy", &array(rays.len() / 8, 8, &rays));
    let speed = |structure: &str, repeat| {
        let words =
            format!("--accuracy stable --structure {structure} --threads 1 --repeat {repeat}");
        let (text, files) = trace("u10k", "u10k-camera", &words);
        assert_eq!(value(&text, "structure"), structure);
        let speed: f64 = value(&text, "mrays_per_s").parse().expect("a number");
        (speed, files)
    };
    // Others may load the machine: the second attempt counts as well.
    let ratio = || {
        let ((brute, expected), (tree, found)) = (speed("brute", 3), speed("bvh", 21));
        assert!(found == expected);
        println!("brute {brute} Mrays/s, bvh {tree} Mrays/s");
        tree / brute
    };
    let first = ratio();
    assert!(first >= 20.0 || ratio() >= 20.0, "{first}");
}

#[test]
fn pairs_have_no_structure() {
    file("pairs.npy", &array(64, 4, &cloud(64, 3)));
    let rays = scattered(64);
    file("pairs-rays.npy", &array(64, 8, &rays));
    for choice in ["auto", "brute"] {
        let (text, _) = trace("pairs", "pairs-rays", &format!("--pairs --structure {choice}"));
        assert_eq!(value(&text, "structure"), "brute");
    }
    for choice in ["tiles", "bvh"] {
        let words = format!("trace --spheres s.npy --rays r.npy --pairs --structure {choice}");
        let message = refusal(&run(words.split(' ')));
        assert_eq!(message, format!("--pairs with --structure {choice}: auto or brute"));
    }
}

#[test]
fn the_build_is_timed() {
    file("built.npy", &array(2000, 4, &cloud(2000, 3)));
    file("built-rays.npy", &array(256, 8, &camera(16)));
    for structure in ["tiles", "bvh"] {
        let (text, _) = trace("built", "built-rays", &format!("--structure {structure}"));
        assert!(value(&text, "build_ms").parse::<f64>().expect("a number") > 0.0, "{text}");
    }
    let (text, _) = trace("built", "built-rays", "--structure brute");
    assert_eq!(value(&text, "build_ms"), "0.0");
}

#[test]
fn pictures_are_the_same() {
    for scene in ["marbles", "edge", "flake"] {
        let picture = |tier: &str, more: &str| {
            let words = format!("{scene} --accuracy {tier} --size 60x23 --color truecolor {more}");
            printed(&run(words.split_whitespace()))
        };
        for tier in ["stable", "exact"] {
            let expected = picture(tier, "--structure brute --threads 1");
            for structure in ["auto", "brute", "tiles", "bvh"] {
                for threads in [1, 2, 5] {
                    let more = format!("--structure {structure} --threads {threads}");
                    assert!(picture(tier, &more) == expected, "{scene} {tier} {more}");
                }
            }
        }
        for structure in ["brute", "tiles", "bvh"] {
            let fast = [1, 2, 5].map(|threads| {
                picture("fast", &format!("--structure {structure} --threads {threads}"))
            });
            assert!(fast[0] == fast[1] && fast[0] == fast[2], "{scene} {structure}");
        }
    }
}
