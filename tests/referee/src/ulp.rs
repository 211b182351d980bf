//! Steps in ulp: from one single-precision number to its neighbours.

/// The place of `x` among all `f32`: neighbours are one apart, both zeros are 0, infinities come
/// after the largest numbers, NaN beyond.
#[must_use]
pub const fn ordered(x: f32) -> i64 {
    let magnitude = (x.to_bits() & 0x7fff_ffff) as i64;
    if x.is_sign_negative() { -magnitude } else { magnitude }
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

/// How many steps apart two numbers are, across zero too; zeros of either sign are one place.
#[must_use]
pub const fn ulp_between(a: f32, b: f32) -> u64 {
    ordered(a).abs_diff(ordered(b))
}
