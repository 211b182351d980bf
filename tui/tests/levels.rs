//! Every instruction set that the CPU has gives the same bytes.

mod program;

use program::{array, file, printed, run};
use spherule_kernel::dispatch::{Level, LevelName};

/// The levels to be compared; the program must have run the one that it was asked for.
fn levels() -> Vec<LevelName> {
    let named = |name: LevelName| Level::named(name).map(Level::name);
    let levels: Vec<_> = LevelName::ALL.into_iter().filter_map(named).collect();
    println!("levels that ran: {levels:?}");
    levels
}

/// Rays from a sphere of radius 3 towards the middle, and spheres there: some hundred hits.
fn data() -> (Vec<f32>, Vec<f32>) {
    let mut state = 9_u32;
    let mut number = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let spheres = (0..333).flat_map(|_| [number(), number(), number(), 0.2 * number()]).collect();
    let mut rays = Vec::new();
    for _ in 0..333 {
        let origin = [3.0 * number(), 3.0 * number(), 3.0 * number()];
        rays.extend(origin);
        rays.extend(origin.map(|x| 0.5 * number() - x));
        rays.extend([0.0, f32::INFINITY]);
    }
    (spheres, rays)
}

#[test]
fn trace_writes_the_same_bytes() {
    let (spheres, rays) = data();
    let spheres = file("levels.s.npy", &array(spheres.len() / 4, 4, &spheres));
    let rays = file("levels.r.npy", &array(rays.len() / 8, 8, &rays));
    for tier in ["fast", "stable", "exact"] {
        for kind in ["", "--pairs", "--any", "--any --pairs"] {
            let mut first = None;
            for level in levels() {
                let (t, id) = (file("levels.t.npy", b""), file("levels.i.npy", b""));
                let mut words = vec!["trace", "--accuracy", tier, "--level", level.as_str()];
                words.extend(["--spheres", spheres.to_str().expect("UTF-8")]);
                words.extend(["--rays", rays.to_str().expect("UTF-8")]);
                words.extend(["--out-id", id.to_str().expect("UTF-8")]);
                if !kind.contains("--any") {
                    words.extend(["--out-t", t.to_str().expect("UTF-8")]);
                }
                words.extend(kind.split_whitespace());
                let text = printed(&run(words));
                let ran = format!(" accuracy={tier} level={} lanes=16 ", level.as_str());
                assert!(text.contains(&ran), "{text}");
                let bytes = (std::fs::read(t).expect("T"), std::fs::read(id).expect("I"));
                let first = first.get_or_insert_with(|| bytes.clone());
                assert!(*first == bytes, "{tier} {kind} {level:?}");
            }
        }
    }
}

#[test]
fn pictures_are_the_same() {
    for scene in ["marbles", "edge", "caffeine"] {
        for tier in ["fast", "stable", "exact"] {
            let picture = |level: LevelName| {
                let words = [scene, "--accuracy", tier, "--level", level.as_str()];
                let colour = ["--size", "60x20", "--color", "truecolor"];
                printed(&run(words.into_iter().chain(colour)))
            };
            let pictures: Vec<String> = levels().into_iter().map(picture).collect();
            assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]), "{scene} {tier}");
        }
    }
}
