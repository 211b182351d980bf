//! `spherule trace` against a scalar loop, and its refusals.

mod program;

use program::{array, file, npy, printed, refusal, run};
use spherule_kernel::{Exact, Fast, Ray, Spheres, Stable, Vec3, nearest_hit};
use std::path::{Path, PathBuf};

/// 4-byte elements after the header of a file that the program wrote.
fn column(path: &Path) -> Vec<[u8; 4]> {
    let bytes = std::fs::read(path).expect("an output");
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[start..].chunks_exact(4).map(|chunk| chunk.try_into().expect("four")).collect()
}

/// 7 spheres and 101 rays (so that the last packet is not full), hostile ones among them.
fn data() -> (Vec<f32>, Vec<f32>) {
    let mut state = 1_u32;
    let mut number = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let mut spheres: Vec<f32> = (0..7 * 4).map(|_| number()).collect();
    spheres.iter_mut().skip(3).step_by(4).for_each(|radius| *radius = radius.abs());
    spheres[4 * 2 + 3] = -1.0;
    spheres[4 * 3] = f32::NAN;
    let mut rays = Vec::new();
    for _ in 0..101 {
        let origin = [3.0 * number(), 3.0 * number(), 3.0 * number()];
        rays.extend(origin);
        rays.extend(origin.map(|x| 0.5 * number() - x));
        rays.extend([0.0, f32::INFINITY]);
    }
    rays[8 * 5 + 3] = f32::NAN;
    rays[8 * 6 + 6] = 1e9;
    (spheres, rays)
}

fn ray(row: &[f32]) -> Ray {
    let (origin, direction) = (Vec3::from_slice(&row[0..3]), Vec3::from_slice(&row[3..6]));
    Ray { origin, direction, t_min: row[6], t_max: row[7] }
}

/// The answer for one ray by the one-lane kernel, as bits of t and an index.
fn scalar(tier: &str, ray: &Ray, spheres: &[f32]) -> (u32, i32) {
    let column = |i: usize| spheres.iter().skip(i).step_by(4).copied().collect::<Vec<_>>();
    let (x, y, z, r) = (column(0), column(1), column(2), column(3));
    let spheres = Spheres::new(&x, &y, &z, &r).expect("equal lengths");
    let hit = match tier {
        "fast" => nearest_hit::<Fast>(ray, spheres),
        "stable" => nearest_hit::<Stable>(ray, spheres),
        _ => nearest_hit::<Exact>(ray, spheres),
    };
    hit.map_or((f32::INFINITY.to_bits(), -1), |hit| (hit.t.to_bits(), hit.sphere as i32))
}

fn inputs(name: &str, spheres: &[f32], rays: &[f32]) -> (PathBuf, PathBuf) {
    (
        file(&format!("{name}.s.npy"), &array(spheres.len() / 4, 4, spheres)),
        file(&format!("{name}.r.npy"), &array(rays.len() / 8, 8, rays)),
    )
}

/// Runs `trace` on data and returns what it printed, the bits of t, and the indices.
fn trace(name: &str, spheres: &[f32], rays: &[f32], words: &str) -> (String, Vec<u32>, Vec<i32>) {
    let (spheres, rays) = inputs(name, spheres, rays);
    let (t, id) = (file(&format!("{name}.t.npy"), b""), file(&format!("{name}.i.npy"), b""));
    let mut arguments = vec!["trace".into(), "--spheres".into(), spheres.into_os_string()];
    arguments.extend(["--rays".into(), rays.into_os_string()]);
    arguments.extend(["--out-id".into(), id.clone().into_os_string()]);
    if !words.contains("--any") {
        arguments.extend(["--out-t".into(), t.clone().into_os_string()]);
    }
    arguments.extend(words.split_whitespace().map(Into::into));
    let text = printed(&run(arguments));
    let t = if words.contains("--any") { Vec::new() } else { column(&t) };
    (
        text,
        t.into_iter().map(u32::from_le_bytes).collect(),
        column(&id).into_iter().map(i32::from_le_bytes).collect(),
    )
}

#[test]
fn nearest_hits_are_those_of_a_scalar_loop() {
    let (spheres, rays) = data();
    for tier in ["fast", "stable", "exact"] {
        let words = format!("--accuracy {tier} --repeat 3");
        let (text, t, id) = trace(tier, &spheres, &rays, &words);
        let expected: Vec<_> =
            rays.chunks(8).map(|row| scalar(tier, &ray(row), &spheres)).collect();
        let met: Vec<_> = t.into_iter().zip(id).collect();
        assert_eq!(met, expected);
        let hits = expected.iter().filter(|(_, id)| *id >= 0).count();
        assert!(hits > 20 && hits < 101);
        let start =
            format!("rays=101 spheres=7 hits={hits} structure=brute accuracy={tier} level=");
        assert!(text.starts_with(&start) && text.ends_with('\n'), "{text}");
        for key in ["lanes=", "threads=", "build_ms=", "mrays_per_s="] {
            assert!(text.contains(&format!(" {key}")), "{text}");
        }
    }
}

#[test]
fn any_is_one_or_nought() {
    let (spheres, rays) = data();
    let (_, t, id) = trace("any", &spheres, &rays, "--any");
    let expected: Vec<_> =
        rays.chunks(8).map(|row| i32::from(scalar("exact", &ray(row), &spheres).1 >= 0)).collect();
    assert_eq!((t.len(), id), (0, expected));
}

#[test]
fn pairs_meet_their_own_sphere_alone() {
    let (spheres, rays) = data();
    let spheres: Vec<f32> = spheres.iter().copied().cycle().take(101 * 4).collect();
    for words in ["--pairs", "--pairs --any --json"] {
        let (text, t, id) = trace("pairs", &spheres, &rays, words);
        let mut hits = 0;
        for (index, (row, sphere)) in rays.chunks(8).zip(spheres.chunks(4)).enumerate() {
            let (expected, met) = scalar("exact", &ray(row), sphere);
            let is_hit = met >= 0;
            hits += i32::from(is_hit);
            if words == "--pairs" {
                assert_eq!(
                    (t[index], id[index]),
                    (expected, if is_hit { index as i32 } else { -1 })
                );
            } else {
                assert_eq!(id[index], i32::from(is_hit));
            }
        }
        assert!(hits > 5);
        if words.contains("json") {
            let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            assert_eq!((&report["hits"], &report["rays"]), (&hits.into(), &101.into()));
            assert_eq!(report["structure"], "brute");
            assert!(report["threads"].as_u64() > Some(0));
        }
    }
}

#[test]
fn nothing_meets_nothing() {
    let (spheres, rays) = data();
    let (_, t, id) = trace("no-spheres", &[], &rays, "");
    assert!(t.iter().all(|&t| t == f32::INFINITY.to_bits()) && id.iter().all(|&id| id == -1));
    let (text, t, _) = trace("no-rays", &spheres, &[], "--repeat 2");
    assert!(t.is_empty() && text.starts_with("rays=0 spheres=7 hits=0 "));
}

#[test]
fn a_single_sphere_by_hand() {
    let rays = [0.0, 0.0, -3.0, 0.0, 0.0, 2.0, 0.0, f32::INFINITY];
    let (_, t, id) = trace("hand", &[0.0, 0.0, 0.0, 1.0], &rays, "");
    assert_eq!((t, id), (vec![1.0_f32.to_bits()], vec![0]));
}

/// What is said about this file of rays, after its name.
fn refused(name: &str, bytes: &[u8]) -> String {
    // Tests run side by side: a file that two of them write is empty for a moment.
    let spheres = file(&format!("{name}.s.npy"), &array(1, 4, &[0.0, 0.0, 0.0, 1.0]));
    let rays = file(name, bytes);
    let words = ["trace".as_ref(), "--spheres".as_ref(), spheres.as_os_str(), "--rays".as_ref()];
    let message = refusal(&run(words.into_iter().chain([rays.as_os_str()])));
    message.strip_prefix(&rays.display().to_string()).expect("the file's name").to_owned()
}

#[test]
fn arrays_that_are_none() {
    let header = |descr: &str, order: &str, shape: &str| {
        format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}\n")
    };
    let good = header("'<f4'", "False", "(1, 8)");
    let data = [0_u8; 32];
    assert_eq!(refused("magic.npy", b"not an array at all"), ": no .npy file");
    assert_eq!(refused("short.npy", b"\x93NUM"), ": no .npy file: it ends within its header");
    assert_eq!(refused("empty.npy", b""), ": no .npy file: it ends within its header");
    let dtype = |name, descr| refused(name, &npy(&header(descr, "False", "(1, 8)"), &[0; 64]));
    assert!(dtype("double.npy", "'<f8'").starts_with(": dtype '<f8', not '<f4'"));
    assert!(dtype("big.npy", "'>f4'").starts_with(": dtype '>f4', not '<f4'"));
    assert!(dtype("int.npy", "'<i4'").starts_with(": dtype '<i4', not '<f4'"));
    assert!(dtype("object.npy", "'|O'").starts_with(": dtype '|O', not '<f4'"));
    assert!(dtype("record.npy", "[('x', '<f4')]").starts_with(": dtype [('x', '<f4')"));
    let fortran = npy(&header("'<f4'", "True", "(1, 8)"), &data);
    assert!(refused("fortran.npy", &fortran).starts_with(": in Fortran order"));
    for (name, shape) in
        [("flat", "(8,)"), ("cube", "(1, 8, 1)"), ("wide", "(1, 4)"), ("none", "()")]
    {
        let message =
            refused(&format!("{name}.npy"), &npy(&header("'<f4'", "False", shape), &data));
        assert!(message.starts_with(": shape ") && message.ends_with("not (N, 8)"), "{message}");
    }
    let fewer = refused("fewer.npy", &npy(&good, &data[1..]));
    assert_eq!(fewer, ": fewer bytes than the 32 of its shape (1, 8)");
    let more = refused("more.npy", &npy(&good, &[0; 33]));
    assert_eq!(more, ": more bytes than the 32 of its shape (1, 8)");
    assert!(refused("brackets.npy", &npy(&"(".repeat(60_000), &[])).contains("a header of 60000"));
    assert!(refused("deep.npy", &npy(&"(".repeat(1000), &[])).starts_with(": "));
    assert!(refused("version.npy", b"\x93NUMPY\x09\x00\x00\x00").contains("unknown version 9"));
}

#[test]
fn a_header_that_lies_about_its_shape_or_length() {
    for (name, rows) in [("lie1", "1000000000000"), ("lie2", "4611686018427387904")] {
        let header =
            format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({rows}, 8), }}\n");
        let message = refused(&format!("{name}.npy"), &npy(&header, &[0; 32]));
        assert!(
            message.contains("bytes than") || message.contains("larger than any file"),
            "{message}"
        );
    }
    let two = "{'descr': '<f4', 'fortran_order': False, 'shape': (9999999999, 9999999999), }\n";
    assert!(refused("lie3.npy", &npy(two, &[])).contains("larger than any file"));
    let long = b"\x93NUMPY\x02\x00\xff\xff\xff\xff{}";
    assert!(refused("lie4.npy", long).contains("a header of 4294967295 bytes"));
}

#[test]
fn rays_and_spheres_that_do_not_fit() {
    let (spheres, rays) = data();
    let (spheres, rays) = inputs("unpaired", &spheres, &rays);
    let words = ["trace".as_ref(), "--pairs".as_ref(), "--spheres".as_ref(), spheres.as_os_str()];
    let message = refusal(&run(words.into_iter().chain(["--rays".as_ref(), rays.as_os_str()])));
    assert!(message.ends_with("101 rays and 7 spheres are no pairs"), "{message}");
    assert!(refusal(&run(["trace", "--rays", "r.npy"])).contains("--spheres"));
    let both = "trace --spheres s --rays r --any --out-t t".split(' ');
    assert!(refusal(&run(both)).contains("cannot be used with"));
    let missing = "trace --spheres no-such.npy --rays r.npy".split(' ');
    assert_eq!(refusal(&run(missing)), "no-such.npy: no such file or directory");
}

#[test]
fn an_output_that_cannot_be_written_is_a_failure() {
    let (spheres, rays) = data();
    let (spheres, rays) = inputs("unwritable", &spheres, &rays);
    for target in ["/dev/full", "no/such/folder/t.npy"] {
        let output = program::spherule()
            .args(["trace", "--out-t", target, "--spheres"])
            .arg(&spheres)
            .arg("--rays")
            .arg(&rays)
            .output()
            .expect("the program runs");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{stderr}");
        assert!(stderr.starts_with(&format!("spherule: {target}: ")), "{stderr}");
    }
}
