//! Random numbers, steps in ulp and printed cases are what they claim to be.

use spherule_referee::case::{Case, Hex};
use spherule_referee::random::{Random, dot, power_of_two};
use spherule_referee::ulp::step;

/// The first numbers of the reference implementation for seed 1234567.
#[test]
fn is_splitmix64() {
    let mut random = Random::seeded(1_234_567);
    let expected: [u64; 3] =
        [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
    assert_eq!([(); 3].map(|()| random.bits()), expected);
}

#[test]
fn both_signs_and_both_ends_occur() {
    let mut random = Random::new(1, 0);
    let draws: Vec<_> = (0..1000).map(|_| (random.sign(), random.integer(-3, 3))).collect();
    for sign in [-1.0, 1.0] {
        assert!(draws.iter().filter(|draw| draw.0 == sign).count() > 400);
    }
    for integer in -3..=3 {
        assert!(draws.iter().filter(|draw| draw.1 == integer).count() > 100);
    }
    assert!(draws.iter().all(|draw| (-3..=3).contains(&draw.1)));
}

#[test]
fn sizes_are_spread_over_the_powers_of_two() {
    let mut random = Random::new(2, 0);
    let mut counts = [0; 5];
    for _ in 0..5000 {
        let size = random.log_uniform(-2, 2);
        let power = (0..5).find(|&i| size < power_of_two(i - 1)).expect("below 2^3");
        counts[power as usize] += 1;
    }
    assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
}

#[test]
fn units_have_length_one_and_perpendiculars_no_part_along_them() {
    let mut random = Random::new(3, 0);
    let mut octants = [0; 8];
    for _ in 0..8000 {
        let u = random.unit();
        let v = random.perpendicular(u);
        assert!((dot(u, u) - 1.0).abs() < 1e-14 && (dot(v, v) - 1.0).abs() < 1e-14);
        assert!(dot(u, v).abs() < 1e-14);
        let octant = u.iter().fold(0, |bits, &x| bits << 1 | usize::from(x < 0.0));
        octants[octant] += 1;
    }
    assert!(octants.iter().all(|count| (850..1150).contains(count)), "{octants:?}");
}

#[test]
fn a_stream_is_its_own() {
    let first = |seed, index| Random::new(seed, index).bits();
    assert_eq!(first(1, 1), first(1, 1));
    assert_ne!(first(1, 1), first(1, 2));
    assert_ne!(first(1, 1), first(2, 1));
}

/// The numbers that place the benches' scenes.
#[test]
fn single_precision_draws_stay_in_their_ranges() {
    let mut random = Random::seeded(5);
    let (mut sum, mut square) = (0.0, 0.0);
    for _ in 0..4000 {
        let (number, normal) = (random.between(-3.0, 5.0), random.normal());
        assert!((-3.0..=5.0).contains(&number) && random.in_cube(2.0).abs().max_element() <= 2.0);
        assert!((random.direction().length() - 1.0).abs() < 1e-6);
        (sum, square) = (sum + normal, square + normal * normal);
    }
    assert!((sum / 4000.0).abs() < 0.1 && (square / 4000.0 - 1.0).abs() < 0.1, "{sum} {square}");
}

#[test]
fn steps_are_the_neighbours_of_the_standard_library() {
    for x in [1.0, -1.0, 0.0, f32::MIN_POSITIVE, -f32::from_bits(1), f32::MAX, 0.1] {
        assert_eq!(step(x, 1), x.next_up());
        assert_eq!(step(x, -1), x.next_down());
        assert_eq!(step(step(x, 5), -5), if x == f32::MAX { step(x, -4) } else { x });
    }
    assert_eq!(step(f32::MAX, 7), f32::INFINITY);
    assert!(step(f32::from_bits(1), -1).is_sign_positive());
}

#[test]
fn numbers_are_printed_in_hexadecimal_with_their_bits() {
    for (value, printed) in [
        (1.5, "0x1.800000p0 [3fc00000]"),
        (-0.0, "-0 [80000000]"),
        (f32::from_bits(1), "0x0.000002p-126 [00000001]"),
        (f32::MAX, "0x1.fffffep127 [7f7fffff]"),
        (f32::NEG_INFINITY, "-inf [ff800000]"),
        (f32::from_bits(0xffc0_0001), "-nan [ffc00001]"),
    ] {
        assert_eq!(Hex(value).to_string(), printed);
    }
}

#[test]
fn a_failing_case_can_be_read_and_pasted() {
    let numbers = [0.0, 0.0, -3.0, 0.0, 0.0, 1.0, 0.0, f32::INFINITY, 0.0, 0.0, 0.0, 1.0];
    let printed = format!("{:?}", Case::from_numbers(numbers));
    assert!(printed.contains("-0x1.800000p1 [c0400000]"), "{printed}");
    assert!(printed.contains("inf [7f800000]"), "{printed}");
}

#[test]
fn bits_go_round() {
    let bits = core::array::from_fn(|i| 0x7fc0_0000 ^ (i as u32 * 0x0101_0101));
    assert_eq!(Case::from_bits(bits).bits(), bits);
}
