//! The oracle against cases worked by hand, a second derivation, and the vectors of another hand.
//!
//! The second derivation uses no square root and no division. By the signs of f(m) = |m d - p|^2 -
//! r^2 and g(m) = d.(m d - p) at a number m it tells on which side of m a root lies. So it finds,
//! by halving, the one `f32` whose rounding interval holds the root.

use num_bigint::{BigInt, Sign};
use spherule_kernel::{Hit, Ray, Sphere, Tier, Vec3, roots};
use spherule_referee::case::Case;
use spherule_referee::families::FAMILIES;
use spherule_referee::random::power_of_two;
use spherule_referee::ulp;
use spherule_tests::oracle::{self, dot, root_bits, units, units3};
use spherule_tests::vectors;
use std::cmp::Ordering;

/// From (0, 0, -3) upwards to the sphere of radius 1 at zero: roots 2 and 4.
fn straight() -> Case {
    Case {
        ray: Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z),
        sphere: Sphere { center: Vec3::ZERO, radius: 1.0 },
    }
}

fn intersect(case: &Case) -> Option<f32> {
    oracle::intersect(&case.ray, &case.sphere)
}

#[test]
fn invalid_input_hits_nothing() {
    for which in 0..Case::NUMBERS {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut numbers = straight().numbers();
            numbers[which] = value;
            let case = Case::from_numbers(numbers);
            let bound = which == 6 || which == 7;
            let hit = (which == 6 && value == f32::NEG_INFINITY)
                || (which == 7 && value == f32::INFINITY);
            assert_eq!(intersect(&case).is_some(), hit, "{case:?}");
            assert_eq!(oracle::meets(&case.ray, &case.sphere), bound, "{case:?}");
        }
    }
}

#[test]
fn signs_of_a_tangent_and_an_ulp_beside_it() {
    let mut case = straight();
    case.ray.origin.x = 1.0;
    assert_eq!(oracle::discriminant_sign(&case.ray, &case.sphere), Some(Ordering::Equal));
    case.sphere.radius = 1.0_f32.next_down();
    assert_eq!(oracle::discriminant_sign(&case.ray, &case.sphere), Some(Ordering::Less));
}

/// Tangents of d = (1, 0, 0) at t = c - o, which needs more than 24 bits.
#[test]
fn ties_are_told_and_go_to_even() {
    let million = 16_777_216.0;
    // The last bit of the largest number is worth 2^104: from half of that on, the result is infinite.
    let half = power_of_two(103) as f32;
    for (c, o, root, is_tie) in [
        (million, -1.0, million, true),
        (million + 2.0, -1.0, million + 4.0, true),
        (-million, 1.0, -million, true),
        (-million - 2.0, 1.0, -million - 4.0, true),
        (million, -1.5, million + 2.0, false),
        (f32::MAX, -half, f32::INFINITY, true),
        (f32::MAX, -half.next_down(), f32::MAX, false),
        (-f32::MAX, half, f32::NEG_INFINITY, true),
    ] {
        let ray = Ray::new(Vec3::new(o, 1.0, 0.0), Vec3::X);
        let sphere = Sphere { center: Vec3::new(c, 0.0, 0.0), radius: 1.0 };
        let expected = Some([(root, is_tie); 2]);
        assert_eq!(oracle::roots_and_ties(&ray, &sphere), expected, "{c} {o}");
    }
}

/// Asserts that both the oracle and `Exact` find these roots, bit for bit.
fn are_the_roots(case: &Case, expected: Option<[f32; 2]>) {
    let Case { ray, sphere } = case;
    let found = [oracle::roots(ray, sphere), roots(Tier::Exact, ray, sphere)];
    let bits = found.map(root_bits);
    assert_eq!(bits, [root_bits(expected); 2], "{found:?}, not {expected:?}: {case:?}");
}

#[test]
fn both_roots_by_hand() {
    let two_to = |exponent| power_of_two(exponent) as f32;
    let (million, max, infinity) = (two_to(24), f32::MAX, f32::INFINITY);
    let (least, normal, half) = (two_to(-149), two_to(-126), two_to(103));
    let (up, down) = (f32::next_up, f32::next_down);
    // From (0, y, 0) along (d, 0, 0), and a sphere of radius r about (c, 0, 0).
    for (y, d, c, r, expected) in [
        (0.0, 1.0, 3.0, 1.0, Some([2.0, 4.0])),
        (0.0, -2.0, 3.0, 1.0, Some([-2.0, -1.0])),
        // A tangent, and an ulp beside it: r^2 - 1 is about 2^-22.
        (1.0, 1.0, 3.0, 1.0, Some([3.0, 3.0])),
        (1.0, 1.0, 3.0, down(1.0), None),
        (1.0, 1.0, 3.0, up(1.0), Some([3.0 - two_to(-11), 3.0 + two_to(-11)])),
        // A point.
        (0.0, 1.0, 3.0, 0.0, Some([3.0, 3.0])),
        (least, 1.0, 3.0, 0.0, None),
        (least, 1.0, 3.0, -0.0, None),
        (0.0, 2.0, 0.0, 0.0, Some([0.0, 0.0])),
        // Ties: 2^24 + 1 falls, 2^24 + 3 rises.
        (0.0, 1.0, million, 1.0, Some([million - 1.0, million])),
        (0.0, 1.0, million, 3.0, Some([million - 3.0, million + 4.0])),
        (0.0, 1.0, million + 4.0, 1.0, Some([million + 4.0, million + 4.0])),
        (0.0, 1.0, million + 4.0, 3.0, Some([million, million + 8.0])),
        (0.0, 1.0, -million, 1.0, Some([-million, 1.0 - million])),
        (0.0, 1.0, -million, 3.0, Some([-million - 4.0, 3.0 - million])),
        // A hair beside them: above 2^24 + 1, and 2^-128 / 6 below 2^24 + 3.
        (0.0, 1.0, million, up(1.0), Some([million - 1.0, million + 2.0])),
        (two_to(-64), 1.0, million, 3.0, Some([million - 3.0, million + 2.0])),
        // -2^-150 and 2^-150 are ties with zero, which has no sign.
        (0.0, two_to(127), 1.0, 1.0, Some([0.0, normal])),
        (0.0, two_to(127), 1.0, up(1.0), Some([0.0, normal])),
        (0.0, -two_to(127), 1.0, up(1.0), Some([-normal, 0.0])),
        // Three halves of the least number are a tie as well.
        (0.0, two_to(127), 1.0, up(up(up(1.0))), Some([-2.0 * least, normal + 2.0 * least])),
        (0.0, 2.0, 3.0 * least, 0.0, Some([2.0 * least, 2.0 * least])),
        // Half of the least number is a tie with zero, of either sign; a little more is none.
        (0.0, 2.0, least, 0.0, Some([0.0, 0.0])),
        (0.0, 2.0, -least, 0.0, Some([0.0, 0.0])),
        (0.0, 1.9, least, 0.0, Some([least, least])),
        (0.0, 1.9, -least, 0.0, Some([-least, -least])),
        (0.0, max, least, 0.0, Some([0.0, 0.0])),
        (0.0, 1.0, -0.0, 0.0, Some([0.0, 0.0])),
        (0.0, 1.0, 3.0 * least, least, Some([2.0 * least, 4.0 * least])),
        (0.0, least, 3.0 * least, least, Some([2.0, 4.0])),
        // The largest number and half of what its last bit is worth: a tie, and infinity is even.
        (0.0, 1.0, max, half, Some([down(max), infinity])),
        (0.0, 1.0, max, down(half), Some([max, max])),
        (0.0, -1.0, max, half, Some([-infinity, -down(max)])),
        (0.0, -1.0, max, down(half), Some([-max, -max])),
        (0.0, least, max, 0.0, Some([infinity, infinity])),
    ] {
        let ray = Ray::new(Vec3::new(0.0, y, 0.0), Vec3::new(d, 0.0, 0.0));
        let sphere = Sphere { center: Vec3::new(c, 0.0, 0.0), radius: r };
        are_the_roots(&Case { ray, sphere }, expected);
    }
    // A tangent in no coordinate plane: p = 5 d + 9 (2, 1, -2), and |d x p|^2 = 9 * 9 * 81.
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 2.0));
    for (radius, expected) in [(27.0, Some([5.0, 5.0])), (down(27.0), None)] {
        let sphere = Sphere { center: Vec3::new(23.0, 19.0, -8.0), radius };
        are_the_roots(&Case { ray, sphere }, expected);
    }
}

#[test]
fn the_closest_of_many_and_the_lowest_of_equals() {
    let Case { ray, sphere } = straight();
    let behind = Sphere { center: Vec3::new(0.0, 0.0, -9.0), ..sphere };
    let further = Sphere { center: Vec3::new(0.0, 0.0, 1.0), ..sphere };
    let spheres = [behind, further, sphere, further, sphere];
    assert_eq!(oracle::closest(&ray, &spheres), Some(Hit { t: 2.0, sphere: 2 }));
    assert_eq!(oracle::closest(&ray, &spheres[..1]), None);
    assert_eq!(oracle::closest(&ray, &[]), None);
}

/// The number at place `place` among all `f32`, in units of 2^-149; infinity counts as 2^128.
fn number_at(place: i64) -> BigInt {
    if place.abs() == ulp::ordered(f32::INFINITY) {
        BigInt::from(place.signum()) << (128 + 149)
    } else {
        units(ulp::step(0.0, place))
    }
}

/// Tells on which side of a number one of the two roots is.
struct Sides {
    d: [BigInt; 3],
    p: [BigInt; 3],
    r: BigInt,
    far: bool,
}

impl Sides {
    /// How m, in units of 2^-150, compares with the root.
    fn compare(&self, m: &BigInt) -> Ordering {
        // With d in units of 2^-149, m d is in units of 2^-299: p and r are shifted to match.
        let q: [BigInt; 3] = std::array::from_fn(|i| m * &self.d[i] - (&self.p[i] << 150));
        let r: BigInt = &self.r << 150;
        let f = (dot(&q, &q) - &r * &r).sign();
        let g = dot(&self.d, &q).sign();
        // Between the roots f < 0. Outside f > 0, with g < 0 before the roots and g > 0 after.
        match (f, g) {
            (Sign::Minus, _) if self.far => Ordering::Less,
            (Sign::Minus, _) => Ordering::Greater,
            (Sign::Plus, Sign::Minus) => Ordering::Less,
            (Sign::Plus, _) => Ordering::Greater,
            (Sign::NoSign, Sign::Minus) if self.far => Ordering::Less,
            (Sign::NoSign, Sign::Plus) if !self.far => Ordering::Greater,
            (Sign::NoSign, _) => Ordering::Equal,
        }
    }

    /// The `f32` nearest to the root: the first whose upper midpoint is not below it.
    fn rounded(&self) -> f32 {
        let infinity = ulp::ordered(f32::INFINITY);
        let (mut low, mut high) = (-infinity, infinity);
        while low < high {
            let place = low + (high - low) / 2;
            // The sum in units of 2^-149 is the midpoint in units of 2^-150.
            let midpoint = number_at(place) + number_at(place + 1);
            let below = match self.compare(&midpoint) {
                Ordering::Less => true,
                Ordering::Greater => false,
                // A tie goes to the even significand, which is the even place.
                Ordering::Equal => place % 2 != 0,
            };
            if below { low = place + 1 } else { high = place }
        }
        ulp::step(0.0, low)
    }
}

/// Both roots by halving; the sign of D from |d x p|^2, not from b^2 - a c.
fn roots_by_halving(case: &Case) -> Option<[f32; 2]> {
    let Case { ray, sphere } = case;
    let numbers = [0, 1, 2, 3, 4, 5, 8, 9, 10, 11].map(|i| case.numbers()[i]);
    if numbers.iter().any(|x| !x.is_finite()) || sphere.radius < 0.0 || ray.direction == Vec3::ZERO
    {
        return None;
    }
    let (o, d, c) = (units3(ray.origin), units3(ray.direction), units3(sphere.center));
    let p: [BigInt; 3] = std::array::from_fn(|i| &c[i] - &o[i]);
    let r = units(sphere.radius);
    let x = [[1, 2], [2, 0], [0, 1]].map(|[i, j]| &d[i] * &p[j] - &d[j] * &p[i]);
    if dot(&d, &d) * &r * &r < dot(&x, &x) {
        return None;
    }
    let mut sides = Sides { d, p, r, far: false };
    let near = sides.rounded();
    sides.far = true;
    Some([near, sides.rounded()])
}

#[test]
fn agrees_with_halving_in_every_family() {
    for family in FAMILIES {
        for (index, case) in family.cases(150).enumerate() {
            let roots = root_bits(oracle::roots(&case.ray, &case.sphere));
            let halved = root_bits(roots_by_halving(&case));
            assert_eq!(roots, halved, "{family:?} {index}: {case:?}");
        }
    }
}

#[test]
fn agrees_with_every_vector() {
    let Some(vectors) = vectors::read() else { return };
    for (index, vector) in vectors.iter().enumerate() {
        let found = intersect(&vector.case).map(f32::to_bits);
        assert_eq!(found, vector.expected.map(f32::to_bits), "vector {index}: {:?}", vector.case);
    }
}
