//! Invalid spheres, memory that is too small, and different builders of the tree.

use super::scenes::{EYE, camera, mixed, parallel, uniform};
use super::{BOTH, EXACT};
use spherule_kernel::bvh::Join;
use spherule_kernel::{
    Bvh, BvhNode, BvhSize, DepthList, QueuedRay, Sphere, SphereList, SphereTree, StreamMemory,
    StreamRay, TooSmall, Vec3, Viewpoint,
};
use spherule_referee::random::Random;
use spherule_tests::variants::{assert_same, assert_same_from};

#[test]
fn invalid_and_immense_spheres() {
    let mut spheres = uniform(300);
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 3e38, 2e12, 1e30];
    let mut random = Random::new(78, 0);
    for (i, sphere) in spheres.iter_mut().enumerate().filter(|(i, _)| i % 3 == 0) {
        let number = random.pick(&numbers);
        if i % 2 == 0 { sphere.radius = number } else { sphere.center[i % 3] = number }
    }
    // Only such spheres.
    let none = vec![Sphere { center: Vec3::ZERO, radius: f32::NAN }; 100];
    let tree = SphereTree::new(none.as_slice());
    assert_eq!((tree.bvh().depth(), tree.bvh().size().nodes), (0, 0));
    let immense = vec![Sphere { center: Vec3::new(0.0, 3e12, 0.0), radius: 3e12 }; 40];
    for (tiers, spheres) in [(EXACT, spheres), (BOTH, none), (EXACT, immense), (BOTH, Vec::new())] {
        assert_same(tiers, &mixed(250, 16), &spheres);
        assert_same(tiers, &camera(EYE, Vec3::ZERO, 0.364, 32), &spheres);
        let parallel = parallel(EYE, -EYE, 1.2, 32);
        assert_same_from(Viewpoint::Direction(-EYE), tiers, &parallel, &spheres);
    }
}

#[test]
fn too_little_memory_for_a_tree() {
    for count in [0, 1, 16, 17, 1000] {
        let list = SphereList::from(uniform(count));
        let needed = Bvh::needed(count);
        let mut nodes = vec![BvhNode::EMPTY; needed.nodes];
        let (mut places, mut indices) = (vec![[0.0; 4]; needed.places], vec![0; needed.places]);
        let few = |all: usize| all.saturating_sub(1);
        for (n, p, i) in [
            (few(needed.nodes), needed.places, needed.places),
            (needed.nodes, needed.places - 1, needed.places),
            (needed.nodes, needed.places, needed.places - 1),
            (0, 0, 0),
        ] {
            if (n, p, i) == (needed.nodes, needed.places, needed.places) {
                continue;
            }
            let (places, indices) = (&mut places[..p], &mut indices[..i]);
            let error = Bvh::build(list.spheres(), &mut nodes[..n], places, indices)
                .expect_err("less than needed");
            assert!(error.given < error.needed, "{error:?}");
            assert!(error.to_string().contains(&error.needed.to_string()), "{error}");
        }
        assert!(Bvh::build(list.spheres(), &mut nodes, &mut places, &mut indices).is_ok());
    }
    let bytes = |count| Bvh::needed(count).nodes * 512 + Bvh::needed(count).places * 20;
    assert_eq!((0..20_000).map(|count| bytes(count).saturating_sub(40 * count)).max(), Some(1040));
    // As many spheres as places can tell apart; and one more, for which no memory is enough.
    let most = Bvh::needed(1 << 27);
    assert!(most.nodes * 512 + most.places * 20 <= 40 << 27, "{most:?}");
    assert_eq!(Bvh::needed((1 << 27) + 1).places, usize::MAX);
    assert_eq!(Bvh::needed(usize::MAX).nodes, usize::MAX);
}

/// Memory that is longer than needed: its rest is left alone, and the tree is that of as much as is needed.
#[test]
fn more_memory_than_a_tree_needs() {
    let list = SphereList::from(uniform(5000));
    let BvhSize { nodes: needed, places } = Bvh::needed(5000);
    // A node that a build would not leave as it is.
    let mut one = [BvhNode::EMPTY; 3];
    let few = SphereList::from(uniform(40));
    let (mut numbers, mut indices) = (vec![[0.0; 4]; places], vec![0; places]);
    let built = Bvh::build(few.spheres(), &mut one, &mut numbers, &mut indices);
    assert!(built.expect("enough").depth() > 0);
    let node = format!("{:?}", one[0]);

    let trees = [0, 10_000].map(|more| {
        let mut nodes = vec![one[0]; needed + more];
        let mut numbers = vec![[7.5; 4]; places + more];
        let mut indices = vec![77; places + more];
        let tree = Bvh::build(list.spheres(), &mut nodes, &mut numbers, &mut indices);
        let tree = format!("{:?}", tree.expect("enough"));
        assert!(nodes[needed..].iter().all(|left| format!("{left:?}") == node));
        assert!(numbers[places..].iter().all(|left| *left == [7.5; 4]));
        assert!(indices[places..].iter().all(|left| *left == 77));
        tree
    });
    assert!(trees[0] == trees[1]);
}

#[test]
fn too_little_memory_for_a_stream() {
    assert_eq!(StreamMemory::queues_needed(1 << 24), (1 << 24) + 256);
    let (mut rays, mut queues) = ([StreamRay::EMPTY; 16], [QueuedRay::EMPTY; 272]);
    let error = StreamMemory::new(&mut rays[..15], &mut queues).expect_err("no packet has room");
    assert_eq!(error, TooSmall { what: "rays", needed: 16, given: 15 });
    let error = StreamMemory::new(&mut rays, &mut queues[..271]).expect_err("a level has no room");
    assert_eq!(error, TooSmall { what: "queues", needed: 272, given: 271 });
    assert!(StreamMemory::new(&mut rays, &mut queues).is_ok());
}

#[test]
fn too_little_memory_for_a_depth_list() {
    let viewpoint = Viewpoint::Origin(Vec3::ZERO);
    for count in [0, 1, 15, 16, 17, 1000] {
        let list = SphereList::from(uniform(count));
        let needed = DepthList::needed(count);
        let mut memory = vec![0.0; needed];
        for words in [0, needed / 2, needed - 1] {
            let error = DepthList::sort(list.spheres(), viewpoint, &mut memory[..words])
                .expect_err("less than needed");
            assert_eq!(error, TooSmall { what: "numbers", needed, given: words });
            assert!(error.to_string().contains(&needed.to_string()), "{error}");
        }
        assert!(DepthList::sort(list.spheres(), viewpoint, &mut memory).is_ok());
        assert!(needed * 4 <= 24 * count + 768, "{needed} words for {count}");
    }
    assert_eq!(DepthList::needed(usize::MAX), usize::MAX);
    assert_eq!(DepthList::scratch(usize::MAX), usize::MAX);
}

/// Starts two threads wherever two pieces of work are independent.
struct Threads;

impl Join for Threads {
    fn join<A: Send, B: Send>(
        &self,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        std::thread::scope(|scope| {
            let one = scope.spawn(one);
            let other = other();
            (one.join().expect("no panic"), other)
        })
    }
}

#[test]
fn threads_build_the_same_tree() {
    // More leaves than one thread counts, and few leaves.
    for count in [40_000, 5000, 300, 17, 16, 1, 0] {
        let list = SphereList::from(uniform(count));
        let alone = SphereTree::new(list.clone());
        let together = SphereTree::build_with(&Threads, list).expect("enough memory");
        let (alone, together) = (format!("{:?}", alone.bvh()), format!("{:?}", together.bvh()));
        assert!(alone == together, "{count} spheres");
    }
}
