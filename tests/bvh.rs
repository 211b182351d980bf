//! The tree answers as brute force does, bit for bit, in every tier, lane width and instruction
//! set; no input makes it deep, slow or large.

use proptest::prelude::*;
use spherule_kernel::fearless_simd::{self, Level, Simd, dispatch};
use spherule_kernel::{
    Accuracy, Bvh, BvhLeaf, BvhNode, BvhSize, Exact, Hit, HitPacket, Lanes, Ray, RayPacket, Sphere,
    Stable, Vec3, bvh, f32x4, f32x8, f32x16,
};
use spherule_tests::case::{Case, HexRay};
use spherule_tests::doors::{Columns, DOORS, Door};
use spherule_tests::inputs::{self, SPECIALS, Scene};
use spherule_tests::random::Random;
use spherule_tests::regimes::REGIMES;
use std::time::{Duration, Instant};

/// Memory for a tree, filled with what must not matter.
struct Memory {
    nodes: Vec<BvhNode>,
    leaves: Vec<BvhLeaf>,
}

impl Memory {
    fn new(count: usize) -> Self {
        let BvhSize { nodes, leaves } = Bvh::needed(count);
        Self { nodes: vec![BvhNode::EMPTY; nodes], leaves: vec![BvhLeaf::EMPTY; leaves] }
    }

    fn build(&mut self, spheres: &Columns) -> Bvh<'_> {
        Bvh::build(spheres.spheres(), &mut self.nodes, &mut self.leaves).expect("enough memory")
    }
}

type Answers = (Vec<Option<Hit>>, Vec<bool>);

/// A tier in a lane width and an instruction set, by way of a tree.
#[derive(Clone, Copy)]
struct Way {
    tier: &'static str,
    name: &'static str,
    walk: fn(&[Ray], &Columns, &Bvh<'_>) -> Answers,
}

fn walk<A: Accuracy, L: Lanes<Token = ()>>(
    rays: &[Ray],
    spheres: &Columns,
    bvh: &Bvh<'_>,
) -> Answers {
    walk_with::<A, L>((), rays, spheres, bvh)
}

#[inline(always)]
fn walk_with<A: Accuracy, L: Lanes>(
    token: L::Token,
    rays: &[Ray],
    spheres: &Columns,
    bvh: &Bvh<'_>,
) -> Answers {
    let packets: Vec<RayPacket<L>> = rays.chunks(L::COUNT).map(RayPacket::<L>::new).collect();
    // What was there before must not show.
    let mut hits = vec![HitPacket::<L>::none(); packets.len()];
    let mut met = vec![u32::MAX; packets.len()];
    bvh::nearest::<A, L>(token, &packets, spheres.spheres(), bvh, &mut hits);
    bvh::any::<A, L>(token, &packets, spheres.spheres(), bvh, &mut met);
    let place = |index: usize| (index / L::COUNT, index % L::COUNT);
    (0..rays.len())
        .map(place)
        .map(|(packet, lane)| (hits[packet].hit(lane), met[packet] >> lane & 1 == 1))
        .unzip()
}

/// The instruction sets of this CPU, the best last.
fn levels() -> Vec<Level> {
    let best = Level::new();
    let lower = [best.as_sse4_2().map(Level::Sse4_2), best.as_avx2().map(Level::Avx2)];
    lower.into_iter().flatten().chain([best]).collect()
}

fn walk_dispatched<A: Accuracy, const AT: usize>(
    rays: &[Ray],
    spheres: &Columns,
    bvh: &Bvh<'_>,
) -> Answers {
    #[inline(always)]
    fn inner<A: Accuracy, S: Simd>(
        simd: S,
        rays: &[Ray],
        spheres: &Columns,
        bvh: &Bvh<'_>,
    ) -> Answers {
        simd.vectorize(
            #[inline(always)]
            || walk_with::<A, fearless_simd::f32x16<S>>(simd, rays, spheres, bvh),
        )
    }
    let levels = levels();
    let level = levels[AT.min(levels.len() - 1)];
    dispatch!(level, simd => inner::<A, _>(simd, rays, spheres, bvh))
}

const fn way<A: Accuracy, L: Lanes<Token = ()>>(name: &'static str) -> Way {
    Way { tier: A::NAME, name, walk: walk::<A, L> }
}

const fn dispatched<A: Accuracy, const AT: usize>(name: &'static str) -> Way {
    Way { tier: A::NAME, name, walk: walk_dispatched::<A, AT> }
}

const WAYS: [Way; 12] = [
    way::<Exact, f32>("1 lane"),
    way::<Exact, f32x4>("4 lanes"),
    way::<Exact, f32x8>("8 lanes"),
    way::<Exact, f32x16>("16 lanes"),
    dispatched::<Exact, 0>("16 lanes, lowest level"),
    dispatched::<Exact, 1>("16 lanes, second level"),
    dispatched::<Exact, 2>("16 lanes, third level"),
    way::<Stable, f32>("1 lane"),
    way::<Stable, f32x4>("4 lanes"),
    way::<Stable, f32x8>("8 lanes"),
    way::<Stable, f32x16>("16 lanes"),
    dispatched::<Stable, 2>("16 lanes, third level"),
];

fn brute(tier: &str) -> Door {
    let door = DOORS.into_iter().find(|door| door.tier == tier && door.lanes == 16);
    door.expect("every tier has sixteen lanes")
}

fn bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// The first ray for which a way of one of `tiers` does not answer as brute force does.
fn difference(tiers: &[&str], rays: &[Ray], spheres: &[Sphere]) -> Option<String> {
    let columns = Columns::new(spheres);
    let mut memory = Memory::new(spheres.len());
    let tree = memory.build(&columns);
    for tier in tiers {
        let door = brute(tier);
        let (expected, met) = ((door.nearest)(rays, spheres), (door.any)(rays, spheres));
        for way in WAYS.iter().filter(|way| way.tier == *tier) {
            let (hits, found) = (way.walk)(rays, &columns, &tree);
            for (i, ray) in rays.iter().enumerate() {
                if bits(hits[i]) != bits(expected[i]) || met[i] != found[i] {
                    return Some(format!(
                        "{tier}, {}, ray {i} of {}, {} spheres: {:?} any {}, by brute force {:?} any {}; {}",
                        way.name,
                        rays.len(),
                        spheres.len(),
                        hits[i],
                        found[i],
                        expected[i],
                        met[i],
                        HexRay(ray)
                    ));
                }
            }
        }
    }
    None
}

#[track_caller]
fn assert_same(tiers: &[&str], rays: &[Ray], spheres: &[Sphere]) {
    if let Some(difference) = difference(tiers, rays, spheres) {
        panic!("{difference}");
    }
}

const BOTH: &[&str] = &["exact", "stable"];
const EXACT: &[&str] = &["exact"];

fn point(random: &mut Random, size: f64) -> Vec3 {
    let mut coordinate = || random.uniform(-size, size) as f32;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// Centres in [-1, 1]^3, some eight radii apart.
fn uniform(count: usize) -> Vec<Sphere> {
    let mut random = Random::new(70, count as u64);
    let size = 0.5 * (count as f64).powf(-1.0 / 3.0);
    (0..count)
        .map(|_| Sphere {
            center: point(&mut random, 1.0),
            radius: (size * random.uniform(0.5, 1.5)) as f32,
        })
        .collect()
}

fn unit(random: &mut Random) -> Vec3 {
    Vec3::from_array(random.unit().map(|x| x as f32))
}

fn diffuse(count: usize) -> Vec<Ray> {
    let mut random = Random::new(71, 0);
    (0..count).map(|_| Ray::new(point(&mut random, 1.0), unit(&mut random))).collect()
}

/// A picture of `size` x `size` pixels from (0, 0, 4).
fn camera(size: usize) -> Vec<Ray> {
    let at = |i: usize| 0.364 * (2.0 * (i as f32 + 0.5) / size as f32 - 1.0);
    let ray = |i| Ray::new(Vec3::new(0.0, 0.0, 4.0), Vec3::new(at(i % size), at(i / size), -1.0));
    (0..size * size).map(ray).collect()
}

#[test]
fn levels_of_this_cpu() {
    println!("levels: {:?}", levels());
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx512f") {
        assert_eq!(levels().len(), 3, "the levels that the CPU has");
    }
}

#[test]
fn any_number_of_spheres() {
    let rays: Vec<Ray> = diffuse(500).into_iter().chain(camera(16)).collect();
    for count in [0, 1, 2, 15, 16, 17, 31, 33, 255, 257, 272, 273, 4097] {
        assert_same(BOTH, &rays, &uniform(count));
    }
}

#[test]
fn intervals() {
    let mut random = Random::new(72, 0);
    let mut rays = diffuse(2000);
    for ray in &mut rays {
        let ends = [f32::NEG_INFINITY, f32::INFINITY, -0.5, 0.0, -0.0, 0.1, 0.5, 1.0, f32::NAN];
        (ray.t_min, ray.t_max) = (random.pick(&ends), random.pick(&ends));
        ray.direction *= random.uniform(0.5, 2.0) as f32;
    }
    assert_same(BOTH, &rays, &uniform(500));
    // Ends that are answers, and their neighbours.
    let spheres = uniform(500);
    let hits = (brute("exact").nearest)(&rays, &spheres);
    for (ray, hit) in rays.iter_mut().zip(hits) {
        let Some(hit) = hit else { continue };
        let end = random.pick(&[hit.t, hit.t.next_up(), hit.t.next_down()]);
        if random.one_in(2) { ray.t_max = end } else { ray.t_min = end }
    }
    assert_same(BOTH, &rays, &spheres);
}

/// Parallel to an axis and exactly tangent, which is to run in the face of a box.
#[test]
fn tangents_along_axes() {
    let mut random = Random::new(73, 0);
    let spheres: Vec<Sphere> = (0..600)
        .map(|_| Sphere {
            center: Vec3::from_array([(); 3].map(|()| random.integer(-512, 512) as f32 / 512.0)),
            radius: random.integer(1, 64) as f32 / 512.0,
        })
        .collect();
    for away in [2.0, 1000.0] {
        let mut rays = Vec::new();
        for _ in 0..3000 {
            let sphere = random.pick(&spheres);
            let axis = random.integer(0, 2) as usize;
            let side = (axis + random.integer(1, 2) as usize) % 3;
            let sign = random.sign() as f32;
            let mut origin = sphere.center;
            origin[side] += random.sign() as f32 * sphere.radius;
            origin[axis] = -sign * away;
            let mut direction = Vec3::ZERO;
            direction[axis] = sign * random.integer(1, 3) as f32;
            // Zeros of either sign, and numbers next to zero.
            let other = 3 - axis - side;
            direction[side] = random.pick(&[0.0, -0.0]);
            direction[other] = random.pick(&[0.0, -0.0, 1e-38, -1e-38, 1e-45, 1e-25]);
            rays.push(Ray::new(origin, direction));
        }
        assert_same(BOTH, &rays, &spheres);
    }
}

/// Tangents of any direction; origins on, and inside of, spheres.
#[test]
fn tangents_and_origins_on_spheres() {
    let mut random = Random::new(74, 0);
    let spheres = uniform(700);
    let mut rays = Vec::new();
    for round in 0..6000 {
        let sphere = random.pick(&spheres);
        let along = random.unit();
        let across = random.perpendicular(along);
        let [along, across] = [along, across].map(|v| Vec3::from_array(v.map(|x| x as f32)));
        let side = sphere.center + sphere.radius * across;
        let away = random.pick(&[0.0, 0.01, 2.0, 1000.0]);
        let origin = if round % 2 == 0 {
            side - away * along
        } else {
            sphere.center
                + random.pick(&[0.0, 0.5, 0.999_999, 1.0, 1.000_001]) * (side - sphere.center)
        };
        rays.push(Ray::new(origin, along));
    }
    assert_same(BOTH, &rays, &spheres);
}

/// Rays with numbers at which something overflows, vanishes or is none.
#[test]
fn rays_of_any_components() {
    let mut random = Random::new(75, 0);
    let numbers: Vec<f32> = SPECIALS.into_iter().chain([1e-38, 3e38, -3e38, 1e-20, 1e20]).collect();
    let mut rays = Vec::new();
    for _ in 0..8000 {
        let mut ray = Ray::new(point(&mut random, 1.0), unit(&mut random));
        for axis in 0..3 {
            if random.one_in(3) {
                ray.direction[axis] = random.pick(&numbers);
            }
            if random.one_in(8) {
                ray.origin[axis] = random.pick(&numbers);
            }
        }
        if random.one_in(4) {
            ray.direction *= random.pick(&[1e-38, 1e-30, 1e-20, 1e-15, 1e15, 1e18, 1e30]);
        }
        rays.push(ray);
    }
    assert_same(EXACT, &rays, &uniform(300));
}

/// The hard cases' rays against the hard cases' spheres, of one regime and of all.
#[test]
fn regimes() {
    let mut all: Vec<Case> = Vec::new();
    for regime in REGIMES {
        let cases: Vec<Case> = regime.cases(400).collect();
        let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        if let Some(difference) = difference(EXACT, &rays, &spheres) {
            panic!("{regime:?}: {difference}");
        }
        // Beside a scene, moved to where it is.
        let mut beside = uniform(400);
        for (place, sphere) in beside.iter_mut().step_by(40).zip(&spheres) {
            *place = *sphere;
        }
        assert_same(EXACT, &rays, &beside);
        all.extend(&cases[..60]);
    }
    let rays: Vec<Ray> = all.iter().map(|case| case.ray).collect();
    let spheres: Vec<Sphere> = all.iter().map(|case| case.sphere).collect();
    assert_same(EXACT, &rays, &spheres);
}

#[test]
fn stable_in_its_domain() {
    // Distances up to 1e6 radii, sizes from 2^-30 to 2^30.
    let mut random = Random::new(76, 0);
    for exponent in [-30, -10, 0, 10, 30] {
        let scale = 2.0_f32.powi(exponent);
        let mut spheres = uniform(400);
        for sphere in &mut spheres {
            sphere.center *= scale;
            sphere.radius *= scale;
        }
        let rays: Vec<Ray> = (0..3000)
            .map(|_| {
                let target = random.pick(&spheres);
                let away = 10.0_f64.powf(random.uniform(-1.0, 4.0)) as f32 * scale;
                let along = unit(&mut random);
                let from = target.center - away * along;
                let aside = target.radius * random.uniform(0.0, 1.1) as f32 * unit(&mut random);
                Ray::new(from + aside, along * random.uniform(0.1, 10.0) as f32)
            })
            .collect();
        assert_same(BOTH, &rays, &spheres);
    }
}

fn check(tiers: &[&str], scene: &Scene) -> Result<(), TestCaseError> {
    match difference(tiers, &scene.rays, &scene.spheres) {
        Some(difference) => Err(TestCaseError::fail(difference)),
        None => Ok(()),
    }
}

proptest! {
    #![proptest_config(inputs::config(400))]

    #[test]
    fn scenes_on_the_lattice(scene in inputs::scene(inputs::lattice)) {
        check(BOTH, &scene)?;
    }

    #[test]
    fn scenes_near_the_lattice(scene in inputs::scene(inputs::walked)) {
        check(BOTH, &scene)?;
    }

    #[test]
    fn scenes_of_every_size(scene in inputs::sized_scene()) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_any_bits(scene in inputs::scene(inputs::wild)) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_every_regime(scene in inputs::scene(inputs::hard)) {
        check(EXACT, &scene)?;
    }

    #[test]
    fn scenes_of_all_kinds(scene in inputs::scene(inputs::case)) {
        check(EXACT, &scene)?;
    }
}

/// Builds, and asserts what no input may break: depth, size, and time (per sphere, generous).
fn tree_of<'a>(name: &str, memory: &'a mut Memory, spheres: &Columns, count: usize) -> Bvh<'a> {
    let start = Instant::now();
    let tree = memory.build(spheres);
    let elapsed = start.elapsed();
    let (size, needed) = (tree.size(), Bvh::needed(count));
    println!("{name}: {size:?} of {needed:?}, depth {}, {elapsed:?}", tree.depth());
    assert!(size.nodes <= needed.nodes && size.leaves <= needed.leaves, "{name}: {size:?}");
    assert!(size.nodes * 448 + size.leaves * 320 <= 40 * count + 1088, "{name}: {size:?}");
    assert!(tree.depth() <= 9, "{name}: depth {}", tree.depth());
    assert!(
        elapsed < Duration::from_secs(2) + Duration::from_micros(5) * count as u32,
        "{name}: {elapsed:?}"
    );
    tree
}

#[test]
fn worst_cases() {
    const COUNT: usize = 100_000;
    let mut random = Random::new(77, 0);
    let here = Sphere { center: Vec3::new(0.1, 0.2, 0.3), radius: 0.25 };
    let coincident = vec![here; COUNT];
    let shells: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { radius: 1.0 - i as f32 / COUNT as f32, ..here }).collect();
    let mut mixed: Vec<Sphere> = (0..COUNT)
        .map(|_| Sphere {
            center: point(&mut random, 1.0),
            radius: (0.001 * (random.uniform(-3.0, 3.0) + random.uniform(-3.0, 3.0)).exp()) as f32,
        })
        .collect();
    mixed[500] = Sphere { center: Vec3::new(0.0, -1000.0, 0.0), radius: 999.5 };
    let collinear: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { center: Vec3::new(i as f32, 0.0, 0.0), radius: 0.4 }).collect();
    let doubling: Vec<Sphere> = (0..COUNT)
        .map(|i| {
            let x = f32::from_bits(1 + (i as u32 % 0x5380_0000 / 64) * 12345 % 0x5380_0000);
            Sphere { center: Vec3::new(x, 0.0, 0.0), radius: x * 0.25 }
        })
        .collect();
    let points: Vec<Sphere> =
        (0..COUNT).map(|i| Sphere { center: Vec3::splat((i % 7) as f32), radius: 0.0 }).collect();
    let rays: Vec<Ray> = diffuse(48).into_iter().chain(camera(4)).collect();
    for (name, spheres) in [
        ("coincident", coincident),
        ("shells", shells),
        ("mixed", mixed),
        ("collinear", collinear),
        ("doubling", doubling),
        ("points", points),
    ] {
        let columns = Columns::new(&spheres);
        let mut memory = Memory::new(COUNT);
        let tree = tree_of(name, &mut memory, &columns, COUNT);
        let door = brute("exact");
        let expected: Vec<_> = (door.nearest)(&rays, &spheres).into_iter().map(bits).collect();
        let met: Vec<_> = expected.iter().map(Option::is_some).collect();
        for way in WAYS.iter().filter(|way| way.tier == "exact" && way.name.starts_with("16")) {
            let start = Instant::now();
            let (hits, found) = (way.walk)(&rays, &columns, &tree);
            println!("{name}, {}: {:?}", way.name, start.elapsed());
            assert_eq!(
                hits.into_iter().map(bits).collect::<Vec<_>>(),
                expected,
                "{name}, {}",
                way.name
            );
            assert_eq!(found, met, "{name}, {}", way.name);
        }
    }
}

#[test]
fn invalid_and_immense_spheres() {
    let mut spheres = uniform(300);
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38, 2e12, 1e30];
    let mut random = Random::new(78, 0);
    for (i, sphere) in spheres.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        let number = random.pick(&numbers);
        if i % 2 == 0 { sphere.radius = number } else { sphere.center[i % 3] = number }
    }
    let rays: Vec<Ray> = diffuse(500).into_iter().chain(camera(16)).collect();
    assert_same(EXACT, &rays, &spheres);
    // Nothing but such.
    let none = vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 100];
    assert_same(BOTH, &rays, &none);
    let immense = vec![Sphere { center: Vec3::new(0.0, 3e12, 0.0), radius: 3e12 }; 100];
    assert_same(EXACT, &rays, &immense);
}

#[test]
fn too_little_memory() {
    for count in [0, 1, 16, 17, 1000] {
        let columns = Columns::new(&uniform(count));
        let needed = Bvh::needed(count);
        let mut memory = Memory::new(count);
        let (nodes, leaves) = (&mut memory.nodes, &mut memory.leaves);
        for (n, l) in [(needed.nodes - 1, needed.leaves), (needed.nodes, needed.leaves - 1), (0, 0)]
        {
            let error = Bvh::build(columns.spheres(), &mut nodes[..n], &mut leaves[..l])
                .expect_err("less than needed");
            assert_eq!(error.needed, needed);
            assert!(error.to_string().contains(&needed.leaves.to_string()), "{error}");
        }
        assert!(Bvh::build(columns.spheres(), nodes, leaves).is_ok());
    }
    let all = Bvh::needed(u32::MAX as usize);
    assert_eq!(all.leaves, (1 << 28) + 1);
}

#[test]
fn other_spheres_than_built_from() {
    let rays: Vec<Ray> = diffuse(200).into_iter().chain(camera(8)).collect();
    let built = uniform(500);
    let mut memory = Memory::new(500);
    let tree = memory.build(&Columns::new(&built));
    for way in WAYS {
        // Of the same length: those that it was built from.
        let same = Columns::new(&vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 500]);
        let expected: Vec<_> =
            (brute(way.tier).nearest)(&rays, &built).into_iter().map(bits).collect();
        let (hits, _) = (way.walk)(&rays, &same, &tree);
        assert_eq!(hits.into_iter().map(bits).collect::<Vec<_>>(), expected, "{}", way.name);
        // Of another: those given.
        for count in [0, 3, 499, 501] {
            let given = uniform(count);
            let expected: Vec<_> =
                (brute(way.tier).nearest)(&rays, &given).into_iter().map(bits).collect();
            let (hits, met) = (way.walk)(&rays, &Columns::new(&given), &tree);
            assert_eq!(met, expected.iter().map(Option::is_some).collect::<Vec<_>>());
            assert_eq!(hits.into_iter().map(bits).collect::<Vec<_>>(), expected, "{}", way.name);
        }
    }
}

/// So the tree really is used. Ray by ray, and beside the other tests on a loaded machine, a
/// picture takes a 14th to a 21st of brute force's time; what walks coherent packets together
/// has to reach a 20th.
#[test]
fn many_times_as_fast_as_brute_force() {
    let spheres = uniform(10_000);
    let rays = camera(64);
    let columns = Columns::new(&spheres);
    let mut memory = Memory::new(spheres.len());
    let tree = memory.build(&columns);
    let door = brute("stable");
    let way = WAYS.iter().find(|way| way.tier == "stable" && way.name == "16 lanes");
    let way = way.expect("that way");
    let time = |work: &dyn Fn()| {
        (0..5)
            .map(|_| {
                let start = Instant::now();
                work();
                start.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min)
    };
    let by_tree = time(&|| drop((way.walk)(&rays, &columns, &tree)));
    let by_brute_force = time(&|| {
        drop((door.nearest)(&rays, &spheres));
        drop((door.any)(&rays, &spheres));
    });
    let ratio = by_brute_force / by_tree;
    println!("brute force takes {ratio:.0} times as long");
    assert!(ratio >= 8.0, "{ratio}");
}
