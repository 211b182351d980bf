//! What moves lanes - masks, compression, another order, the greatest - against plain loops: every
//! width of `wide`, and the lanes that are chosen at run time at every level of this CPU. (What
//! computes is tested in `bit_for_bit.rs`, and by the traversals.)

use crate::lanes::{LaneArray, LaneMask, Lanes};
use crate::proofs::climb::Random;
use crate::{f32x4, f32x8, f32x16};
use std::vec::Vec;

fn moves<L: Lanes>(token: L::Token) {
    let mut random = Random(43);
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

        let sixteen_bits = bits as u32 & 0xffff;
        let ordered = L::bits_in_order(token, sixteen_bits, order);
        for place in 0..32 {
            let expected =
                if place < 16 { sixteen_bits >> (order >> (4 * place) & 15) & 1 } else { 0 };
            assert_eq!(ordered >> place & 1, expected, "{sixteen_bits:x} {order:x} {place}");
        }

        // Lanes compared and put in that order, some of them equal.
        let mut others = L::Array::filled(0.0);
        for (lane, number) in numbers.iter().enumerate() {
            let equal = random.bits() & 1 == 1;
            let other = f32::from_bits(random.bits() as u32);
            others.set(lane, if equal { *number } else { other });
        }
        let compared = lanes.le_in_order(L::load(token, &others), 0, order);
        for place in 0..16 {
            let lane = (order >> (4 * place) & 15) as usize;
            let expected = lane < L::COUNT && numbers[lane] <= others.get(lane);
            assert_eq!(compared >> place & 1 == 1, expected, "{order:x} {place}");
        }

        // In double precision and back, part by part.
        let mut back = L::Array::filled(0.0);
        for part in 0..L::PARTS {
            L::narrow(&mut back, part, lanes.widen(part));
        }
        for (number, found) in numbers.iter().zip(back.as_ref()) {
            assert!(number.to_bits() == found.to_bits() || number.is_nan() && found.is_nan());
        }

        // Parts of sixteen numbers, and lanes laid down anywhere.
        let sixteen: [f32; 16] = core::array::from_fn(|_| f32::from_bits(random.bits() as u32));
        let mut copy = [0.0; 16];
        for part in 0..16 / L::COUNT {
            L::load_part(token, &sixteen, part).store().put_part(&mut copy, part);
        }
        assert_eq!(copy.map(f32::to_bits), sixteen.map(f32::to_bits));
        let mut column = Vec::from([0.0; 20]);
        let at = random.below(24) as usize;
        let room = at + L::COUNT <= column.len();
        assert_eq!(array.put_at(&mut column, at), room);
        if room {
            for (found, number) in column[at..].iter().zip(&numbers) {
                assert_eq!(found.to_bits(), number.to_bits());
            }
        }

        assert_eq!(L::Array::taken_at(&column, at).is_some(), room);
        if let Some(taken) = L::Array::taken_at(&column, at) {
            let bits =
                |lanes: L::Array| lanes.as_ref().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(taken), bits(array));
        }

        // Rows become columns.
        let rows: [[f32; 8]; 16] =
            [[(); 8]; 16].map(|row| row.map(|()| f32::from_bits(random.bits() as u32)));
        let columns = L::columns(token, |row| rows[row]);
        for row in 0..L::COUNT {
            for column in 0..8 {
                let found = columns[column].get(row);
                assert_eq!(found.to_bits(), rows[row][column].to_bits(), "{row}, {column}");
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

#[cfg(feature = "std")]
#[test]
fn lanes_of_every_level() {
    use crate::lanes::dispatched::joined::Joined;
    use fearless_simd::{Simd, f32x4, f32x8, f32x16};
    // However many registers there are, on each CPU.
    fn sixteen<S: Simd>(token: S) {
        moves::<f32x16<S>>(token);
        moves::<Joined<f32x8<S>, 2>>(token);
        moves::<Joined<f32x4<S>, 4>>(token);
    }
    let widest = fearless_simd::Level::new();
    fearless_simd::dispatch!(widest, token => sixteen(token));
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(token) = widest.as_avx2() {
            sixteen(token);
        }
        if let Some(token) = widest.as_sse2() {
            sixteen(token);
        }
    }
}
