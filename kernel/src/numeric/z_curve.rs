//! Places on a Z curve (Morton 1966): the bits of a cell's numbers along the axes, interleaved.

/// The bits of a number below 2^8, two zeros behind each.
pub(crate) const fn one_in_three(number: u32) -> u32 {
    let number = (number | number << 8) & 0x0000_f00f;
    let number = (number | number << 4) & 0x000c_30c3;
    (number | number << 2) & 0x0024_9249
}

/// The bits of a number below 2^8, a zero behind each.
pub(crate) const fn one_in_two(number: u32) -> u32 {
    let number = (number | number << 4) & 0x0f0f;
    let number = (number | number << 2) & 0x3333;
    (number | number << 1) & 0x5555
}

#[cfg(all(test, proofs))]
mod tests {
    use super::{one_in_three, one_in_two};

    #[test]
    fn every_bit_is_where_it_is_said_to_be() {
        for number in 0..256_u32 {
            let spread = |step| (0..8).map(|bit| (number >> bit & 1) << (step * bit)).sum();
            assert_eq!([one_in_two(number), one_in_three(number)], [2, 3].map(spread));
        }
    }
}
