use super::*;

/// Nothing is known yet.
fn around(list: &SphereList, reach: f32, tree: Option<Arc<SphereTree>>) -> Around {
    let openness = Arc::new(Openness::new(list.len(), reach));
    Around { openness, list: Arc::new(list.clone()), tree }
}

/// The openness around every sphere of a list.
fn learnt(list: &SphereList, reach: f32) -> Arc<Openness> {
    let around = around(list, reach, None);
    let threads = Threads::default();
    let all = || 0..list.len() as u32;
    assert_eq!(learn(&around, &threads, all().chain(all())), 64 * list.len() as u64);
    assert_eq!(learn(&around, &threads, all()), 0);
    around.openness
}

/// Learns some spheres, and returns how many rays that took.
fn learn(around: &Around, threads: &Threads, spheres: impl Iterator<Item = u32>) -> u64 {
    let (mut scratch, mut memory) = (Scratch::default(), OpennessMemory::default());
    around.learn((Level::best(), threads), &mut scratch, &mut memory, spheres)
}

#[test]
fn directions_are_even() {
    let directions = &*DIRECTIONS;
    let nearest = |one: &Vec3| {
        let others = directions.iter().filter(|&other| other != one);
        others.map(|other| one.dot(*other)).fold(-1.0, f32::max)
    };
    // Of 64 as far apart as can be, neighbours are some 27 degrees apart; where the halves meet, 13 of these.
    assert!(directions.iter().all(|one| (one.length() - 1.0).abs() < 1e-6));
    assert!(directions.iter().all(|one| nearest(one) < 13.0_f32.to_radians().cos()));
    assert!(directions.iter().sum::<Vec3>().length() < 1e-6);
    for axis in 0..3 {
        let square =
            directions.iter().map(|direction| direction[axis] * direction[axis]).sum::<f32>();
        assert!((square / 64.0 - 1.0 / 3.0).abs() < 0.01, "{square}");
    }
}

#[test]
fn alone_a_sphere_is_open_wherever_it_is_and_however_large() {
    for scale in [1e-30, 1e-12, 1.0, 1e12, 1e17] {
        for place in [Vec3::ZERO, Vec3::splat(3.0), Vec3::new(-7.0, 1e4, 2.0)] {
            let list = SphereList::from_iter([(scale * place, scale)]);
            let openness = learnt(&list, f32::INFINITY);
            for &normal in DIRECTIONS.iter() {
                assert_eq!(openness.towards(0, normal), 1.0, "{scale} {place}");
            }
        }
    }
}

#[test]
fn above_a_ground_it_is_as_open_as_the_sky_is_wide() {
    for scale in [1e-12, 1.0, 1e9] {
        let ground = (scale * Vec3::new(0.0, -1e4, 0.0), scale * 1e4);
        let list = SphereList::from_iter([(scale * Vec3::Y, scale), ground]);
        let openness = learnt(&list, f32::INFINITY);
        for normal in [Vec3::Y, Vec3::X, Vec3::NEG_Z, Vec3::NEG_Y, Vec3::new(0.6, 0.8, 0.0)] {
            // Of a plane: the part of the sky by cosine.
            let truth = (1.0 + normal.y) / 2.0;
            let found = openness.towards(0, normal);
            assert!((found - truth).abs() < 0.03, "{scale} {normal}: {found}, not {truth}");
        }
    }
}

/// The rays are also traced in double precision, in a heap of spheres.
#[test]
fn in_a_heap_it_is_what_those_rays_meet() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f32 / (1_u64 << 24) as f32
    };
    let place = |random: &mut dyn FnMut() -> f32| 12.0 * Vec3::new(random(), random(), random());
    let spheres: Vec<Sphere> =
        (0..200).map(|_| Sphere { center: place(&mut random), radius: 0.6 }).collect();
    let list = SphereList::from_iter(spheres.iter().copied());
    let openness = learnt(&list, 8.0);
    let is_open = |from: &Sphere, way: Vec3| {
        let way = way.as_dvec3().normalize();
        !spheres.iter().filter(|&other| other != from).any(|other| {
            let radius = f64::from(other.radius);
            let offset = (other.center - from.center).as_dvec3();
            let along = offset.dot(way);
            let half = radius * radius - offset.length_squared() + along * along;
            // From the surface on: roots between two diameters and the reach.
            let counts = |t: f64| (4.0 * 0.6..=8.0).contains(&(t - f64::from(from.radius)));
            half >= 0.0 && (counts(along - half.sqrt()) || counts(along + half.sqrt()))
        })
    };
    let mut means = Vec::new();
    for (index, sphere) in spheres.iter().enumerate() {
        let open = DIRECTIONS.iter().copied().filter(|&way| is_open(sphere, way));
        let (count, sum) =
            open.fold((0.0, Vec3::ZERO), |(count, sum), way| (count + 1.0, sum + way));
        for normal in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.0, 0.8)] {
            let truth = ((count + 2.0 * sum.dot(normal)) / 64.0).clamp(0.0, 1.0);
            let found = openness.towards(index as u32, normal);
            // A ray that grazes a sphere may be decided in either way.
            assert!((found - truth).abs() < 0.06, "{index} {normal}: {found}, not {truth}");
            means.push((found - truth).abs());
        }
    }
    let mean = means.iter().sum::<f32>() / means.len() as f32;
    assert!(mean < 0.004, "{mean}");
    let all: Vec<_> = (0..200).map(|index| openness.towards(index, Vec3::Y)).collect();
    assert!(all.iter().any(|&one| one < 0.5) && all.iter().any(|&one| one > 0.9));
}

/// So many spheres in rows of eight.
fn rows(count: u16) -> SphereList {
    (0..count)
        .map(|index| {
            (Vec3::new(f32::from(index % 8), f32::from(index / 8 % 8), f32::from(index / 64)), 0.6)
        })
        .collect()
}

/// Asserts that both know the same.
fn assert_same(found: &Openness, expected: &Openness) {
    for (sphere, (found, expected)) in found.known.iter().zip(&expected.known).enumerate() {
        let [found, expected] = [found, expected].map(|one| one.load(Ordering::Relaxed));
        assert_eq!(found, expected, "{sphere}");
    }
}

/// With a tree and without, one after another and at once, and on any thread, the result is the same.
#[test]
fn how_it_is_found_does_not_show() {
    let list = rows(500);
    let expected = learnt(&list, f32::INFINITY);
    let tree = Some(Arc::new(SphereTree::new(list.clone())));
    let around = around(&list, f32::INFINITY, tree);
    std::thread::scope(|scope| {
        for part in 0..4_u32 {
            let around = &around;
            scope.spawn(move || {
                let (mut scratch, mut memory) = (Scratch::default(), OpennessMemory::default());
                let by = (Level::best(), &Threads::default());
                for sphere in (0..500).filter(|sphere| sphere % 5 <= part) {
                    around.learn(by, &mut scratch, &mut memory, [sphere].into_iter());
                }
                around.learn(by, &mut scratch, &mut memory, 0..500);
            });
        }
    });
    assert_same(&around.openness, &expected);
}

/// What is not learnt is learnt later, as if no one had stopped.
#[test]
fn stopped_threads_learn_nothing_and_what_is_known_stays() {
    let (list, few) = (rows(500), 300);
    let (expected, threads) = (learnt(&list, f32::INFINITY), Threads::default());
    let around = around(&list, f32::INFINITY, None);
    threads.stop();
    assert_eq!(learn(&around, &threads, 0..500), 0);
    assert!(around.openness.known.iter().all(|one| one.load(Ordering::Relaxed) == UNKNOWN));
    threads.go_on();
    assert_eq!(learn(&around, &threads, 0..few), 64 * u64::from(few));
    threads.stop();
    assert_eq!(learn(&around, &threads, 0..500), 0);
    threads.go_on();
    assert_eq!(learn(&around, &threads, 0..500), 64 * u64::from(500 - few));
    assert_same(&around.openness, &expected);
}

#[test]
fn what_is_out_of_reach_is_in_nobodys_way() {
    let sky = (Vec3::ZERO, 100.0);
    let list = SphereList::from_iter([(Vec3::ZERO, 1.0), sky]);
    assert_eq!(learnt(&list, f32::INFINITY).towards(0, Vec3::X), 0.0);
    assert_eq!(learnt(&list, 50.0).towards(0, Vec3::X), 1.0);
}

#[test]
fn what_nobody_asked_for_is_open() {
    assert_eq!(Openness::new(2, 1.0).towards(1, Vec3::X), 1.0);
    assert_eq!(Openness::new(2, 1.0).towards(7, Vec3::X), 1.0);
    assert_eq!(Openness::default().towards(0, Vec3::NAN), 1.0);
}

#[test]
fn four_bytes_hold_it() {
    for count in 0..=64 {
        for sum in [Vec3::ZERO, Vec3::new(16.0, -16.0, 0.4), Vec3::splat(-9.2)] {
            let packed = packed(count, sum);
            assert_ne!(packed, UNKNOWN);
            let (mean, slope) = unpacked(packed);
            assert_eq!(mean, f32::from(count) / 64.0);
            assert!((slope - 2.0 * sum / 64.0).abs().max_element() < 0.003, "{slope}");
        }
    }
}
