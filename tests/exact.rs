//! `Exact` against the truth: in every lane width, alone and through the filter, t bit for bit.
//!
//! `cargo test` takes a fixed number of cases. The nightly run takes 10^6 a regime and 10^7 of the
//! lattice, some ten minutes on a core:
//!
//! ```text
//! SPHERULE_CASES=1000000 cargo test -p spherule-tests --test exact -- --nocapture
//! ```
//!
//! `SPHERULE_SEED=N` draws others.

use spherule_kernel::{Exact, Hit, Ray, Sphere, roots};
use spherule_tests::case::Case;
use spherule_tests::oracle;
use spherule_tests::random::Random;
use spherule_tests::regimes::REGIMES;
use spherule_tests::vectors;
use spherule_tests::widths::WIDTHS;

/// Cases a regime.
fn count() -> u64 {
    variable("SPHERULE_CASES").unwrap_or(1500)
}

/// Where in the regimes' streams to begin: past the kept cases and those of other tests.
fn first() -> u64 {
    (1 + variable("SPHERULE_SEED").unwrap_or(0)) << 40
}

fn variable(name: &str) -> Option<u64> {
    let value = std::env::var(name).ok()?;
    Some(value.parse().unwrap_or_else(|_| panic!("{name}={value}: no count")))
}

/// Bits, since -0 is not 0 here and a NaN shall be seen.
fn bits(t: Option<f32>) -> Option<u32> {
    t.map(f32::to_bits)
}

fn hit_bits(hit: Option<Hit>) -> Option<(u32, u32)> {
    hit.map(|hit| (hit.t.to_bits(), hit.sphere))
}

/// Rules 3 and 4 on correctly rounded roots.
fn accepted(ray: &Ray, roots: Option<[f32; 2]>) -> Option<f32> {
    let within = |t: &f32| t.is_finite() && ray.t_min <= *t && *t <= ray.t_max;
    roots?.into_iter().find(within)
}

fn dot(v: [i64; 3], w: [i64; 3]) -> i64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

/// 16 cases with their answers, as pairs and each sphere as a list of its own for all 16 rays.
fn check(cases: &[Case], expected: &[Option<f32>]) {
    let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
    for width in WIDTHS {
        let found = (width.pairs)(cases);
        for index in 0..cases.len() {
            let (lanes, case) = (width.lanes, cases[index]);
            let expected = bits(expected[index]);
            assert_eq!(bits(found[index]), expected, "pairs, {lanes} lanes: {case:?}");
            let filtered = (width.nearest)(&rays, &[case.sphere])[index];
            let filtered = bits(filtered.map(|hit| hit.t));
            assert_eq!(filtered, expected, "list, {lanes} lanes: {case:?}");
        }
    }
}

#[test]
fn the_vectors_are_answered_bit_for_bit() {
    let vectors = vectors::read().unwrap_or_else(|| {
        let own = REGIMES.iter().flat_map(|regime| {
            regime.cases(1000).map(|case| vectors::Vector {
                regime: regime.number,
                case,
                expected: oracle::intersect(&case.ray, &case.sphere),
            })
        });
        own.collect()
    });
    for vectors in vectors.chunks(16) {
        let cases: Vec<Case> = vectors.iter().map(|vector| vector.case).collect();
        let expected: Vec<Option<f32>> = vectors.iter().map(|vector| vector.expected).collect();
        check(&cases, &expected);
    }
    println!("{} cases, 0 mismatches, pairs and lists in 1, 4, 8, 16 lanes", vectors.len());
}

#[test]
fn fresh_cases_of_every_regime_are_answered_as_the_oracle_does() {
    for regime in REGIMES {
        let (mut hits, mut ties, mut done) = (0_u64, 0_u64, 0_u64);
        while done < count() {
            let cases: Vec<Case> =
                (done..done + 16).map(|index| regime.case(first() + index)).collect();
            let mut expected = Vec::new();
            for case in &cases {
                let truth = oracle::roots_and_ties(&case.ray, &case.sphere);
                let rounded = truth.map(|roots| roots.map(|(root, _)| root));
                let found = roots::<Exact>(&case.ray, &case.sphere);
                let root_bits =
                    |roots: Option<[f32; 2]>| roots.map(|roots| roots.map(f32::to_bits));
                // Roots are those of the line: an empty interval changes nothing.
                assert_eq!(root_bits(found), root_bits(rounded), "roots: {case:?}");
                let t = accepted(&case.ray, rounded);
                hits += u64::from(t.is_some());
                ties += u64::from(truth.is_some_and(|roots| roots.iter().any(|root| root.1)));
                expected.push(t);
            }
            check(&cases, &expected);
            done += 16;
        }
        println!("{regime:?}: {done} cases, {hits} hits, {ties} ties, 0 mismatches");
    }
}

/// The pure expansion path, which every root takes in `roots`, against the filtered one, on small
/// integers; hit or miss also against D in `i64`.
#[test]
fn expansions_and_filter_agree_on_a_lattice_rich_in_tangents() {
    let total = count() * 10;
    let (mut tangents, mut hits, mut done) = (0_u64, 0_u64, 0_u64);
    let mut random = Random::new(31, first());
    while done < total {
        let reach = random.pick(&[2, 4, 9]);
        let mut point = || [(); 3].map(|()| random.integer(-reach, reach));
        let (origin, mut direction) = (point(), point());
        let centers: [[i64; 3]; 16] = core::array::from_fn(|_| point());
        if random.one_in(2) {
            let kept = random.integer(0, 2) as usize;
            direction = core::array::from_fn(|i| if i == kept { direction[i] } else { 0 });
        }
        // Half of the lines that can touch their sphere do: where the distance is an integer.
        let radii: [i64; 16] = core::array::from_fn(|index| {
            let p: [i64; 3] = core::array::from_fn(|i| centers[index][i] - origin[i]);
            let (a, b) = (dot(direction, direction).max(1), dot(direction, p));
            let square = (a * dot(p, p) - b * b) / a;
            let distance = square.isqrt();
            let touches = a * distance * distance == a * dot(p, p) - b * b;
            if touches && random.one_in(2) { distance } else { random.integer(0, 2 * reach) }
        });
        if direction == [0; 3] {
            continue;
        }
        let behind = random.one_in(4);
        let cases: Vec<Case> = (0..16)
            .map(|index| {
                let single = |v: [i64; 3]| v.map(|x| x as f32);
                let ([ox, oy, oz], [dx, dy, dz]) = (single(origin), single(direction));
                let [cx, cy, cz] = single(centers[index]);
                let t_min = if behind { f32::NEG_INFINITY } else { 0.0 };
                let radius = radii[index] as f32;
                Case::from_numbers([
                    ox,
                    oy,
                    oz,
                    dx,
                    dy,
                    dz,
                    t_min,
                    f32::INFINITY,
                    cx,
                    cy,
                    cz,
                    radius,
                ])
            })
            .collect();
        let pure: Vec<Option<f32>> = cases
            .iter()
            .zip(centers.iter().zip(radii))
            .map(|(case, (center, radius))| {
                let roots = roots::<Exact>(&case.ray, &case.sphere);
                let p: [i64; 3] = core::array::from_fn(|i| center[i] - origin[i]);
                let b = dot(direction, p);
                let d = b * b - dot(direction, direction) * (dot(p, p) - radius * radius);
                assert_eq!(roots.is_some(), d >= 0, "{case:?}");
                tangents += u64::from(d == 0);
                accepted(&case.ray, roots)
            })
            .collect();
        hits += pure.iter().flatten().count() as u64;

        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        let mut expected: Option<Hit> = None;
        for (index, t) in pure.iter().enumerate() {
            if let Some(t) = *t
                && expected.is_none_or(|hit| t < hit.t)
            {
                expected = Some(Hit { t, sphere: index as u32 });
            }
        }
        for width in WIDTHS {
            let found = (width.pairs)(&cases);
            for (index, case) in cases.iter().enumerate() {
                assert_eq!(bits(found[index]), bits(pure[index]), "{case:?}");
            }
            let nearest = (width.nearest)(&[cases[0].ray], &spheres)[0];
            assert_eq!(hit_bits(nearest), hit_bits(expected), "{cases:?}");
        }
        done += 16;
    }
    println!("lattice: {done} cases, {tangents} tangents, {hits} hits, 0 mismatches");
    assert!(tangents * 25 > done, "{tangents} tangents of {done}: not rich in them");
}

#[test]
fn the_nearest_of_many_hard_spheres_is_the_oracles() {
    let scenes = count() / 30;
    let (mut hits, mut equal) = (0, 0);
    for regime in REGIMES {
        for scene in 0..scenes {
            let cases: Vec<Case> =
                (0..9).map(|index| regime.case(first() + scene * 9 + index)).collect();
            let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
            // Every sphere twice, groups of four apart: equal t, of which the first must win.
            let spheres: Vec<Sphere> = (0..18).map(|i| cases[i * 7 % 9].sphere).collect();
            let expected: Vec<_> = rays.iter().map(|ray| oracle::nearest(ray, &spheres)).collect();
            hits += expected.iter().flatten().count();
            equal += expected.iter().flatten().filter(|hit| hit.sphere < 9).count();
            for width in WIDTHS {
                let found = (width.nearest)(&rays, &spheres);
                for ((found, expected), ray) in found.iter().zip(&expected).zip(&rays) {
                    assert_eq!(
                        hit_bits(*found),
                        hit_bits(*expected),
                        "{regime:?}, {} lanes: {:?} {spheres:?}",
                        width.lanes,
                        spherule_tests::case::HexRay(ray)
                    );
                }
            }
        }
    }
    println!("{} rays against 18 spheres, {hits} hits, 0 mismatches", scenes * 9 * 22);
    assert_eq!(hits, equal, "the lower index of twins wins");
}

/// Whatever stands in one lane, the others answer the same bits.
#[test]
fn any_bits_change_nothing_for_their_neighbours() {
    let mut random = Random::new(37, first());
    for round in 0..count() * 4 {
        let regime = random.pick(&REGIMES);
        let cases: Vec<Case> = (0..16).map(|i| regime.case(first() + round * 16 + i)).collect();
        let lane = random.integer(0, 15) as usize;
        let mut disturbed = cases.clone();
        disturbed[lane] = if random.one_in(2) {
            Case::from_numbers([(); Case::NUMBERS].map(|()| random.any_f32()))
        } else {
            let other = random.pick(&REGIMES);
            other.case(random.bits())
        };
        let list = |cases: &[Case]| {
            let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
            // The list stays: only the rays of one lane change.
            let spheres: Vec<Sphere> = disturbed.iter().map(|case| case.sphere).collect();
            WIDTHS.map(|width| (width.nearest)(&rays, &spheres))
        };
        let (before, after) = (list(&cases), list(&disturbed));
        for (which, width) in WIDTHS.iter().enumerate() {
            let pairs = [(width.pairs)(&cases), (width.pairs)(&disturbed)];
            for index in (0..16).filter(|&index| index != lane) {
                let lanes = width.lanes;
                let [alone, beside] = pairs.each_ref().map(|t| bits(t[index]));
                assert_eq!(
                    alone, beside,
                    "{lanes} lanes: {:?} beside {:?}",
                    cases[index], disturbed[lane]
                );
                let [alone, beside] = [&before, &after].map(|hits| hit_bits(hits[which][index]));
                assert_eq!(
                    alone, beside,
                    "{lanes} lanes: {:?} beside {:?}",
                    cases[index], disturbed[lane]
                );
            }
        }
    }
}
