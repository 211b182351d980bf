//! Small integers, among which tangents are many.

use super::{bits, count, first, is_exact};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3, roots};
use spherule_referee::case::Case;
use spherule_referee::random::Random;
use spherule_tests::oracle;
use spherule_tests::variants::{bits as hit_bits, lists, pair_layers, pairs_of};

fn dot(v: [i64; 3], w: [i64; 3]) -> i64 {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

/// `roots`, which has no filter and no lanes, against pairs and lists, on small integers. Hit or miss is also checked
/// against D in `i64`.
#[test]
fn roots_pairs_and_lists_agree_on_a_lattice_rich_in_tangents() {
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
        let single = |v: [i64; 3]| Vec3::from_array(v.map(|x| x as f32));
        let t_min = if behind { f32::NEG_INFINITY } else { 0.0 };
        let ray = Ray { t_min, ..Ray::new(single(origin), single(direction)) };
        let sphere = |i: usize| Sphere { center: single(centers[i]), radius: radii[i] as f32 };
        let cases: Vec<Case> = (0..16).map(|i| Case { ray, sphere: sphere(i) }).collect();
        let alone: Vec<Option<f32>> = cases
            .iter()
            .zip(centers.iter().zip(radii))
            .map(|(case, (center, radius))| {
                let roots = roots(Tier::Exact, &case.ray, &case.sphere);
                let p: [i64; 3] = core::array::from_fn(|i| center[i] - origin[i]);
                let b = dot(direction, p);
                let d = b * b - dot(direction, direction) * (dot(p, p) - radius * radius);
                assert_eq!(roots.is_some(), d >= 0, "{case:?}");
                tangents += u64::from(d == 0);
                roots.and_then(|roots| oracle::accepted(&case.ray, roots))
            })
            .collect();
        hits += alone.iter().flatten().count() as u64;

        let spheres: Vec<Sphere> = cases.iter().map(|case| case.sphere).collect();
        let hits_of_all =
            (0..).zip(&alone).filter_map(|(sphere, t)| Some(Hit { t: (*t)?, sphere }));
        let expected = hits_of_all.reduce(|known, hit| if hit.t < known.t { hit } else { known });
        for layer in pair_layers() {
            let found = pairs_of(Tier::Exact, layer, &cases);
            for (index, case) in cases.iter().enumerate() {
                assert_eq!(bits(found[index]), bits(alone[index]), "{layer:?}: {case:?}");
            }
        }
        for variant in lists().filter(is_exact) {
            let closest = variant.closest(&spheres, &[cases[0].ray])[0];
            assert_eq!(hit_bits(closest), hit_bits(expected), "{variant:?}: {cases:?}");
        }
        done += 16;
    }
    println!("lattice: {done} cases, {tangents} tangents, {hits} hits, 0 mismatches");
    assert!(tangents * 25 > done, "{tangents} tangents of {done}: not rich in them");
}
