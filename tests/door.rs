//! The door's edges: slices of unequal length, nothing to do, and what is left alone, at every storey of every
//! structure.

use spherule_kernel::{
    Bvh, Coherence, DepthList, Hit, HitPacket, Intersect, Lanes, Level, Ray, RayPacket, Sphere,
    SphereList, SpherePacket, SphereTree, Spheres, Tier, Trace, Vec3, Vec4, Viewpoint, f32x4,
    f32x8, f32x16, pair_packets, pairs,
};
use spherule_tests::variants::levels;

/// From (0, 0, -3) upwards, and the sphere of radius 1 about zero: hit at 2.
const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
const MISS: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::X);
const SPHERE: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
const HIT: Option<Hit> = Some(Hit { t: 2.0, sphere: 0 });
/// What nobody answers.
const STALE: Option<Hit> = Some(Hit { t: -7.0, sphere: 7 });

/// Traces of every kind of coherence at every level.
fn traces(check: impl Fn(Trace<'_>)) {
    for name in levels() {
        let level = Level::named(name).expect("a level of this CPU");
        for coherence in [Coherence::Detect, Coherence::Coherent, Coherence::Incoherent] {
            for words in [0, 5, 1000] {
                let mut scratch = vec![f32::NAN; words];
                check(Trace::new().with(coherence).at(level).with_scratch(&mut scratch));
            }
        }
    }
}

/// Rays past the end of the output are left out, output past the rays is left alone.
fn slices(structure: &impl Intersect, hit: Option<Hit>) {
    let met = hit.is_some();
    for (rays, outputs) in
        [(0, 0), (0, 3), (3, 0), (1, 40), (40, 1), (17, 16), (1025, 1100), (1100, 1025)]
    {
        let (given, common) = (vec![RAY; rays], rays.min(outputs));
        let expected = [vec![hit; common], vec![STALE; outputs - common]].concat();
        let expected_met = [vec![met; common], vec![!met; outputs - common]].concat();
        for tier in Tier::ALL {
            let (mut hits, mut flags) = (vec![STALE; outputs], vec![!met; outputs]);
            structure.closest_hits(tier, &given, &mut hits);
            structure.any_hits(tier, &given, &mut flags);
            assert_eq!((&hits, &flags), (&expected, &expected_met), "{tier:?}, {rays} rays");
            traces(|mut trace| {
                let (mut hits, mut flags) = (vec![STALE; outputs], vec![!met; outputs]);
                structure.closest_hits_with(tier, &mut trace, &given, &mut hits);
                structure.any_hits_with(tier, &mut trace, &given, &mut flags);
                assert_eq!((&hits, &flags), (&expected, &expected_met), "{tier:?}, {rays} rays");
            });
        }
    }
}

/// The same of packets, whose output is overwritten as far as there are rays.
fn packets(structure: &impl Intersect, hit: Option<Hit>) {
    let (hitting, missing) = (RayPacket::new(&[RAY; 16]), RayPacket::new(&[MISS; 16]));
    let all = if hit.is_some() { 0xffff } else { 0 };
    for tier in Tier::ALL {
        traces(|mut trace| {
            let mut hits = [HitPacket::none(); 3];
            structure.closest_hit_packets(tier, &mut trace, &[hitting; 3], &mut hits[..2]);
            assert_eq!(hits.map(|packet| packet.hit(0)), [hit, hit, None], "{tier:?}");
            structure.closest_hit_packets(tier, &mut trace, &[missing], &mut hits);
            assert_eq!(hits.map(|packet| packet.hit(15)), [None, hit, None], "{tier:?}");
            structure.closest_hit_packets(tier, &mut trace, &[], &mut hits);
            assert_eq!(hits.map(|packet| packet.hit(15)), [None, hit, None], "{tier:?}");

            let mut met = [7; 3];
            structure.any_hit_packets(tier, &mut trace, &[hitting; 3], &mut met[..2]);
            assert_eq!(met, [all, all, 7], "{tier:?}");
            structure.any_hit_packets(tier, &mut trace, &[missing], &mut met);
            assert_eq!(met, [0, all, 7], "{tier:?}");
        });
    }
}

/// And of the caller's own lanes.
fn lanes<L: Lanes<Token = ()>>() {
    let structure = SphereList::from(&[SPHERE][..]);
    let (hitting, missing) = (RayPacket::new(&[RAY; 16]), RayPacket::new(&[MISS; 16]));
    let (mut trace, all) = (Trace::new(), (1 << L::COUNT) - 1);
    for tier in Tier::ALL {
        let mut hits = [HitPacket::none(); 3];
        structure.closest_hit_lanes::<L>(tier, (), &mut trace, &[hitting; 3], &mut hits[..2]);
        assert_eq!(hits.map(|packet| packet.hit(0)), [HIT, HIT, None], "{tier:?}");
        structure.closest_hit_lanes::<L>(tier, (), &mut trace, &[missing], &mut hits);
        assert_eq!(hits.map(|packet| packet.hit(L::COUNT - 1)), [None, HIT, None], "{tier:?}");

        let mut met = [7; 3];
        structure.any_hit_lanes::<L>(tier, (), &mut trace, &[hitting; 3], &mut met[..2]);
        assert_eq!(met, [all, all, 7], "{tier:?}");
        structure.any_hit_lanes::<L>(tier, (), &mut trace, &[missing], &mut met);
        assert_eq!(met, [0, all, 7], "{tier:?}");
    }
}

#[test]
fn lanes_of_every_width() {
    lanes::<f32>();
    lanes::<f32x4>();
    lanes::<f32x8>();
    lanes::<f32x16>();
}

fn slices_and_packets(structure: &impl Intersect, hit: Option<Hit>) {
    slices(structure, hit);
    packets(structure, hit);
}

#[test]
fn every_structure_of_one_sphere_and_of_none() {
    for (spheres, hit) in [(&[SPHERE][..], HIT), (&[], None)] {
        let list = SphereList::from(spheres);
        let tree = SphereTree::new(list.clone());
        let mut memory = vec![0.0; DepthList::needed(spheres.len())];
        let viewpoint = Viewpoint::Origin(RAY.origin);
        let depth_list = DepthList::sort(list.spheres(), viewpoint, &mut memory);
        let depth_list = depth_list.expect("enough memory");
        let borrowed: Spheres<'_> = list.spheres();
        let bvh: Bvh<'_> = tree.bvh();
        slices_and_packets(&borrowed, hit);
        slices_and_packets(&list, hit);
        slices_and_packets(&depth_list, hit);
        slices_and_packets(&bvh, hit);
        slices_and_packets(&tree, hit);
    }
}

/// The shortest of the three slices counts.
#[test]
fn pairs_of_unequal_slices() {
    for (rays, spheres, outputs) in [(0, 2, 3), (2, 0, 3), (2, 3, 0), (1, 40, 20), (40, 20, 33)] {
        let common = rays.min(spheres).min(outputs);
        for tier in Tier::ALL {
            let mut hits = vec![STALE; outputs];
            pairs(tier, &vec![RAY; rays], &vec![SPHERE; spheres], &mut hits);
            for (index, hit) in hits.into_iter().enumerate() {
                let expected = Some(Hit { t: 2.0, sphere: index as u32 });
                assert_eq!(hit, if index < common { expected } else { STALE }, "{tier:?}");
            }
        }
    }
    let (ray, sphere) = (RayPacket::new(&[RAY; 16]), SpherePacket::new(&[SPHERE; 16]));
    for (rays, spheres, outputs) in [(0, 1, 2), (1, 0, 2), (2, 3, 1), (3, 1, 2), (2, 2, 3)] {
        let common = rays.min(spheres).min(outputs);
        for name in levels() {
            let level = Level::named(name).expect("a level of this CPU");
            let mut hits = vec![HitPacket::none(); outputs];
            pair_packets(Tier::Exact, level, &vec![ray; rays], &vec![sphere; spheres], &mut hits);
            let hit = hits.iter().map(|packet| packet.hit(15).is_some());
            assert!(hit.eq((0..outputs).map(|index| index < common)), "{name:?}");
        }
    }
}

/// Each pair on its own, beside rays and spheres that are none.
#[test]
fn pairs_beside_what_is_none() {
    let nan = Vec3::splat(f32::NAN);
    let (mut rays, mut spheres) = ([RAY; 40], [SPHERE; 40]);
    rays[3].origin = nan;
    rays[17].direction = nan;
    spheres[20].center = nan;
    spheres[39].radius = -1.0;
    let mut hits = [STALE; 40];
    for tier in Tier::ALL {
        pairs(tier, &rays, &spheres, &mut hits);
        for (index, hit) in hits.into_iter().enumerate() {
            assert_eq!(hit.is_some(), ![3, 17, 20, 39].contains(&index), "{tier:?}, {index}");
        }
    }
}

#[test]
fn columns_of_unequal_length() {
    let (one, two) = ([1.0], [1.0, 2.0]);
    for (x, y, z, r) in [
        (&two[..], &one[..], &one[..], &one[..]),
        (&one, &two, &one, &one),
        (&one, &one, &two, &one),
        (&one, &one, &one, &two),
        (&one, &one, &one, &[]),
    ] {
        assert!(Spheres::new(x, y, z, r).is_err());
    }
    assert!(Spheres::new(&one, &one, &one, &one).is_ok());
}

/// Whatever spheres come from, they are the same list.
#[test]
fn lists_from_everything() {
    let rows = [[0.0, 1.0, 2.0, 3.0], [4.0, 5.0, 6.0, 7.0], [f32::NAN, -0.0, 1e38, -1.0]];
    let spheres = rows.map(Sphere::from);
    let bits = |list: SphereList| -> Vec<[u32; 4]> {
        let bits = |s: Sphere| [s.center.x, s.center.y, s.center.z, s.radius].map(f32::to_bits);
        list.spheres().iter().map(bits).collect()
    };
    let expected: Vec<_> = rows.iter().map(|row| row.map(f32::to_bits)).collect();
    for list in [
        SphereList::from(&spheres[..]),
        SphereList::from(spheres.to_vec()),
        SphereList::from(&rows[..]),
        SphereList::from(rows),
        spheres.into_iter().collect(),
        rows.into_iter().collect(),
        rows.map(Vec4::from_array).into_iter().collect(),
        spheres.map(|sphere| (sphere.center, sphere.radius)).into_iter().collect(),
    ] {
        assert_eq!(bits(list), expected);
    }
}
