//! Trees whose spheres move answer as a list of the spheres does, however the spheres came there.

mod lent;

use super::scenes::{EYE, camera, mixed, uniform};
use spherule_kernel::{
    Coherence, Intersect, Ray, RefitError, Sphere, SphereList, SphereTree, Tier, Trace, Vec3,
};
use spherule_referee::random::Random;
use spherule_tests::variants::{bits, levels};

/// Asserts that a tree answers as the list of its spheres does, at every level: one ray a call, and whatever the trace says of many.
fn assert_as_list(tree: &impl Intersect, list: &SphereList, tiers: &[Tier], rays: &[Ray]) {
    let of_many = [Coherence::Incoherent, Coherence::Coherent, Coherence::Detect].map(Some);
    for &tier in tiers {
        let mut expected = vec![None; rays.len()];
        list.closest_hits(tier, rays, &mut expected);
        for level in levels() {
            for coherence in [None].into_iter().chain(of_many) {
                let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
                if let Some(coherence) = coherence {
                    let mut trace = Trace::new().at(level).with(coherence);
                    tree.closest_hits_with(tier, &mut trace, rays, &mut hits);
                    tree.any_hits_with(tier, &mut trace, rays, &mut occluded);
                } else {
                    for (place, ray) in rays.iter().enumerate() {
                        let mut trace = Trace::new().at(level);
                        hits[place] = tree.closest_hit_with(tier, &mut trace, ray);
                        occluded[place] = tree.any_hit_with(tier, &mut trace, ray);
                    }
                }
                for (place, expected) in expected.iter().enumerate() {
                    let (ray, hit) = (&rays[place], hits[place]);
                    let is_same = bits(hit) == bits(*expected) && occluded[place] == hit.is_some();
                    assert!(
                        is_same,
                        "{tier:?}, {level:?}, {coherence:?}, {place}: {ray:?}: {hit:?}, {expected:?}"
                    );
                }
            }
        }
    }
}

/// Moves the spheres of a tree, and asserts that it answers as their list does. Returns its growth.
fn refit(tree: &mut SphereTree, spheres: &[Sphere], tiers: &[Tier], rays: &[Ray]) -> f32 {
    let growth = tree.refit(spheres).expect("as many");
    assert_as_list(tree, &SphereList::from(spheres), tiers, rays);
    growth
}

fn rays() -> Vec<Ray> {
    let mut rays = mixed(200, 5);
    rays.extend(camera(EYE, Vec3::ZERO, 0.364, 16));
    // From so far away that no bound covers them.
    rays.extend((0..20).map(|i| {
        let from = Vec3::new(0.0, 3e25, i as f32 * 0.05);
        Ray::new(from, Vec3::new(0.0, -3e25, i as f32 * 0.01))
    }));
    rays
}

/// One ray in `share`, another one each time.
fn some(rays: &[Ray], random: &mut Random, share: usize) -> Vec<Ray> {
    let first = random.integer(0, share as i64 - 1) as usize;
    rays.iter().skip(first).step_by(share).copied().collect()
}

/// What becomes of a sphere.
fn moved(random: &mut Random, sphere: Sphere, other: Sphere, how: usize) -> Sphere {
    let strange = [f32::NAN, f32::INFINITY, -1.0, 1e20, 3e38];
    match how {
        0 => Sphere { center: sphere.center + random.in_cube(0.01), ..sphere },
        1 => Sphere { center: sphere.center + random.in_cube(1.0), ..sphere },
        2 => Sphere { center: random.in_cube(2.0), radius: other.radius },
        3 => Sphere { radius: random.pick(&strange), ..sphere },
        4 => Sphere { center: Vec3::new(0.0, random.pick(&strange), 0.0), ..sphere },
        5 => other,
        _ => Sphere { center: Vec3::ZERO, radius: 0.25 },
    }
}

#[test]
fn repeated_moves_of_every_kind() {
    let (rays, mut random) = (rays(), Random::new(24, 0));
    for count in [0, 1, 2, 17, 70, 300, 3000] {
        // The check of three thousand takes as long as all others together.
        let shares: &[i64] = if count < 3000 { &[1, 3, 20] } else { &[3] };
        let start = uniform(count);
        for &share in shares {
            let mut now = start.clone();
            let mut tree = SphereTree::new(start.as_slice());
            for how in [0, 1, 2, 3, 5, 4, 6, 7, 0] {
                for index in 0..count {
                    if how == 7 {
                        now[index] = start[index];
                    } else if random.one_in(share) {
                        let other = now[random.integer(0, count as i64 - 1) as usize];
                        now[index] = moved(&mut random, now[index], other, how);
                    }
                }
                // Where all hits are of huge spheres, telling which is first takes some microseconds a pair.
                let rays = some(&rays, &mut random, if how == 3 || how == 4 { 16 } else { 3 });
                let growth = refit(&mut tree, &now, &[Tier::Exact], &rays);
                assert!(growth.is_finite() && growth > 0.0, "{growth}");
                assert!(how != 7 || growth == 1.0, "back at the start: {growth}");
            }
        }
    }
}

/// A sphere alone in its tree is tested without a bound, except once it is invalid.
#[test]
fn one_sphere_becomes_none_and_returns() {
    let rays = rays();
    for sphere in
        [[0.0, 0.0, 0.0, 0.3], [0.1, -0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]].map(Sphere::from)
    {
        let mut tree = SphereTree::new([sphere].as_slice());
        for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38] {
            for becomes in [
                Sphere { radius: number, ..sphere },
                Sphere { center: Vec3::new(number, 0.0, 0.0), ..sphere },
                Sphere { center: Vec3::new(0.0, 0.0, number), radius: number },
                sphere,
            ] {
                refit(&mut tree, &[becomes], &[Tier::Exact], &rays);
            }
        }
    }
}

/// In `Stable`'s domain: no sphere and no ray is out of scale.
#[test]
fn stable_moves() {
    let (rays, mut random) = (mixed(200, 6), Random::new(25, 0));
    let mut now = uniform(1000);
    let mut tree = SphereTree::new(now.as_slice());
    for how in [0, 2, 5, 1] {
        for index in 0..now.len() {
            if random.one_in(3) {
                let other = now[random.integer(0, 999) as usize];
                now[index] = moved(&mut random, now[index], other, how);
            }
        }
        refit(&mut tree, &now, &[Tier::Stable, Tier::Exact], &rays);
    }
}

/// Equal spheres, of which all but a few had no lane, separate and come together again.
#[test]
fn copies_part() {
    let own = uniform(1000);
    let rays = rays();
    for copies in [2, 5, 16, 17, 100, 900] {
        let mut spheres = own.clone();
        for sphere in &mut spheres[1000 - copies..] {
            *sphere = own[40];
        }
        let mut tree = SphereTree::new(spheres.as_slice());
        let together = refit(&mut tree, &spheres, &[Tier::Exact], &rays);
        assert_eq!(together, 1.0, "{copies} copies");
        let growth = refit(&mut tree, &own, &[Tier::Exact], &rays);
        assert!(growth > 1.9 || copies < 100, "{copies} copies: {growth}");
        // All go together.
        for sphere in &mut spheres {
            sphere.center += Vec3::new(0.25, 0.0, 0.0);
        }
        let growth = refit(&mut tree, &spheres, &[Tier::Exact], &rays);
        assert!((0.9..1.1).contains(&growth), "{growth}");
    }
}

/// Copies had one lane. Where they come to lie with a third sphere, of a higher index than theirs, the lowest of those that lie there
/// is answered.
#[test]
fn copies_part_and_meet_another_sphere() {
    let at = |x: f32, y: f32| Sphere { center: Vec3::new(x, y, 0.0), radius: 1.0 };
    let ray = Ray::new(Vec3::new(0.0, 5.0, -5.0), Vec3::Z);
    for count in [3, 6, 9] {
        let row = |index: usize| at(10.0 * index as f32, 0.0);
        let copies = [at(0.0, 0.0), at(0.0, 0.0)].into_iter();
        let mut spheres: Vec<_> = copies.chain((2..count).map(row)).collect();
        let mut tree = SphereTree::new(spheres.as_slice());
        spheres[0] = row(count);
        (spheres[1], spheres[2]) = (at(0.0, 5.0), at(0.0, 5.0));
        refit(&mut tree, &spheres, &[Tier::Exact], &[ray; 64]);
        assert_eq!(tree.closest_hit(Tier::Exact, &ray).map(|hit| hit.sphere), Some(1));
    }
}

/// The less is left of a tree, the larger; none where all move together.
#[test]
fn growth_says_when_to_build_anew() {
    let start = uniform(10_000);
    let mut random = Random::new(26, 0);
    let mut tree = SphereTree::new(start.as_slice());
    assert_eq!(tree.bvh().growth(), 1.0);
    let mut before = 0.98;
    for by in [0.001, 0.01, 0.1, 0.5] {
        let moved: SphereList = start
            .iter()
            .map(|sphere| Sphere { center: sphere.center + random.in_cube(by), ..*sphere })
            .collect();
        let growth = tree.refit(moved).expect("as many");
        assert!(growth > before, "{by}: {growth}, before {before}");
        before = growth;
    }
    assert!(before > 3.0, "{before}");
    for factor in [0.25, 3.0] {
        let scaled: SphereList = start
            .iter()
            .map(|s| Sphere { center: s.center * factor + Vec3::Y, radius: s.radius * factor })
            .collect();
        let growth = tree.refit(scaled).expect("as many");
        assert!((0.95..1.05).contains(&growth), "{factor}: {growth}");
    }
    // One far away does not hide the others.
    let mut one_far = start.clone();
    one_far[5].center.x = 1e6;
    let growth = tree.refit(one_far.as_slice()).expect("as many");
    assert!((1.0..1.5).contains(&growth), "{growth}");
    // Every ray meets those that no box holds, as ten leaves.
    let mut immense = start.clone();
    immense[..160].iter_mut().for_each(|sphere| sphere.radius = 1e30);
    let growth = tree.refit(immense.as_slice()).expect("as many");
    assert!((1.2..3.0).contains(&growth), "{growth}");
    assert_eq!(tree.refit(start.as_slice()), Ok(1.0));
}

#[test]
fn another_number_is_an_error_and_nothing_changes() {
    for count in [0, 1, 100] {
        let spheres = uniform(count);
        let mut tree = SphereTree::new(spheres.as_slice());
        let given = count + 1;
        let error = tree.refit(uniform(given)).expect_err("one more");
        assert_eq!(error, RefitError::OtherCount { built: count, given });
        assert!(error.to_string().contains(&given.to_string()), "{error}");
        assert_as_list(&tree, &SphereList::from(&spheres), &[Tier::Exact], &rays());
    }
}
