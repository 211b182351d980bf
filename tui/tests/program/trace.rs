//! `spherule trace` against a scalar loop, and its refusals.

use crate::run::{array, failure, file, header, npy, prints, refuses, run, split};
use crate::scenes::inward;
use crate::traced::{inputs, traced};
use spherule_kernel::{Intersect, Ray, SphereList, Tier, Vec3};
use spherule_referee::random::Random;
use std::path::Path;

/// 7 spheres and 101 rays (so that the last packet is not full), hostile ones among them.
fn data() -> (Vec<f32>, Vec<f32>) {
    let mut random = Random::seeded(1);
    let mut spheres: Vec<f32> = (0..7 * 4).map(|_| random.between(-1.0, 1.0)).collect();
    spheres.iter_mut().skip(3).step_by(4).for_each(|radius| *radius = radius.abs());
    spheres[4 * 2 + 3] = -1.0;
    spheres[4 * 3] = f32::NAN;
    let mut rays = inward(101);
    rays[8 * 5 + 3] = f32::NAN;
    rays[8 * 6 + 6] = 1e9;
    (spheres, rays)
}

/// The answer for each ray by itself: the bits of t, and an index.
fn scalar(tier: Tier, rays: &[f32], spheres: &[f32]) -> Vec<(u32, i32)> {
    let spheres = SphereList::from(spheres.as_chunks::<4>().0);
    let answer = |row: &[f32]| {
        let (origin, direction) = (Vec3::from_slice(&row[0..3]), Vec3::from_slice(&row[3..6]));
        let ray = Ray { origin, direction, t_min: row[6], t_max: row[7] };
        let hit = spheres.closest_hit(tier, &ray);
        hit.map_or((f32::INFINITY.to_bits(), -1), |hit| (hit.t.to_bits(), hit.sphere as i32))
    };
    rays.chunks(8).map(answer).collect()
}

#[test]
fn closest_hits_are_those_of_a_scalar_loop() {
    let (spheres, rays) = data();
    for tier in Tier::ALL {
        let name = tier.as_str();
        let found = traced(name, &spheres, &rays, &format!("--accuracy {name} --repeat 3"));
        let expected = scalar(tier, &rays, &spheres);
        let met: Vec<_> = found.t().into_iter().zip(found.id()).collect();
        assert_eq!(met, expected);
        let hits = expected.iter().filter(|(_, id)| *id >= 0).count();
        assert!(hits > 20 && hits < 101);
        let start =
            format!("rays=101 spheres=7 hits={hits} structure=brute accuracy={name} level=");
        assert!(found.text.starts_with(&start) && found.text.ends_with('\n'), "{}", found.text);
        for key in ["lanes", "threads", "build_ms", "mrays_per_s"] {
            assert!(!found.value(key).is_empty());
        }
    }
}

#[test]
fn any_is_one_or_nought() {
    let (spheres, rays) = data();
    let found = traced("any", &spheres, &rays, "--any");
    let expected = scalar(Tier::Exact, &rays, &spheres);
    assert!(found.id().into_iter().eq(expected.into_iter().map(|(_, id)| i32::from(id >= 0))));
    assert!(found.files[0].is_empty());
}

#[test]
fn pairs_meet_their_own_sphere_alone() {
    let (spheres, rays) = data();
    let spheres: Vec<f32> = spheres.iter().copied().cycle().take(101 * 4).collect();
    let pairs = rays.chunks(8).zip(spheres.chunks(4));
    let expected: Vec<_> = pairs.map(|(ray, sphere)| scalar(Tier::Exact, ray, sphere)[0]).collect();
    let hits = expected.iter().filter(|(_, id)| *id >= 0).count();
    assert!(hits > 5);

    let found = traced("pairs", &spheres, &rays, "--pairs");
    for (index, (t, id)) in expected.iter().enumerate() {
        let id = if *id >= 0 { index as i32 } else { -1 };
        assert_eq!((found.t()[index], found.id()[index]), (*t, id));
    }
    let any = traced("pairs", &spheres, &rays, "--pairs --any --json");
    assert!(any.id().into_iter().eq(expected.iter().map(|(_, id)| i32::from(*id >= 0))));
    let report: serde_json::Value = serde_json::from_str(&any.text).expect("JSON");
    assert_eq!((&report["hits"], &report["rays"]), (&hits.into(), &101.into()));
    assert_eq!(report["structure"], "brute");
    assert!(report["threads"].as_u64() > Some(0));
}

#[test]
fn nothing_meets_nothing() {
    let (spheres, rays) = data();
    let found = traced("no-spheres", &[], &rays, "");
    assert_eq!((found.t(), found.id()), (vec![f32::INFINITY.to_bits(); 101], vec![-1; 101]));
    let found = traced("no-rays", &spheres, &[], "--repeat 2");
    assert!(found.t().is_empty() && found.text.starts_with("rays=0 spheres=7 hits=0 "));
}

/// What is said about this file of rays, after its name.
fn refused(name: &str, bytes: &[u8]) -> String {
    // Tests run side by side: a file that two of them write is empty for a moment.
    let spheres = file(&format!("{name}.s.npy"), array(1, 4, &[0.0, 0.0, 0.0, 1.0]));
    let rays = file(name, bytes);
    let message = refuses(&format!("trace --spheres {spheres} --rays {rays}"));
    message.strip_prefix(&rays).expect("the file's name").to_owned()
}

#[test]
fn arrays_that_are_none() {
    let header = |descr: &str, shape: &str| header(descr, "False", shape);
    assert_eq!(refused("magic.npy", b"not an array at all"), ": not a .npy file");
    assert_eq!(refused("short.npy", b"\x93NUM"), ": not a .npy file: it ends within its header");
    assert_eq!(refused("empty.npy", b""), ": not a .npy file: it ends within its header");
    for (name, descr, begin) in [
        ("int.npy", "'<i4'", ": dtype '<i4', not float32"),
        ("object.npy", "'|O'", ": dtype '|O', not float32"),
        ("record.npy", "[('x', '<f4')]", ": dtype [('x', '<f4')"),
    ] {
        let message = refused(name, &npy(&header(descr, "(1, 8)"), &[0; 64]));
        assert!(message.starts_with(begin), "{message}");
    }
    for (name, shape) in [
        ("flat.npy", "(8,)"),
        ("cube.npy", "(1, 8, 1)"),
        ("wide.npy", "(1, 4)"),
        ("none.npy", "()"),
    ] {
        let message = refused(name, &npy(&header("'<f4'", shape), &[0; 32]));
        assert!(message.starts_with(": shape ") && message.contains("not "), "{message}");
    }
    let good = header("'<f4'", "(1, 8)");
    let fewer = refused("fewer.npy", &npy(&good, &[0; 31]));
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
        let header = header("'<f4'", "False", &format!("({rows}, 8)"));
        let message = refused(&format!("{name}.npy"), &npy(&header, &[0; 32]));
        assert!(
            message.contains("bytes than") || message.contains("larger than any file"),
            "{message}"
        );
    }
    let two = header("'<f4'", "False", "(9999999999, 9999999999)");
    assert!(refused("lie3.npy", &npy(&two, &[])).contains("larger than any file"));
    let long = b"\x93NUMPY\x02\x00\xff\xff\xff\xff{}";
    assert!(refused("lie4.npy", long).contains("a header of 4294967295 bytes"));
}

#[test]
fn rays_and_spheres_that_do_not_fit() {
    let (spheres, rays) = data();
    let message = refuses(&format!("trace --pairs {}", inputs("unpaired", &spheres, &rays)));
    assert!(message.ends_with("101 rays, 7 spheres; --pairs needs as many of each"), "{message}");
}

#[test]
fn an_output_that_cannot_be_written_is_a_failure() {
    let (spheres, rays) = data();
    let inputs = inputs("unwritable", &spheres, &rays);
    for target in ["/dev/full", "no/such/folder/t.npy"] {
        let words = format!("trace --out-t {target} {inputs}");
        let message = failure(&run(split(&words)));
        assert!(message.starts_with(&format!("{target}: ")), "{message}");
    }
}

/// What was there before stays until both are whole, each in a file of its own.
#[test]
fn an_output_is_no_half_of_two_and_not_standard_output() {
    let (spheres, rays) = data();
    let inputs = inputs("halves", &spheres, &rays);
    let t = file("halves.t.npy", "before");
    let words =
        |out_t: &str, out_id: &str| format!("trace --out-t {out_t} --out-id {out_id} {inputs}");
    let failed = run(split(&words(&t, "no/such/i.npy")));
    assert_eq!(failed.status.code(), Some(1));
    let message = "-: standard output has the report; name a file";
    assert_eq!(refuses(&words("-", "no/such/i.npy")), format!("--out-t {message}"));
    assert_eq!(refuses(&words(&t, "-")), format!("--out-id {message}"));
    let folder = Path::new(&t).parent().expect("a folder").display();
    for again in
        [t.clone(), format!("{folder}/./halves.t.npy"), format!("{folder}/.//halves.t.npy")]
    {
        let message = refuses(&words(&t, &again));
        assert_eq!(message, format!("--out-id {again}: --out-t has that file; name another"));
    }
    for (option, input) in [("--spheres", "halves.s.npy"), ("--rays", "halves.r.npy")] {
        let input = format!("{folder}/{input}");
        let before = std::fs::read(&input).expect("a file");
        let what = format!("{option} is read from that file; name another");
        assert_eq!(refuses(&words(&t, &input)), format!("--out-id {input}: {what}"));
        assert!(std::fs::read(&input).expect("a file") == before);
    }
    prints(&words("/dev/null", "/dev/null"));
    assert_eq!(std::fs::read(&t).expect("a file"), b"before");
}

/// Numbers of either size and byte order, in either order of axes: the same rays and spheres.
#[test]
fn arrays_of_numpy_s_own_kinds() {
    let (spheres, rays) = data();
    let expected = traced("kinds", &spheres, &rays, "").text;
    let hits =
        |text: &str| text.split(' ').find(|word| word.starts_with("hits=")).map(str::to_owned);
    for (descr, size, is_big) in [("'<f8'", 8, false), ("'>f8'", 8, true), ("'>f4'", 4, true)] {
        for order in ["False", "True"] {
            let array = |values: &[f32], width: usize| {
                let rows = values.len() / width;
                let place = |index: usize| match order {
                    "True" => index % rows * width + index / rows,
                    _ => index,
                };
                let bytes = (0..values.len()).flat_map(|index| {
                    let value = values[place(index)];
                    let mut bytes = match size {
                        8 => f64::from(value).to_le_bytes().to_vec(),
                        _ => value.to_le_bytes().to_vec(),
                    };
                    if is_big {
                        bytes.reverse();
                    }
                    bytes
                });
                let header = header(descr, order, &format!("({rows}, {width})"));
                npy(&header, &bytes.collect::<Vec<u8>>())
            };
            let name = format!("kind{size}{is_big}{order}");
            let s = file(&format!("{name}.s.npy"), array(&spheres, 4));
            let r = file(&format!("{name}.r.npy"), array(&rays, 8));
            let found = prints(&format!("trace --spheres {s} --rays {r}"));
            assert_eq!(hits(&found), hits(&expected), "{name}");
        }
    }
}
