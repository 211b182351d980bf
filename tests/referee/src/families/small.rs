//! Integers of one digit: tangents and ties are common, and a failing case is readable.

use crate::case::Case;
use crate::random::Random;
use crate::ulp::step;
use spherule_kernel::{Ray, Sphere};

/// Small integers throughout, half of the directions along an axis, and common intervals.
pub(super) fn integers(random: &mut Random) -> Case {
    let mut point = |reach: i64| [(); 3].map(|()| random.integer(-reach, reach) as f32);
    let (origin, center) = (point(4), point(2));
    let mut direction = point(2);
    if random.one_in(2) || direction == [0.0; 3] {
        direction = [0.0; 3];
        direction[random.integer(0, 2) as usize] = random.pick(&[1.0, -1.0, 2.0, 3.0]);
    }
    let (t_min, t_max) = match random.integer(0, 5) {
        0 => (f32::NEG_INFINITY, f32::INFINITY),
        1 => {
            let low = random.integer(-3, 3) as f32;
            (low, low + random.integer(-1, 6) as f32)
        }
        _ => (0.0, f32::INFINITY),
    };
    let radius = random.integer(0, 5) as f32;
    let (origin, direction) = (origin.into(), direction.into());
    let ray = Ray { origin, direction, t_min, t_max };
    Case { ray, sphere: Sphere { center: center.into(), radius } }
}

/// The same, with one nonzero number up to two ulp off.
pub(super) fn near_integers(random: &mut Random) -> Case {
    let mut numbers = integers(random).numbers();
    let moved = |number: &f32| *number != 0.0 && number.is_finite();
    let places: Vec<usize> = (0..numbers.len()).filter(|&i| moved(&numbers[i])).collect();
    if !places.is_empty() {
        let place = random.pick(&places);
        numbers[place] = step(numbers[place], random.pick(&[-2, -1, 1, 2]));
    }
    Case::from_numbers(numbers)
}
