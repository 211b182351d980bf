//! Each degenerate input by its name, in every variant: in some lanes, and a hit, points and intervals in every lane.
//!
//! The numbers are small integers, so that every tier computes the roots exactly. So the tests
//! check only how the roots are judged.

use spherule_kernel::{Ray, Sphere, Tier, Vec3, Viewpoint, discriminant, roots};
use spherule_referee::case::Case;
use spherule_referee::strategies::SPECIALS;
use spherule_tests::oracle;
use spherule_tests::variants::{Layer, Memory, pair_layers, pairs_of, variants};

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

/// The first and the last lane of every width.
const ENDS: [usize; 4] = [0, 3, 7, 15];
const EVERY: [usize; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// Asserts that the case has this answer at the [`ENDS`] of every variant.
fn answers(case: &Case, expected: Option<f32>) {
    answers_in(&ENDS, case, expected);
}

/// Asserts that the case has this answer in these lanes of every variant, beside lanes that hit and
/// lanes that are full of NaN, and that the oracle agrees.
fn answers_in(lanes: &[usize], case: &Case, expected: Option<f32>) {
    assert_eq!(oracle::intersect(&case.ray, &case.sphere), expected, "the oracle: {case:?}");
    let bits = expected.map(f32::to_bits);
    let poison = Case::from_numbers([NAN; Case::NUMBERS]);
    Memory::new(&[case.sphere]).sorted(Viewpoint::Origin(case.ray.origin), |structures| {
        for neighbour in [STRAIGHT, poison] {
            for &lane in lanes {
                let mut cases = [neighbour; 16];
                cases[lane] = *case;
                let rays = cases.map(|case| case.ray);
                for variant in variants().filter(|variant| lane < variant.layer.lanes()) {
                    let place = format!("{variant:?}, lane {lane}: {case:?}");
                    let answers = variant.ask(structures, &rays);
                    let (hit, occluded) = (answers.hits[lane], answers.occluded[lane]);
                    assert_eq!(hit.map(|hit| hit.t.to_bits()), bits, "closest, {place}");
                    assert!(hit.is_none_or(|hit| hit.sphere == 0), "closest, {place}");
                    assert_eq!(occluded, expected.is_some(), "any, {place}");
                }
                for layer in pair_layers().filter(|layer| lane < layer.lanes()) {
                    for tier in Tier::ALL {
                        let t = pairs_of(tier, layer, &cases)[lane];
                        assert_eq!(t.map(f32::to_bits), bits, "{tier:?}, {layer:?}: {case:?}");
                    }
                }
            }
        }
    });
}

fn misses(change: impl Fn(&mut Ray, &mut Sphere)) {
    answers(&straight(change), None);
}

fn hits_at(t: f32, change: impl Fn(&mut Ray, &mut Sphere)) {
    answers(&straight(change), Some(t));
}

#[test]
fn a_common_hit() {
    answers_in(&EVERY, &STRAIGHT, Some(2.0));
}

#[test]
fn nan_and_infinity_in_origin_direction_and_center() {
    for value in [NAN, -NAN, INF, -INF] {
        for axis in 0..3 {
            misses(|ray, _| ray.origin[axis] = value);
            misses(|ray, _| ray.direction[axis] = value);
            misses(|_, sphere| sphere.center[axis] = value);
        }
        // The difference of centre and origin is NaN, or infinite.
        misses(|ray, sphere| (ray.origin.z, sphere.center.z) = (value, INF));
    }
}

#[test]
fn a_radius_that_is_none() {
    for radius in [NAN, -NAN, INF, -INF, -1.0, -LEAST, f32::MIN] {
        misses(|_, sphere| sphere.radius = radius);
    }
}

#[test]
fn direction_zero() {
    misses(|ray, _| ray.direction = Vec3::ZERO);
    misses(|ray, _| ray.direction = -Vec3::ZERO);
    // From the centre and from the surface.
    misses(|ray, _| (ray.direction, ray.origin) = (Vec3::ZERO, Vec3::ZERO));
    misses(|ray, _| (ray.direction, ray.origin) = (Vec3::ZERO, Vec3::X));
    misses(|ray, sphere| {
        (ray.direction, ray.origin, sphere.radius) = (Vec3::ZERO, Vec3::ZERO, 0.0);
    });
}

#[test]
fn radius_zero_is_a_point() {
    for zero in [0.0, -0.0] {
        for (origin, expected) in [
            (STRAIGHT.ray.origin, Some(3.0)),
            (Vec3::new(1.0, 0.0, -3.0), None),
            (Vec3::ZERO, Some(0.0)),
        ] {
            let point = straight(|ray, sphere| (ray.origin, sphere.radius) = (origin, zero));
            answers_in(&EVERY, &point, expected);
        }
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
fn intervals() {
    let (before, after) = (f32::next_down, f32::next_up);
    for (t_min, t_max, expected) in [
        // Empty intervals.
        (5.0, 1.0, None),
        (INF, -INF, None),
        (after(2.0), 2.0, None),
        // Intervals of one number.
        (2.0, 2.0, Some(2.0)),
        (4.0, 4.0, Some(4.0)),
        (3.0, 3.0, None),
        // Intervals are closed at both ends.
        (0.0, 2.0, Some(2.0)),
        (0.0, before(2.0), None),
        (after(2.0), 4.0, Some(4.0)),
        (after(2.0), before(4.0), None),
        (after(2.0), INF, Some(4.0)),
        (4.0, INF, Some(4.0)),
        (after(4.0), INF, None),
        // Intervals with an end that is NaN.
        (NAN, INF, None),
        (0.0, NAN, None),
        (NAN, NAN, None),
        (-INF, -NAN, None),
        (-INF, INF, Some(2.0)),
        (INF, INF, None),
        (-INF, -INF, None),
    ] {
        let case = straight(|ray, _| (ray.t_min, ray.t_max) = (t_min, t_max));
        answers_in(&EVERY, &case, expected);
    }
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
    // A 3-4-5 triangle, away from the axes: p = (3, 4, 3), |d x p| = 5.
    hits_at(3.0, |ray, sphere| {
        (ray.origin, sphere.radius) = (Vec3::new(3.0, 4.0, -3.0), 5.0);
    });
}

#[test]
fn origin_on_the_surface() {
    // The ray looks in, out, and along.
    hits_at(0.0, |ray, _| ray.origin = -Vec3::Z);
    hits_at(2.0, |ray, _| (ray.origin, ray.t_min) = (-Vec3::Z, LEAST));
    hits_at(0.0, |ray, _| ray.origin = Vec3::Z);
    misses(|ray, _| (ray.origin, ray.t_min) = (Vec3::Z, LEAST));
    hits_at(0.0, |ray, _| ray.origin = Vec3::X);
    misses(|ray, _| (ray.origin, ray.t_min) = (Vec3::X, LEAST));
}

#[test]
fn zero_has_no_sign() {
    // Along the surface from the ray's own origin: b and the root are -0 for some signs of zeros.
    for origin in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y] {
        for signs in 0..8 {
            let signed = |x: f32, place: u32| if signs >> place & 1 == 0 { x } else { -x };
            let direction = Vec3::new(signed(0.0, 0), signed(0.0, 1), signed(1.0, 2));
            let case = straight(|ray, _| (ray.origin, ray.direction) = (origin, direction));
            answers(&case, Some(0.0));
            for tier in Tier::ALL {
                let roots = roots(tier, &case.ray, &case.sphere).expect("a tangent");
                assert_eq!(roots.map(f32::to_bits), [0, 0], "{tier:?}: {case:?}");
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
    for (case, expected) in [
        (straight(|ray, _| (ray.t_min, ray.t_max) = (NAN, -7.0)), Some([2.0, 4.0])),
        (straight(|ray, _| ray.origin.x = 2.0), None),
        (straight(|_, sphere| sphere.radius = -1.0), None),
        (straight(|ray, _| ray.direction = Vec3::ZERO), None),
    ] {
        for tier in Tier::ALL {
            assert_eq!(roots(tier, &case.ray, &case.sphere), expected, "{tier:?}: {case:?}");
        }
    }
}

#[test]
fn the_discriminant_whatever_the_interval() {
    for (case, expected) in [
        (straight(|ray, _| (ray.t_min, ray.t_max) = (NAN, -7.0)), Some(1.0)),
        (straight(|ray, _| ray.origin.x = 2.0), Some(-3.0)),
        (straight(|_, sphere| sphere.radius = -1.0), None),
        (straight(|ray, _| ray.direction = Vec3::ZERO), None),
        (straight(|ray, _| ray.origin.y = NAN), None),
    ] {
        let found = discriminant(&case.ray, &case.sphere);
        assert_eq!(found.map(|(d, _)| d), expected, "{case:?}");
    }
    let Case { ray, sphere } = straight(|ray, _| (ray.t_min, ray.t_max) = (NAN, -7.0));
    let (_, bound) = discriminant(&ray, &sphere).expect("a valid line");
    assert!(bound > 0.0 && bound < 1e-14, "{bound}");
}

/// Every pair of places with every pair of special numbers: nothing panics, all widths agree, and
/// whatever rule 1 excludes is not hit.
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
            for tier in Tier::ALL {
                let reference = pairs_of(tier, Layer::Lanes(1), &cases);
                for layer in pair_layers() {
                    let bits = |t: &Option<f32>| t.map(f32::to_bits);
                    let ts = pairs_of(tier, layer, &cases);
                    let same = ts.iter().map(bits).eq(reference.iter().map(bits));
                    assert!(same, "{tier:?}, {layer:?}, places {first} and {second}");
                }
                for (case, t) in cases.iter().zip(reference) {
                    let Some(t) = t else { continue };
                    let valid = oracle::discriminant_sign(&case.ray, &case.sphere).is_some();
                    assert!(valid, "{tier:?}: {case:?}");
                    let within = case.ray.t_min <= t && t <= case.ray.t_max && t.is_finite();
                    assert!(within && t.to_bits() != 0x8000_0000, "{tier:?}: {case:?}");
                }
            }
        }
    }
}
