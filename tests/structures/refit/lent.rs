//! Refitted trees in a caller's memory.

use super::*;
use spherule_kernel::{Bvh, BvhMemory, BvhNode};

/// Memory of the caller's: as much as a tree needs, and with room for all spheres to leave their boxes.
#[test]
fn lent_memory() {
    let start = SphereList::from(uniform(500));
    let needed = Bvh::needed(500);
    let rays = rays();
    // Telling which of 500 huge spheres is first takes a millisecond a ray.
    let some = some(&rays, &mut Random::new(28, 0), 16);
    let far: SphereList =
        start.spheres().iter().map(|s| Sphere { center: s.center, radius: 1e30 }).collect();
    let near: SphereList = start
        .spheres()
        .iter()
        .map(|s| Sphere { center: s.center + Vec3::new(s.center.y, 0.0, 0.0), ..s })
        .collect();
    for more in [0, 500] {
        let mut nodes = vec![BvhNode::EMPTY; needed.nodes];
        let mut places = vec![[f32::NAN; 4]; needed.places];
        let mut indices = vec![7; needed.places + more];
        let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
        assert_eq!(memory.refit(start.spheres()).err(), Some(RefitError::NoTree));
        assert_eq!(memory.build(start.spheres()).expect("enough").growth(), 1.0);
        let few = uniform(499);
        let error = memory.refit(SphereList::from(few).spheres()).expect_err("another number");
        assert_eq!(error, RefitError::OtherCount { built: 500, given: 499 });
        match memory.refit(far.spheres()) {
            Ok(tree) => {
                assert_eq!(more, 500);
                assert!(tree.growth() > 2.0, "{}", tree.growth());
                assert_as_list(&tree, &far, &[Tier::Exact], &some);
            }
            Err(RefitError::TooSmall(error)) => {
                assert!(more == 0 && error.what == "indices" && error.needed > error.given);
            }
            Err(error) => panic!("{error}"),
        }
        for list in [&near, &start] {
            let tree = memory.refit(list.spheres()).expect("all are inside");
            assert_as_list(&tree, list, &[Tier::Exact], &rays);
        }
        assert_eq!(memory.refit(start.spheres()).expect("inside").growth(), 1.0);
    }
}

/// Copies and invalid spheres have no lane. Where they become spheres of their own, and others leave their lanes, each takes an index, and
/// no more are asked for; where there are too few, the tree can be refitted as before.
#[test]
fn lent_memory_for_what_had_no_lane() {
    let (own, rays) = (uniform(500), some(&rays(), &mut Random::new(29, 0), 16));
    let mut start = own.clone();
    start[300..480].fill(own[40]);
    start[480..].iter_mut().for_each(|sphere| sphere.radius = -1.0);
    let (start, needed) = (SphereList::from(start), Bvh::needed(500));
    for immense in [150, 500] {
        let mut moved = own.clone();
        moved[..immense].iter_mut().for_each(|sphere| sphere.radius = 1e30);
        let moved = SphereList::from(moved);
        // Returns how many indices are taken before any sphere leaves its lane, and how many a refit asks for if these are too few.
        let refitted = |given: usize| {
            let mut nodes = vec![BvhNode::EMPTY; needed.nodes];
            let mut places = vec![[f32::NAN; 4]; needed.places];
            let mut indices = vec![7; given];
            let mut memory = BvhMemory::new(&mut nodes, &mut places, &mut indices);
            let taken = memory.build(start.spheres()).expect("enough").size().places;
            let asked = match memory.refit(moved.spheres()) {
                Ok(tree) => {
                    assert_as_list(&tree, &moved, &[Tier::Exact], &rays);
                    None
                }
                Err(RefitError::TooSmall(error)) => Some(error.needed),
                Err(error) => panic!("{error}"),
            };
            let tree = memory.refit(start.spheres()).expect("what was built");
            assert_as_list(&tree, &start, &[Tier::Exact], &rays);
            (taken, asked)
        };
        let (taken, asked) = refitted(needed.places);
        let asked = asked.expect("more than there are");
        // Those and the 200 that had no lane, except a few copies that had one.
        let outside = if immense == 500 { 500..=500 } else { 340..=350 };
        assert!(outside.contains(&(asked - taken)), "{asked} {taken}");
        assert_eq!(refitted(asked).1, None);
        assert_eq!(refitted(asked - 1).1, Some(asked));
    }
}

/// So many spheres out of scale that greedy leaves, which take all places there are, would leave no room for their
/// indices.
#[test]
fn spheres_out_of_scale_have_room_when_built() {
    let mut random = Random::new(27, 0);
    let mut spheres = Vec::new();
    // Pairs far from each other, which leaves of their own hold best.
    while spheres.len() < 1200 {
        let center = random.in_cube(100.0);
        for _ in 0..2 {
            spheres.push(Sphere { center: center + random.in_cube(0.01), radius: 0.5 });
        }
    }
    for index in 0..1000 {
        spheres.push(Sphere { center: Vec3::new(index as f32 * 1e17, 0.0, 1e20), radius: 1e16 });
    }
    let mut rays = mixed(64, 7);
    rays.extend(
        (0..1000).map(|index| Ray::new(Vec3::ZERO, Vec3::new(index as f32 * 1e17, 0.0, 1e20))),
    );
    let tree = SphereTree::new(spheres.as_slice());
    assert_as_list(&tree, &SphereList::from(&spheres), &[Tier::Exact], &rays);
}
