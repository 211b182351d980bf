//! Prints numbers without the standard library's formatting, which takes as much flash as a tier.

use crate::platform::print;

/// Prints a number in decimal digits.
pub fn print_decimal(number: u32) {
    let (mut digits, mut rest, mut first) = ([b'0'; 10], number, 9);
    for place in (0..10).rev() {
        if let Some(digit) = digits.get_mut(place) {
            *digit = b'0' + (rest % 10) as u8;
        }
        if rest > 0 {
            first = place;
        }
        rest /= 10;
    }
    print(digits.get(first..).unwrap_or_default());
}

/// Prints a number in sixteen hexadecimal digits.
pub fn print_hexadecimal(number: u64) {
    for place in (0..16).rev() {
        let digit = (number >> (4 * place) & 15) as u8;
        print(&[if digit < 10 { b'0' + digit } else { b'a' - 10 + digit }]);
    }
}
