//! What moves lanes - masks, compression, another order, the greatest - against plain loops: every
//! width of `wide`, and of the lanes that are chosen at run time at every level of this CPU. (What
//! computes is tested beside its source, and by the walks.)

use spherule_kernel::dispatch::{Level, LevelName};
use spherule_kernel::fearless_simd::{self, Simd, dispatch};
use spherule_kernel::{LaneMask, Lanes, f32x4, f32x8, f32x16};
use spherule_tests::random::Random;

fn moves<L: Lanes>(token: L::Token) {
    let mut random = Random::new(43, 0);
    for _ in 0..5_000 {
        let bits = random.bits();
        let mask = bits as u32 & ((1_u64 << L::COUNT) - 1) as u32;
        let order = random.bits();
        let mut array = L::Array::default();
        for element in array.as_mut() {
            // Any pattern, NaN and subnormals too: lanes are moved as they are.
            *element = f32::from_bits(random.bits() as u32);
        }
        let numbers = array.as_ref().to_vec();
        let lanes = L::load(token, &array);

        // Bits past the last lane are not looked at.
        assert_eq!(L::mask(token, bits as u32).bits(), mask);
        let kept = numbers.iter().enumerate().filter(|(lane, _)| mask >> lane & 1 == 1);
        let compressed = lanes.compress(L::mask(token, mask)).store();
        for ((_, expected), found) in kept.zip(compressed.as_ref()) {
            assert_eq!(expected.to_bits(), found.to_bits());
        }

        for (lane, found) in lanes.in_order(order).store().as_ref().iter().enumerate() {
            let from = (order >> (4 * lane)) as usize % 16;
            if from < L::COUNT {
                assert_eq!(found.to_bits(), numbers[from].to_bits(), "{order:x} {lane}");
            }
        }

        if numbers.iter().all(|number| !number.is_nan()) {
            let greatest = numbers.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            assert_eq!(lanes.filter_greatest(), greatest);
        }
    }
}

#[test]
fn lanes_of_the_build() {
    moves::<f32>(());
    moves::<f32x4>(());
    moves::<f32x8>(());
    moves::<f32x16>(());
}

fn all_widths<S: Simd>(token: S) {
    moves::<fearless_simd::f32x4<S>>(token);
    moves::<fearless_simd::f32x8<S>>(token);
    moves::<fearless_simd::f32x16<S>>(token);
}

#[test]
fn lanes_of_every_level() {
    let widest = fearless_simd::Level::new();
    dispatch!(widest, token => all_widths(token));
    let named = LevelName::ALL.into_iter().filter(|&name| Level::named(name).is_some());
    println!("levels: {:?}", named.collect::<Vec<_>>());
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(token) = widest.as_avx2() {
            all_widths(token);
        }
        if let Some(token) = widest.as_sse4_2() {
            all_widths(token);
        }
        if let Some(token) = widest.as_sse2() {
            all_widths(token);
        }
    }
}
