//! Lists of spheres by name: empty, of any length, full of equals, with invalid members.

use spherule_kernel::{Hit, Ray, Sphere, Spheres, SpheresError, Vec3};
use spherule_tests::doors::DOORS;

/// From (0, 0, -3) upwards, and the sphere of radius 1 about zero: hit at 2.
const RAY: Ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
const SPHERE: Sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };

#[test]
fn inactive_rays() {
    for door in DOORS {
        let hits = (door.nearest)(&[Ray::INACTIVE; 16], &[SPHERE]);
        assert_eq!(hits, [None; 16], "{} in {} lanes", door.tier, door.lanes);
        let met = (door.any)(&[Ray::INACTIVE; 16], &[SPHERE]);
        assert_eq!(met, [false; 16], "{} in {} lanes", door.tier, door.lanes);
    }
}

#[test]
fn empty_list() {
    for door in DOORS {
        assert_eq!(door.nearest_one(&RAY, &[]), None);
        assert_eq!((door.any)(&[RAY], &[]), [false]);
        assert_eq!((door.nearest)(&[], &[SPHERE]), []);
    }
}

/// The one that is hit last in its list, whatever the length: no sphere of a begun group of four,
/// and none of a second block, is lost.
#[test]
fn lists_of_any_length() {
    let far = Sphere { center: Vec3::new(0.0, 9.0, 0.0), radius: 1.0 };
    for length in (1..=20).chain([127, 128, 129, 255, 257]) {
        let mut spheres = vec![far; length];
        spheres[length - 1] = SPHERE;
        let expected = Some(Hit { t: 2.0, sphere: length as u32 - 1 });
        for door in DOORS {
            let hit = door.nearest_one(&RAY, &spheres);
            assert_eq!(hit, expected, "{} in {} lanes, {length} spheres", door.tier, door.lanes);
            assert_eq!((door.any)(&[RAY], &spheres), [true]);
        }
    }
}

/// A ray that is done does not end the search for its neighbours.
#[test]
fn each_lane_meets_its_own_sphere() {
    let count = 40;
    let at = |index: usize| Vec3::new(10.0 * index as f32, 0.0, 0.0);
    let spheres: Vec<Sphere> = (0..count).map(|i| Sphere { center: at(i), ..SPHERE }).collect();
    let rays: Vec<Ray> =
        (0..count).map(|i| Ray { origin: RAY.origin + at(i), ..RAY }).rev().collect();
    let expected: Vec<Option<Hit>> =
        (0..count as u32).rev().map(|sphere| Some(Hit { t: 2.0, sphere })).collect();
    for door in DOORS {
        let hits = (door.nearest)(&rays, &spheres);
        assert_eq!(hits, expected, "{} in {} lanes", door.tier, door.lanes);
        let met = (door.any)(&rays, &spheres);
        assert_eq!(met, vec![true; count], "{} in {} lanes", door.tier, door.lanes);
    }
}

#[test]
fn a_million_spheres_in_one_place() {
    let spheres = vec![SPHERE; 1_000_000];
    for door in DOORS {
        let hit = door.nearest_one(&RAY, &spheres);
        assert_eq!(hit, Some(Hit { t: 2.0, sphere: 0 }), "{} in {} lanes", door.tier, door.lanes);
    }
}

#[test]
fn the_lowest_index_of_equals() {
    let near = Sphere { center: Vec3::new(0.0, 0.0, -0.5), radius: 0.5 };
    let miss = Sphere { center: Vec3::new(9.0, 0.0, 0.0), radius: 1.0 };
    // Different spheres that are met at 2, from the third on.
    let equals = [miss, Sphere { radius: -1.0, ..near }, near, SPHERE, near];
    for door in DOORS {
        let hit = door.nearest_one(&RAY, &equals);
        assert_eq!(hit, Some(Hit { t: 2.0, sphere: 2 }), "{} in {} lanes", door.tier, door.lanes);
    }
}

#[test]
fn invalid_spheres_among_others() {
    let invalid = [
        Sphere { radius: f32::NAN, ..SPHERE },
        Sphere { radius: f32::INFINITY, ..SPHERE },
        Sphere { center: Vec3::new(0.0, f32::NAN, 0.0), ..SPHERE },
        Sphere { center: Vec3::new(f32::INFINITY, 0.0, 0.0), ..SPHERE },
        SPHERE,
        Sphere { radius: -1.0, ..SPHERE },
    ];
    for door in DOORS {
        let hit = door.nearest_one(&RAY, &invalid);
        assert_eq!(hit, Some(Hit { t: 2.0, sphere: 4 }), "{} in {} lanes", door.tier, door.lanes);
        assert_eq!(door.nearest_one(&RAY, &invalid[..4]), None);
    }
}

#[test]
fn unequal_slices() {
    let (one, two) = ([1.0], [1.0, 2.0]);
    for (x, y, z, r) in [
        (&two[..], &one[..], &one[..], &one[..]),
        (&one, &two, &one, &one),
        (&one, &one, &two, &one),
        (&one, &one, &one, &two),
        (&one, &one, &one, &[]),
    ] {
        assert_eq!(Spheres::new(x, y, z, r).err(), Some(SpheresError::UnequalLengths));
    }
    assert!(Spheres::new(&one, &one, &one, &one).is_ok());
}
