//! Each degenerate input by its name, in every tier, lane width, lane and door.
//!
//! The numbers are small integers, so that every tier computes the roots exactly, and what is
//! tested is how they are judged.

use spherule_kernel::{Ray, Sphere, Vec3};
use spherule_tests::case::Case;
use spherule_tests::doors::{DOORS, Door};
use spherule_tests::inputs::SPECIALS;
use spherule_tests::oracle;

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;
const LEAST: f32 = f32::from_bits(1);

/// From (0, 0, -3) upwards, and the sphere of radius 1 about zero: roots 2 and 4.
const STRAIGHT: Case = Case {
    ray: Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z),
    sphere: Sphere { center: Vec3::ZERO, radius: 1.0 },
};

fn straight(change: impl Fn(&mut Ray, &mut Sphere)) -> Case {
    let mut case = STRAIGHT;
    change(&mut case.ray, &mut case.sphere);
    case
}

/// The case has this answer in every lane of every door, beside lanes that hit and lanes that
/// are full of NaN; and the oracle agrees that it should.
fn answers(case: &Case, expected: Option<f32>) {
    assert_eq!(oracle::intersect(&case.ray, &case.sphere), expected, "the oracle: {case:?}");
    let bits = expected.map(f32::to_bits);
    let poison = Case::from_numbers([NAN; Case::NUMBERS]);
    for door in DOORS {
        for neighbour in [STRAIGHT, poison] {
            for lane in 0..door.lanes {
                let mut cases = vec![neighbour; door.lanes];
                cases[lane] = *case;
                let rays: Vec<Ray> = cases.iter().map(|case| case.ray).collect();
                let Door { tier, lanes, .. } = door;
                let place = format!("{tier}, lane {lane} of {lanes}: {case:?}");

                let t = (door.pairs)(&cases)[lane];
                assert_eq!(t.map(f32::to_bits), bits, "pairs, {place}");
                let hit = (door.nearest)(&rays, &[case.sphere])[lane];
                assert_eq!(hit.map(|hit| hit.t.to_bits()), bits, "nearest, {place}");
                assert!(hit.is_none_or(|hit| hit.sphere == 0), "nearest, {place}");
                let met = (door.any)(&rays, &[case.sphere])[lane];
                assert_eq!(met, expected.is_some(), "any, {place}");
            }
        }
    }
}

fn misses(change: impl Fn(&mut Ray, &mut Sphere)) {
    answers(&straight(change), None);
}

fn hits_at(t: f32, change: impl Fn(&mut Ray, &mut Sphere)) {
    answers(&straight(change), Some(t));
}

/// The coordinates, one after the other, set to each of `values`: no hit.
fn misses_with(values: &[f32], place: impl Fn(&mut Ray, &mut Sphere, usize, f32)) {
    for axis in 0..3 {
        for &value in values {
            misses(|ray, sphere| place(ray, sphere, axis, value));
        }
    }
}

#[test]
fn a_common_hit() {
    hits_at(2.0, |_, _| {});
}

#[test]
fn nan_in_the_origin() {
    misses_with(&[NAN, -NAN], |ray, _, axis, value| ray.origin[axis] = value);
}

#[test]
fn infinity_in_the_origin() {
    misses_with(&[INF, -INF], |ray, _, axis, value| ray.origin[axis] = value);
}

#[test]
fn nan_in_the_direction() {
    misses_with(&[NAN, -NAN], |ray, _, axis, value| ray.direction[axis] = value);
}

#[test]
fn infinity_in_the_direction() {
    misses_with(&[INF, -INF], |ray, _, axis, value| ray.direction[axis] = value);
}

#[test]
fn nan_in_the_center() {
    misses_with(&[NAN, -NAN], |_, sphere, axis, value| sphere.center[axis] = value);
}

#[test]
fn infinity_in_the_center() {
    misses_with(&[INF, -INF], |_, sphere, axis, value| sphere.center[axis] = value);
}

#[test]
fn nan_in_the_radius() {
    misses(|_, sphere| sphere.radius = NAN);
    misses(|_, sphere| sphere.radius = -NAN);
}

#[test]
fn infinite_radius() {
    misses(|_, sphere| sphere.radius = INF);
    misses(|_, sphere| sphere.radius = -INF);
}

#[test]
fn infinity_in_origin_and_center() {
    // The difference is NaN, or infinite.
    misses(|ray, sphere| (ray.origin.z, sphere.center.z) = (INF, INF));
    misses(|ray, sphere| (ray.origin.z, sphere.center.z) = (-INF, INF));
}

#[test]
fn direction_zero() {
    misses(|ray, _| ray.direction = Vec3::ZERO);
    misses(|ray, _| ray.direction = -Vec3::ZERO);
}

#[test]
fn direction_zero_from_the_center_and_from_the_surface() {
    misses(|ray, _| (ray.direction, ray.origin) = (Vec3::ZERO, Vec3::ZERO));
    misses(|ray, _| (ray.direction, ray.origin) = (Vec3::ZERO, Vec3::X));
    misses(|ray, sphere| {
        (ray.direction, ray.origin, sphere.radius) = (Vec3::ZERO, Vec3::ZERO, 0.0);
    });
}

#[test]
fn negative_radius() {
    misses(|_, sphere| sphere.radius = -1.0);
    misses(|_, sphere| sphere.radius = -LEAST);
    misses(|_, sphere| sphere.radius = f32::MIN);
}

#[test]
fn radius_zero_is_a_point() {
    for zero in [0.0, -0.0] {
        hits_at(3.0, |_, sphere| sphere.radius = zero);
        misses(|ray, sphere| (ray.origin.x, sphere.radius) = (1.0, zero));
        hits_at(0.0, |ray, sphere| (ray.origin, sphere.radius) = (Vec3::ZERO, zero));
    }
}

#[test]
fn subnormal_radius() {
    // Straight at the centre; t = 3 to the last bit, in truth and in every tier.
    hits_at(3.0, |_, sphere| sphere.radius = LEAST);
    hits_at(3.0, |_, sphere| sphere.radius = f32::MIN_POSITIVE.next_down());
    misses(|ray, sphere| (ray.origin.x, sphere.radius) = (1.0, LEAST));
}

#[test]
fn empty_interval() {
    misses(|ray, _| (ray.t_min, ray.t_max) = (5.0, 1.0));
    misses(|ray, _| (ray.t_min, ray.t_max) = (INF, -INF));
    misses(|ray, _| (ray.t_min, ray.t_max) = (2.0_f32.next_up(), 2.0));
}

#[test]
fn interval_of_one_number() {
    hits_at(2.0, |ray, _| (ray.t_min, ray.t_max) = (2.0, 2.0));
    hits_at(4.0, |ray, _| (ray.t_min, ray.t_max) = (4.0, 4.0));
    misses(|ray, _| (ray.t_min, ray.t_max) = (3.0, 3.0));
}

#[test]
fn interval_closed_at_both_ends() {
    hits_at(2.0, |ray, _| ray.t_max = 2.0);
    misses(|ray, _| ray.t_max = 2.0_f32.next_down());
    hits_at(4.0, |ray, _| ray.t_min = 2.0_f32.next_up());
    hits_at(4.0, |ray, _| ray.t_min = 4.0);
    misses(|ray, _| ray.t_min = 4.0_f32.next_up());
}

#[test]
fn nan_bounds() {
    misses(|ray, _| ray.t_min = NAN);
    misses(|ray, _| ray.t_max = NAN);
    misses(|ray, _| (ray.t_min, ray.t_max) = (NAN, NAN));
    misses(|ray, _| (ray.t_min, ray.t_max) = (-INF, -NAN));
}

#[test]
fn infinite_bounds() {
    hits_at(2.0, |ray, _| (ray.t_min, ray.t_max) = (-INF, INF));
    misses(|ray, _| (ray.t_min, ray.t_max) = (INF, INF));
    misses(|ray, _| (ray.t_min, ray.t_max) = (-INF, -INF));
}

#[test]
fn hits_behind_the_origin() {
    let behind = |ray: &mut Ray| ray.origin.z = 3.0;
    misses(|ray, _| behind(ray));
    hits_at(-4.0, |ray, _| {
        behind(ray);
        ray.t_min = -INF;
    });
    hits_at(-2.0, |ray, _| {
        behind(ray);
        ray.t_min = -3.0;
    });
}

#[test]
fn tangent() {
    hits_at(3.0, |ray, _| ray.origin.x = 1.0);
    misses(|ray, sphere| (ray.origin.x, sphere.radius) = (2.0, 1.0));
    // 3-4-5, away from the axes: p = (3, 4, 3), |d x p| = 5.
    hits_at(3.0, |ray, sphere| {
        (ray.origin, sphere.radius) = (Vec3::new(3.0, 4.0, -3.0), 5.0);
    });
}

#[test]
fn origin_on_the_surface() {
    // Looking in, out, and along.
    hits_at(0.0, |ray, _| ray.origin = -Vec3::Z);
    hits_at(2.0, |ray, _| (ray.origin, ray.t_min) = (-Vec3::Z, LEAST));
    hits_at(0.0, |ray, _| ray.origin = Vec3::Z);
    misses(|ray, _| (ray.origin, ray.t_min) = (Vec3::Z, LEAST));
    hits_at(0.0, |ray, _| ray.origin = Vec3::X);
    misses(|ray, _| (ray.origin, ray.t_min) = (Vec3::X, LEAST));
}

#[test]
fn zero_has_no_sign() {
    // Along the surface from where it starts: b and the root are -0 for some signs of zeros.
    let zeros = [0.0, -0.0];
    for origin in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y] {
        for (x, y, z) in [(0, 0, 1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, 1.0)]
            .into_iter()
            .flat_map(|(x, y, z)| [(x, y, z), (x, y, -z)])
        {
            let direction = Vec3::new(zeros[x], zeros[y], z);
            let case = straight(|ray, _| (ray.origin, ray.direction) = (origin, direction));
            answers(&case, Some(0.0));
            for door in Door::references() {
                let roots = (door.roots)(&case.ray, &case.sphere).expect("a tangent");
                assert_eq!(roots.map(f32::to_bits), [0, 0], "{}: {case:?}", door.tier);
            }
        }
    }
    hits_at(0.0, |ray, _| (ray.origin, ray.t_max) = (-Vec3::Z, -0.0));
    hits_at(0.0, |ray, _| (ray.origin, ray.t_min) = (Vec3::Z, -0.0));
}

#[test]
fn inside_meets_the_far_side() {
    hits_at(1.0, |ray, _| ray.origin = Vec3::ZERO);
    hits_at(0.5, |ray, _| ray.origin = Vec3::new(0.0, 0.0, 0.5));
    misses(|ray, _| (ray.origin, ray.t_max) = (Vec3::ZERO, 0.5));
    hits_at(-1.0, |ray, _| (ray.origin, ray.t_min) = (Vec3::ZERO, -INF));
}

#[test]
fn directions_of_any_length() {
    for exponent in [-20, -8, 8, 20] {
        let length = 2.0_f32.powi(exponent);
        hits_at(2.0 / length, |ray, _| ray.direction *= length);
    }
}

#[test]
fn both_roots_whatever_the_interval() {
    for door in Door::references() {
        let interval = straight(|ray, _| (ray.t_min, ray.t_max) = (NAN, -7.0));
        let roots = (door.roots)(&interval.ray, &interval.sphere);
        assert_eq!(roots, Some([2.0, 4.0]), "{}", door.tier);
        let wide = straight(|ray, _| ray.origin.x = 2.0);
        assert_eq!((door.roots)(&wide.ray, &wide.sphere), None, "{}", door.tier);
        let invalid = straight(|_, sphere| sphere.radius = -1.0);
        assert_eq!((door.roots)(&invalid.ray, &invalid.sphere), None, "{}", door.tier);
        let invalid = straight(|ray, _| ray.direction = Vec3::ZERO);
        assert_eq!((door.roots)(&invalid.ray, &invalid.sphere), None, "{}", door.tier);
    }
}

/// Every pair of places with every pair of special numbers: nothing panics, all widths agree, and
/// what rule 1 forbids is not hit.
#[test]
fn special_numbers_in_any_two_places() {
    for first in 0..Case::NUMBERS {
        for second in first + 1..Case::NUMBERS {
            let pair = |index: usize| {
                let mut numbers = STRAIGHT.numbers();
                numbers[first] = SPECIALS[index / SPECIALS.len()];
                numbers[second] = SPECIALS[index % SPECIALS.len()];
                Case::from_numbers(numbers)
            };
            let cases: Vec<Case> = (0..SPECIALS.len() * SPECIALS.len()).map(pair).collect();
            for door in DOORS {
                let ts = (door.pairs)(&cases);
                let reference = (door.reference().pairs)(&cases);
                for ((case, t), reference) in cases.iter().zip(ts).zip(reference) {
                    assert_eq!(t.map(f32::to_bits), reference.map(f32::to_bits), "{case:?}");
                    let Some(t) = t else { continue };
                    let valid = oracle::discriminant_sign(&case.ray, &case.sphere).is_some();
                    assert!(valid, "{}: {case:?}", door.tier);
                    let within = case.ray.t_min <= t && t <= case.ray.t_max && t.is_finite();
                    assert!(within && t.to_bits() != 0x8000_0000, "{}: {case:?}", door.tier);
                }
            }
        }
    }
}
