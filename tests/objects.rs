//! Object order: spheres one by one, in any order, give the closest hits of their list; and the number of stored hits
//! is counted.

use proptest::prelude::*;
use spherule_kernel::{
    Hit, HitPacket, Lanes, Level, Ray, RayPacket, Sphere, SphereList, Spheres, Tier, Vec3, Writes,
    f32x4, f32x8, f32x16, object_lanes, object_packets,
};
use spherule_referee::scene::Scene;
use spherule_referee::strategies;
use spherule_tests::variants::{bits, levels, reference};

/// Object order in lanes.
fn in_lanes<L: Lanes<Token = ()>>(
    tier: Tier,
    spheres: Spheres<'_>,
    order: &[u32],
    rays: &[Ray],
) -> (Vec<Option<Hit>>, Writes) {
    let (mut found, mut writes) = (Vec::new(), Writes::default());
    for rays in rays.chunks(L::COUNT) {
        let (packet, mut hits) = (RayPacket::new(rays), HitPacket::none());
        for &index in order {
            writes += object_lanes::<L>(tier, (), spheres, index, &packet, &mut hits);
        }
        found.extend(hits.hits().take(rays.len()));
    }
    (found, writes)
}

/// Object order at a level.
fn at_level(
    tier: Tier,
    level: Level,
    spheres: Spheres<'_>,
    order: &[u32],
    rays: &[Ray],
) -> (Vec<Option<Hit>>, Writes) {
    let packets: Vec<RayPacket> = rays.chunks(16).map(RayPacket::new).collect();
    let numbers: Vec<u32> = (0..packets.len() as u32).collect();
    let (mut hits, mut writes) = (vec![HitPacket::none(); packets.len()], Writes::default());
    for &index in order {
        writes += object_packets(tier, level, spheres, index, &numbers, &packets, &mut hits);
    }
    (hits.iter().flat_map(HitPacket::hits).take(rays.len()).collect(), writes)
}

fn check(Scene { rays, spheres }: &Scene) {
    let list = SphereList::from(spheres);
    let forwards: Vec<u32> = (0..spheres.len() as u32).collect();
    let backwards: Vec<u32> = forwards.iter().rev().copied().collect();
    for tier in Tier::ALL {
        let expected: Vec<_> =
            reference(tier).closest(spheres, rays).into_iter().map(bits).collect();
        for order in [&forwards, &backwards] {
            let list = list.spheres();
            let mut all = vec![
                in_lanes::<f32>(tier, list, order, rays),
                in_lanes::<f32x4>(tier, list, order, rays),
                in_lanes::<f32x8>(tier, list, order, rays),
                in_lanes::<f32x16>(tier, list, order, rays),
            ];
            all.extend(levels().map(|level| at_level(tier, level, list, order, rays)));
            let scalar_writes = all[0].1;
            for (hits, writes) in all {
                let hits: Vec<_> = hits.into_iter().map(bits).collect();
                assert_eq!(hits, expected, "{tier:?}");
                assert_eq!(writes, scalar_writes, "{tier:?}");
                let met = expected.iter().flatten().count() as u64;
                assert_eq!(writes.stored - writes.overwritten, met, "{tier:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(strategies::config(300))]

    #[test]
    fn objects_are_their_list_on_the_lattice(scene in strategies::scene(strategies::lattice)) {
        check(&scene);
    }

    #[test]
    fn objects_are_their_list_in_every_regime(scene in strategies::scene(strategies::hard)) {
        check(&scene);
    }

    #[test]
    fn objects_are_their_list_for_any_bits(scene in strategies::scene(strategies::wild)) {
        check(&scene);
    }
}

/// Of equal hits the lowest index stays, and a sphere that is hit twice is stored once.
#[test]
fn writes_are_counted() {
    let at = |z| Sphere { center: Vec3::new(0.0, 0.0, z), radius: 1.0 };
    let list = SphereList::from([at(9.0), at(5.0), at(5.0), at(7.0)]);
    let rays = [Ray::new(Vec3::ZERO, Vec3::Z), Ray::new(Vec3::ZERO, Vec3::X)];
    for tier in Tier::ALL {
        for (order, stored, overwritten) in [
            (&[0, 1, 2, 3][..], 2, 1),
            (&[3, 2, 1, 0], 3, 2),
            (&[0, 3, 2, 1], 4, 3),
            (&[1, 1, 1], 1, 0),
            (&[4, u32::MAX], 0, 0),
        ] {
            let (hits, writes) = in_lanes::<f32x8>(tier, list.spheres(), order, &rays);
            assert_eq!(writes, Writes { stored, overwritten }, "{tier:?}, {order:?}");
            let hit = Hit { t: 4.0, sphere: 1 };
            assert_eq!(hits, [(stored > 0).then_some(hit), None], "{tier:?}, {order:?}");
        }
    }
}

/// Only the named packets are tested, and numbers past the end name none.
#[test]
fn packets_by_their_numbers() {
    let list = SphereList::from([[0.0, 0.0, 5.0, 1.0]]);
    let rays = [RayPacket::new(&[Ray::new(Vec3::ZERO, Vec3::Z)]); 4];
    for level in levels() {
        let mut hits = [HitPacket::none(); 3];
        let numbers = [2, 0, 3, u32::MAX];
        let writes =
            object_packets(Tier::Exact, level, list.spheres(), 0, &numbers, &rays, &mut hits);
        assert_eq!(writes, Writes { stored: 2, overwritten: 0 });
        assert_eq!(hits.map(|hits| hits.hit(0).is_some()), [true, false, true], "{level:?}");
    }
}
