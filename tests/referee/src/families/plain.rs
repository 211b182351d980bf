//! Rays aimed at spheres of many sizes from many distances.

use crate::aim::{Aim, line_distance};
use crate::case::Case;
use crate::random::{Random, power_of_two};

fn ordinary_aim(random: &mut Random) -> Aim {
    let radius = random.log_uniform(-3, 2);
    Aim::ordinary(random, radius)
}

pub(super) fn ordinary(random: &mut Random) -> Case {
    ordinary_aim(random).case(random)
}

/// Distance / radius about 10^`DIGITS`.
pub(super) fn far<const DIGITS: u32>(random: &mut Random) -> Case {
    let aim = ordinary_aim(random);
    let distance = aim.radius * random.uniform(0.5, 2.0) * f64::from(10_u32.pow(DIGITS));
    Aim { distance, ..aim }.case(random)
}

/// The radius within 2^-6 to 2^-26 of the line's distance from the centre.
pub(super) fn grazing(random: &mut Random) -> Case {
    let aim = Aim { offset: random.uniform(0.2, 2.0), ..ordinary_aim(random) };
    let mut case = aim.case(random);
    let off = random.sign() * power_of_two(-random.integer(6, 26));
    case.sphere.radius = (line_distance(&case) * (1.0 + off)) as f32;
    case
}

/// Directions far from unit length, both ways.
pub(super) fn direction_length(random: &mut Random) -> Case {
    let aim = ordinary_aim(random);
    let exponent = random.integer(20, 120) * if random.one_in(2) { 1 } else { -1 };
    Aim { length: random.uniform(1.0, 2.0) * power_of_two(exponent), ..aim }.case(random)
}

/// All of it, a million units away from zero.
pub(super) fn translated(random: &mut Random) -> Case {
    let aim = ordinary_aim(random);
    Aim { origin: random.unit().map(|x| 1e6 * x), ..aim }.case(random)
}

/// Radii of 2^-93 to 2^-37: all as small, or seen from a common distance.
pub(super) fn tiny_radius(random: &mut Random) -> Case {
    let aim = ordinary_aim(random);
    let scale = power_of_two(-random.integer(40, 90));
    let radius = aim.radius * scale;
    let (origin, distance) = if random.one_in(2) {
        (aim.origin.map(|x| x * scale), aim.distance * scale)
    } else {
        ([0.0; 3], aim.distance)
    };
    Aim { origin, distance, radius, ..aim }.case(random)
}

/// Radii of 2^37 to 2^93: seen from as far, or from the surface of a planet.
pub(super) fn huge_radius(random: &mut Random) -> Case {
    let aim = ordinary_aim(random);
    let scale = power_of_two(random.integer(40, 90));
    let radius = aim.radius * scale;
    let distance =
        if random.one_in(2) { aim.distance * scale } else { random.uniform(-1.0, 1.0) * radius };
    Aim { distance, radius, ..aim }.case(random)
}
