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
            Err(RefitError::TooSmall(error)) => assert!(more == 0 && error.needed > error.given),
            Err(error) => panic!("{error}"),
        }
        for list in [&near, &start] {
            let tree = memory.refit(list.spheres()).expect("all are inside");
            assert_as_list(&tree, list, &[Tier::Exact], &rays);
        }
        assert_eq!(memory.refit(start.spheres()).expect("inside").growth(), 1.0);
    }
}

/// Copies and invalid spheres have no lane. Where they become spheres of their own, and others leave their lanes, each takes room, of which
/// just enough is asked for; and nothing has changed where there is too little.
#[test]
fn lent_memory_for_what_had_no_lane() {
    let (mut own, rays) = (uniform(500), some(&rays(), &mut Random::new(29, 0), 16));
    let mut start = own.clone();
    start[300..480].fill(own[40]);
    start[480..].iter_mut().for_each(|sphere| sphere.radius = -1.0);
    // These leave their lanes.
    own[..150].iter_mut().for_each(|sphere| sphere.radius = 1e30);
    let [own, start] = [own, start].map(SphereList::from);
    let needed = Bvh::needed(500);
    let refitted = |places: usize| {
        let mut nodes = vec![BvhNode::EMPTY; needed.nodes];
        let mut coordinates = vec![[f32::NAN; 4]; needed.places];
        let mut indices = vec![7; places];
        let mut memory = BvhMemory::new(&mut nodes, &mut coordinates, &mut indices);
        memory.build(start.spheres()).expect("enough");
        let lacking = match memory.refit(own.spheres()) {
            Ok(tree) => {
                assert_as_list(&tree, &own, &[Tier::Exact], &rays);
                None
            }
            Err(RefitError::TooSmall(error)) => Some(error.needed - error.given),
            Err(error) => panic!("{error}"),
        };
        let tree = memory.refit(start.spheres()).expect("what was built");
        assert_as_list(&tree, &start, &[Tier::Exact], &rays);
        lacking
    };
    let lacking = refitted(needed.places).expect("350 have no lane");
    assert_eq!(refitted(needed.places + lacking), None);
    assert_eq!(refitted(needed.places + lacking - 1), Some(1));
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
