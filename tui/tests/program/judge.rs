//! `spherule cases` and `spherule judge`: what one writes the other judges, and what both refuse.

mod again;
mod precision;

use crate::run::{
    self, array, file, folder, header, json, names, npy, printed, prints, refusal, refuses, run,
    run_with_input, split,
};
use serde_json::Value;
use spherule_kernel::{Exact, Ray, Sphere, Vec3, roots};
use spherule_referee::ulp::ulp_between;
use std::fs;

/// The data of a `.npy` file.
fn data(path: &str) -> Vec<u8> {
    run::data(&fs::read(path).expect("a file")).to_vec()
}

fn floats(path: &str) -> Vec<f32> {
    data(path).as_chunks().0.iter().map(|&x| f32::from_le_bytes(x)).collect()
}

/// A file of one column.
fn column(dtype: &str, rows: usize, data: &[u8]) -> Vec<u8> {
    npy(&header(&format!("'{dtype}'"), "False", &format!("({rows},)")), data)
}

/// Spheres, rays, families, and where the answers go.
#[derive(Clone)]
struct Files {
    spheres: String,
    rays: String,
    family: String,
    t: String,
    id: String,
}

impl Files {
    /// Cases of all families, and what a tier answers.
    fn new(name: &str, options: &str, tier: &str) -> Self {
        let files = ["s", "r", "f", "t", "i"].map(|part| format!("judge-{name}.{part}.npy"));
        let [spheres, rays, family, t, id] = files.map(|name| file(&name, b""));
        let cases = format!("--out-spheres {spheres} --out-rays {rays} --out-family {family}");
        assert_eq!(prints(&format!("cases {options} {cases}")), "");
        let arrays = format!("--spheres {spheres} --rays {rays} --out-t {t} --out-id {id}");
        prints(&format!("trace --pairs --accuracy {tier} {arrays}"));
        Self { spheres, rays, family, t, id }
    }

    /// The words that have the answers judged.
    fn judge(&self, options: &str) -> String {
        let Self { spheres, rays, t, .. } = self;
        format!("judge {options} --spheres {spheres} --rays {rays} --t {t}")
    }

    /// The same answers in double precision.
    fn double(self) -> Self {
        let t = floats(&self.t);
        let doubles: Vec<u8> = t.iter().flat_map(|&t| f64::from(t).to_le_bytes()).collect();
        fs::write(&self.t, column("<f8", t.len(), &doubles)).expect("a writable folder");
        self
    }

    fn report(&self, options: &str) -> Value {
        json(&self.judge(&format!("--json --family {} {options}", self.family)))
    }
}

const KINDS: [&str; 6] =
    ["false_hit", "lost_hit", "other_root", "other_sphere", "t_off", "no_answer"];

#[test]
fn exact_is_right_in_every_family() {
    let files = Files::new("exact", "--count 2400", "exact");
    let report = files.report(&format!("--pairs --id {}", files.id));
    assert_eq!(report["families"].as_array().map(Vec::len), Some(24));
    for by in ["by_rules", "by_contract"] {
        assert_eq!(report["all"][by]["judged"], 2400);
        assert_eq!(KINDS.map(|kind| report["all"][by][kind].as_u64()), [Some(0); 6], "{report}");
    }
    assert!(report["all"]["by_rules"]["hits"].as_u64() > Some(700));
}

#[test]
fn fast_is_wrong_and_the_snippet_has_the_numbers() {
    let files = Files::new("fast", "--count 2400 --family far-1e4,small-integers", "fast");
    let report = files.report("--pairs");
    assert_eq!(report["rays"], 2400);
    let families = report["families"].as_array().expect("a list");
    assert_eq!((families.len(), &families[0]["family"]), (2, &"far-1e4".into()));
    let counts = &families[0]["by_rules"];
    assert!(counts["false_hit"].as_u64() > Some(100) && counts["lost_hit"].as_u64() > Some(100));
    let failure = &report["failures"][0]["smallest"];
    assert_eq!((&failure["truth"], &failure["family"]), (&Value::Null, &"far-1e4".into()));
    let row = failure["row"].as_u64().expect("a row") as usize;
    let rays = floats(&files.rays);
    let python = failure["python"].as_str().expect("a text");
    let c = failure["c"].as_str().expect("a text");
    for x in &rays[8 * row..8 * row + 6] {
        let hex = spherule_referee::snippet::hex(*x);
        assert!(python.contains(&format!("h(\"{hex}\")")) && c.contains(&format!("{hex}f")), "{x}");
    }
    // The same in words, and a picture.
    let text = prints(&files.judge("--pairs --chart"));
    assert!(text.starts_with("2400 rays, 2400 spheres\nfamily "), "{text}");
    for part in [
        "smallest, row ",
        "worst, row ",
        "const float ray[8]",
        "float.fromhex",
        "let ray: [f32; 8]",
        "wrong decisions by |D|",
    ] {
        assert!(text.contains(part), "{part}");
    }
}

#[test]
fn rays_that_share_spheres_are_judged_with_what_they_name() {
    let ray = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, f32::INFINITY];
    let [spheres, rays, t, id, family] = [
        ("s", array(2, 4, &[0.0, 0.0, 5.0, 1.0, 0.0, 0.0, 9.0, 1.0])),
        ("r", array(3, 8, &[ray; 3].concat())),
        ("t", column("<f4", 3, &[4.0_f32, 8.0, 6.0].map(f32::to_le_bytes).concat())),
        ("i", column("<i4", 3, &[0_i32, 1, 0].map(i32::to_le_bytes).concat())),
        ("f", column("|u1", 3, &[0; 3])),
    ]
    .map(|(name, bytes)| file(&format!("judge-shared.{name}.npy"), bytes));
    let files = Files { spheres, rays, family, t, id };
    let report = json(&format!("{} --id {}", files.judge("--json"), files.id));
    let counts = &report["all"]["by_rules"];
    let found = KINDS.map(|kind| counts[kind].as_u64());
    assert_eq!(found, [0, 0, 1, 1, 0, 0].map(Some), "{report}");
}

/// NaN, -inf, and a sphere past the last, whose lowest bits are those of the first.
#[test]
fn what_is_no_answer_is_counted() {
    let files = Files::new("no-answer", "--count 4 --family ordinary", "exact");
    let t = [f32::NAN, f32::NEG_INFINITY, 1.0, f32::INFINITY].map(f32::to_le_bytes).concat();
    let id = [-1, 3, 1_i64 << 32, -1].map(i64::to_le_bytes).concat();
    fs::write(&files.t, column("<f4", 4, &t)).expect("a writable folder");
    fs::write(&files.id, column("<i8", 4, &id)).expect("a writable folder");
    let id = format!("--id {}", files.id);
    for (options, expected) in [("--pairs", 2), ("", 2), (&*id, 3)] {
        let report = files.report(options);
        assert_eq!(report["all"]["by_rules"]["no_answer"], expected, "{options}: {report}");
        let worst = &report["failures"][5]["worst"];
        assert_eq!((&worst["row"], &worst["answer"]["t"]), (&0.into(), &Value::Null), "{worst}");
    }
    let text = prints(&files.judge("--pairs"));
    assert!(text.contains("answered was t = NaN\n"), "{text}");
}

#[test]
fn one_ray_and_one_sphere_are_singular() {
    let files = Files::new("one", "--count 1 --family ordinary", "exact");
    let report = prints(&files.judge("--pairs"));
    assert!(report.starts_with("1 ray, 1 sphere\n"), "{report}");
}

#[test]
fn answers_that_are_none() {
    let files = Files::new("none", "--count 4 --family ordinary", "exact");
    let four = |t: [f32; 4]| column("<f4", 4, &t.map(f32::to_le_bytes).concat());
    let refused = |t: Vec<u8>, id: Option<[i32; 4]>, options: &str| {
        let t = file("judge-none.other-t.npy", t);
        let id = id.map_or_else(String::new, |id| {
            let bytes = column("<i4", 4, &id.map(i32::to_le_bytes).concat());
            format!("--id {}", file("judge-none.other-i.npy", bytes))
        });
        refuses(&Files { t, ..files.clone() }.judge(&format!("{options} {id}")))
    };
    let inf = f32::INFINITY;
    let misses = || four([inf; 4]);
    for (t, id, end) in [
        (four([1.0, inf, inf, inf]), Some([-2, -1, -1, -1]), "row 0: id -2 of 4 spheres"),
        (four([1.0; 4]), Some([0, 1, -1, 3]), "row 2: t = 1 where nothing is hit; +inf with id -1"),
        (misses(), Some([-1, 2, -1, -1]), "row 1: id 2 without a hit; -1 with t = +inf"),
        (column("<f4", 3, &[0; 12]), None, "3 rows, and 4 rays"),
        (column("<f4", 4, &[0; 15]), None, "fewer bytes than 4 rows have"),
        (column("<f4", 4, &[0; 17]), None, "more bytes than 4 rows have"),
        (column("<i4", 4, &[0; 16]), None, "dtype '<i4', not '<f4' or '<f8'"),
        (column(">f4", 4, &[0; 16]), None, "dtype '>f4', not '<f4' or '<f8'"),
        (array(4, 1, &[0.0; 4]), None, "shape [4, 1], not (N,)"),
    ] {
        let message = refused(t, id, "");
        assert!(message.ends_with(end), "{end}: {message}");
    }
    let pair = refused(four([1.0; 4]), Some([0, 0, 2, 3]), "--pairs");
    assert!(pair.ends_with("row 1: id 0; 1 of a pair, or -1"), "{pair}");
    for (rules, part) in [
        ("\nshape = 3\n", ".toml:2:1: unknown field `shape`"),
        ("tangents = \"maybe\"", ".toml:1:12: unknown variant `maybe`"),
        (&*"#".repeat((64 << 10) + 1), ": rules have at most 64 KiB"),
        ("smallest = 2.0\nlargest = 1.0\n", "no size is between them"),
        ("inside = \"solid\"\n", "inside = \"solid\" answers t = 0"),
        ("precision = \"f64\"\n", "the answers are float32"),
    ] {
        let rules = file("judge-none.toml", rules);
        let message = refused(misses(), None, &format!("--rules {rules}"));
        assert!(message.contains(part), "{part}: {message}");
    }
    let family = file("judge-none.other-f.npy", column("|u1", 4, &[0, 1, 99, 0]));
    let message = refused(misses(), None, &format!("--family {family}"));
    let what = "row 2: no family has the number 99; numbers are 0 to 23";
    assert!(message.ends_with(what), "{message}");
    let missing = refused(misses(), None, "--rules no-such.toml");
    assert_eq!(missing, "no-such.toml: no such file or directory");
}

/// A header may claim sixteen terabytes, which a pipe need not have.
#[test]
fn spheres_of_a_pipe_take_the_memory_that_they_need() {
    let files = Files::new("pipe", "--count 4 --family ordinary", "exact");
    let line = Files { spheres: "/dev/stdin".to_owned(), ..files }.judge("");
    let refused = refusal(&run_with_input(&line, &array(1_000_000_000_000, 4, &[1.0; 8])));
    assert!(refused.ends_with("fewer bytes than 1000000000000 rows have"), "{refused}");
    // More than are read at once.
    let many: Vec<f32> = (0..20_000).flat_map(|x| [x as f32, 0.0, 5.0, 0.25]).collect();
    let report = printed(run_with_input(&line, &array(20_000, 4, &many)));
    assert!(report.starts_with("4 rays, 20000 spheres\n"), "{report}");
}

#[test]
fn cases_are_the_same_as_lines_and_in_files() {
    let files = Files::new("lines", "--count 60 --seed 7", "exact");
    let [rays, spheres, t] = [&files.rays, &files.spheres, &files.t].map(|path| floats(path));
    let lines = prints("cases --json --count 60 --seed 7");
    assert_eq!(lines.lines().count(), 60);
    let hex = |x: f32| Value::from(spherule_referee::snippet::hex(x));
    for (index, line) in lines.lines().enumerate() {
        let case: Value = serde_json::from_str(line).expect("JSON");
        assert_eq!(case["origin"][1], hex(rays[8 * index + 1]));
        assert_eq!(case["t_max"], hex(rays[8 * index + 7]));
        assert_eq!(case["radius"], hex(spheres[4 * index + 3]));
        let expected = if t[index].is_finite() { hex(t[index]) } else { Value::Null };
        assert_eq!(case["t"], expected);
    }
    assert_eq!(data(&files.family)[22..26], [22, 23, 0, 1]);
    let list = prints("cases");
    assert_eq!(list.lines().count(), 24);
    assert!(list.contains(" 5 tangent "));
}

/// Directions that are brought to length one leave intervals where they end on the ray.
#[test]
fn unit_directions_keep_ends_at_roots() {
    let files = Files::new("unit", "--unit --count 400 --family interval-at-root", "exact");
    let (rays, spheres) = (floats(&files.rays), floats(&files.spheres));
    let is_at_root = |(ray, sphere): &(&[f32; 8], &[f32; 4])| {
        let [x, y, z, dx, dy, dz, t_min, t_max] = **ray;
        let ray = Ray::new(Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
        assert!((ray.direction.length() - 1.0).abs() < 1e-6, "{ray:?}");
        let is_end = |root| [t_min, t_max].iter().any(|end| ulp_between(root, *end) <= 2);
        let roots = roots(Exact, &ray, &Sphere::from(**sphere));
        roots.is_some_and(|roots| roots.into_iter().any(is_end))
    };
    let cases = rays.as_chunks::<8>().0.iter().zip(spheres.as_chunks::<4>().0);
    let count = cases.filter(is_at_root).count();
    assert!(count > 300, "{count} of 400");
}

#[test]
fn cases_that_cannot_be_written_leave_nothing() {
    let folder = folder("judge-half");
    let cases = "cases --count 100000 --out-rays /dev/full --out-spheres";
    let output = run(split(&format!("{cases} {}/s.npy", folder.display())));
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(names(&folder), [""; 0]);
}
