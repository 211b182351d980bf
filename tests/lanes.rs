//! What moves lanes - masks, compression, another order, the greatest - against plain loops, in
//! every width of `wide`. (What computes is tested beside its source, and by the traversals.)

use spherule_kernel::{LaneArray, LaneMask, Lanes, f32x4, f32x8, f32x16};
use spherule_tests::random::Random;

fn moves<L: Lanes>(token: L::Token) {
    let mut random = Random::new(43, 0);
    for _ in 0..5_000 {
        let bits = random.bits();
        let mask = bits as u32 & ((1_u64 << L::COUNT) - 1) as u32;
        let order = random.bits();
        let mut array = L::Array::filled(0.0);
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
