//! What moves lanes - masks, compression, another order, parts, the greatest - against plain loops: every
//! width of `wide`, and the lanes that are chosen at run time at every level of this CPU. (What
//! computes is tested in `bit_for_bit.rs`, and by the traversals.)

use crate::lanes::{DoubleLanes, LaneArray, LaneMask, Lanes};
use crate::proofs::climb::Random;
use crate::{f32x4, f32x8, f32x16};
use std::vec::Vec;

/// Any pattern, NaN and subnormals too: lanes are moved as they are.
fn any(random: &mut Random) -> f32 {
    f32::from_bits(random.bits() as u32)
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

fn moves<L: Lanes>(token: L::Token) {
    let mut random = Random(43);
    for _ in 0..5_000 {
        let marks = random.bits() as u32;
        let mask = marks & ((1_u64 << L::COUNT) - 1) as u32;
        let order = random.bits();
        let mut array = L::Array::filled(0.0);
        array.as_mut().fill_with(|| any(&mut random));
        let numbers = array.as_ref().to_vec();
        let lanes = L::load(token, &array);

        // Bits past the last lane are not looked at.
        assert_eq!(L::mask(token, marks).bits(), mask);
        let kept = (0..L::COUNT).filter(|lane| mask >> lane & 1 == 1).map(|lane| numbers[lane]);
        let kept: Vec<f32> = kept.collect();
        let compressed = lanes.compress(L::mask(token, mask)).store();
        assert_eq!(bits(&compressed.as_ref()[..kept.len()]), bits(&kept));

        let sixteen_bits = marks & 0xffff;
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
            let other = any(&mut random);
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
        let sixteen = [(); 16].map(|()| any(&mut random));
        let mut copy = [0.0; 16];
        for part in 0..16 / L::COUNT {
            L::load_part(token, &sixteen, part).store().put_part(&mut copy, part);
        }
        assert_eq!(bits(&copy), bits(&sixteen));
        let mut column = Vec::from([0.0; 20]);
        let at = random.below(24) as usize;
        let room = at + L::COUNT <= column.len();
        assert_eq!(array.put_at(&mut column, at), room);
        if room {
            assert_eq!(bits(&column[at..at + L::COUNT]), bits(&numbers));
        }
        let taken = L::Array::taken_at(&column, at);
        assert_eq!(taken.map(|taken| bits(taken.as_ref())), room.then(|| bits(&numbers)));

        // Rows become columns.
        let rows = [[(); 8]; 16].map(|row| row.map(|()| any(&mut random)));
        let columns = L::columns(token, |row| rows[row]);
        for (row, expected) in rows.iter().enumerate().take(L::COUNT) {
            let found = columns.map(|column| column.get(row));
            assert_eq!(bits(&found), bits(expected), "{row}");
        }

        if numbers.iter().all(|number| !number.is_nan()) {
            let greatest = numbers.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            assert_eq!(lanes.filter_greatest(), greatest);
        }
    }
}

/// A part past the last is one of the parts, and a bit past the last one of the bits, however large the number.
fn wraps<L: Lanes>(token: L::Token) {
    let sixteen = core::array::from_fn(|number| number as f32);
    let lanes = L::load_part(token, &sixteen, usize::MAX);
    let last = lanes.store();
    assert_eq!(last.as_ref(), &sixteen[16 - L::COUNT..]);
    let mut copy = [0.0; 16];
    last.put_part(&mut copy, usize::MAX);
    assert_eq!(copy[16 - L::COUNT..], sixteen[16 - L::COUNT..]);

    let mut back = L::Array::ZEROS;
    L::narrow(&mut back, usize::MAX, lanes.widen(usize::MAX));
    let from = L::COUNT - L::Double::COUNT;
    assert_eq!(back.as_ref()[from..], last.as_ref()[from..]);

    // The order that leaves each bit where it is, and a multiple of 32.
    let bits = lanes.le_in_order(lanes, usize::MAX - 31, 0xfedc_ba98_7654_3210);
    assert_eq!(bits, ((1_u64 << L::COUNT) - 1) as u32);
}

#[test]
fn lanes_of_the_build() {
    moves::<f32>(());
    wraps::<f32>(());
    moves::<f32x4>(());
    wraps::<f32x4>(());
    moves::<f32x8>(());
    wraps::<f32x8>(());
    moves::<f32x16>(());
    wraps::<f32x16>(());
}

#[cfg(feature = "std")]
#[test]
fn lanes_of_every_level() {
    use crate::lanes::dispatched::joined::Joined;
    use fearless_simd::{Simd, f32x4, f32x8, f32x16};
    // However many registers there are, on each CPU.
    fn sixteen<S: Simd>(token: S) {
        moves::<f32x16<S>>(token);
        wraps::<f32x16<S>>(token);
        moves::<Joined<f32x8<S>, 2>>(token);
        wraps::<Joined<f32x8<S>, 2>>(token);
        moves::<Joined<f32x4<S>, 4>>(token);
        wraps::<Joined<f32x4<S>, 4>>(token);
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
