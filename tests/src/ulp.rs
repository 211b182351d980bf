//! Distance in ulp: how many single-precision numbers lie between two.

/// The place of `x` among all `f32`: neighbours are one apart, both zeros are 0, infinities come
/// after the largest numbers, NaN beyond.
#[must_use]
pub const fn ordered(x: f32) -> i64 {
    let magnitude = (x.to_bits() & 0x7fff_ffff) as i64;
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// How many `f32` steps apart `a` and `b` are, across zero too.
#[must_use]
pub const fn distance(a: f32, b: f32) -> u64 {
    ordered(a).abs_diff(ordered(b))
}

/// The number `steps` places up (or down) from `x`; no further than the infinities. Never `-0`.
///
/// # Panics
/// Never.
#[must_use]
pub fn step(x: f32, steps: i64) -> f32 {
    let infinity = ordered(f32::INFINITY);
    let place = ordered(x).saturating_add(steps).clamp(-infinity, infinity);
    let magnitude = f32::from_bits(u32::try_from(place.abs()).expect("at most infinity"));
    if place < 0 { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_apart() {
        let tiny = f32::from_bits(1);
        for (a, b, apart) in [
            (1.0, 1.0, 0),
            (1.0, 1.0 + f32::EPSILON, 1),
            (1.0, 1.0 - f32::EPSILON / 2.0, 1),
            (0.0, -0.0, 0),
            (0.0, tiny, 1),
            (-tiny, tiny, 2),
            (f32::MIN_POSITIVE, f32::from_bits(0x007f_ffff), 1),
            (f32::MAX, f32::INFINITY, 1),
            (1.0, 2.0, 1 << 23),
            (-1.0, 1.0, 2 * 0x3f80_0000),
        ] {
            assert_eq!(distance(a, b), apart, "{a:e} {b:e}");
            assert_eq!(distance(b, a), apart, "{b:e} {a:e}");
        }
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
}
