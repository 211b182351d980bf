//! The door's edges: slices of unequal length, empty calls, and memory that must not be touched, at every layer of
//! every structure.

mod given;

use spherule_kernel::{
    Bvh, Bvh4, Coherence, DepthList, Hit, HitColumns, HitPacket, Intersect, Lanes, Ray, RayColumns,
    RayPacket, Sphere, SphereList, SpherePacket, SphereTree, Spheres, Tier, Trace, Vec3, Viewpoint,
    f32x4, f32x8, f32x16, pair_packets, pairs,
};
use spherule_tests::variants::levels;

/// From (0, 0, -3) upwards, and the sphere of radius 1 about zero: hit at 2.
const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
const MISS: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::X);
const SPHERE: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
const HIT: Option<Hit> = Some(Hit { t: 2.0, sphere: 0 });
/// An answer that no query gives.
const STALE: Option<Hit> = Some(Hit { t: -7.0, sphere: 7 });

/// Calls `check` with traces of every coherence at every level.
fn traces(check: impl Fn(Trace<'_>)) {
    for level in levels() {
        for coherence in [Coherence::Detect, Coherence::Coherent, Coherence::Incoherent] {
            for words in [0, 5, 1000] {
                let mut scratch = vec![f32::NAN; words];
                check(Trace::new().with(coherence).at(level).with_scratch(&mut scratch));
            }
        }
    }
}

/// Rays past the end of the output are ignored; output past the rays stays unchanged.
fn slices(structure: &impl Intersect, hit: Option<Hit>) {
    let occluded = hit.is_some();
    for (rays, outputs) in [
        (0, 0),
        (0, 3),
        (3, 0),
        (1, 40),
        (40, 1),
        (15, 15),
        (17, 16),
        (65, 64),
        (1025, 1100),
        (1100, 1025),
    ] {
        let (given, common) = (vec![RAY; rays], rays.min(outputs));
        let expected = [vec![hit; common], vec![STALE; outputs - common]].concat();
        let expected_occluded =
            [vec![occluded; common], vec![!occluded; outputs - common]].concat();
        let stale = || (vec![STALE; outputs], vec![!occluded; outputs]);
        let check = |tier: Tier, hits: Vec<Option<Hit>>, flags: Vec<bool>| {
            assert_eq!((&hits, &flags), (&expected, &expected_occluded), "{tier:?}, {rays} rays");
        };
        for tier in Tier::ALL {
            let (mut hits, mut flags) = stale();
            structure.closest_hits(tier, &given, &mut hits);
            structure.any_hits(tier, &given, &mut flags);
            check(tier, hits, flags);
            traces(|mut trace| {
                let (mut hits, mut flags) = stale();
                structure.closest_hits_with(tier, &mut trace, &given, &mut hits);
                structure.any_hits_with(tier, &mut trace, &given, &mut flags);
                check(tier, hits, flags);
            });
        }
    }
}

/// The shortest of ten columns decides the length, whichever it is.
fn columns(structure: &impl Intersect, hit: Option<Hit>) {
    let found = hit.map_or((f32::INFINITY, u32::MAX), |hit| (hit.t, hit.sphere));
    let numbers = [0.0, 0.0, -3.0, 0.0, 0.0, 1.0, 0.0, f32::INFINITY];
    for (rays, outputs) in [(0, 3), (3, 0), (1, 15), (15, 16), (17, 40), (1025, 1030), (70, 65)] {
        for shorter in 0..10 {
            let length = |column| if column == shorter { rays.min(outputs) / 2 } else { rays };
            let table: Vec<Vec<f32>> =
                (0..8).map(|column| vec![numbers[column]; length(column)]).collect();
            let column = |number: usize| table[number].as_slice();
            let given = RayColumns {
                origin: [column(0), column(1), column(2)],
                direction: [column(3), column(4), column(5)],
                t_min: column(6),
                t_max: column(7),
            };
            let output = |column| if column == shorter { outputs / 2 } else { outputs };
            let (room_t, room) = (output(8), output(9));
            let common = given.len().min(room_t).min(room);
            traces(|mut trace| {
                let (mut t, mut sphere) = (vec![-7.0; room_t], vec![7; room]);
                let mut occluded = vec![hit.is_none(); outputs];
                let hits = HitColumns { t: &mut t, sphere: &mut sphere };
                structure.closest_hit_columns(Tier::Exact, &mut trace, given, hits);
                structure.any_hit_columns(Tier::Exact, &mut trace, given, &mut occluded);
                let case = format!("{rays} rays, {outputs} outputs, column {shorter} is shorter");
                let expected_t = [vec![found.0; common], vec![-7.0; room_t - common]].concat();
                let expected = [vec![found.1; common], vec![7; room - common]].concat();
                assert_eq!((t, sphere), (expected_t, expected), "{case}");
                let asked = given.len().min(outputs);
                for (index, &occluded) in occluded.iter().enumerate() {
                    assert_eq!(occluded, hit.is_some() == (index < asked), "{case}, {index}");
                }
            });
        }
    }
}

/// The same for packets, whose output is overwritten as far as there are rays.
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

            let mut occluded = [7; 3];
            structure.any_hit_packets(tier, &mut trace, &[hitting; 3], &mut occluded[..2]);
            assert_eq!(occluded, [all, all, 7], "{tier:?}");
            structure.any_hit_packets(tier, &mut trace, &[missing], &mut occluded);
            assert_eq!(occluded, [0, all, 7], "{tier:?}");
        });
    }
}

/// The same for the caller's own lanes.
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

        let mut occluded = [7; 3];
        structure.any_hit_lanes::<L>(tier, (), &mut trace, &[hitting; 3], &mut occluded[..2]);
        assert_eq!(occluded, [all, all, 7], "{tier:?}");
        structure.any_hit_lanes::<L>(tier, (), &mut trace, &[missing], &mut occluded);
        assert_eq!(occluded, [0, all, 7], "{tier:?}");
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
    columns(structure, hit);
    packets(structure, hit);
}

/// The sphere, and as many others that the rays miss as make nodes, which rays enter.
fn among_others() -> Vec<Sphere> {
    let other = |i: u16| Sphere { center: Vec3::new(f32::from(i), 40.0, 0.0), radius: 0.25 };
    [SPHERE].into_iter().chain((0..80).map(other)).collect()
}

#[test]
fn every_structure_of_one_sphere_of_none_and_of_many() {
    let many = among_others();
    for (spheres, hit) in [(&[SPHERE][..], HIT), (&[], None), (many.as_slice(), HIT)] {
        let list = SphereList::from(spheres);
        let tree = SphereTree::new(list.clone());
        let mut memory = vec![0.0; DepthList::needed(spheres.len())];
        let viewpoint = Viewpoint::Origin(RAY.origin);
        let depth_list = DepthList::sort(list.spheres(), viewpoint, &mut memory);
        let depth_list = depth_list.expect("enough memory");
        let mut words = vec![0; Bvh4::needed(spheres.len())];
        let bvh4 = Bvh4::build(list.spheres(), &mut words).expect("enough memory");
        let borrowed: Spheres<'_> = list.spheres();
        let bvh: Bvh<'_> = tree.bvh();
        assert_eq!(bvh.size().nodes > 0, spheres.len() > 64);
        slices_and_packets(&borrowed, hit);
        slices_and_packets(&list, hit);
        slices_and_packets(&depth_list, hit);
        slices_and_packets(&bvh, hit);
        slices_and_packets(&tree, hit);
        slices_and_packets(&bvh4, hit);
    }
}

/// The shortest of the three slices decides the length.
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
        for level in levels() {
            let mut hits = vec![HitPacket::none(); outputs];
            pair_packets(Tier::Exact, level, &vec![ray; rays], &vec![sphere; spheres], &mut hits);
            let hit = hits.iter().map(|packet| packet.hit(15).is_some());
            assert!(hit.eq((0..outputs).map(|index| index < common)), "{level:?}");
        }
    }
}
